//! Tilted frames: X, Y, Z count in a frame that lies askew in the part, with the tool
//! along its Z.
//!
//! Which of two positions of its rotary axes a control takes hangs on its parameters. So
//! a frame is followed where the axes stand near one of them before it begins; how the
//! frame lies is in the program. What turns the machine while a frame is in force is refused.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::Fault;
use super::state::State;
use super::words::{Words, letter};
use crate::dialect::{Function, Group};
use crate::errors::NcCode;
use crate::motion::{Compensation, Position, Tilt};

/// Degrees that a rotary axis may stand from where the frame wants it: more than any
/// rounding, and less than the way to another position.
const NEAR: f64 = 0.1;

/// Directions nearer than this are one.
const SAME: f64 = 1e-7;

/// Less than binary fractions may add, degrees.
const DUST: f64 = 1e-9;

/// Turns about X, Y and Z.
pub(super) fn about([x, y, z]: [f64; 3], degrees: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z) * degrees.to_radians())
}

pub(super) const X: [f64; 3] = [1.0, 0.0, 0.0];
pub(super) const Y: [f64; 3] = [0.0, 1.0, 0.0];
pub(super) const Z: [f64; 3] = [0.0, 0.0, 1.0];

impl State<'_> {
    /// A block of a tilted frame (`G68.2`, `G53.1`, `G69`); false for another block.
    pub(super) fn tilted_block(&mut self, words: &mut Words) -> Result<bool, Fault> {
        let aligns = words.peek(Group::Once) == Some(Function::AlignTool);
        if words.peek(Group::Tilt).is_none() && !aligns {
            return Ok(false);
        }
        if let Some((_, range)) = words.auxiliaries.first() {
            let message = "an auxiliary function in the block of a tilted work plane";
            return Err(Fault::new(NcCode::NoMeaning, message).at(range));
        }
        match words.function(Group::Tilt) {
            Some(Function::Tilt) => {
                let origin = [b'X', b'Y', b'Z'].map(letter).map(|name| words.take(name));
                let [x, y, z] = whole(origin, 0.0)?;
                let angles = [b'I', b'J', b'K'].map(letter).map(|name| words.take(name));
                let [first, tilt, last] = whole(angles, 0.0)?;
                let turn = about(Z, first) * about(X, tilt) * about(Z, last);
                let origin = Point3::new(x, y, z) * self.unit();
                self.begin_tilt(Tilt { turn, origin })?;
                self.head.aligned = false;
            }
            Some(Function::TiltByAxes) => {
                let turn = self.turn_of_axes()?;
                self.begin_tilt(Tilt { turn, origin: Point3::origin() })?;
                self.head.aligned = true;
            }
            Some(_) => self.end_tilt(),
            None => {}
        }
        if aligns {
            words.function(Group::Once);
            self.align()?;
        }
        words.finish()?;
        Ok(true)
    }

    /// How the axes of the machine lie in the part where the rotary axes stand.
    fn turn_of_axes(&self) -> Result<UnitQuaternion<f64>, Fault> {
        let mut turn = UnitQuaternion::identity();
        for (n, rotary) in self.dialect.forward.rotaries().iter().enumerate() {
            let Some(rotary) = rotary else { continue };
            if !self.known[n + 3] {
                let message = "the rotary position at the tilted work plane is not known";
                return Err(Fault::new(NcCode::MissingWord, message));
            }
            let degrees = self.at[n + 3];
            turn *= UnitQuaternion::from_axis_angle(&rotary.direction, degrees.to_radians());
        }
        Ok(turn)
    }

    /// Takes a frame up; the tool need not lie along its Z yet.
    pub(super) fn begin_tilt(&mut self, tilt: Tilt) -> Result<(), Fault> {
        let refuse = |why: &str| Err(Fault::new(NcCode::NoMeaning, why));
        if self.head.tilt.is_some() {
            return refuse("a tilted work plane within another one; the first must be ended");
        }
        if self.modes.frame.tip_control {
            return refuse("a tilted work plane starts under TCPC");
        }
        if self.modes.compensation.side != Compensation::Off {
            return refuse("a tilted work plane begins under cutter compensation");
        }
        if self.cycle.active.is_some() {
            return refuse("a tilted work plane begins while a cycle is in force");
        }
        self.counts_in(Some(tilt));
        self.modes.frame.tilted = true;
        Ok(())
    }

    /// Turns the tool along Z of the frame, by as little as rounding left.
    pub(super) fn align(&mut self) -> Result<(), Fault> {
        let along = self.stands_along()?;
        for (stands, along) in self.at[3..].iter_mut().zip(along) {
            // What binary fractions add to angles of 180 degrees turns no axis away from zero.
            if (*stands - along).abs() > DUST {
                *stands = along;
            }
        }
        self.head.aligned = true;
        Ok(())
    }

    /// The rotary axes must stand along Z of the frame, and stay as they are.
    pub(super) fn check_along(&mut self) -> Result<(), Fault> {
        self.stands_along()?;
        self.head.aligned = true;
        Ok(())
    }

    /// Positions of the rotary axes, near where they stand, that bring the tool along Z
    /// of the frame.
    fn stands_along(&self) -> Result<[f64; 2], Fault> {
        let Some(tilt) = self.head.tilt else {
            return Err(Fault::new(NcCode::NoMeaning, "no tilted work plane is in force"));
        };
        let forward = &self.dialect.forward;
        let present = |axis: &usize| forward.rotaries()[*axis].is_some();
        if !(0..2).filter(present).all(|axis| self.known[axis + 3]) {
            let message = "the rotary position before the tilted work plane is not known";
            return Err(Fault::new(NcCode::MissingWord, message));
        }
        let stands = [self.at[3], self.at[4]];
        let axis = tilt.turn * Vector3::z();
        let along = forward.refine(stands, axis);
        let near = (0..2).all(|n| (along[n] - stands[n]).abs() < NEAR);
        if !near || (forward.axis(along) - axis).norm() > SAME {
            let message = "the tool does not lie along Z of the tilted work plane, and which of the \
                           positions of the rotary axes the control turns to is not known: turn \
                           there before the frame begins";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        Ok(along)
    }

    /// Gives a tilted frame up.
    pub(super) fn end_tilt(&mut self) {
        if self.head.tilt.is_some() {
            self.counts_in(None);
        }
        self.modes.frame.tilted = false;
    }

    /// From now on X, Y and Z count in this frame; the tool stands, and no word has said where.
    fn counts_in(&mut self, tilt: Option<Tilt>) {
        let [x, y, z, first, second] = self.at;
        let stands = Position {
            linear: [x, y, z],
            rotary: [first, second],
            tip_control: std::mem::take(&mut self.since.was_tip),
            tilt: self.head.tilt,
            ..Position::default()
        };
        let there = Position { tilt, ..Position::default() };
        let linear = self.dialect.forward.restated(&stands, &there).linear;
        self.at[..3].copy_from_slice(&linear);
        self.known[..3].fill(false);
        self.head.tilt = tilt;
    }

    /// Refuses a motion while the tool does not lie along the frame in force, and one that
    /// would turn it away.
    pub(super) fn check_tilted_motion(&self, turns: bool) -> Result<(), Fault> {
        if self.head.tilt.is_none() {
            return Ok(());
        }
        if !self.head.aligned {
            let message = "a motion in a tilted work plane before the tool is turned along its Z";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        if turns {
            return Err(Fault::new(
                NcCode::NoMeaning,
                "a rotary axis turns in a tilted work plane",
            ));
        }
        Ok(())
    }

    /// Refuses what would move a tilted frame that is in force.
    pub(super) fn check_tilt(&self, words: &Words) -> Result<(), Fault> {
        if self.head.tilt.is_none() {
            return Ok(());
        }
        for (function, range) in words.functions() {
            let what = match function {
                Function::Fixture(code) if self.moves_fixture(code) => "another work offset",
                Function::NumberedFixture(_) => "another work offset",
                Function::Units { metric } if metric != self.metric => "another unit",
                Function::TipControl => "TCPC",
                function if function.goes_to_machine() => "a point of the machine",
                _ => continue,
            };
            let message = format!("{what} in a tilted work plane");
            return Err(Fault::new(NcCode::NoMeaning, message).at(range));
        }
        if !words.has_axes(self.dialect) {
            return Ok(());
        }
        self.check_tilted_motion(words.has_rotary(self.dialect))
    }
}

/// The values of three words.
fn whole(values: [Result<Option<f64>, Fault>; 3], absent: f64) -> Result<[f64; 3], Fault> {
    let [x, y, z] = values;
    Ok([x?.unwrap_or(absent), y?.unwrap_or(absent), z?.unwrap_or(absent)])
}
