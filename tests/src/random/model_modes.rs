//! Feed, spindle, coolant, tool and compensation, as the model reads them.

use crate::path::{Axis, Unit};

use super::expected::{Act, Compensation, Coolant, Rate, Turning, Want};
use super::model::{Model, number};
use super::model_cycle::Active;
use super::setup::Placement;
use super::statement::{CoolantCommand, CutcomCommand, Feedrate, SpindleCommand};

/// A mode whose word may wait for a motion.
pub(super) struct Waiting<T> {
    pub(super) now: Want<T>,
    next: Option<(Want<T>, Placement)>,
}

impl<T: PartialEq + Clone> Waiting<T> {
    pub(super) fn new(now: Want<T>) -> Self {
        Waiting { now, next: None }
    }

    /// Takes a value, at once or with a motion.
    pub(super) fn set(&mut self, value: Want<T>, placement: Placement) {
        if placement == Placement::Own {
            self.now = value;
            self.next = None;
        } else {
            self.now = self.now.or(&value);
            self.next = Some((value, placement));
        }
    }

    /// A value waits for a motion.
    pub(super) fn waits(&self) -> bool {
        self.next.is_some()
    }

    /// A motion across or along Z: what waited for it is in force.
    pub(super) fn moved(&mut self, across: bool, along: bool) {
        let due = |placement| match placement {
            Placement::Own => true,
            Placement::NextXy => across,
            Placement::NextAny => across || along,
            Placement::NextZ => along,
        };
        if let Some((value, _)) = self.next.take_if(|(_, placement)| due(*placement)) {
            self.now = value;
        }
    }
}

impl Model<'_> {
    pub(super) fn rate(&self, feed: Feedrate) -> Rate {
        Rate { value: feed.value * self.mm(), per_revolution: feed.per_revolution }
    }

    pub(super) fn feed_unit(&self, feed: Feedrate) -> &'static str {
        match (self.unit, feed.per_revolution) {
            (Unit::Mm, false) => "MMPM",
            (Unit::Mm, true) => "MMPR",
            (Unit::Inch, false) => "IPM",
            (Unit::Inch, true) => "IPR",
        }
    }

    pub(super) fn feedrate(&mut self, feed: Feedrate) {
        let unit = self.feed_unit(feed);
        self.line(&format!("FEDRAT / {}, {unit}", number(feed.value)));
        self.feed = Want::only(self.rate(feed));
        self.thread = None;
    }

    /// The value that is in force after a statement: where the block may be left
    /// out, the value before it too.
    fn either<T: PartialEq + Clone>(&self, before: &Want<T>, value: T) -> Want<T> {
        let value = Want::only(value);
        if self.runs() { value } else { before.or(&value) }
    }

    pub(super) fn spindle(&mut self, command: SpindleCommand) {
        if self.cycle.as_ref().is_some_and(Active::taps) {
            self.may_refuse("another speed between the holes of a tap");
        }
        let (turning, placement) = match command {
            SpindleCommand::Turn { speed, ccw } => {
                let direction = if ccw { "CCLW" } else { "CLW" };
                self.line(&format!("SPINDL / RPM, {}, {direction}", number(speed)));
                (Turning::At { speed, ccw }, self.setup.spindle)
            }
            SpindleCommand::Surface { speed, ccw, limit } => {
                let direction = if ccw { "CCLW" } else { "CLW" };
                let unit = if self.unit == Unit::Mm { "SMM" } else { "SFM" };
                let most =
                    limit.map_or(String::new(), |limit| format!(", MAXRPM, {}", number(limit)));
                self.line(&format!("SPINDL / {unit}, {}{most}, {direction}", number(speed)));
                if let Some(limit) = limit {
                    self.limit = self.either(&self.limit, limit);
                }
                (Turning::Surface { speed, ccw }, self.setup.spindle)
            }
            SpindleCommand::Off => {
                self.line("SPINDL / OFF");
                (Turning::Stopped, Placement::Own)
            }
        };
        let value = self.either(&self.spindle.now, turning);
        self.spindle.set(value, placement);
    }

    /// DELAY/REV on a machine that waits seconds: they follow from the speed.
    pub(super) fn delay_turns(&mut self, turns: f64) {
        self.line(&format!("DELAY / REV, {}", number(turns)));
        match &self.spindle.now {
            Want::OneOf(known) => match known[..] {
                [Turning::At { speed, .. }] => self.wait_turns(turns, speed),
                [Turning::Surface { speed, .. }] => match self.slowest_at_surface(speed) {
                    Some(speed) => self.wait_turns(turns, speed),
                    None => self.out.unpredictable = true,
                },
                [_] => self.must_refuse("turns of a spindle whose speed nobody knows"),
                _ => self.out.unpredictable = true,
            },
            Want::Any => self.out.unpredictable = true,
        }
    }

    fn wait_turns(&mut self, turns: f64, speed: f64) {
        let seconds = turns * 60.0 / speed;
        let amount = seconds * self.setup.dwell_factor;
        if self.setup.rounds_dwell(seconds) && amount < 50.0 {
            self.may_refuse("a dwell that rounding changes by a hundredth");
        }
        self.push(Act::Dwell(seconds));
    }

    /// Turns a minute at a surface speed where the tool stands, no more than its limit; `None`
    /// where one of the two is not known.
    fn slowest_at_surface(&self, speed: f64) -> Option<f64> {
        let diameter = 2.0 * self.tape?[0].abs();
        let mm_a_minute = if self.unit == Unit::Mm { speed * 1000.0 } else { speed * 304.8 };
        let Want::OneOf(limits) = &self.limit else { return None };
        let [limit] = limits[..] else { return None };
        Some((mm_a_minute / (std::f64::consts::PI * diameter)).min(limit))
    }

    pub(super) fn coolant(&mut self, command: CoolantCommand) {
        let (word, flows) = match command {
            CoolantCommand::On => ("ON", Coolant { flood: true, mist: false }),
            CoolantCommand::Mist => ("MIST", Coolant { flood: false, mist: true }),
            CoolantCommand::Off => ("OFF", Coolant { flood: false, mist: false }),
        };
        self.line(&format!("COOLNT / {word}"));
        let off = command == CoolantCommand::Off;
        let placement = if off { Placement::Own } else { self.setup.coolant };
        let value = self.either(&self.coolant.now, flows);
        self.coolant.set(value, placement);
    }

    pub(super) fn tool(&mut self, tool: u32, offset: Option<u32>) {
        let osetno = offset.map_or(String::new(), |offset| format!(", OSETNO, {offset}"));
        self.line(&format!("LOADTL / {tool}{osetno}"));
        if self.cycle.is_some() {
            self.may_refuse("a tool change in a cycle");
        }
        if self.compensation.now != Want::only(Compensation::Off) {
            self.may_refuse("a tool change under compensation");
        }
        if self.is_skipped() {
            self.may_refuse("a tool change in skipped blocks");
            self.tool = None;
            self.tool_offset = None;
            self.length = Want::Any;
        } else if self.setup.tool_modal
            && self.tool == Some(tool)
            && self.tool_offset == Some(offset.unwrap_or(tool))
        {
            return;
        }
        // Another offset of the tool in the spindle is no change of it, but for a T word that has both.
        let before = self.tool_offset.filter(|_| self.tool == Some(tool));
        let is_tip = before.is_some_and(|before| before != offset.unwrap_or(tool));
        if is_tip {
            self.may_refuse("another tip of the tool in its cut");
        }
        if !is_tip || self.setup.runs_on_our_lathe() {
            self.push(Act::Tool(tool));
        }
        if !self.is_skipped() {
            self.tool = Some(tool);
            self.tool_offset = Some(offset.unwrap_or(tool));
            self.length = Want::only(offset.unwrap_or(tool));
        }
        self.thread = None;
        self.spindle = Waiting::new(Want::Any);
        self.any_coolant();
        self.lost();
        self.height_unknown = true;
    }

    pub(super) fn cutcom(&mut self, command: CutcomCommand) {
        if self.cycle.is_some() {
            self.may_refuse("compensation in a cycle");
        }
        let value = match command {
            CutcomCommand::Off => {
                self.line("CUTCOM / OFF");
                Compensation::Off
            }
            CutcomCommand::On { left, offset } => {
                let side = if left { "LEFT" } else { "RIGHT" };
                let given = offset.map_or(String::new(), |offset| format!(", {offset}"));
                self.line(&format!("CUTCOM / {side}{given}"));
                // On a lathe the nose is in the offset of the tool, and nothing names it, but
                // where LinuxCNC would take the radius of the tool itself.
                let is_other = self.tool_offset.is_some() && self.tool_offset != self.tool;
                let names = self.setup.ready == "linuxcnc-lathe" && is_other;
                let of_offset = self.tool_offset.filter(|_| names).unwrap_or(0);
                let of_lathe = self.setup.turns().then_some(of_offset);
                let Some(number) = of_lathe.or(offset).or(self.tool) else {
                    return self.out.unpredictable = true;
                };
                if left { Compensation::Left(number) } else { Compensation::Right(number) }
            }
        };
        if self.is_skipped() {
            self.may_refuse("compensation in skipped blocks");
        }
        if self.setup.turns() && self.frame.turns_over(Axis::Y) {
            self.must_refuse("compensation in a frame where left is right");
        }
        self.compensation_is_fresh = true;
        self.compensation.set(Want::only(value), self.setup.cutcom);
    }

    pub(super) fn compensated(&self) -> bool {
        self.compensation.now != Want::only(Compensation::Off)
    }

    pub(super) fn compensation_waits(&self) -> bool {
        self.compensation.waits()
    }

    pub(super) fn any_compensation(&mut self) {
        self.compensation = Waiting::new(Want::Any);
    }

    pub(super) fn any_spindle(&mut self) {
        self.spindle = Waiting::new(Want::Any);
    }

    pub(super) fn any_coolant(&mut self) {
        self.coolant = Waiting::new(Want::Any);
    }
}
