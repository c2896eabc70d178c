//! What the control remembers from block to block.

use super::Fault;
use super::cycle::Cycle;
use super::thread::{Pass, Setup};
use super::words::{AxisWord, Words};
use crate::dialect::{Amount, Certain, Dialect, FeedMode, Function, Habit};
use crate::errors::NcCode;
use crate::motion::{
    Arc, Compensation, Course, DRILLED, Event, Modes, Move, OtherPlane, PlaneModes, Position, Rate,
    SpindleModes, StartMode, Tilt, unit,
};
use crate::text::Block;

/// X, Y, Z in mm, primary and secondary rotary axis in degrees.
pub(super) type Axes = [f64; 5];

/// F words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Feed {
    pub(super) mode: FeedMode,
    /// F as on the tape.
    pub(super) word: Option<f64>,
}

/// Where planes were chosen; by the index of their normals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planes {
    /// The plane that was said last, and the line of that.
    pub(super) said: usize,
    pub(super) line: u32,
    /// The plane in force before polar interpolation.
    pub(super) before: usize,
}

/// What ends with the next motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SinceMotion {
    /// Radius of the arc that the last motion made, as on the tape, where the next arc
    /// may leave it out.
    pub(super) arc_radius: Option<f64>,
    /// Cutter compensation was switched.
    pub(super) compensation_rests: bool,
    /// Tool center point control has ended: X, Y and Z are those of the tip.
    pub(super) was_tip: bool,
}

/// The cycle of the control.
#[derive(Default)]
pub(super) struct ActiveCycle {
    pub(super) active: Option<Cycle>,
    /// A cycle of a SINUMERIK is called at each position (MCALL).
    pub(super) at_each: bool,
    /// Holes return to the level before the cycle.
    pub(super) returns_initial: bool,
    /// The level of G71 of an OSP, along the plane's normal.
    pub(super) level: Option<f64>,
}

/// How the head and the tables hold the tool.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Head {
    /// The tilted work plane in force.
    pub(super) tilt: Option<Tilt>,
    /// The tool lies along its Z.
    pub(super) aligned: bool,
    /// Words of I, J and K are the direction of the tool, and no words of rotary axes are taken.
    pub(super) by_direction: bool,
}

/// The main spindle of a mill-turn machine as the axis C.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LiveAxis {
    /// It is one.
    pub(super) is_on: bool,
    /// X and C are a plane of lengths.
    pub(super) polar: bool,
    /// Radius of the cylinder on which the feed counts, mm.
    pub(super) cylinder: Option<f64>,
}

/// Threading cycles.
#[derive(Default)]
pub(super) struct ThreadCycles {
    pub(super) pass: Option<Pass>,
    pub(super) setup: Option<Setup>,
    /// They leave the thread at an angle, where M codes switch that and one has.
    pub(super) leaves: Option<bool>,
}

/// The control.
pub(super) struct State<'d> {
    pub(super) dialect: &'d Dialect,
    /// Line of the block that is run.
    pub(super) line: u32,
    pub(super) at: Axes,
    pub(super) known: [bool; 5],
    /// Where the zero of the program lies, X Y Z, mm.
    pub(super) zero: [f64; 3],
    /// Motion function in force.
    pub(super) motion: Option<Function>,
    /// The plane in force, by the index of its normal.
    pub(super) plane: usize,
    pub(super) planes: Planes,
    pub(super) metric: bool,
    pub(super) absolute: bool,
    pub(super) feed: Feed,
    pub(super) since: SinceMotion,
    /// The function of the length offset stood behind the last tool change.
    pub(super) length_is_on: bool,
    /// S is a surface speed.
    pub(super) surface: bool,
    /// The modes that a block has said, or the machine.
    pub(super) certain: Certain,
    pub(super) cycle: ActiveCycle,
    pub(super) head: Head,
    pub(super) live: LiveAxis,
    pub(super) threads: ThreadCycles,
    /// Tool that the next change takes.
    pub(super) next_tool: Option<u32>,
    pub(super) modes: Modes,
    /// The spindle that is not the master spindle.
    pub(super) other_spindle: SpindleModes,
    /// Events of the block; they count when the whole block has a meaning.
    pub(super) events: Vec<Event>,
    /// The words of the block before, whose memory is used again.
    pub(super) words: Words,
}

impl<'d> State<'d> {
    pub(super) fn new(dialect: &'d Dialect) -> Self {
        State {
            dialect,
            line: 0,
            at: dialect.axes.map(|axis| axis.start.unwrap_or(0.0)),
            known: std::array::from_fn(|axis| {
                let is_spindle = axis == 3 && dialect.turning.live_at_start == Some(false);
                dialect.axes[axis].start.is_some()
                    || dialect.axes[axis].scale.is_none()
                    || is_spindle
            }),
            zero: [0.0; 3],
            motion: None,
            plane: dialect.start.plane,
            planes: Planes {
                said: if dialect.is_lathe() { dialect.start.plane } else { DRILLED },
                line: 0,
                before: dialect.start.plane,
            },
            metric: dialect.has(Habit::Metric),
            absolute: dialect.has(Habit::Absolute),
            feed: Feed { mode: dialect.start.feed_mode, word: None },
            since: SinceMotion::default(),
            length_is_on: false,
            surface: false,
            certain: dialect.start.certain,
            cycle: ActiveCycle {
                returns_initial: dialect.has(Habit::ReturnsInitial),
                ..ActiveCycle::default()
            },
            head: Head::default(),
            live: LiveAxis {
                is_on: dialect.turning.live_at_start == Some(true),
                ..LiveAxis::default()
            },
            threads: ThreadCycles::default(),
            next_tool: None,
            modes: Modes { inch: !dialect.has(Habit::Metric), ..Modes::default() },
            other_spindle: SpindleModes::default(),
            events: Vec::new(),
            words: Words::default(),
        }
    }

    /// Takes the unit, the meaning of axis words and of F, and the plane that a refused block
    /// gives: they hold, whatever else the block does.
    pub(super) fn keep_meanings(&mut self, block: &Block) {
        self.line = block.line;
        let mut words = std::mem::take(&mut self.words);
        words.read_meanings(block, self.dialect);
        // What could be refused is not among them.
        let _ = self.modes(&mut words);
        self.words = words;
    }

    /// Goes on after a refused block: which axes it moves, and which functions it leaves in
    /// force, is unknown until the program gives them again.
    pub(super) fn forget(&mut self) {
        self.known = std::array::from_fn(|axis| self.dialect.axes[axis].scale.is_none());
        self.motion = None;
        self.since = SinceMotion::default();
        self.cycle.active = None;
        self.threads = ThreadCycles::default();
        self.events.clear();
    }

    /// Remembers where the plane in force was said first.
    pub(super) fn say_plane(&mut self, normal: usize) {
        if self.planes.said != normal || self.planes.line == 0 {
            (self.planes.said, self.planes.line) = (normal, self.line);
        }
    }

    /// The plane in force on a SINUMERIK, where it is not that in which the lengths of the tool
    /// count rightly: X and Y in TRANSMIT, Z and X on a lathe, else that which the tool is square to.
    fn other_plane(&self) -> Option<OtherPlane> {
        let is_open = self.live.is_on && !self.dialect.has(Habit::Transforms);
        if !self.dialect.counts_lengths_in_plane() || is_open {
            return None;
        }
        self.plane_but(if self.live.polar { DRILLED } else { self.dialect.plane_of_lengths() })
    }

    /// The plane in force, where it is another one than must be.
    pub(super) fn plane_but(&self, must: usize) -> Option<OtherPlane> {
        // Of a plane that neither the program nor the machine says that much is told elsewhere.
        let is_unsaid = self.planes.line == 0 && !self.dialect.start.certain.has(StartMode::Plane);
        let is_other = self.plane != must && !is_unsaid;
        is_other.then_some(OtherPlane { normal: self.plane, must, line: self.planes.line })
    }

    /// Takes the unit of what follows.
    pub(super) fn set_metric(&mut self, metric: bool) {
        self.metric = metric;
        self.modes.inch = !metric;
    }

    /// Millimetres of a unit of length on the tape.
    pub(super) fn unit(&self) -> f64 {
        unit(self.metric)
    }

    /// Position of an axis that a value on the tape stands for.
    pub(super) fn position(&self, axis: usize, value: f64) -> f64 {
        let scale = self.dialect.axes[axis].scale;
        let zero = self.zero.get(axis).copied().unwrap_or(0.0);
        scale.map_or(value, |scale| scale.position(value)) * self.axis_unit(axis) + zero
    }

    /// Way of an axis that an increment on the tape stands for.
    pub(super) fn way(&self, axis: usize, value: f64) -> f64 {
        let scale = self.dialect.axes[axis].scale;
        scale.map_or(value, |scale| scale.way(value)) * self.axis_unit(axis)
    }

    /// A length along an axis that the tape says outside of the axis' own words, mm: diameters
    /// are of positions alone.
    pub(super) fn length(&self, axis: usize, value: f64) -> f64 {
        let scale =
            self.dialect.axes[axis].scale.filter(|scale| !(axis == 0 && scale.is_diameter()));
        scale.map_or(value, |scale| scale.way(value)) * self.axis_unit(axis)
    }

    fn axis_unit(&self, axis: usize) -> f64 {
        if axis < 3 { self.unit() } else { 1.0 }
    }

    /// Where axis words lead, from where the axes stand; which axes are known there.
    pub(super) fn target(&self, words: &[AxisWord]) -> (Axes, [bool; 5]) {
        let (mut to, mut known) = (self.at, self.known);
        for word in words {
            let word = &self.in_plane(*word);
            if self.absolute && !word.increment {
                to[word.axis] = match self.dialect.axes[word.axis].way_round {
                    None => self.position(word.axis, word.value),
                    Some(way) => self.turned(word.axis, word.value, way),
                };
                known[word.axis] = true;
            } else {
                to[word.axis] += self.way(word.axis, word.value);
            }
        }
        (to, known)
    }

    /// The feed in force.
    pub(super) fn rate(&self) -> Result<Rate, Fault> {
        let feed = self.feed.word.filter(|feed| *feed > 0.0);
        let feed = feed.ok_or_else(|| Fault::new(NcCode::NoFeed, "no F word is in force"))?;
        Ok(match self.feed.mode {
            FeedMode::PerMinute => {
                Rate::PerMinute(feed / self.dialect.factor(Amount::Feed) * self.unit())
            }
            FeedMode::PerTurn => Rate::PerTurn(feed * self.unit()),
            FeedMode::Inverse => Rate::Inverse(feed / self.dialect.factor(Amount::Inverse)),
        })
    }

    /// A straight motion.
    pub(super) fn go(
        &mut self,
        (to, known): (Axes, [bool; 5]),
        course: Course,
        rate: Option<Rate>,
    ) {
        self.travel((to, known), course, rate, None);
    }

    /// A motion to a point, along an arc where one is given.
    pub(super) fn travel(
        &mut self,
        (to, known): (Axes, [bool; 5]),
        course: Course,
        rate: Option<Rate>,
        arc: Option<Arc>,
    ) {
        (self.at, self.known) = (to, known);
        self.since = SinceMotion::default();
        let [x, y, z, primary, secondary] = to;
        let usual = [DRILLED, self.dialect.start.plane].contains(&self.planes.said);
        let is_other =
            !usual && !self.dialect.is_lathe() && !self.dialect.counts_lengths_in_plane();
        let plane = is_other.then_some((self.planes.said, self.planes.line));
        let other_plane = self.other_plane().filter(|_| course != Course::Machine);
        let is_compensated = self.modes.compensation.side != Compensation::Off;
        let mut modes = self.modes;
        modes.planes = PlaneModes { unusual: plane, other: other_plane };
        modes.compensation.plane = is_compensated.then_some(self.plane);
        let transformed = self.dialect.has(Habit::Transforms)
            && (self.live.polar || self.live.cylinder.is_some());
        self.events.push(Event::Move(Move {
            line: self.line,
            course,
            to: Position {
                linear: [x, y, z],
                rotary: [primary, secondary],
                tip_control: self.modes.frame.tip_control,
                tilt: self.head.tilt,
                transformed,
            },
            arc,
            rate,
            in_cycle: course != Course::Machine
                && (self.cycle.active.is_some() || self.threads.pass.is_some()),
            known,
            to_machine: [false; 5],
            modes,
        }));
    }

    /// A motion to a point of the machine: where the axes that go there stand in the frame of
    /// the program is not known.
    pub(super) fn go_to_machine(&mut self, to: Axes, named: [bool; 5]) {
        let known = std::array::from_fn(|axis| self.known[axis] && !named[axis]);
        self.go((to, known), Course::Machine, None);
        if let Some(Event::Move(found)) = self.events.last_mut() {
            found.to_machine = named;
        }
        if named[2] && self.dialect.has(Habit::PositionsEndLengths) {
            self.modes.length.offset = None;
        }
    }

    /// A motion of some axes within a cycle; none when they stand there.
    pub(super) fn step(&mut self, to: &[(usize, f64)], course: Course, rate: Option<Rate>) {
        let mut target = self.at;
        for (axis, position) in to {
            target[*axis] = *position;
        }
        if target != self.at {
            self.go((target, self.known), course, rate);
        }
    }
}
