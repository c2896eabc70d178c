//! The model: from the statements to the CL text and to what it asks of the
//! machine. It knows what CL records mean and nothing of the post.

use std::fmt::Write;

use crate::path::{Point, Unit};

use super::expected::{Act, Compensation, Coolant, Expected, Modes, Rate, Step, Turning, Want};
use super::geometry::{Frame, add, distance, times};
use super::model_modes::Waiting;
use super::senses::has_arc_against_neighbours;
use super::setup::Setup;
use super::statement::{Statement, Trans};

/// How the control reads blocks with a skip mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum World {
    /// It runs them.
    Whole,
    /// It leaves them out.
    Skipping,
}

/// The first motion that moves so far settles what waits for it, mm.
const SETTLES: f64 = 0.02;

/// What statements leave for the later ones. Lengths in mm.
pub(super) struct Model<'s> {
    pub(super) setup: &'s Setup,
    world: World,
    pub(super) unit: Unit,
    pub(super) frame: Frame,
    /// The CL point, in the frame of the CL.
    pub(super) at: Option<Point>,
    /// TRANS has moved the points since the last motion.
    pub(super) is_left: bool,
    /// Where the machine stands, when the CL tells.
    pub(super) tape: Option<Point>,
    pub(super) height_unknown: bool,
    skipping: bool,
    /// Z of the machine before the blocks that may be skipped.
    height_before_skip: Option<f64>,
    pub(super) tool: Option<u32>,
    pub(super) tool_offset: Option<u32>,
    pub(super) feed: Want<Rate>,
    pub(super) spindle: Waiting<Turning>,
    pub(super) coolant: Waiting<Coolant>,
    pub(super) compensation: Waiting<Compensation>,
    /// No straight motion across has come since compensation was called.
    pub(super) compensation_is_fresh: bool,
    pub(super) length: Want<u32>,
    pub(super) limit: Want<f64>,
    /// Lead of the thread that feed motions are passes of.
    pub(super) thread: Option<f64>,
    /// How the spindle turns in its first pass, and its limit.
    thread_turns: Option<(Want<Turning>, Want<f64>)>,
    repeats_feed: bool,
    pub(super) cycle: Option<super::model_cycle::Active>,
    pub(super) out: Expected,
    line: u32,
}

/// What a program asks for, as one of the two worlds sees it.
pub fn expect(setup: &Setup, statements: &[Statement], world: World) -> Expected {
    let mut model = Model::new(setup, world);
    model.head();
    for statement in statements {
        model.take(statement);
    }
    model.line("FINI");
    if model.compensated() || model.compensation_waits() {
        model.may_refuse("compensation that is on at the end");
    }
    if has_arc_against_neighbours(&model.out.steps) {
        model.may_refuse("an arc that runs back from both its neighbours");
    }
    model.out
}

impl<'s> Model<'s> {
    fn new(setup: &'s Setup, world: World) -> Self {
        Model {
            setup,
            world,
            unit: setup.unit,
            frame: Frame::default(),
            at: None,
            is_left: false,
            tape: None,
            height_unknown: true,
            skipping: false,
            height_before_skip: None,
            tool: None,
            tool_offset: None,
            feed: Want::OneOf(Vec::new()),
            spindle: Waiting::new(Want::Any),
            coolant: Waiting::new(Want::Any),
            compensation: Waiting::new(Want::only(Compensation::Off)),
            compensation_is_fresh: false,
            length: Want::Any,
            limit: Want::Any,
            thread: None,
            thread_turns: None,
            repeats_feed: false,
            cycle: None,
            out: Expected::default(),
            line: 0,
        }
    }

    fn head(&mut self) {
        self.line("PARTNO / RANDOM 7");
        self.line("MACHIN / UNCX01, 1");
        self.units(self.unit);
    }

    /// Adds a line of CL.
    pub(super) fn line(&mut self, text: &str) {
        self.line += 1;
        let _ = writeln!(self.out.cl, "{text}");
    }

    pub(super) fn may_refuse(&mut self, reason: &'static str) {
        if !self.out.may_refuse.contains(&reason) {
            self.out.may_refuse.push(reason);
        }
    }

    pub(super) fn must_refuse(&mut self, reason: &'static str) {
        self.out.must_refuse.get_or_insert(reason);
    }

    fn take(&mut self, statement: &Statement) {
        match statement {
            Statement::Rapid(to) => self.straight(Some(*to), [0.0; 3], true),
            Statement::Feed(to) => self.straight(Some(*to), [0.0; 3], false),
            Statement::Delta { by, rapid } => self.straight(None, *by, *rapid),
            Statement::Arc(shape) => self.arc(shape),
            Statement::Feedrate(feed) => self.feedrate(*feed),
            Statement::Spindle(command) => self.spindle(*command),
            Statement::Coolant(command) => self.coolant(*command),
            Statement::Tool { number, offset } => self.tool(*number, *offset),
            Statement::Cutcom(command) => self.cutcom(*command),
            Statement::Skip(on) => {
                self.line(if *on { "OPSKIP / ON" } else { "OPSKIP / OFF" });
                if self.height_unknown || self.something_waits() {
                    self.may_refuse("a word would stand on the other side of OPSKIP");
                }
                let height = self.at.map(|at| self.frame.apply(at)[2]);
                if *on {
                    self.height_before_skip = height;
                } else if self.height_before_skip != height {
                    self.may_refuse("a height that depends on the block delete");
                }
                self.skipping = *on;
            }
            Statement::Cycle(shape) => self.cycle(shape),
            Statement::Hole(at) => self.hole(*at),
            Statement::CycleOff => {
                self.line("CYCLE / OFF");
                self.cycle = None;
            }
            Statement::Insert(text) => {
                self.line(&format!("INSERT / {text}"));
                self.text(text);
            }
            Statement::Prefun(code) => {
                self.line(&format!("PREFUN / {code}"));
                self.text(&format!("G{code}"));
            }
            Statement::Auxfun(code) => {
                self.line(&format!("AUXFUN / {code}"));
                self.text(&format!("M{code}"));
            }
            Statement::Postn(words) => self.postn(words),
            Statement::RepeatFeed(value) => {
                self.line(&format!("REPEAT / 6, {}", number(*value)));
                self.repeats_feed = true;
            }
            Statement::RepeatOff => {
                self.line("REPEAT / OFF");
                self.repeats_feed = false;
            }
            Statement::Trans(trans) => self.trans(trans),
            Statement::TransOff => {
                self.line("TRANS / NOMORE");
                self.frame = Frame::default();
                self.is_left = true;
            }
            Statement::Delay(seconds) => {
                self.line(&format!("DELAY / {}", number(*seconds)));
                if self.setup.rounds_dwell(*seconds) {
                    self.may_refuse("a dwell that its format can't hold");
                }
                self.push(Act::Dwell(*seconds));
            }
            Statement::DelayTurns(turns) => self.delay_turns(*turns),
            Statement::Stop => {
                self.line("STOP");
                self.push(Act::Stop);
            }
            Statement::OptionalStop => {
                self.line("OPSTOP");
                self.push(Act::OptionalStop);
            }
            Statement::Seqno(text) => self.line(&format!("SEQNO / {text}")),
            Statement::Message(text) => self.line(&format!("PPRINT / {text}")),
            Statement::Units(unit) => {
                self.may_refuse("the unit changes on the way");
                self.units(*unit);
            }
            Statement::Thread(lead) => {
                let unit = if self.unit == Unit::Mm { "MMPR" } else { "IPR" };
                self.line(&format!("THREAD / {unit}, {}", number(*lead)));
                self.thread = Some(lead * self.mm());
                self.thread_turns = None;
            }
            Statement::ThreadOff => {
                self.line("THREAD / OFF");
                self.thread = None;
            }
        }
    }

    fn units(&mut self, unit: Unit) {
        self.line(match unit {
            Unit::Mm => "UNITS / MM",
            Unit::Inch => "UNITS / INCHES",
        });
        self.unit = unit;
    }

    /// A CL length, or point, in mm.
    pub(super) fn mm(&self) -> f64 {
        self.unit.in_mm()
    }

    /// GOTO or GODLTA; the text and the motion.
    fn straight(&mut self, to: Option<Point>, by: Point, rapid: bool) {
        if rapid {
            self.line("RAPID");
        }
        let scaled = times(by, self.mm());
        let target = match (to, self.at) {
            (Some(to), _) => {
                self.goto(to);
                times(to, self.mm())
            }
            (None, Some(at)) => {
                let [x, y, z] = by.map(number);
                self.line(&format!("GODLTA / {x}, {y}, {z}"));
                if self.is_left {
                    self.must_refuse("GODLTA from a point at which the tool does not stand");
                }
                add(at, scaled)
            }
            (None, None) => return self.out.unpredictable = true,
        };
        let machine = self.frame.apply(target);
        if self.cycle.is_some() && self.at.is_none_or(|at| target[2] < at[2]) {
            self.may_refuse("a rapid move in a cycle that leads down");
        }
        self.at = Some(target);
        self.is_left = false;
        if let Some(cycle) = &mut self.cycle {
            if !rapid {
                // A GOTO inside a cycle is a hole, which the generator says so.
                self.out.unpredictable = true;
                return;
            }
            cycle.traversed(machine[2]);
        }
        let (across, along) = self.moves(machine);
        // In the first part of a split rapid one of the two still waits.
        let in_parts = self.setup.split && rapid && self.has_parts(machine);
        if !in_parts {
            self.settle(across, along);
        }
        let act = match self.thread {
            _ if rapid => Act::Rapid(machine),
            Some(lead) => Act::Thread { to: machine, lead },
            None => Act::Feed(machine),
        };
        if matches!(act, Act::Feed(_)) && self.no_feed() {
            self.must_refuse("a feed motion without a feed");
        }
        self.push(act);
        self.compensation_is_fresh &= !(across || along && self.setup.turns());
        if in_parts {
            self.settle(across, along);
        }
        self.stands(machine);
    }

    pub(super) fn goto(&mut self, to: Point) {
        let [x, y, z] = to.map(number);
        self.line(&format!("GOTO / {x}, {y}, {z}"));
    }

    pub(super) fn no_feed(&self) -> bool {
        self.feed == Want::OneOf(Vec::new())
    }

    /// The machine is at a point, where the block that brings it there is run.
    pub(super) fn stands(&mut self, machine: Point) {
        if self.runs() {
            self.tape = Some(machine);
            self.height_unknown = false;
        }
    }

    /// Where the machine stands is not what the CL says.
    pub(super) fn lost(&mut self) {
        if self.runs() {
            self.tape = None;
        }
    }

    pub(super) fn runs(&self) -> bool {
        !(self.skipping && self.world == World::Skipping)
    }

    pub(super) fn is_skipped(&self) -> bool {
        self.skipping
    }

    fn something_waits(&self) -> bool {
        self.spindle.waits() || self.coolant.waits() || self.compensation.waits()
    }

    /// Whether a motion goes across, and whether along Z.
    pub(super) fn moves(&self, to: Point) -> (bool, bool) {
        let Some(from) = self.tape else { return (true, true) };
        let moves = |axis: usize| (to[axis] - from[axis]).abs() > SETTLES;
        (moves(0) || moves(1), moves(2))
    }

    /// A motion may need a part across and one along Z, of a last digit at least.
    fn has_parts(&self, to: Point) -> bool {
        let Some(from) = self.tape else { return true };
        (to[0] != from[0] || to[1] != from[1]) && to[2] != from[2]
    }

    /// What waits for a motion is in force when it moves.
    pub(super) fn settle(&mut self, across: bool, along: bool) {
        self.spindle.moved(across, along);
        self.coolant.moved(across, along);
        self.compensation.moved(across, along);
    }

    /// Adds a step with the modes in force.
    pub(super) fn push(&mut self, act: Act) {
        if !self.runs() {
            return;
        }
        let feed = if self.repeats_feed { Want::Any } else { self.feed.clone() };
        self.needs_spindle(&act, &feed);
        let modes = Modes {
            feed,
            spindle: self.spindle.now.clone(),
            coolant: self.coolant.now.clone(),
            compensation: self.compensation.now.clone(),
            length: self.length.clone(),
            limit: self.limit.clone(),
        };
        let height_unknown = self.height_unknown;
        self.out.steps.push(Step { act, modes, line: self.line, height_unknown });
    }

    /// The interpreter refuses a feed a revolution while the spindle stands, and so does a post of
    /// a lathe.
    fn needs_spindle(&mut self, act: &Act, feed: &Want<Rate>) {
        let may_stop = self.spindle.now.accepts(|turning| *turning == Turning::Stopped);
        if matches!(act, Act::Thread { .. }) {
            if may_stop {
                self.may_refuse("a thread with the spindle standing");
            }
            self.needs_one_speed();
        }
        let cuts = matches!(act, Act::Feed(_) | Act::Arc(_) | Act::Hole(_));
        let per_revolution = feed.accepts(|rate| rate.per_revolution);
        match cuts && per_revolution && may_stop {
            true if self.setup.turns() => {
                self.may_refuse("feed per revolution of a spindle that stands")
            }
            true => self.out.unpredictable = true,
            false => {}
        }
    }

    /// The passes of a thread meet at one speed of the spindle alone.
    fn needs_one_speed(&mut self) {
        let of_surface = |turning: &Turning| matches!(turning, Turning::Surface { .. });
        if self.spindle.now.accepts(of_surface) {
            self.may_refuse("a thread at surface speed");
        }
        let now = (self.spindle.now.clone(), self.limit.clone());
        if self.thread_turns.get_or_insert_with(|| now.clone()) != &now {
            self.may_refuse("another speed of the spindle between the passes of a thread");
        }
    }

    fn trans(&mut self, trans: &Trans) {
        self.line(&trans_text(trans));
        self.frame = Frame::new(trans, self.mm());
        self.is_left = true;
    }

    /// How far the machine stands from where the CL point lies in the frame in force.
    pub(super) fn off_tape(&self) -> f64 {
        match (self.at, self.tape) {
            (Some(at), Some(tape)) => distance(self.frame.apply(at), tape),
            _ => f64::INFINITY,
        }
    }
}

fn trans_text(trans: &Trans) -> String {
    match trans {
        Trans::Shift(by) => {
            let [x, y, z] = by.map(number);
            format!("TRANS / {x}, {y}, {z}")
        }
        Trans::Matrix { shift, points_only, .. } => {
            let rows = Frame::new(trans, 1.0).rows();
            let mut items = Vec::new();
            for (row, shift) in rows.into_iter().zip(shift) {
                items.extend(row.map(|value| format!("{value:.12}")));
                items.push(number(*shift));
            }
            let option = if *points_only { ", OPTION, 10" } else { "" };
            format!("TRANS / {}{option}", items.join(", "))
        }
    }
}

/// A number with at most ten decimals, as Creo writes them, and a point.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.10}");
    let text = text.trim_end_matches('0');
    if text == "-0." { "0.".to_string() } else { text.to_string() }
}
