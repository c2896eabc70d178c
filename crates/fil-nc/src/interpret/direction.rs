//! The direction of the tool as a vector under tool-tip control: where the rotary axes turn.
//!
//! The tool lies along `R(u1, r1) R(u2, r2) t`. With the part of the direction along u1 the
//! second angle has one or two values, and each of them one first angle. Controls choose by the
//! turn of their first axis, of their second one or by the sum, so what is followed is a
//! direction whose positions are the nearest for each axis.

use nalgebra::{Rotation3, Unit, Vector3};

use super::Fault;
use super::state::State;
use super::words::{Words, letter};
use crate::errors::NcCode;
use crate::forward::Forward;

/// A direction off by this from what the machine reaches is rounding, radians.
const ROUNDING: f64 = 2e-4;

/// A vector shorter than this along or across an axis is none.
const NONE: f64 = 1e-9;

/// A direction that leans from a rotary axis by less than this, radians, leaves it where it
/// stands: an acos loses half of the digits there, and a vector has six decimals.
const ALONG: f64 = 1e-7;

/// Turns nearer than this are the same, degrees.
const SAME: f64 = 0.05;

const HALF_TURN: f64 = 180.0;

const I: u8 = letter(b'I');
const J: u8 = letter(b'J');
const K: u8 = letter(b'K');

impl State<'_> {
    /// The positions of the rotary axes for I, J and K, where a block has them.
    pub(super) fn direction_words(&mut self, words: &mut Words) -> Result<Option<[f64; 2]>, Fault> {
        if !self.head.by_direction {
            return Ok(None);
        }
        if let Some(range) =
            words.first_axis(self.dialect).filter(|_| words.has_rotary(self.dialect))
        {
            let message = "a word of a rotary axis where the tool's direction is a vector";
            return Err(Fault::new(NcCode::NoMeaning, message).at(range));
        }
        let parts = [words.take(I)?, words.take(J)?, words.take(K)?];
        self.toward(parts)
    }

    /// The positions of the rotary axes for the parts of a direction; `None` without any.
    pub(super) fn toward(&self, parts: [Option<f64>; 3]) -> Result<Option<[f64; 2]>, Fault> {
        if parts == [None; 3] {
            return Ok(None);
        }
        let [Some(i), Some(j), Some(k)] = parts else {
            let message = "controls differ in how they complete a partial tool direction vector";
            return Err(Fault::new(NcCode::MissingWord, message));
        };
        if !self.modes.frame.tip_control {
            let message = "a tool direction vector without TCPC";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        let direction = Unit::try_new(Vector3::new(i, j, k), NONE)
            .ok_or_else(|| Fault::new(NcCode::BadNumber, "a direction of length zero"))?;
        for (axis, rotary) in self.dialect.forward.rotaries().iter().enumerate() {
            if rotary.is_some() && !self.known[axis + 3] {
                let message = "a tool direction vector while the rotary position is not known";
                return Err(Fault::new(NcCode::NoMeaning, message));
            }
        }
        nearest(&self.dialect.forward, direction, [self.at[3], self.at[4]]).map(Some)
    }
}

/// The positions for a direction from which all others are farther for one axis, and nearer for
/// none.
fn nearest(forward: &Forward, to: Unit<Vector3<f64>>, from: [f64; 2]) -> Result<[f64; 2], Fault> {
    let found = positions(forward, to, from);
    let turns = |at: &[f64; 2]| [0, 1].map(|n| (at[n] - from[n]).abs());
    let leads = |at: &&[f64; 2]| {
        let own = turns(at);
        let behind = |other: &[f64; 2]| {
            let ways = turns(other);
            let nearer = (0..2).any(|n| ways[n] < own[n] - SAME);
            !nearer && (0..2).any(|n| ways[n] > own[n] + SAME)
        };
        let apart = |other: &[f64; 2]| (0..2).any(|n| (other[n] - at[n]).abs() > SAME);
        own.iter().all(|turn| *turn < HALF_TURN - SAME)
            && found.iter().all(|other| !apart(other) || behind(other))
    };
    match found.iter().find(leads) {
        Some(best) => Ok(*best),
        None if found.is_empty() => {
            Err(Fault::new(NcCode::NoMeaning, "the machine does not reach this direction"))
        }
        None => Err(Fault::new(
            NcCode::NoMeaning,
            "which of two turns of the rotary axes the direction asks for is not known",
        )),
    }
}

/// All positions for a direction, each axis with the whole turns nearest to where it stands; an
/// axis that does not turn the tool stays.
fn positions(forward: &Forward, to: Unit<Vector3<f64>>, from: [f64; 2]) -> Vec<[f64; 2]> {
    let tool = forward.tool();
    let near = |angle: f64, n: usize| angle + 360.0 * ((from[n] - angle) / 360.0).round();
    let reached = |at: &[f64; 2]| (forward.axis(*at) - to.into_inner()).norm() < ROUNDING;
    let [first, second] = forward.rotaries();
    let own = |direction: Vector3<f64>, n: usize, against: Vector3<f64>| match &[first, second][n] {
        Some(axis) => turn(axis.direction, direction, against).map_or(from[n], |a| near(a, n)),
        None => from[n],
    };
    let seconds = match (first, second) {
        (Some(first), Some(second)) => {
            second_angles(first.direction, second.direction, tool, to.dot(&first.direction))
        }
        (None, Some(_)) => vec![own(tool, 1, to.into_inner())],
        _ => vec![from[1]],
    };
    let seconds = if seconds.is_empty() { vec![from[1]] } else { seconds };
    let pairs = seconds.into_iter().map(|angle| {
        let leaning = match second {
            Some(axis) => Rotation3::from_axis_angle(&axis.direction, angle.to_radians()) * tool,
            None => tool,
        };
        [own(leaning, 0, to.into_inner()), near(angle, 1)]
    });
    pairs.filter(reached).collect()
}

/// The angles about `second` by which a vector gets a given part along `first`, degrees; none
/// where its turns change nothing of that.
fn second_angles(
    first: Unit<Vector3<f64>>,
    second: Unit<Vector3<f64>>,
    tool: Vector3<f64>,
    along: f64,
) -> Vec<f64> {
    let axial = second.into_inner() * tool.dot(&second);
    let radial = tool - axial;
    let across = second.cross(&radial);
    // axial·u1 + cos φ radial·u1 + sin φ across·u1 = along
    let (a, b) = (radial.dot(&first), across.dot(&first));
    let size = libm::hypot(a, b);
    if size < NONE {
        return Vec::new();
    }
    let share = (along - axial.dot(&first)) / size;
    if share.abs() > 1.0 + ROUNDING {
        return Vec::new();
    }
    let (middle, half) = (libm::atan2(b, a), libm::acos(share.clamp(-1.0, 1.0)));
    vec![(middle + half).to_degrees(), (middle - half).to_degrees()]
}

/// The angle about an axis from one vector to another, degrees; `None` for one along the axis.
fn turn(axis: Unit<Vector3<f64>>, from: Vector3<f64>, to: Vector3<f64>) -> Option<f64> {
    let flat = |v: Vector3<f64>| v - axis.into_inner() * v.dot(&axis);
    let (from, to) = (flat(from), flat(to));
    let turns = from.norm() > ALONG && to.norm() > ALONG;
    turns.then(|| libm::atan2(axis.cross(&from).dot(&to), from.dot(&to)).to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forward::tests::rotary;
    use fil_machine::axis_chain::{AxisChain, Carries};

    fn tables_ca() -> Forward {
        let c = rotary(Carries::Table, [0.0, 0.0, 1.0], [0.0; 3]);
        let a = rotary(Carries::Table, [1.0, 0.0, 0.0], [0.0; 3]);
        Forward::new(AxisChain { rotaries: [Some(c), Some(a)], ..AxisChain::default() })
    }

    fn toward(direction: [f64; 3], from: [f64; 2]) -> Option<[f64; 2]> {
        nearest(&tables_ca(), Unit::new_normalize(Vector3::from(direction)), from).ok()
    }

    #[test]
    fn a_direction_has_two_positions_and_the_nearer_one_counts() {
        let forward = tables_ca();
        let at = [37.0, 20.0];
        let direction = forward.axis(at);
        let near = |found: Option<[f64; 2]>, to: [f64; 2]| {
            found.is_some_and(|found| (0..2).all(|n| (found[n] - to[n]).abs() < 1e-6))
        };
        assert!(near(toward(direction.into(), [30.0, 15.0]), at));
        assert!(near(toward(direction.into(), [-150.0, -15.0]), [-143.0, -20.0]));
        assert!(near(toward(direction.into(), [390.0, 15.0]), [397.0, 20.0]));
        // C turns less the one way, A the other.
        assert_eq!(toward(direction.into(), [37.0, -20.0]), None);
        assert!(near(toward([0.0, 0.0, 1.0], [55.0, 3.0]), [55.0, 0.0]));
    }
}
