//! The path a CL file asks for, read without the post.
//!
//! [`ClPath`] goes through the records and gives [`Step`]s: poses in the part
//! frame after TRANS and the input translation, in mm. A statement whose effect is
//! not known from the CL file alone becomes [`Wanted::Unknown`].

mod drill;
mod frame_words;
mod named_frame;
mod own_words;
mod path;
mod skip;
mod thread;
mod tool_names;
mod unit;

use std::collections::VecDeque;

use fil_cl::record::{kind, mode};
use fil_cl::{Circle, Reader, Record, Vocabulary, WordId, words as w};
use fil_diag::Diag;
use fil_machine::Unit;
use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Matrix3x4, Point3, Vector3};

use super::statements::{
    compensation, coolant, numbers, numbers_beside, plane_of_compensation, spindle, statement,
    whole,
};
use super::wanted::{Effect, End, Step, Wanted};
pub use frame_words::FrameWords;

use crate::motion::{INCH, Rate, Speed};
use named_frame::NamedFrames;
use skip::Opskip;
use tool_names::ToolNames;
use unit::said;

/// Statements that move the tool or the frame by rules that are not public.
const ENDS_THE_PATH: [WordId; 9] =
    [w::COPY, w::INDEX, w::ROTABL, w::ROTATE, w::ROTHED, w::HEAD, w::CALSUB, w::DEFSUB, w::ENDSUB];

/// Statements that write words of the user's own.
const OWN_WORDS: [WordId; 2] = [w::POSTN, w::REPEAT];

/// A cycle that is on; lengths in CL units.
#[derive(Clone, Copy)]
struct Cycle {
    kind: CycleKind,
    depth: f64,
    clear: Option<f64>,
    retract: Option<f64>,
    step: Option<f64>,
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

/// TRANS with a matrix.
struct Matrix {
    rows: Matrix3x4<f64>,
    turns_axis: bool,
}

/// What statements leave for the later ones; lengths in CL units.
struct State {
    /// `None` before anything has said it.
    unit: Option<Unit>,
    point: Option<Point3<f64>>,
    axis: Vector3<f64>,
    /// MULTAX is on.
    multax: bool,
    rapid: bool,
    rate: Option<Rate>,
    thread: Option<Rate>,
    /// The lead of PITCH, for a thread that names none.
    pitch: Option<Rate>,
    /// Turns of the spindle that SPINDL has given last.
    turns: Option<f64>,
    /// The last SPINDL spoke of the second spindle.
    counts_side: bool,
    /// How far from the crest the tool goes back from a thread that does not say it, mm.
    thread_clearance: f64,
    /// OP/THREAD that waits for the ends of its crest.
    awaited: Option<thread::Awaited>,
    circle: Option<Waiting>,
    cycle: Option<Cycle>,
    matrix: Option<Matrix>,
    shift: Vector3<f64>,
    /// The machine's shift along its tool axis, which no TRANS ends.
    along: Vector3<f64>,
    /// A matrix without OPTION leaves the tool axis alone.
    leaves_axis: bool,
    /// LINTOL, mm.
    straight: Option<f64>,
    words: FrameWords,
    frames: NamedFrames,
    names: ToolNames,
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
}

impl<'r> ClPath<'r> {
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
                unit: None,
                point: None,
                axis: Vector3::z(),
                multax: false,
                rapid: false,
                rate: None,
                turns: None,
                thread: None,
                pitch: None,
                counts_side: false,
                thread_clearance: 0.0,
                awaited: None,
                circle: None,
                cycle: None,
                matrix: None,
                shift: Vector3::from(shift),
                along: Vector3::zeros(),
                leaves_axis: false,
                straight: None,
                words: FrameWords::default(),
                frames: NamedFrames::default(),
                names: ToolNames::default(),
            },
            ready: VecDeque::new(),
            over: false,
            skip: Opskip::default(),
        }
    }

    /// The path on a machine that calls its tools by the names of the CL file.
    pub fn naming_tools(mut self, names: bool) -> Self {
        self.state.names.are_called = names;
        self
    }

    /// The path with the blocks left out that the operator may skip: of what stands between
    /// OPSKIP/ON and OPSKIP/OFF only what holds on is asked for.
    pub fn leaving_out(mut self, leaves_out: bool) -> Self {
        self.skip.leaves_out = leaves_out;
        self
    }

    /// What the machine does with the input besides: a shift along its tool axis, and
    /// whether a matrix without OPTION leaves the tool axis alone.
    pub fn on_machine(mut self, along: [f64; 3], leaves_axis: bool) -> Self {
        self.state.along = Vector3::from(along);
        self.state.leaves_axis = leaves_axis;
        self
    }

    /// How far from the crest the tool goes back from a thread that does not say it, mm.
    pub fn clear_of_threads_by(mut self, clearance: f64) -> Self {
        self.state.thread_clearance = clearance;
        self
    }

    /// What the machine takes words for that move the frame.
    pub fn with_frame_words(mut self, words: FrameWords) -> Self {
        self.state.words = words;
        self
    }

    /// The unit of a CL file that does not say it itself.
    pub fn in_unit(mut self, unit: Option<Unit>) -> Self {
        self.state.unit = unit;
        self.given = unit.is_some();
        self.ready
            .extend(unit.map(|unit| Step { line: 0, what: Wanted::Metric(unit.is_metric()) }));
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
                self.give(vec![Wanted::End(End::OfFile)]);
                continue;
            }
            let line = self.record.line;
            self.require_unit()?;
            self.refuse_other_unit()?;
            if self.is_plain_motion() {
                self.skip.goes_on();
                match self.state.motion(&self.record, &self.vocabulary) {
                    Some(what) => return Ok(Some(Step { line, what })),
                    None => continue,
                }
            }
            let steps = self.state.take(&self.record, &self.vocabulary);
            self.give(steps);
        }
    }

    /// Gives the steps of the record at hand that are asked for.
    fn give(&mut self, steps: Vec<Wanted>) {
        let steps = self.skip.asked_of(&self.record, steps);
        self.over = steps.iter().any(|what| matches!(what, Wanted::End(_)));
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
    fn take(&mut self, record: &Record, vocabulary: &Vocabulary) -> Vec<Wanted> {
        if matches!(record.major, w::TPRINT | w::TOOL_PATH) {
            self.names.say(record);
            return Vec::new();
        }
        self.name_frame(record, vocabulary.name(record.major));
        if record.inert {
            return Vec::new();
        }
        match record.kind {
            kind::MOTION => self.motion(record, vocabulary).into_iter().collect(),
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
            kind::FINI => vec![Wanted::End(End::OfFile)],
            kind::PSEUDO if record.major != w::CUTTER => Vec::new(),
            _ => self.command(record, vocabulary),
        }
    }

    fn mode(&mut self, record: &Record) {
        if record.sub == mode::MULTAX {
            self.multax = !record.has(w::OFF);
        }
        match (record.sub, &numbers(record)[..]) {
            (mode::TLAXIS, [i, j, k]) => self.axis = Vector3::new(*i, *j, *k),
            (mode::MULTAX, _) if record.has(w::OFF) => self.axis = Vector3::z(),
            _ => {}
        }
    }

    fn command(&mut self, record: &Record, vocabulary: &Vocabulary) -> Vec<Wanted> {
        let unknown = |effect| {
            let what = statement(record, vocabulary);
            vec![Wanted::Unknown { what, effect }]
        };
        match record.major {
            w::UNITS | w::UNIT => {
                let unit = said(record);
                self.unit = Some(unit);
                vec![Wanted::Metric(unit.is_metric())]
            }
            w::RAPID => {
                self.rapid = true;
                Vec::new()
            }
            // Inverse time says the same feed in another way.
            w::FEDRAT if record.has(w::INVERS) && numbers(record).is_empty() => Vec::new(),
            w::FEDRAT if record.has(w::LOCK) && numbers(record).is_empty() => {
                vec![Wanted::OverrideLock(record.has(w::ON))]
            }
            w::CUTTER => {
                let cutter = numbers(record).first().map(|diameter| diameter * self.unit());
                cutter.map(Wanted::Cutter).into_iter().collect()
            }
            w::FEDRAT => {
                self.rate = numbers(record).first().map(|value| self.rate_of(record, *value));
                if let Some(cycle) = self.cycle.as_mut().filter(|cycle| !cycle.has_own_rate) {
                    cycle.rate = self.rate;
                    cycle.turns = None;
                }
                self.end_thread();
                Vec::new()
            }
            w::TRANS => self.trans(record),
            w::ORIGIN => self.origin(record).unwrap_or_else(|| unknown(Effect::Path)),
            w::TRACUT => self.tracut(record).unwrap_or_else(|| unknown(Effect::Path)),
            w::ROTABL | w::ROTATE => self.table(record).unwrap_or_else(|| unknown(Effect::Path)),
            w::CYCLE => self.cycle(record, vocabulary),
            w::GOHOME if record.data.is_empty() => self.go_to_machine(Wanted::Home),
            w::RETRCT if record.data.is_empty() => self.go_to_machine(Wanted::Retract),
            w::GOHOME => match numbers(record)[..] {
                [x, y, z] => vec![self.line_to(Point3::new(x, y, z), self.axis)],
                [x, y, z, i, j, k] => {
                    vec![self.line_to(Point3::new(x, y, z), Vector3::new(i, j, k))]
                }
                _ => unknown(Effect::Path),
            },
            w::LOADTL | w::LOAD | w::TURRET => {
                self.tool(record).unwrap_or_else(|| unknown(Effect::Words))
            }
            w::SPINDL => {
                self.counts_side = record.has(w::SIDE);
                let wanted = spindle(record);
                let speed = wanted.iter().find_map(|wanted| match wanted {
                    Wanted::Speed(speed) => Some(*speed),
                    _ => None,
                });
                self.turns = speed.map_or(self.turns, Speed::turns);
                wanted
            }
            w::COOLNT => coolant(record).map_or_else(|| unknown(Effect::Words), |kind| vec![kind]),
            w::CUTCOM => {
                let plane = plane_of_compensation(record);
                let both = |side| [side].into_iter().chain(plane).collect();
                compensation(record).map_or_else(|| unknown(Effect::Words), both)
            }
            w::DELAY => {
                let amount = numbers(record).first().copied();
                vec![match amount.filter(|_| record.has(w::REV)) {
                    Some(turns) => Wanted::DwellTurns(turns),
                    None => Wanted::Dwell(amount),
                }]
            }
            w::PITCH => self.pitch(record).unwrap_or_else(|| unknown(Effect::Path)),
            w::OP | w::THREAD => self.thread(record).unwrap_or_else(|| unknown(Effect::Path)),
            w::MODE if record.has(w::TURN) => vec![Wanted::Mills(false)],
            w::MODE if record.has(w::MILL) => vec![Wanted::Mills(true)],
            w::PREFUN => match numbers(record)[..] {
                [code] if self.chooses_offset(code) => {
                    vec![Wanted::Fixture(code as u32)]
                }
                [code] if (17.0..20.0).contains(&code) => {
                    let plane = Wanted::Plane(19 - code as usize);
                    unknown(own_words::effect(record)).into_iter().chain([plane]).collect()
                }
                // Its mode is that of a text.
                [code] => {
                    let text = Wanted::Words(format!("G{code}"));
                    unknown(own_words::effect(record)).into_iter().chain([text]).collect()
                }
                _ => unknown(own_words::effect(record)),
            },
            w::SET if record.has(w::OFSETL) => {
                vec![Wanted::WorkOffset(numbers(record).first().copied())]
            }
            w::LINTOL => self.straight(record),
            w::STOP => vec![Wanted::Stop { optional: false }],
            w::OPSTOP => vec![Wanted::Stop { optional: true }],
            w::INSERT => {
                let text = record.text.trim().to_string();
                vec![Wanted::Insert { text, may_be_skipped: false }]
            }
            w::END => vec![Wanted::End(End::Stay)],
            w::REWIND => vec![Wanted::End(End::Rewind)],
            w::CLAMP => vec![Wanted::Clamp(record.has(w::ON))],
            w::AUXFUN => {
                let code = numbers(record).first().and_then(|code| whole(*code));
                code.map_or_else(
                    || unknown(Effect::Auxiliary),
                    |code| vec![Wanted::Auxiliary(code)],
                )
            }
            major if ENDS_THE_PATH.contains(&major) => unknown(Effect::Path),
            major if OWN_WORDS.contains(&major) => {
                let (effect, words) = match major {
                    w::POSTN => own_words::once(record, vocabulary),
                    _ => own_words::repeated(record, vocabulary),
                };
                let mut wanted = unknown(effect);
                wanted.push(words);
                wanted
            }
            _ => Vec::new(),
        }
    }

    /// To a position of the machine, which the CL file does not know.
    fn go_to_machine(&mut self, what: Wanted) -> Vec<Wanted> {
        self.point = None;
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
    fn straight(&mut self, record: &Record) -> Vec<Wanted> {
        if record.has(w::OFF) {
            return vec![Wanted::Straight(None)];
        }
        let within = numbers(record).first().copied().filter(|within| *within > 0.0);
        self.straight = within.map(|within| within * self.unit()).or(self.straight);
        vec![Wanted::Straight(self.straight)]
    }

    fn tool(&mut self, record: &Record) -> Option<Vec<Wanted>> {
        self.end_thread();
        let numbers = numbers_beside(record, &[w::LENGTH, w::OSETNO, w::ADJUST]);
        let number = *numbers.first()?;
        let offset = record.number_after(w::OSETNO).or(record.number_after(w::ADJUST));
        Some(vec![Wanted::Tool {
            number: self.names.number(whole(number)?),
            offset: match offset {
                Some(offset) => Some(whole(offset)?),
                None => None,
            },
        }])
    }
}
