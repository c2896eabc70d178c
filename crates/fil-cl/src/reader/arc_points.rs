//! Several points behind a CIRCLE of Creo's (CIRC_INTERPOLATION POINTS_&_ARC, NUMBER_OF_ARC_PTS).
//!
//! PTC documents that the points of the GOTO behind a CIRCLE lie on the arc, and that the last one is
//! its end. In GOTO statements of their own they look like lines behind a shorter arc, so the
//! third point on one circle is refused.

use fil_diag::{Diag, Result};

use super::Reader;
use crate::errors::ClCode;
use crate::forms::vector::{Vector, across, cross, dot, norm, sub, unit};
use crate::layout::is_unit;
use crate::record::{Record, Word};
use crate::words;

/// Points nearer than this are one point: CAM systems round to four decimals.
const NEAR: f64 = 1e-3;

/// Points on one circle behind a CIRCLE that are no lines any more: its end, and two further ones.
const TOO_MANY: u32 = 3;

/// A circle, and how far along it the points have come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArcPoints {
    center: Vector,
    axis: Vector,
    /// The start, then the last point on it.
    at: Vector,
    /// Degrees that the points have turned by.
    turned: f64,
    /// Points behind the start.
    count: u32,
    /// The point right behind the CIRCLE, which is looked at when another follows.
    first: Option<Vector>,
}

impl ArcPoints {
    /// Takes the next point; false for one that does not lie on the circle, ahead of the last one.
    /// Z along the axis is free: an arc to another level is a helix.
    fn take(&mut self, point: Vector) -> bool {
        let [from, to] = [self.at, point].map(|point| across(sub(point, self.center), self.axis));
        if (norm(from) - norm(to)).abs() >= NEAR {
            return false;
        }
        let degrees = libm::atan2(dot(self.axis, cross(from, to)), dot(from, to)).to_degrees();
        let slack = (2.0 * NEAR / norm(from).max(NEAR)).to_degrees();
        let is_back = self.count == 0 && degrees.abs() < slack;
        self.turned += if is_back { 360.0 } else { degrees.rem_euclid(360.0) };
        (self.at, self.count) = (point, self.count + 1);
        self.turned < 360.0 + slack
    }

    /// A point behind the end of the arc that lies on its circle, less than a quarter turn ahead.
    fn goes_on(&mut self, point: Vector) -> bool {
        let (at, turned) = (self.at, self.turned);
        let is_level = dot(sub(point, at), self.axis).abs() < NEAR;
        self.take(point) && is_level && self.turned - turned < 90.0
    }
}

impl Reader<'_> {
    /// Notes the circle of a CIRCLE whose points may follow in any number.
    pub(super) fn note_circle(&mut self, record: &Record) {
        let circle = record.circle().filter(|_| self.rules().packed_points && !self.is_scout);
        let start = self.modal.point;
        self.modal.forms.arc_points = circle.zip(start).and_then(|(circle, at)| {
            let axis = unit(circle.axis)?;
            Some(ArcPoints { center: circle.center, axis, at, turned: 0.0, count: 0, first: None })
        });
    }

    /// Leaves the last one of the points behind a CIRCLE, which is its end.
    ///
    /// # Errors
    /// The points do not lie on the circle, one ahead of the other.
    pub(super) fn keep_end_of_arc(&mut self, record: &mut Record) -> Result<()> {
        let Some(mut arc) = self.modal.forms.arc_points.filter(|_| self.modal.in_arc) else {
            return Ok(());
        };
        let number = |word: &Word| match word {
            Word::Number(value) => Some(*value),
            _ => None,
        };
        let Some(values) = record.data.iter().map(number).collect::<Option<Vec<f64>>>() else {
            return Ok(());
        };
        let is_one =
            values.len() <= 3 || values.len() == 6 && is_unit([values[3], values[4], values[5]]);
        let group = if self.modal.multax { 6 } else { 3 };
        if is_one || !values.len().is_multiple_of(group) {
            return Ok(());
        }
        if !values.chunks(group).all(|point| arc.take([point[0], point[1], point[2]])) {
            return Err(self
                .arc_error("several points after a CIRCLE, but not one ahead of the other on it"));
        }
        record.data.drain(..values.len() - group);
        self.modal.forms.arc_points = None;
        Ok(())
    }

    /// Counts the points behind a CIRCLE that lie on it.
    ///
    /// # Errors
    /// The third one in turn: the arc ends at the first one or the last one.
    pub(super) fn watch_arc_points(&mut self, record: &Record) -> Result<()> {
        let point = record.point().filter(|_| record.major == words::GOTO);
        if point.is_some_and(|point| self.follows_arc(point)) {
            return Ok(());
        }
        self.modal.forms.arc_points = None;
        if point.is_none() {
            return Ok(());
        }
        Err(self.arc_error(
            "three points after a CIRCLE lie on it: points of the arc, or lines after its end?",
        ))
    }

    /// Takes a point behind a CIRCLE; false for the third one in turn that lies on it.
    #[inline]
    pub(super) fn follows_arc(&mut self, point: Vector) -> bool {
        let Some(mut arc) = self.modal.forms.arc_points else { return true };
        if arc.count == 0 && arc.first.is_none() {
            self.modal.forms.arc_points = Some(ArcPoints { first: Some(point), ..arc });
            return true;
        }
        let is_on_it = arc.first.take().is_none_or(|first| arc.take(first)) && arc.goes_on(point);
        let is_clear = !is_on_it || arc.count < TOO_MANY;
        if is_clear {
            self.modal.forms.arc_points = Some(arc).filter(|_| is_on_it);
        }
        is_clear
    }

    fn arc_error(&self, message: &str) -> Box<Diag> {
        let mut diag = self.diag(ClCode::UnclearPoints, message, 0..self.statement.joined.len());
        let hint = "Write the CL file with CIRC_INTERPOLATION ARC_ONLY and NUMBER_OF_ARC_PTS 1, or with POINTS_ONLY.";
        diag.hint = Some(hint.to_string());
        diag
    }
}
