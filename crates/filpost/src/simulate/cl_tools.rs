//! The tools that a CL file describes.

use std::collections::BTreeMap;

use fil_cl::{Reader, Record, Vocabulary, Word, record::kind, words as w};
use fil_machine::Unit;
use fil_machine::commons::Commons;
use fil_stock::{Tool, Tools, from_cutter, from_tool_data};

use crate::error::Error;
use crate::plot::ClText;
use crate::units;

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// The tools of a CL file.
#[derive(Clone, Debug, Default)]
pub struct ClTools {
    /// Those whose size it gives.
    pub tools: Tools,
    /// Why others can't be simulated.
    pub unknown: BTreeMap<u32, String>,
}

/// The tools that CUTTER, `$$-> CUTTER` and TLDATA of a CL file describe, by the number of the
/// tool change before or after them.
///
/// # Errors
/// What the CL reader refuses.
pub fn cl_tools(cl: &ClText<'_>, commons: &Commons) -> Result<ClTools, Error> {
    let known = units::known_before(cl.unit, None, commons).map_err(Error::Run)?;
    let mut reading = Reading {
        unit: known.map_or(1.0, |(unit, _)| mm_of(unit)),
        number: None,
        described: None,
        has_moved: true,
        found: ClTools::default(),
    };
    let mut reader = Reader::new(cl.text.bytes, cl.text.name, cl.options);
    let (mut vocabulary, mut record) = (Vocabulary::default(), Record::default());
    while reader.read(&mut vocabulary, &mut record).map_err(Error::Run)? {
        reading.take(&record);
    }
    Ok(reading.found)
}

fn mm_of(unit: Unit) -> f64 {
    if unit == Unit::Inch { INCH } else { 1.0 }
}

struct Reading {
    /// Millimetres of a length in the file.
    unit: f64,
    /// The tool in use.
    number: Option<u32>,
    /// The tool that was described last.
    described: Option<Result<Tool, String>>,
    /// A motion came since the tool was changed or described.
    has_moved: bool,
    found: ClTools,
}

impl Reading {
    fn take(&mut self, record: &Record) {
        match record.major {
            w::UNITS | w::UNIT if record.has(w::MM) => self.unit = 1.0,
            w::UNITS | w::UNIT => self.unit = INCH,
            w::LOADTL | w::TURRET => self.change(record),
            w::LOAD if record.has(w::TOOL) => self.change(record),
            _ if record.kind == kind::MOTION => self.has_moved = true,
            _ if !record.tool_values().is_empty() => self.describe(record),
            _ => {}
        }
    }

    /// A description before a tool change is that of the new tool, unless a motion came between.
    fn change(&mut self, record: &Record) {
        let number = record.data.iter().find_map(|word| match word {
            Word::Number(number) => Some(*number),
            _ => None,
        });
        self.number = number.filter(|number| *number >= 0.0).map(|number| number as u32);
        if self.has_moved {
            self.described = None;
        }
        self.has_moved = false;
        self.note();
    }

    fn describe(&mut self, record: &Record) {
        let is_data = record.major == w::TLDATA;
        let values: Vec<f64> = record
            .tool_values()
            .iter()
            .map_while(|word| match word {
                Word::Number(value) => Some(*value),
                _ => None,
            })
            .collect();
        // Behind TLDATA the reader gives its diameter once more.
        if values.len() == 1 && self.described.is_some() && !self.has_moved {
            return;
        }
        let drills = is_data && record.has(w::DRILL);
        let made = if is_data {
            from_tool_data(&values, self.unit, drills)
        } else {
            from_cutter(&values, self.unit)
        };
        self.described = Some(made);
        if self.has_moved {
            // It is that of the next tool, unless the tool stays.
            self.has_moved = false;
        }
        self.note();
    }

    /// Gives the tool in use its description. The first one counts.
    fn note(&mut self) {
        let (Some(number), Some(described)) = (self.number, &self.described) else { return };
        if self.found.tools.contains_key(&number) || self.found.unknown.contains_key(&number) {
            return;
        }
        match described {
            Ok(tool) => drop(self.found.tools.insert(number, tool.clone())),
            Err(why) => drop(self.found.unknown.insert(number, why.clone())),
        }
    }
}
