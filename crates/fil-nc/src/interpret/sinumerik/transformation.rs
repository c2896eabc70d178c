//! Live tools: SETMS, TRANSMIT, TRACYL, TRAFOOF.
//!
//! By the manual of the language: M70 makes the master spindle an axis, SETMS chooses the master
//! spindle, whose S and M have no number; TRANSMIT makes X and Y a plane of lengths whose X lies
//! where C is 0; TRACYL makes Y the way around a cylinder of the diameter that it names; TRAFOOF
//! ends both. Each wants compensation off. DIAMOF makes X a radius until DIAMON.

use super::super::{Fault, refuse};
use super::Sinumerik;
use super::block::Said;
use super::line::{Value, Word};
use crate::dialect::{FeedMode, Function, Habit, Numbered};
use crate::motion::{Compensation, Spindle};

/// Number of the axis C.
const C: usize = 3;

impl Sinumerik<'_> {
    /// `SETMS(2)` and `SETMS`.
    pub(super) fn choose_master(&mut self, word: &Word) -> Result<(), Fault> {
        let number = match word.arguments.as_deref() {
            None | Some([]) => 1,
            Some([Some(Value::Number(number))]) => *number as i32,
            Some(_) => return Err(word.no_meaning()),
        };
        if let Some(second) = self.state.dialect.turning.counted.number {
            return match number {
                1 => self.state.count(false),
                number if number == second => self.state.count(true),
                _ => Err(word.no_meaning()),
            };
        }
        let Some(live) = self.state.dialect.number(Numbered::LiveSpindle) else {
            return Err(word.foreign("on a machine without another spindle"));
        };
        let [milling, turning] = self.state.dialect.turning.mode_codes;
        match number {
            1 if self.state.live.is_on => self.change_spindle(false, turning),
            1 => Ok(()),
            number if number == live && self.is_axis => self.change_spindle(true, milling),
            number if number == live => {
                refuse("SETMS before M70 has made the main spindle an axis")
            }
            _ => Err(word.no_meaning()),
        }
    }

    fn change_spindle(&mut self, on: bool, code: Option<i32>) -> Result<(), Fault> {
        self.is_axis = on;
        self.state.change_spindle(on, code.unwrap_or(0).unsigned_abs())
    }

    /// M70: the main spindle stands and becomes an axis.
    pub(super) fn become_axis(&mut self, on: bool, code: u32) -> Result<(), Fault> {
        if self.state.dialect.number(Numbered::LiveSpindle).is_none() {
            return self.change_spindle(on, Some(code as i32));
        }
        if self.state.modes.spindle.turn != Spindle::Off || self.state.live.is_on {
            return refuse("a spindle becomes an axis while it turns, or is that of a live tool");
        }
        self.is_axis = on;
        Ok(())
    }

    /// TRANSMIT.
    pub(super) fn transmit(&mut self) -> Result<(), Fault> {
        self.check_transformation()?;
        let plane = self.state.plane;
        self.state.begin_polar()?;
        self.state.plane = plane;
        Ok(())
    }

    /// `TRACYL(40)`.
    pub(super) fn tracyl(&mut self, word: &Word) -> Result<(), Fault> {
        self.check_transformation()?;
        let diameter = match word.arguments.as_deref() {
            Some([Some(Value::Number(diameter))]) if *diameter > 0.0 => *diameter,
            _ => return Err(word.no_meaning()),
        };
        if !self.state.known[C] {
            return refuse("TRACYL while the position of C is not known");
        }
        self.state.live.cylinder = Some(diameter / 2.0 * self.state.unit());
        Ok(())
    }

    fn check_transformation(&self) -> Result<(), Fault> {
        if !self.state.dialect.has(Habit::Transforms) || !self.state.live.is_on {
            return refuse("a transformation while the main spindle is no axis");
        }
        if self.is_transformed() {
            return refuse("a transformation within another");
        }
        self.check_no_compensation()
    }

    fn check_no_compensation(&self) -> Result<(), Fault> {
        match self.state.modes.compensation.side {
            Compensation::Off => Ok(()),
            _ => refuse("a transformation begins or ends under compensation"),
        }
    }

    /// Ends a transformation; false where none is in force.
    pub(super) fn end_transformation(&mut self) -> Result<bool, Fault> {
        if !self.is_transformed() {
            return Ok(false);
        }
        self.check_no_compensation()?;
        if self.state.live.polar {
            let plane = self.state.plane;
            self.state.end_polar()?;
            self.state.plane = plane;
        }
        self.state.live.cylinder = None;
        Ok(true)
    }

    pub(super) fn is_transformed(&self) -> bool {
        self.state.live.polar || self.state.live.cylinder.is_some()
    }

    /// Where an axis word of the block leads: which axis, by what on the tape as its scale counts
    /// it. Y of TRACYL turns C.
    pub(super) fn in_transformation(&self, axis: usize, value: f64) -> (usize, f64) {
        let is_diameter = self.state.dialect.axes[0].scale.is_some_and(|x| x.is_diameter());
        match (axis, self.state.live.cylinder) {
            (0, _) if self.counts_radii && is_diameter => (0, 2.0 * value),
            (1, Some(radius)) => (C, (value * self.state.unit() / radius).to_degrees()),
            _ => (axis, value),
        }
    }

    /// Refuses what only one of the two kinds of spindle does, and axes that are not there.
    pub(super) fn check_live(&self, said: &Said) -> Result<(), Fault> {
        if self.state.dialect.turning.live_at_start.is_none() {
            return Ok(());
        }
        let names = |axis: usize| said.axes[axis].is_some();
        if self.state.dialect.has(Habit::Transforms) && names(1) && !self.is_transformed() {
            return refuse("a word of Y without TRANSMIT and TRACYL");
        }
        if names(C) && (self.is_transformed() || !self.state.live.is_on) {
            return refuse("a word of C in a transformation, or of a spindle that is no axis");
        }
        if self.state.live.is_on
            && self.state.surface
            && self.state.modes.spindle.turn != Spindle::Off
        {
            return refuse("a surface speed of a live tool");
        }
        let threads = [Function::Thread, Function::VaryingThread].map(Some);
        if self.state.live.is_on && threads.contains(&self.state.motion) && said.moves() {
            return refuse("a thread while the main spindle is the axis C");
        }
        if self.counts_radii && said.moves() && !self.is_transformed() && !said.taps() {
            return refuse("X as a radius outside of a transformation and of a tap");
        }
        Ok(())
    }

    /// An arc of a live tool: in TRANSMIT in its plane, at a feed a minute.
    pub(super) fn check_live_arc(&self, normal: usize, rises: bool) -> Result<(), Fault> {
        if !self.state.live.is_on {
            return Ok(());
        }
        if self.state.feed.mode == FeedMode::PerTurn {
            return refuse("feed per revolution of a main spindle in C-axis mode");
        }
        if self.state.live.cylinder.is_some() || self.state.live.polar && (normal != 2 || rises) {
            return refuse("an arc in TRACYL, or of TRANSMIT in another plane than X and Y");
        }
        Ok(())
    }
}
