//! SINUMERIK 840D programs to events.
//!
//! Followed are G0 to G3 with `CR=` or a center, modes, tools by number or name, D,
//! named addresses, TRANS and ATRANS, work offsets, R parameters that are given numbers,
//! CYCLE800, and the cycles 81 to 86 and 89, called once or by MCALL. What else moves, calculates
//! or jumps is refused.

mod block;
mod cycle;
mod functions;
pub(crate) mod line;
mod motion;
mod rigid_tap;
mod swivel;
mod thread_cycle;
mod transformation;

use std::collections::{BTreeMap, VecDeque};

use fil_diag::{Diag, TextSpan};

use super::left_to_control::Uses;
use super::program::may_be_skipped;
use super::state::State;
use super::{Fault, cant_read};
use crate::dialect::{Dialect, Habit, Numbered};
use crate::errors::NcCode;
use crate::motion::{Event, StartMode};
use crate::source::{Lines, Source};
use cycle::Call;
use line::{Value, Word};

/// Where the reading stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Before the end.
    Body,
    /// After M2, M17 or M30.
    Ended,
    /// In another program behind it.
    Behind,
}

/// The program and what the control remembers besides the modes that all controls have.
struct Sinumerik<'d> {
    state: State<'d>,
    part: Part,
    /// Values of R parameters.
    parameters: BTreeMap<u32, f64>,
    /// The cycle that each motion calls.
    called: Option<Call>,
    /// TRANS and ATRANS, mm.
    shift: [f64; 3],
    /// Feeds count millimeters.
    metric_feed: bool,
    /// G35: the lead of a thread shrinks by F in each turn, and grows by G34.
    lead_shrinks: bool,
    /// K of the G331 that was the last motion.
    rigid_tap_lead: Option<f64>,
    /// DIAMOF: X is a radius.
    counts_radii: bool,
    /// M70: the main spindle is an axis.
    is_axis: bool,
    /// What the words of the line may depend on.
    uses: Uses,
}

/// The number of the first tool whose name is none.
const NAMED_TOOLS: u32 = 1_000_001;

/// Numbers that names may have.
const NAMES: u64 = 1_000_000_007;

/// The number of a tool by its name: the name itself where it is one, else one above a
/// million that follows from its letters alone, whatever their case.
pub(crate) fn number_of_tool(name: &str) -> u32 {
    let name = name.trim();
    if let Ok(number) = name.parse() {
        return number;
    }
    // FNV-1a
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte.to_ascii_uppercase())).wrapping_mul(0x0100_0000_01b3)
    });
    NAMED_TOOLS + (hash % NAMES) as u32
}

/// A program of a SINUMERIK, line by line.
pub(super) struct Program<'a> {
    control: Sinumerik<'a>,
    lines: Lines<'a>,
    /// The line that was read last, 1-based, and the last one that is not empty.
    number: u32,
    last: u32,
}

impl<'a> Program<'a> {
    pub(super) fn new(source: &'a Source<'a>, dialect: &'a Dialect) -> Self {
        let mut control = Sinumerik {
            state: State::new(dialect),
            part: Part::Body,
            parameters: BTreeMap::new(),
            called: None,
            shift: [0.0; 3],
            metric_feed: dialect.has(Habit::Metric),
            lead_shrinks: false,
            rigid_tap_lead: None,
            counts_radii: false,
            is_axis: false,
            uses: Uses::default(),
        };
        // Cycles say the level they return to.
        control.state.certain.say(StartMode::ReturnLevel);
        Program { control, lines: Lines::from(source, 0), number: 0, last: 1 }
    }

    /// Goes on after a refused line: the cycle that MCALL calls is unknown too.
    pub(super) fn forget(&mut self) {
        self.control.state.forget();
        self.control.called = None;
        self.control.rigid_tap_lead = None;
    }

    /// Goes on after a refused line as if it were not there.
    pub(super) fn pass_over(&mut self) -> bool {
        self.control.state.events.clear();
        true
    }

    /// Runs the next line; false behind the last.
    pub(super) fn run_line(
        &mut self,
        name: &str,
        into: &mut VecDeque<Event>,
    ) -> Result<bool, Box<Diag>> {
        let dialect = self.control.state.dialect;
        let line = self.lines.next_line().map_err(|error| cant_read(name, &error))?;
        let Some(text) = line else {
            if self.control.part != Part::Body || !dialect.has(Habit::HasEnd) {
                return Ok(false);
            }
            let cut_off = Diag::new(NcCode::CutOff, "no end code was found");
            return Err(Box::new(cut_off.at(TextSpan::line(name, self.last, ""))));
        };
        self.number += 1;
        let text = text.strip_suffix(b"\r").unwrap_or(text);
        let text = &*dialect.text.marks.read(text);
        let left_out = dialect.leaves_blocks_out() && may_be_skipped(text);
        if left_out || text.trim_ascii().is_empty() {
            return Ok(true);
        }
        self.last = self.number;
        self.control.state.line = self.number;
        self.control.state.events.clear();
        self.control.uses = Uses::default();
        let placed = |fault: Fault| fault.place(name, self.number, text);
        self.control.line(text).map_err(placed)?;
        if !self.control.state.certain.all() {
            let uses = self.control.uses;
            self.control.state.tell_left_to_control(uses);
        }
        into.extend(self.control.state.events.drain(..));
        Ok(true)
    }
}

impl Sinumerik<'_> {
    fn line(&mut self, text: &[u8]) -> Result<(), Fault> {
        let bare = text.trim_ascii();
        if bare.starts_with(b"%") {
            if self.part != Part::Body {
                self.part = Part::Behind;
            }
            return Ok(());
        }
        if self.part == Part::Behind {
            return Ok(());
        }
        let text_of = || String::from_utf8_lossy(text).into_owned();
        if self.part == Part::Body && self.state.is_of_others(text_of) {
            return Ok(());
        }
        let words = line::read(text)?;
        let Some(first) = words.first() else { return Ok(()) };
        if self.part == Part::Ended {
            return Err(Fault::new(NcCode::AfterEnd, "the program has ended before this block"));
        }
        match (first.name.as_str(), &first.arguments) {
            ("MSG" | "WORKPIECE" | "GROUP_BEGIN" | "GROUP_END", _) => Ok(()),
            ("CYCLE832", _) => {
                self.controls_path();
                Ok(())
            }
            ("MCALL", _) => self.call_at_each(&words[1..]),
            ("TRAORI", arguments) if words.len() == 1 => {
                if arguments.as_ref().is_some_and(|given| given.iter().any(Option::is_some)) {
                    return Err(first.foreign("with a number or more is not followed"));
                }
                if self.called.is_some() {
                    return Err(first.foreign("while MCALL calls a cycle"));
                }
                self.state.begin_stated_tip_control()
            }
            ("TRAFOOF", None) if words.len() == 1 => {
                if !self.end_transformation()? {
                    self.state.end_tip_control();
                }
                Ok(())
            }
            ("TRANSMIT", None) if words.len() == 1 => self.transmit(),
            ("TRACYL", Some(_)) if words.len() == 1 => self.tracyl(first),
            ("SETMS", _) if words.len() == 1 => self.choose_master(first),
            ("CYCLE800", Some(_)) if words.len() == 1 => self.swivel(first),
            (_, Some(_)) if words.len() == 1 => {
                let call = self.call_of(first)?;
                self.drill(&call)
            }
            ("TRANS" | "ATRANS", _) => self.translate(first, &words[1..]),
            _ => self.block(&words),
        }
    }

    /// A statement changes how the path is followed.
    fn controls_path(&mut self) {
        self.state.modes.path_control = Some(self.state.line);
    }

    /// `MCALL CYCLE81(…)`, and `MCALL` that ends it.
    fn call_at_each(&mut self, words: &[Word]) -> Result<(), Fault> {
        self.called = match words {
            [] => None,
            [call] if call.name == "CYCLE97" => {
                return Err(call.foreign("of MCALL is not followed"));
            }
            [call] => Some(self.call_of(call)?),
            [_, other, ..] => return Err(other.no_meaning()),
        };
        self.state.cycle.at_each = self.called.is_some();
        Ok(())
    }

    /// TRANS places the zero from that of the work offset, ATRANS from where it lies:
    /// where the axes stand in it is not known.
    fn translate(&mut self, statement: &Word, words: &[Word]) -> Result<(), Fault> {
        if self.state.head.tilt.is_some() {
            return Err(statement.foreign("in a tilted plane is not followed"));
        }
        let mut shift = if statement.name == "ATRANS" { self.shift } else { [0.0; 3] };
        for word in words {
            let axis = self.axis(&word.name).filter(|axis| *axis < 3);
            let (Some(axis), Some(value)) = (axis, &word.value) else {
                return Err(word.no_meaning());
            };
            shift[axis] += self.number(word, value)? * self.state.unit();
        }
        if self.state.dialect.has(Habit::Translates) {
            (self.shift, self.state.zero) = (shift, shift);
            return Ok(());
        }
        for (axis, to) in shift.into_iter().enumerate() {
            if to != self.shift[axis] {
                self.state.known[axis] = false;
            }
        }
        self.shift = shift;
        self.state.modes.frame.moved_zero = Some(self.state.line).filter(|_| shift != [0.0; 3]);
        Ok(())
    }

    /// The axis of a name: `X`, `X1` where the machine names it so, `C4`.
    fn axis(&self, name: &str) -> Option<usize> {
        let letter = name.bytes().next().filter(u8::is_ascii_uppercase)?;
        let axis = self.state.dialect.axis(letter - b'A' + 1)?;
        let index = if axis < 3 {
            self.state.dialect.number(Numbered::Linear)
        } else {
            self.state.dialect.number(Numbered::Rotary)
        };
        let named = index.is_some_and(|index| name[1..] == index.to_string());
        (name.len() == 1 || named).then_some(axis)
    }

    /// The number that a value stands for.
    fn number(&self, word: &Word, value: &Value) -> Result<f64, Fault> {
        match value {
            Value::Number(value) => Ok(*value),
            Value::Parameter(number, sign) => match self.parameters.get(number) {
                Some(value) => Ok(sign * value),
                None => Err(word.foreign("takes a parameter that has no value here")),
            },
            Value::Unread => Err(word.foreign("is given an expression, which is not supported")),
            _ => Err(word.no_meaning()),
        }
    }

    /// A whole number at or above zero.
    fn whole(&self, word: &Word, value: &Value) -> Result<u32, Fault> {
        let number = self.number(word, value)?;
        if number.fract() != 0.0 || !(0.0..=4e9).contains(&number) {
            let message = format!("{number} is no whole number");
            return Err(Fault::new(NcCode::BadNumber, message).at(&word.range));
        }
        Ok(number as u32)
    }

    /// The number of a tool: that of its name, else one of its own.
    fn tool_of_name(&self, name: &str) -> u32 {
        number_of_tool(name)
    }
}
