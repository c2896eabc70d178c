//! Tilted planes: `CYCLE800(_FR, _TC, _ST, _MODE, _X0, _Y0, _Z0, _A, _B, _C, _X1, _Y1,
//! _Z1, _DIR, _FR_I, _DMODE)`.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::super::Fault;
use super::super::tilt::{X, Y, Z, about};
use super::Sinumerik;
use super::line::{Value, Word};
use crate::motion::Tilt;

/// Arguments that a call may have.
const MOST: usize = 16;

impl Sinumerik<'_> {
    /// Begins a plane, or ends it by a call without arguments.
    pub(super) fn swivel(&mut self, call: &Word) -> Result<(), Fault> {
        let arguments = call.arguments.as_deref().unwrap_or_default();
        if arguments.iter().all(Option::is_none) {
            self.state.refuse_under_tip_control("the end of a tilted plane")?;
            self.state.end_tilt();
            return Ok(());
        }
        if self.shift != [0.0; 3] {
            return Err(call.foreign("about a zero that TRANS has moved is not followed"));
        }
        if arguments.len() > MOST {
            return Err(call.foreign("has more arguments than are known"));
        }
        let number = |n: usize| match arguments.get(n) {
            Some(Some(value)) => self.number(call, value),
            _ => Ok(0.0),
        };
        if let Some(Some(value)) = arguments.get(1)
            && !matches!(value, Value::Text(_))
        {
            return Err(call.foreign("names its swivel data record by a text"));
        }
        if ![0.0, 1.0, 2.0, 4.0, 5.0].contains(&number(0)?) {
            return Err(call.foreign("retracts in a way that is not known"));
        }
        let status = number(2)?;
        if status % 100.0 != 0.0 {
            return Err(call.foreign("adds to a plane, or keeps the tip, which is not supported"));
        }
        let angles = [number(7)?, number(8)?, number(9)?];
        let turn = turn(number(3)?, angles)
            .ok_or_else(|| call.foreign("is followed with turns axis by axis (_MODE 57)"))?;
        let [before, behind] = [[4, 5, 6], [10, 11, 12]].map(|at| at.map(number));
        let point = |[x, y, z]: [Result<f64, Fault>; 3]| Ok(Vector3::new(x?, y?, z?));
        let (before, behind) = (point(before)?, point(behind)?);
        let moves = number(13)? != 0.0;
        let origin = Point3::from((before + turn * behind) * self.state.unit());
        self.state.end_tilt();
        self.state.begin_tilt(Tilt { turn, origin })?;
        if self.called.is_some() {
            return Err(call.foreign("while MCALL calls a cycle"));
        }
        if moves { self.state.align() } else { self.state.check_along() }
    }
}

/// Three turns, each about an axis that the ones before have turned; `_MODE` names the axes
/// in pairs of bits, from the lowest on.
fn turn(mode: f64, angles: [f64; 3]) -> Option<UnitQuaternion<f64>> {
    let bits = Some(mode).filter(|mode| mode.fract() == 0.0 && (0.0..64.0).contains(mode))? as u8;
    let mut turn = UnitQuaternion::identity();
    for (n, angle) in angles.into_iter().enumerate() {
        let axis = match bits >> (2 * n) & 3 {
            1 => X,
            2 => Y,
            3 => Z,
            _ => return None,
        };
        turn *= about(axis, angle);
    }
    Some(turn)
}
