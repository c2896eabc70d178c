//! An arc whose statement tells how far it turns: the point where it ends must say the same.

use fil_diag::Result;

use super::Reader;
use crate::errors::ClCode;
use crate::forms::vector::{Vector, across, cross, dot, norm, sub, unit};
use crate::record::Record;
use crate::words;

/// Points nearer than this are one point: CAM systems round to four decimals.
const NEAR: f64 = 1e-3;

/// An arc until the GOTO to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ToldSweep {
    center: Vector,
    axis: Vector,
    start: Option<Vector>,
    /// How far it turns.
    degrees: f64,
    line: u32,
}

impl Reader<'_> {
    /// Notes how far a CIRCLE turns.
    pub(super) fn note_sweep(&mut self, record: &Record, degrees: f64) {
        let Some(circle) = record.circle() else { return };
        self.modal.forms.told_sweep = Some(ToldSweep {
            center: circle.center,
            axis: unit(circle.axis).unwrap_or(circle.axis),
            start: self.modal.point,
            degrees,
            line: record.line,
        });
    }

    /// Checks the arc before a GOTO.
    ///
    /// # Errors
    /// It turns otherwise than was told, or where it starts is not known.
    pub(super) fn check_sweep(&mut self, record: &Record) -> Result<()> {
        let Some(arc) = self.modal.forms.told_sweep.take() else { return Ok(()) };
        let whole = 0..self.statement.joined.len();
        let refuse =
            |message: &str| Err(self.diag(ClCode::UncomputedMotion, message, whole.clone()));
        let end = record.point().filter(|_| record.major == words::GOTO);
        let (Some(start), Some(end)) = (arc.start, end) else {
            let message =
                format!("the MOVARC of line {} needs a GOTO before it and one after it", arc.line);
            return refuse(&message);
        };
        let [from, to] = [start, end].map(|point| across(sub(point, arc.center), arc.axis));
        let turn = libm::atan2(dot(arc.axis, cross(from, to)), dot(from, to)).to_degrees();
        // From a whole turn to none it is a small step.
        let off = (turn - arc.degrees).rem_euclid(360.0);
        let off = off.min(360.0 - off);
        let slack = (2.0 * NEAR / norm(from).max(NEAR)).to_degrees();
        let is_whole = arc.degrees > 360.0 - slack;
        if off > slack || is_whole != (norm(sub(from, to)) < NEAR) {
            let message = format!(
                "the MOVARC of line {} has {} degrees, but to this point it would be {:.3}",
                arc.line,
                arc.degrees,
                turn.rem_euclid(360.0)
            );
            return refuse(&message);
        }
        Ok(())
    }
}
