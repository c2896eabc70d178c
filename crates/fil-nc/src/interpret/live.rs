//! Live tools: a main spindle that is the axis C, the plane of X and C in polar
//! interpolation, and the cylinder of cylindrical interpolation.
//!
//! Fanuc's manual of these functions: each stands in a block of its own; polar
//! interpolation takes the place of C as the zero of its second axis, in lengths of radius,
//! with arcs by I and J; neither takes rapid traverse; cylindrical interpolation begins
//! under G1, names its radius by the word of the rotary axis, and 0 ends it.

use super::state::{Axes, State};
use super::words::{AxisWord, Words, letter};
use super::{Fault, refuse};
use crate::dialect::{Amount, Auxiliary, FeedMode, Function, Group, Role};
use crate::motion::{Compensation, Course, Event, Speed, Spindle};

/// Number of the axis C.
const C: usize = 3;

/// Angles nearer than this are one, degrees.
const SAME_ANGLE: f64 = 1e-9;

/// The path may not come nearer to the axis of the spindle than this, mm.
const NEAREST: f64 = 0.04;

/// Lengths nearer than this are one in the last digits of any control, mm.
const DIGITS: f64 = 2e-3;

impl State<'_> {
    /// The main spindle becomes the axis C or a spindle again; it must stand, and so must the
    /// live tool.
    pub(super) fn change_spindle(&mut self, on: bool, code: u32) -> Result<(), Fault> {
        if self.modes.spindle.turn != Spindle::Off {
            return refuse("the main spindle changes its mode while a spindle turns");
        }
        if self.live.polar || self.live.cylinder.is_some() {
            return refuse("the main spindle changes its mode within an interpolation");
        }
        self.modes.spindle.speed = None;
        self.live.is_on = on;
        self.at[C] = 0.0;
        self.known[C] = !on;
        self.events.push(Event::Auxiliary { line: self.line, code });
        Ok(())
    }

    /// The live tool turns, where the main spindle is an axis; it stands otherwise.
    pub(super) fn turn_live_tool(&mut self, turn: Spindle) -> Result<(), Fault> {
        match (self.live.is_on, turn) {
            (true, turn) => self.turn_spindle(turn),
            (false, Spindle::Off) => {}
            (false, _) => return refuse("a live tool turns while the main spindle is no axis"),
        }
        Ok(())
    }

    /// The speed of a live tool that has a letter of its own, beside its code.
    pub(super) fn live_speed(&mut self, words: &mut Words) -> Result<(), Fault> {
        let letter = self.dialect.letter(Role::LiveSpeed);
        let turns = |auxiliary: &Auxiliary| {
            matches!(auxiliary, Auxiliary::Live(Spindle::Clockwise | Spindle::Counterclockwise))
        };
        if letter == 0 || !words.auxiliaries.iter().any(|(auxiliary, _)| turns(auxiliary)) {
            return Ok(());
        }
        match words.take(letter)? {
            Some(speed) => self.modes.spindle.speed = Some(Speed::Turns(speed)),
            None => return refuse("a live tool turns without its speed"),
        }
        Ok(())
    }

    /// True where P of a block that turns or stops a spindle selects the live tool.
    pub(super) fn selects_live_tool(&self, words: &mut Words) -> Result<bool, Fault> {
        let Some([main, live]) = self.dialect.turning.selects else { return Ok(false) };
        let turns = |auxiliary: &Auxiliary| {
            use Auxiliary::{Clockwise, Counterclockwise, SpindleOff};
            matches!(auxiliary, Clockwise | Counterclockwise | SpindleOff)
        };
        if !words.auxiliaries.iter().any(|(auxiliary, _)| turns(auxiliary)) {
            return Ok(false);
        }
        let selected =
            words.take_whole(letter(b'P'))?.and_then(|number| i32::try_from(number).ok());
        match selected {
            Some(_) if selected == live => Ok(true),
            Some(_) if selected == main => Ok(false),
            _ => refuse("P of this block selects no spindle"),
        }
    }

    /// A code of the main spindle while it is an axis: the same code may turn the live tool.
    pub(super) fn turn_main(&mut self, turn: Spindle) -> Result<(), Fault> {
        let [clockwise, counterclockwise, stop] = self.dialect.turning.one_code;
        let of_live_tool = match turn {
            Spindle::Clockwise => clockwise,
            Spindle::Counterclockwise => counterclockwise,
            Spindle::Off => stop,
        };
        match (of_live_tool, turn) {
            (true, turn) => self.turn_spindle(turn),
            (false, Spindle::Off) => {}
            (false, _) => return refuse("the main spindle turns while it is the axis C"),
        }
        Ok(())
    }

    /// Refuses what only one of the two kinds of spindle does.
    pub(super) fn check_live(&self, words: &Words) -> Result<(), Fault> {
        if self.dialect.turning.live_at_start.is_none() {
            return Ok(());
        }
        let turns = self.modes.spindle.turn != Spindle::Off;
        if self.live.is_on && self.surface && turns {
            return refuse("a surface speed of a live tool");
        }
        if self.live.is_on
            && matches!(
                self.motion,
                Some(Function::Thread | Function::VaryingThread | Function::ThreadPass)
            )
        {
            return refuse("a thread while the main spindle is the axis C");
        }
        if !self.live.is_on && words.has_rotary(self.dialect) {
            return refuse("a word of C while the main spindle is no axis");
        }
        Ok(())
    }

    /// Refuses what may not stand in a block of polar interpolation: its manual names the functions
    /// that may.
    pub(super) fn check_live_words(&self, words: &Words) -> Result<(), Fault> {
        if self.live.polar && words.peek(Group::Surface).is_some() {
            return refuse("a speed mode in polar interpolation, which takes none");
        }
        if self.live.polar && words.peek(Group::Plane).is_some() {
            return refuse("a plane is chosen in polar interpolation, which has its own");
        }
        Ok(())
    }

    /// A block of polar or cylindrical interpolation; false for another block.
    pub(super) fn interpolation_block(&mut self, words: &mut Words) -> Result<bool, Fault> {
        let Some(function) = words.function(Group::Interpolation) else { return Ok(false) };
        if !self.live.is_on {
            return refuse("the main spindle is no axis");
        }
        if self.modes.compensation.side != Compensation::Off {
            return refuse("an interpolation begins or ends under cutter compensation");
        }
        if self.cycle.active.is_some() {
            return refuse("an interpolation begins or ends in a cycle");
        }
        match function {
            Function::Polar(true) => self.begin_polar()?,
            Function::Polar(_) => self.end_polar()?,
            _ => self.cylinder(words)?,
        }
        words.finish()?;
        Ok(true)
    }

    pub(super) fn begin_polar(&mut self) -> Result<(), Fault> {
        if self.live.polar || self.live.cylinder.is_some() {
            return refuse("polar interpolation within an interpolation");
        }
        if !self.known[C] || self.at[C].abs() > SAME_ANGLE {
            return refuse(
                "polar interpolation begins where C is not at 0: controls differ in where its \
                 plane lies then",
            );
        }
        if self.at[1] != 0.0 {
            return refuse("polar interpolation begins with Y beside the axis");
        }
        self.live.polar = true;
        self.planes.before = std::mem::replace(&mut self.plane, 2);
        self.known[1] = true;
        Ok(())
    }

    pub(super) fn end_polar(&mut self) -> Result<(), Fault> {
        if !self.live.polar {
            return refuse("polar interpolation ends and none has begun");
        }
        self.live.polar = false;
        self.plane = self.planes.before;
        self.at[C] = libm::atan2(self.at[1], self.at[0]).to_degrees();
        self.at[0] = libm::hypot(self.at[0], self.at[1]);
        self.at[1] = 0.0;
        // The tool may stand on either side of the axis, after any number of turns.
        (self.known[0], self.known[C]) = (false, false);
        Ok(())
    }

    fn cylinder(&mut self, words: &mut Words) -> Result<(), Fault> {
        let radius = words.take(self.dialect.axes[C].letter)?;
        let Some(radius) = radius.map(|radius| radius * self.unit()) else {
            return refuse("cylindrical interpolation needs its radius");
        };
        if radius == 0.0 {
            if self.live.cylinder.take().is_none() {
                return refuse("cylindrical interpolation ends and none has begun");
            }
            return Ok(());
        }
        if self.live.polar || self.live.cylinder.is_some() || radius < 0.0 {
            return refuse("cylindrical interpolation within an interpolation, or below zero");
        }
        if self.motion != Some(Function::Linear) {
            return refuse("cylindrical interpolation begins under another function than G1");
        }
        self.live.cylinder = Some(radius);
        Ok(())
    }

    /// An axis word as the control takes it: C is the second axis of the plane in polar
    /// interpolation.
    pub(super) fn in_plane(&self, word: AxisWord) -> AxisWord {
        match self.live.polar && word.axis == C {
            true => AxisWord { axis: 1, ..word },
            false => word,
        }
    }

    /// How a straight motion of a mill-turn machine is driven, and whether it can be made.
    pub(super) fn live_course(&self, to: &Axes, course: Course) -> Result<Course, Fault> {
        if !self.live.is_on {
            return Ok(course);
        }
        let turns = (to[C] - self.at[C]).abs() > SAME_ANGLE || !self.known[C];
        if course == Course::Rapid {
            if self.live.polar || self.live.cylinder.is_some() {
                return refuse("rapid traverse within polar or cylindrical interpolation");
            }
            return Ok(course);
        }
        if self.feed.mode == FeedMode::PerTurn {
            return refuse("feed per revolution of a main spindle in C-axis mode");
        }
        if self.live.polar {
            return self.polar_course(to, course);
        }
        if turns && course == Course::Feed {
            let Some(radius) = self.live.cylinder else {
                if self.dialect.has_polar() {
                    return refuse("C moves at feed per minute without a cylinder");
                }
                // The tip goes along a curve, which the check of the path measures.
                return Ok(course);
            };
            if [self.at[0], to[0]].iter().any(|x| (x - radius).abs() > DIGITS) {
                return refuse("C turns at a feed beside the cylinder on which it counts");
            }
        }
        Ok(course)
    }

    /// The feed that the machine has for rapid motions makes one of them.
    fn polar_course(&self, to: &Axes, course: Course) -> Result<Course, Fault> {
        let way = [to[0] - self.at[0], to[1] - self.at[1]];
        let length = way[0] * way[0] + way[1] * way[1];
        if length > 0.0 {
            let along = -(self.at[0] * way[0] + self.at[1] * way[1]) / length;
            let along = along.clamp(0.0, 1.0);
            let near = libm::hypot(self.at[0] + along * way[0], self.at[1] + along * way[1]);
            if near < NEAREST {
                return refuse("the path passes the axis of the spindle in polar interpolation");
            }
        }
        if length > 0.0 && to[2] != self.at[2] {
            return refuse(
                "Z moves together with X and C in polar interpolation, which leads those two only",
            );
        }
        let feed = self.feed.word.map(|feed| feed * self.unit());
        let rapid = self.dialect.amount(Amount::PolarRapid);
        let is_rapid = feed.zip(rapid).is_some_and(|(feed, rapid)| (feed - rapid).abs() < 0.5);
        Ok(if is_rapid { Course::Rapid } else { course })
    }
}
