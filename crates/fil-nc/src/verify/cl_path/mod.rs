//! The path a CL file asks for, read without the post.
//!
//! [`ClPath`] goes through the records and gives [`Step`]s: poses in the part
//! frame after TRANS and the input translation, in mm. A statement whose effect is
//! not known from the CL file alone becomes [`ExpectedStep::Unknown`].

mod drill;
mod frame_words;
mod named_frame;
mod own_words;
mod path;
mod skip;
mod thread;
mod tool_names;
mod unit;
mod words;

use std::collections::VecDeque;

use fil_cl::record::{kind, mode};
use fil_cl::{Circle, Reader, Record, Vocabulary, operation_sign, words as w};
use fil_diag::Diag;
use fil_machine::Unit;
use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Matrix3x4, Point3, Vector3};

use super::expected_step::{End, ExpectedStep, GivenOffset, Step};
use super::statements::{numbers, numbers_beside, whole};
pub use frame_words::FrameWords;
use frame_words::{Frame, Matrix, Mover};
use thread::Threads;
pub use words::{ignored_words, knows_word};

use crate::motion::{INCH, Rate};
use skip::Opskip;
use tool_names::ToolNames;

/// A cycle that is on; lengths in CL units.
#[derive(Clone, Copy)]
struct Cycle {
    kind: CycleKind,
    depth: f64,
    clear: Option<f64>,
    retract: Option<f64>,
    step: Option<f64>,
    out_each: Option<u32>,
    dwell: Option<f64>,
    rate: Option<Rate>,
    /// Turns of the spindle at the first hole of a tap.
    turns: Option<f64>,
    /// The rate is of the CYCLE itself, and not of FEDRAT.
    has_own_rate: bool,
    rigid: bool,
}

/// A CIRCLE that waits for its end.
#[derive(Clone, Copy)]
struct Waiting {
    circle: Circle,
    turns: f64,
}

/// Where the tool is, in CL units.
#[derive(Default)]
struct Tool {
    point: Option<Point3<f64>>,
    axis: Vector3<f64>,
    /// MULTAX is on.
    multax: bool,
    /// The machine is a lathe.
    turns: bool,
}

/// What SPINDL has asked for last.
#[derive(Default)]
struct SpindleAsked {
    /// Turns a minute.
    turns: Option<f64>,
    /// It named the second spindle.
    is_side: bool,
}

/// What statements leave for the later ones; lengths in CL units.
#[derive(Default)]
struct State {
    /// `None` before anything has said it.
    unit: Option<Unit>,
    tool: Tool,
    rapid: bool,
    rate: Option<Rate>,
    spindle: SpindleAsked,
    threads: Threads,
    circle: Option<Waiting>,
    cycle: Option<Cycle>,
    /// Ends and beginnings of the plates that the holes of the cycle lead through.
    plates: Vec<f64>,
    /// Where the tip was before the first of them.
    came_from: Option<Point3<f64>>,
    /// Steps of a motion record behind its first one.
    further: VecDeque<ExpectedStep>,
    frame: Frame,
    /// A full turn ends exactly where it begins.
    exact_turns: bool,
    /// LINTOL, mm.
    straight: Option<f64>,
    names: ToolNames,
    /// RAPTO beside CLEAR is the R level.
    rapto_is_level: bool,
    /// Each TAP is rigid, as with HIGH.
    taps_are_rigid: bool,
    /// M codes that end the program.
    end_codes: Vec<u32>,
    /// Where operations begin is asked for.
    says_signs: bool,
}

/// Goes through a CL file.
pub struct ClPath<'r> {
    reader: Reader<'r>,
    /// Name of the CL file in messages.
    name: String,
    /// The user or the machine says the unit.
    given: bool,
    vocabulary: Vocabulary,
    record: Record,
    state: State,
    ready: VecDeque<Step>,
    over: bool,
    skip: Opskip,
    /// Lines whose records are passed over, in order.
    without: Vec<u32>,
}

impl<'r> ClPath<'r> {
    /// The same path, where each CYCLE/TAP is rigid (`cycle.tap_rigid`).
    #[must_use]
    pub fn with_rigid_taps(mut self, are_rigid: bool) -> Self {
        self.state.taps_are_rigid = are_rigid;
        self
    }

    /// The same path, which says where operations begin too.
    #[must_use]
    pub fn saying_signs(mut self, says: bool) -> Self {
        self.state.says_signs = says;
        self
    }

    /// The same path, where AUXFUN with one of these codes ends the program.
    #[must_use]
    pub fn ending_by(mut self, end_codes: Vec<u32>) -> Self {
        self.state.end_codes = end_codes;
        self
    }

    /// The same path, where RAPTO beside CLEAR is the R level (`cycle.rapto = 1`).
    #[must_use]
    pub fn with_rapto_as_level(mut self, is_level: bool) -> Self {
        self.state.rapto_is_level = is_level;
        self
    }

    /// The path of a CL text; `name` is what messages show, `shift` the machine's
    /// translation of the input.
    pub fn new(reader: Reader<'r>, name: &str, shift: [f64; 3]) -> Self {
        ClPath {
            reader,
            name: name.to_string(),
            given: false,
            vocabulary: Vocabulary::new(),
            record: Record::default(),
            state: State {
                tool: Tool { axis: Vector3::z(), ..Tool::default() },
                frame: Frame { shift: Vector3::from(shift), ..Frame::default() },
                ..State::default()
            },
            ready: VecDeque::new(),
            over: false,
            skip: Opskip::default(),
            without: Vec::new(),
        }
    }

    /// The path on a machine that calls its tools by the names of the CL file.
    pub fn naming_tools(mut self, names: bool) -> Self {
        self.state.names.are_called = names;
        self
    }

    /// The path on a lathe, whose turning tools have no axis of their own.
    pub fn turning(mut self, turns: bool) -> Self {
        self.state.tool.turns = turns;
        self
    }

    /// The path with the blocks left out that the operator may skip: of what stands between
    /// OPSKIP/ON and OPSKIP/OFF only what holds on is asked for.
    pub fn leaving_out(mut self, leaves_out: bool) -> Self {
        self.skip.leaves_out = leaves_out;
        self
    }

    /// The path without the records of these lines, which are in order.
    pub fn without(mut self, lines: Vec<u32>) -> Self {
        self.without = lines;
        self
    }

    /// What the machine does with the input besides: a shift along its tool axis, and
    /// whether a matrix without OPTION leaves the tool axis alone.
    pub fn on_machine(mut self, along: [f64; 3], leaves_axis: bool) -> Self {
        self.state.frame.along = Vector3::from(along);
        self.state.frame.leaves_axis = leaves_axis;
        self
    }

    /// The same path, through the matrix of the machine.
    #[must_use]
    pub fn through(mut self, matrix: Option<Matrix3x4<f64>>) -> Self {
        let turns_axis = !self.state.frame.leaves_axis;
        let of_machine = |rows| Matrix { rows, turns_axis, of: Mover::Machine };
        self.state.frame.matrix = matrix.map(of_machine);
        self
    }

    /// How far from the crest the tool goes back from a thread that does not say it, mm.
    pub fn clear_of_threads_by(mut self, clearance: f64) -> Self {
        self.state.threads.clearance = clearance;
        self
    }

    /// What the machine takes words for that move the frame.
    pub fn with_frame_words(mut self, words: FrameWords) -> Self {
        self.state.frame.words = words;
        self
    }

    /// The unit of a CL file that does not say it itself; without it, what its feeds tell.
    pub fn in_unit(mut self, unit: Option<Unit>) -> Self {
        self.given = unit.is_some();
        let unit = unit.or_else(|| self.reader.told_unit().map(unit::of_word));
        self.state.unit = unit;
        self.ready.extend(
            unit.map(|unit| Step { line: 0, what: ExpectedStep::Metric(unit.is_metric()) }),
        );
        self
    }

    /// The next step; `None` at the end.
    fn step(&mut self) -> Result<Option<Step>, Box<Diag>> {
        loop {
            if let Some(step) = self.ready.pop_front() {
                return Ok(Some(step));
            }
            if self.over {
                return Ok(None);
            }
            if !self.reader.read(&mut self.vocabulary, &mut self.record)? {
                self.give(vec![ExpectedStep::End(End::OfFile)]);
                continue;
            }
            let line = self.record.line;
            if self.without.binary_search(&line).is_ok() {
                continue;
            }
            self.require_unit()?;
            self.refuse_other_unit()?;
            if self.is_plain_motion() {
                self.skip.goes_on();
                match self.state.motion(&self.record, &self.vocabulary) {
                    Some(what) => {
                        let further = self.state.further.drain(..);
                        self.ready.extend(further.map(|what| Step { line, what }));
                        return Ok(Some(Step { line, what }));
                    }
                    None => continue,
                }
            }
            if self.record.kind == kind::SURFACE {
                self.state.exact_turns = self.reader.recognized().dialect.has_exact_turns();
            }
            let steps = self.state.take(&self.record, &self.vocabulary);
            self.give(steps);
        }
    }

    /// Gives the steps of the record at hand that are asked for.
    fn give(&mut self, steps: Vec<ExpectedStep>) {
        let steps = self.skip.asked_of(&self.record, steps);
        self.over = steps.iter().any(|what| matches!(what, ExpectedStep::End(_)));
        let line = self.record.line;
        self.ready.extend(steps.into_iter().map(|what| Step { line, what }));
    }
}

impl ClPath<'_> {
    /// A motion that nothing leaves out: most records are.
    fn is_plain_motion(&self) -> bool {
        self.record.kind == kind::MOTION && !self.record.inert && !self.skip.leaves_out_now()
    }
}

impl Iterator for ClPath<'_> {
    type Item = Result<Step, Box<Diag>>;

    fn next(&mut self) -> Option<Self::Item> {
        let step = self.step();
        self.over |= step.is_err();
        step.transpose()
    }
}

impl State {
    fn take(&mut self, record: &Record, vocabulary: &Vocabulary) -> Vec<ExpectedStep> {
        let steps = self.take_effects(record, vocabulary);
        match operation_sign::of(record).filter(|_| self.says_signs) {
            Some(sign) => [ExpectedStep::Sign(sign)].into_iter().chain(steps).collect(),
            None => steps,
        }
    }

    fn take_effects(&mut self, record: &Record, vocabulary: &Vocabulary) -> Vec<ExpectedStep> {
        if matches!(record.major, w::TPRINT | w::TOOL_PATH) {
            self.names.say(record);
            return Vec::new();
        }
        self.name_frame(record, vocabulary.name(record.major));
        if record.inert {
            return Vec::new();
        }
        match record.kind {
            kind::MOTION => {
                let first = self.motion(record, vocabulary);
                first.into_iter().chain(self.further.drain(..)).collect()
            }
            kind::SURFACE => {
                self.circle = record.circle().map(|circle| Waiting {
                    circle,
                    turns: record.number_after(w::TIMES).unwrap_or(0.0),
                });
                Vec::new()
            }
            kind::MODE => {
                self.mode(record);
                Vec::new()
            }
            kind::FINI => vec![ExpectedStep::End(End::OfFile)],
            kind::PSEUDO if record.major != w::CUTTER => Vec::new(),
            _ => self.command(record, vocabulary),
        }
    }

    fn mode(&mut self, record: &Record) {
        if record.sub == mode::MULTAX {
            self.tool.multax = !record.has(w::OFF);
        }
        match (record.sub, &numbers(record)[..]) {
            (mode::TLAXIS, [i, j, k]) if self.tool.turns && *i == 0.0 && *k == 0.0 && *j != 0.0 => {
            }
            (mode::TLAXIS, [i, j, k]) => self.tool.axis = Vector3::new(*i, *j, *k),
            (mode::MULTAX, _) if record.has(w::OFF) => self.tool.axis = Vector3::z(),
            _ => {}
        }
    }

    /// To a position of the machine, which the CL file does not know.
    fn go_to_machine(&mut self, what: ExpectedStep) -> Vec<ExpectedStep> {
        self.tool.point = None;
        self.rapid = false;
        vec![what]
    }

    /// Length of a CL unit in mm.
    fn unit(&self) -> f64 {
        self.unit.map_or(1.0, Unit::in_mm)
    }

    /// A feed; per minute in the unit of the file when none is named.
    fn rate_of(&self, record: &Record, value: f64) -> Rate {
        let foot = 12.0 * INCH;
        match () {
            () if record.has(w::MMPM) => Rate::PerMinute(value),
            () if record.has(w::IPM) => Rate::PerMinute(value * INCH),
            () if record.has(w::FPM) => Rate::PerMinute(value * foot),
            () if record.has(w::MMPR) => Rate::PerTurn(value),
            () if record.has(w::IPR) => Rate::PerTurn(value * INCH),
            () if record.has(w::FPR) => Rate::PerTurn(value * foot),
            () if record.has(w::UPR) => Rate::PerTurn(value * self.unit()),
            () => Rate::PerMinute(value * self.unit()),
        }
    }

    /// LINTOL with a length, ON for the last one, or OFF.
    fn straight(&mut self, record: &Record) -> Vec<ExpectedStep> {
        if record.has(w::OFF) {
            return vec![ExpectedStep::Straight(None)];
        }
        let within = numbers(record).first().copied().filter(|within| *within > 0.0);
        self.straight = within.map(|within| within * self.unit()).or(self.straight);
        vec![ExpectedStep::Straight(self.straight)]
    }

    fn tool(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        self.end_thread();
        let numbers = numbers_beside(record, &[w::LENGTH, w::OSETNO, w::ADJUST]);
        let number = *numbers.first()?;
        let of_tool = record.data.iter().skip(1).any(|word| *word == fil_cl::Word::Minor(w::TOOL));
        let given = [w::OSETNO, w::ADJUST].into_iter().find_map(|word| record.number_after(word));
        let offset = match given.map(whole) {
            Some(offset) if of_tool => Some(GivenOffset::Compensation(offset?)),
            Some(offset) => Some(GivenOffset::OfMachine(offset?)),
            None => None,
        };
        let number = self.names.number(whole(number)?);
        Some(vec![ExpectedStep::Tool { number, offset, by_hand: record.has(w::MANUAL) }])
    }
}
