//! What a first pass over the CL file finds: the program's totals, its tools and operations.
//!
//! A header asks for them before the motions come, so the CL file is posted twice. The first
//! pass writes nothing and answers every question with 1; the second one answers with what
//! the first has counted, counts again, and is refused where it comes to something else.

use fil_cl::operation_sign::{NAME_OF_OPERATION, Sign};
use fil_cl::{Record, words};
use fil_machine::Unit;
use fil_machine::modes::INCH;
use fil_vm::{TotalsOf, TotalsText, TotalsWord};

use crate::tally::{Motion, Totals};

const SECONDS_IN_A_MINUTE: f64 = 60.0;

/// Operations and tool changes that are kept.
const MOST: usize = 100_000;

/// What a record came to.
pub(crate) struct Counted {
    /// Its motion.
    pub motion: Option<Motion>,
    /// Seconds of its dwell or tool change.
    pub other_seconds: f64,
    /// Diameter of the tool in use, as the CL file gives it.
    pub diameter: Option<f64>,
    /// Its corner radius.
    pub corner: Option<f64>,
    /// The unit of the CL file.
    pub unit: Option<Unit>,
    /// A matrix moves the points of the CL file.
    pub is_moved: bool,
    /// It writes words of Z, as a script does for a cycle of its own.
    pub writes_z: bool,
}

/// What was counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Overview {
    total: Totals,
    /// Each tool once.
    tools: Vec<ToolEntry>,
    operations: Vec<Operation>,
    /// Number of the CL record and of the tool, for each tool change.
    changes: Vec<(u32, f64)>,
    part: Option<String>,
    unit: Option<Unit>,
    /// There are more operations or tool changes than are kept.
    too_many: bool,
    /// What starts operations in this file.
    level: Sign,
    pending: Pending,
    /// Entry of the tool in use.
    tool: Option<usize>,
}

/// A tool with all that is done with it.
#[derive(Clone, Debug, Default, PartialEq)]
struct ToolEntry {
    number: f64,
    diameter: Option<f64>,
    corner: Option<f64>,
    length: Option<f64>,
    name: Option<String>,
    totals: Totals,
    /// Its lowest Z may not be that of its points: it cuts whole threads, a script writes axis words
    /// for it, or a matrix moves the points.
    other_z: bool,
}

impl ToolEntry {
    /// `T1 D=12. CR=0. - ZMIN=-5. - NAME`, without what the CL file does not say.
    fn line(&self) -> String {
        let measure = |name: &str, value: Option<f64>| {
            value.map_or(String::new(), |value| format!(" {name}={}", length(value)))
        };
        let mut line = format!("T{}", self.number);
        line.push_str(&measure("D", self.diameter));
        line.push_str(&measure("CR", self.corner));
        if let Some(reach) = self.totals.reach.as_ref().filter(|_| !self.other_z) {
            line.push_str(&format!(" - ZMIN={}", length(reach.min[2])));
        }
        if let Some(name) = &self.name {
            line.push_str(&format!(" - {name}"));
        }
        line
    }
}

/// A length with a point and at most four decimals: `12.`, `-0.5`.
fn length(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0');
    if text == "-0." { "0.".into() } else { text.into() }
}

/// What is done from one sign of the CAM system to the next.
#[derive(Clone, Debug, Default, PartialEq)]
struct Operation {
    name: Option<String>,
    feature: Option<f64>,
    tool: Option<f64>,
    totals: Totals,
}

/// What came since the last motion.
#[derive(Clone, Debug, Default, PartialEq)]
struct Pending {
    sign: Sign,
    name: Option<String>,
    feature: Option<f64>,
    tool_name: Option<String>,
    seconds: f64,
}

impl Overview {
    /// Looks at a record as it is read.
    pub fn note(&mut self, record: &Record) {
        match record.major {
            words::PARTNO if self.part.is_none() => {
                self.part = Some(record.text.trim().to_string());
            }
            words::FEATNO => {
                self.sign(Sign::Named);
                self.pending.name = None;
                self.pending.feature = record.first_number();
            }
            words::TOOL_PATH => self.tool_path(record.text.trim()),
            words::TPRINT => self.pending.tool_name = named(&record.text),
            words::PPRINT => self.message(record.text.trim()),
            _ => {}
        }
    }

    fn sign(&mut self, sign: Sign) {
        self.pending.sign = self.pending.sign.max(sign);
    }

    /// NX: `TOOL PATH/NAME,TOOL,NAME OF THE TOOL`
    fn tool_path(&mut self, text: &str) {
        self.sign(Sign::Named);
        let mut parts = text.splitn(3, ',');
        self.pending.name = parts.next().and_then(named);
        self.pending.tool_name = parts.nth(1).and_then(named);
    }

    fn message(&mut self, text: &str) {
        if let Some(name) = text.strip_prefix(NAME_OF_OPERATION) {
            self.sign(Sign::Named);
            self.pending.name = named(name.trim_start().trim_start_matches(':'));
        } else {
            self.sign(Sign::Message);
            if self.pending.name.is_none() {
                self.pending.name = named(text);
            }
        }
    }

    /// Counts a record that the post has carried out while the CL record of that number was
    /// the current one.
    pub fn count(&mut self, record: &Record, cl_record: u32, counted: &Counted) {
        self.unit = counted.unit;
        let seconds = counted.other_seconds;
        if record.takes_tool() {
            self.change_tool(record, cl_record);
        }
        let is_thread = matches!(record.major, words::THREAD | words::OP);
        let has_other_z = match counted.motion {
            None => is_thread || counted.writes_z,
            Some(_) => counted.is_moved,
        };
        if let Some(tool) = self.tool.filter(|_| has_other_z) {
            self.tools[tool].other_z = true;
        }
        if seconds > 0.0 {
            self.total.other_seconds += seconds;
            if let Some(tool) = self.tool {
                self.tools[tool].totals.other_seconds += seconds;
            }
            self.pending.seconds += seconds;
        }
        if let Some(motion) = &counted.motion {
            self.move_to(motion, counted);
        }
    }

    fn change_tool(&mut self, record: &Record, cl_record: u32) {
        self.sign(Sign::ToolChange);
        let Some(number) = record.first_number() else {
            self.tool = None;
            return;
        };
        if self.changes.len() < MOST {
            self.changes.push((cl_record, number));
        } else {
            self.too_many = true;
        }
        let known = self.tools.iter().position(|entry| entry.number == number);
        let index = known.unwrap_or_else(|| {
            self.tools.push(ToolEntry { number, ..ToolEntry::default() });
            self.tools.len() - 1
        });
        let entry = &mut self.tools[index];
        entry.length = entry.length.or(record.number_after(words::LENGTH));
        if entry.name.is_none() {
            entry.name = self.pending.tool_name.take();
        }
        self.tool = Some(index);
    }

    fn move_to(&mut self, motion: &Motion, counted: &Counted) {
        let pending = std::mem::take(&mut self.pending);
        if let Some(tool) = self.tool {
            let entry = &mut self.tools[tool];
            entry.diameter = entry.diameter.or(counted.diameter);
            entry.corner = entry.corner.or(counted.corner);
            entry.name = entry.name.take().or(pending.tool_name.clone());
            entry.totals.add(motion);
        }
        self.total.add(motion);
        let seconds = pending.seconds;
        self.begin_operation(pending);
        if let Some(operation) = self.operations.last_mut() {
            operation.totals.other_seconds += seconds;
            operation.totals.add(motion);
        }
    }

    /// A new operation, where the signs since the last motion start one.
    fn begin_operation(&mut self, pending: Pending) {
        if pending.sign > self.level && self.level != Sign::None {
            self.join_operations();
        }
        self.level = self.level.max(pending.sign);
        let begins = pending.sign == self.level && pending.sign != Sign::None;
        if !begins && !self.operations.is_empty() {
            return;
        }
        if self.operations.len() >= MOST {
            self.too_many = true;
            return;
        }
        let tool = self.tool.map(|index| self.tools[index].number);
        let Pending { name, feature, .. } = pending;
        self.operations.push(Operation { name, feature, tool, totals: Totals::default() });
    }

    /// What weaker signs divided before the first of a stronger kind is one operation.
    fn join_operations(&mut self) {
        let mut rest = std::mem::take(&mut self.operations).into_iter();
        if let Some(mut first) = rest.next() {
            rest.for_each(|other| first.totals.join(&other.totals));
            self.operations.push(first);
        }
    }

    /// The tools in the order of their first change, a line each: number, diameter, corner radius,
    /// lowest Z, name.
    pub fn tool_list(&self) -> Vec<String> {
        self.tools.iter().map(ToolEntry::line).collect()
    }

    /// A number that a script asks for.
    ///
    /// # Errors
    /// A sentence, for an entry that there is not.
    pub fn number(&self, of: TotalsOf, word: TotalsWord) -> Result<Option<f64>, String> {
        let totals = match of {
            TotalsOf::Program => &self.total,
            TotalsOf::Tool(index) => &self.tool_entry(index)?.totals,
            TotalsOf::Operation(index) => &self.operation(index)?.totals,
        };
        let timed = |seconds: f64| (totals.untimed == 0).then_some(seconds / SECONDS_IN_A_MINUTE);
        let number = match word {
            TotalsWord::Tools => Some(self.tools.len() as f64),
            TotalsWord::Operations => {
                self.check_room()?;
                Some(self.operations.len() as f64)
            }
            TotalsWord::Units => self.unit.map(|unit| match unit {
                Unit::Mm => 1.0,
                Unit::Inch => INCH,
            }),
            TotalsWord::Time => timed(totals.seconds()),
            TotalsWord::CuttingTime => timed(totals.cutting_seconds),
            TotalsWord::RapidTime => timed(totals.rapid_seconds),
            TotalsWord::CuttingLength => Some(totals.cutting_length),
            TotalsWord::RapidLength => Some(totals.rapid_length),
            TotalsWord::Extent(axis, largest) => totals
                .reach
                .as_ref()
                .map(|found| if largest { found.max[axis] } else { found.min[axis] }),
            word => self.of_entry(of, word)?,
        };
        Ok(number)
    }

    /// What tools and operations have besides totals.
    fn of_entry(&self, of: TotalsOf, word: TotalsWord) -> Result<Option<f64>, String> {
        Ok(match of {
            TotalsOf::Tool(index) => {
                let entry = self.tool_entry(index)?;
                match word {
                    TotalsWord::Diameter => entry.diameter,
                    TotalsWord::Length => entry.length,
                    _ => Some(entry.number),
                }
            }
            TotalsOf::Operation(index) => {
                let operation = self.operation(index)?;
                if word == TotalsWord::Feature { operation.feature } else { operation.tool }
            }
            TotalsOf::Program => None,
        })
    }

    /// A text that a script asks for.
    ///
    /// # Errors
    /// As [`Overview::number`].
    pub fn text(&self, of: TotalsText) -> Result<String, String> {
        let found = match of {
            TotalsText::Part => &self.part,
            TotalsText::Tool(index) => &self.tool_entry(index)?.name,
            TotalsText::Operation(index) => &self.operation(index)?.name,
        };
        Ok(found.clone().unwrap_or_default())
    }

    /// Number of the tool of the first change behind a CL record.
    ///
    /// # Errors
    /// As [`Overview::number`].
    pub fn tool_after(&self, cl_record: u32) -> Result<Option<f64>, String> {
        self.check_room()?;
        let next = self.changes.iter().find(|(record, _)| *record > cl_record);
        Ok(next.map(|(_, number)| *number))
    }

    fn tool_entry(&self, index: usize) -> Result<&ToolEntry, String> {
        let count = self.tools.len();
        let none = || format!("the tool list has no entry {}; it has {count}", index + 1);
        self.tools.get(index).ok_or_else(none)
    }

    fn operation(&self, index: usize) -> Result<&Operation, String> {
        self.check_room()?;
        let count = self.operations.len();
        let none = || format!("there is no operation {}; the program has {count}", index + 1);
        self.operations.get(index).ok_or_else(none)
    }

    fn check_room(&self) -> Result<(), String> {
        if self.too_many {
            return Err(format!("there are more than {MOST} operations or tool changes"));
        }
        Ok(())
    }

    /// What this first pass and a second one differ in.
    pub fn difference(&self, second: &Overview) -> Option<String> {
        if self == second {
            return None;
        }
        let count = |what: &str, one: usize, other: usize| {
            (one != other).then(|| format!("the first pass has {one} {what}, the second {other}"))
        };
        let number = |what: &str, one: f64, other: f64| {
            let message = || format!("the first pass has {one:.3} {what}, the second {other:.3}");
            (one != other).then(message)
        };
        let (one, other) = (&self.total, &second.total);
        count("tools", self.tools.len(), second.tools.len())
            .or_else(|| count("operations", self.operations.len(), second.operations.len()))
            .or_else(|| number("seconds", one.seconds(), other.seconds()))
            .or_else(|| number("of length at feed", one.cutting_length, other.cutting_length))
            .or_else(|| Some("the two passes have other tools, operations or extents".to_string()))
    }
}

/// A text without the blanks around it; `None` where nothing is left.
fn named(text: &str) -> Option<String> {
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_string())
}
