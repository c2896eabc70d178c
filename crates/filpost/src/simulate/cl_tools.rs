//! The tools that a CL file describes.

use std::collections::BTreeMap;

use fil_cl::{Reader, Record, Vocabulary, Word, record::kind, words as w};
use fil_machine::Unit;
use fil_machine::commons::Commons;
use fil_nc::dialect::Dialect;
use fil_stock::{Tool, Tools, from_cutter, from_tool_data};

use crate::error::Error;
use crate::plot::ClText;
use crate::units;

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// The tools of a CL file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct ClTools {
    /// Those whose size it gives, by their numbers; lengths in millimeters.
    pub tools: Tools,
    /// Why others can't be simulated, by their numbers.
    pub unknown: BTreeMap<u32, String>,
}

/// The tools that CUTTER, `$$-> CUTTER` and TLDATA of a CL file describe, by the number of the
/// tool change before or after them.
///
/// # Errors
/// What the CL reader refuses.
pub fn cl_tools(cl: &ClText<'_>, commons: &Commons) -> Result<ClTools, Error> {
    if Dialect::new(commons).map_err(Error::Run)?.is_lathe() {
        // CUTTER of a lathe's CL file is a nose: how the insert lies is not in the file.
        return Ok(ClTools::default());
    }
    let mut reader = Reader::new(cl.text.bytes, cl.text.name, cl.options);
    let told = reader.told_unit().map(units::of_word);
    let known = units::known_before(cl.unit, told, commons).map_err(Error::Run)?;
    let mut reading = Reading {
        unit: known.map(|(unit, _)| mm_of(unit)),
        number: None,
        data_diameter: None,
        described: None,
        has_moved: true,
        found: ClTools::default(),
    };
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
    /// Millimetres of a length in the file; `None` while nothing says it.
    unit: Option<f64>,
    /// The tool in use.
    number: Option<u32>,
    /// The diameter of a TLDATA right before.
    data_diameter: Option<f64>,
    /// The tool that was described last.
    described: Option<Result<Tool, String>>,
    /// A motion came since the tool was changed or described.
    has_moved: bool,
    found: ClTools,
}

impl Reading {
    fn take(&mut self, record: &Record) {
        match record.major {
            w::UNITS | w::UNIT if record.has(w::MM) => self.unit = Some(1.0),
            w::UNITS | w::UNIT => self.unit = Some(INCH),
            w::LOADTL | w::TURRET => self.change(record),
            w::LOAD if record.has(w::TOOL) => self.change(record),
            _ if record.kind == kind::MOTION => {
                self.note();
                self.has_moved = true;
            }
            _ if !record.tool_values().is_empty() => self.describe(record),
            _ => {}
        }
    }

    /// A description before a tool change is that of the new tool, unless a motion came between.
    fn change(&mut self, record: &Record) {
        let number = record.first_number();
        self.number = number.filter(|number| *number >= 0.0).map(|number| number as u32);
        if self.has_moved {
            self.described = None;
        }
        self.has_moved = false;
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
        let is_again = values.len() == 1 && self.data_diameter == values.first().copied();
        self.data_diameter = values.first().copied().filter(|_| is_data);
        if is_again && !is_data {
            return;
        }
        let drills = is_data && record.has(w::DRILL);
        let made = match self.unit {
            None => Err("the unit of the CL file is not known (--units)".to_string()),
            Some(unit) if is_data => from_tool_data(&values, unit, drills),
            Some(unit) => from_cutter(&values, unit),
        };
        self.described = Some(made);
        // Before a tool change it is that of the next tool.
        self.has_moved = false;
    }

    /// Gives the tool that moves its description. The first one counts.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Text;
    use fil_cl::reader::Options;
    use fil_machine::locations::default_commons;
    use fil_stock::{Body, Shape};

    /// Diameters by number.
    fn diameters(cl: &str) -> Vec<(u32, f64)> {
        let text = Text { name: "part.ncl", bytes: cl.as_bytes() };
        let cl = ClText { text, options: Options::default(), unit: None };
        let found = cl_tools(&cl, &default_commons()).expect("tools").tools;
        let diameter = |(number, tool): (u32, Tool)| match tool.body {
            Body::Shape(shape) => (number, 2.0 * shape.radius()),
            Body::Insert(insert) => panic!("{insert:?}"),
        };
        found.into_iter().map(diameter).collect()
    }

    #[test]
    fn a_description_is_of_the_tool_that_moves_next() {
        let before = "UNITS / MM\nLOADTL / 1\nGOTO / 1, 2, 3\nCUTTER / 6\nLOADTL / 2\nGOTO / 1, 2, 3\nFINI\n";
        assert_eq!(diameters(before), [(2, 6.0)]);
        let unused =
            "UNITS / MM\nLOADTL / 1\nCUTTER / 10\nLOADTL / 2\nCUTTER / 6\nGOTO / 1, 2, 3\nFINI\n";
        assert_eq!(diameters(unused), [(2, 6.0)]);
        let behind = "UNITS / INCHES\nLOADTL / 1\nCUTTER / 0.5, 0.1\nGOTO / 1, 2, 3\nFINI\n";
        assert_eq!(diameters(behind), [(1, 12.7)]);
    }

    #[test]
    fn without_a_unit_no_tool_has_a_size() {
        assert!(diameters("LOADTL / 1\nCUTTER / 10\nGOTO / 1, 2, 3\nFINI\n").is_empty());
    }

    #[test]
    fn the_values_of_nx_come_with_their_corner() {
        let text = "TLDATA/MILL,10.0,2.0,50.0,0.0,0.0\nLOAD/TOOL,1\nGOTO/1.0,2.0,3.0\n";
        let text = Text { name: "part.cls", bytes: text.as_bytes() };
        let cl = ClText { text, options: Options::default(), unit: Some(Unit::Mm) };
        let found = cl_tools(&cl, &default_commons()).expect("tools").tools;
        assert_eq!(found[&1].body, Body::Shape(Shape::Round { radius: 5.0, corner: 2.0 }));
    }
}
