//! Tool-tip control (`G43.4`, `G43.5`): the tip goes straight in the frame of the part while
//! the rotary axes turn, and X, Y, Z name the tip there.
//!
//! Lengths of tools are the control's, so the tip is known from the program where all
//! rotary axes stand at zero and tool, part and machine lie alike, and wherever the
//! program names it. What controls, or their parameters, read in different ways is
//! refused.

use super::Fault;
use super::modes::H;
use super::state::{Axes, State};
use super::words::Words;
use crate::dialect::{Function, Group, Habit};
use crate::errors::NcCode;
use crate::motion::Compensation;

impl State<'_> {
    /// Refuses what has no sure meaning where tool-tip control is on, begins or ends.
    pub(super) fn check_tip_control(&self, words: &Words) -> Result<(), Fault> {
        let on = self.modes.frame.tip_control;
        match words.peek(Group::Length) {
            Some(Function::TipControl | Function::TipControlByDirection) if on => {
                refuse(words, "TCPC is already on")
            }
            Some(Function::TipControl | Function::TipControlByDirection) => self.check_begin(words),
            Some(Function::Length(true)) if on => {
                refuse(words, "TCPC must first be cancelled by G49")
            }
            Some(_) if on => self.check_end(words),
            None if on => self.check_on(words),
            _ => Ok(()),
        }
    }

    fn check_begin(&self, words: &Words) -> Result<(), Fault> {
        let gives_up = |function: Function| words.peek(function.group()) == Some(function);
        let compensates = self.modes.compensation.side != Compensation::Off;
        if compensates && !gives_up(Function::Compensation(Compensation::Off)) {
            return refuse(words, "TCPC starts during cutter compensation");
        }
        if self.cycle.active.is_some() && !gives_up(Function::CycleOff) {
            return refuse(words, "TCPC starts in an active cycle");
        }
        if !self.dialect.has(Habit::TipControlAnywhere) {
            self.check_tables(words)?;
        }
        self.check_functions(words)
    }

    /// Where the tables stand at zero, all controls take the part alike.
    fn check_tables(&self, words: &Words) -> Result<(), Fault> {
        for axis in self.dialect.tables() {
            let letter = char::from(b'@' + self.dialect.axes[axis].letter);
            if !self.known[axis] {
                let message = format!("G43.4 needs {letter} at 0, but its position is not known");
                return Err(at_length(words, Fault::new(NcCode::MissingWord, message)));
            }
            if !is_zero(self.at[axis]) {
                let why =
                    format!("with {letter} away from 0, controls differ in how the part lies");
                return refuse(words, &why);
            }
        }
        Ok(())
    }

    /// In the block of `G43.4` the tip does not yet go straight, so the rotary axes must
    /// stand where they stood.
    pub(super) fn check_begun(&self, stood: &Axes, known: &[bool; 5]) -> Result<(), Fault> {
        if self.at[3..] == stood[3..] && self.known[3..] == known[3..] {
            return Ok(());
        }
        let message =
            "in the block of G43.4 the tip does not yet go straight; turn before or after it";
        Err(Fault::new(NcCode::NoMeaning, message))
    }

    fn check_end(&self, words: &Words) -> Result<(), Fault> {
        let elsewhere = words.peek(Group::Once).is_some_and(Function::goes_to_machine);
        match words.first_axis(self.dialect) {
            Some(range) if !elsewhere => {
                let message = "controls differ in where a motion in the block of G49 ends";
                Err(Fault::new(NcCode::NoMeaning, message).at(range))
            }
            _ => Ok(()),
        }
    }

    fn check_on(&self, words: &Words) -> Result<(), Fault> {
        if let Some(range) = words.range_of(H) {
            let message = "another tool length offset under TCPC; cancel it with G49 first";
            return Err(Fault::new(NcCode::NoMeaning, message).at(range));
        }
        self.check_functions(words)
    }

    fn check_functions(&self, words: &Words) -> Result<(), Fault> {
        for (function, range) in words.functions() {
            let what = match function {
                Function::Arc { .. } => "an arc",
                Function::Thread | Function::VaryingThread => "a thread",
                Function::Cycle(..) | Function::LiveCycle { .. } => "a cycle",
                Function::Plane(normal) if normal != self.plane => "another plane",
                Function::Fixture(code) if self.moves_fixture(code) => "another work offset",
                Function::Units { metric } if metric != self.metric => "another unit",
                Function::Compensation(Compensation::Left | Compensation::Right) => {
                    "cutter compensation"
                }
                function if function.goes_to_machine() => "a point of the machine",
                _ => continue,
            };
            return Err(differ(what).at(range));
        }
        Ok(())
    }

    /// A motion function that is in force from before.
    pub(super) fn check_tip_motion(&self) -> Result<(), Fault> {
        match self.motion {
            Some(Function::Arc { .. }) => Err(differ("an arc")),
            Some(Function::Thread | Function::VaryingThread) => Err(differ("a thread")),
            _ => Ok(()),
        }
    }

    /// Takes up tool-tip control by a statement of its own (`TRAORI`, `M128`), with the
    /// length that the tool has already.
    pub(super) fn begin_stated_tip_control(&mut self) -> Result<(), Fault> {
        let refuse = |why: &str| Err(Fault::new(NcCode::NoMeaning, why));
        if self.modes.compensation.side != Compensation::Off {
            return refuse("TCPC starts during cutter compensation");
        }
        if self.head.tilt.is_some() {
            return refuse("TCPC starts in a tilted work plane");
        }
        for axis in self.dialect.tables() {
            let stands = self.known[axis] && is_zero(self.at[axis]);
            if !(stands || self.dialect.has(Habit::TipControlAnywhere)) {
                return refuse(
                    "TCPC starts with a table that is not at 0, where controls differ, or at an unknown position",
                );
            }
        }
        self.modes.frame.tip_control = true;
        self.lose_tip();
        Ok(())
    }

    /// Refuses what controls take in different ways while tool-tip control is on.
    pub(super) fn refuse_under_tip_control(&self, what: &str) -> Result<(), Fault> {
        if self.modes.frame.tip_control { Err(differ(what)) } else { Ok(()) }
    }

    /// Takes up tool-tip control with its length offset, by the direction of the tool or by the
    /// angles of the rotary axes.
    pub(super) fn begin_tip_control(
        &mut self,
        words: &mut Words,
        by_direction: bool,
    ) -> Result<(), Fault> {
        let offset = words.take_whole(H)?;
        let missing = || Fault::new(NcCode::MissingWord, "TCPC needs an H word");
        self.modes.length.offset = Some(offset.ok_or_else(missing)?);
        self.modes.frame.tip_control = true;
        self.modes.frame.tip_control_line = self.line;
        self.head.by_direction = by_direction;
        self.lose_tip();
        Ok(())
    }

    /// Gives tool-tip control up.
    pub(super) fn end_tip_control(&mut self) {
        self.head.by_direction = false;
        if std::mem::take(&mut self.modes.frame.tip_control) {
            self.since.was_tip = true;
            self.lose_tip();
        }
    }

    /// Where tool-tip control begins or ends, X, Y, Z keep their values when no rotary
    /// axis is turned; else they must be said again.
    fn lose_tip(&mut self) {
        if !(3..5).all(|axis| self.known[axis] && is_zero(self.at[axis])) {
            self.known[..3].fill(false);
        }
    }
}

fn is_zero(degrees: f64) -> bool {
    degrees % 360.0 == 0.0
}

fn differ(what: &str) -> Fault {
    let message = format!("controls differ in what {what} does under TCPC");
    Fault::new(NcCode::NoMeaning, message)
}

fn refuse(words: &Words, why: &str) -> Result<(), Fault> {
    Err(at_length(words, Fault::new(NcCode::NoMeaning, why)))
}

/// Puts a fault at the function of the tool length.
fn at_length(words: &Words, fault: Fault) -> Fault {
    match words.functions().find(|(function, _)| function.group() == Group::Length) {
        Some((_, range)) => fault.at(range),
        None => fault,
    }
}
