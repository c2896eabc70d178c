//! The parts of an arc that takes several blocks.

use super::sense::Course;
use crate::control::Control;
use crate::operation::motion::PlaneArc;
use crate::operation::{Arc, Target};
use fil_diag::Result;
use nalgebra::{Point3, Vector3};

pub(super) const FULL: f64 = 360.0;

/// End and start of an arc nearer than this make a full circle, mm or inch: CL files round to five
/// digits behind the point at least, and no arc is that short.
pub(super) const SAME_POINT: f64 = 1.5e-5;

/// Radii of start and end may differ by this, mm or inch.
pub(super) const RADIUS_TOLERANCE: f64 = 1e-3;

/// Where the blocks of an arc end.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// After each full turn.
    Turns,
    /// After half a turn, so that none is a full circle.
    Halves,
    /// At the axes of the plane.
    Quadrants,
}

/// The vector from the axis of the arc to a point.
pub fn flat(arc: &Arc, point: Point3<f64>) -> Vector3<f64> {
    let from = point - arc.center;
    from - arc.axis * arc.axis.dot(&from)
}

/// Angle from start to end about the axis, degrees: above 0, at most 360 and
/// the full turns on top. A start above the end is one turn, or TIMES turns, of which
/// rounded points may lack a little.
pub(super) fn sweep(arc: &Arc, [from, to]: [Vector3<f64>; 2]) -> f64 {
    let apart = (from - to).norm();
    if arc.turns == 0.0 && apart < SAME_POINT {
        return FULL;
    }
    let angle = libm::atan2(arc.axis.dot(&from.cross(&to)), from.dot(&to)).to_degrees();
    let whole_turns = arc.turns > 0.0 && apart < RADIUS_TOLERANCE;
    let part = if angle <= 0.0 && !whole_turns { angle + FULL } else { angle };
    part + FULL * arc.turns
}

/// Angle of the start from the first axis of the plane, degrees.
pub(super) fn start_angle(arc: &PlaneArc) -> f64 {
    let [first, second] = arc.plane.axes();
    libm::atan2(arc.from[second] - arc.center[1], arc.from[first] - arc.center[0]).to_degrees()
}

/// What is left of a CIRCLE.
#[derive(Clone, Debug)]
pub(crate) enum Rest {
    /// Lines, and how the motion before the arc ended.
    Lines(Chords, Course),
    /// Arcs, and where the last one ends.
    Arcs(Parts, Point3<f64>),
}

/// The parts of an arc, one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    whole: PlaneArc,
    /// Angle of the start from the first axis of the plane, degrees.
    angle: f64,
    /// Degrees from the start at which the next part ends at the earliest, and from one end to
    /// the next.
    next: f64,
    step: f64,
    /// No part is shorter, degrees.
    least: f64,
    /// Where the part before ended: exactly, as the control has it, and in degrees from the start.
    from: [f64; 5],
    start: [f64; 2],
    pub(super) done: f64,
    pub(super) over: bool,
}

impl Parts {
    /// The parts of an arc that end by a rule; no part is shorter than `least` degrees.
    pub(super) fn new(arc: &PlaneArc, step: Step, least: f64) -> Self {
        let angle = start_angle(arc);
        let (next, step) = match step {
            Step::Quadrants => {
                let turned = if arc.counterclockwise { angle } else { -angle };
                (((turned / 90.0).floor() + 1.0) * 90.0 - turned, 90.0)
            }
            Step::Halves => {
                let parts = (arc.sweep / (FULL / 2.0)).ceil().max(2.0);
                (arc.sweep / parts, arc.sweep / parts)
            }
            Step::Turns => (FULL, FULL),
        };
        let (from, start) = (arc.from, arc.start);
        Parts { whole: *arc, angle, next, step, least, from, start, done: 0.0, over: false }
    }

    /// Degrees from the start at which the next part ends.
    fn stop(&mut self) -> f64 {
        while self.next < self.whole.sweep - self.least {
            let stop = self.next;
            self.next += self.step;
            if stop > self.least {
                return stop;
            }
        }
        self.over = true;
        self.whole.sweep
    }

    /// The next part; `None` behind the last.
    ///
    /// # Errors
    /// A position that does not fit its address.
    pub fn next(&mut self, control: &Control) -> Result<Option<PlaneArc>> {
        if self.over {
            return Ok(None);
        }
        let stop = self.stop();
        let arc = &self.whole;
        let axes = arc.plane.axes();
        let mut to = arc.to;
        if !self.over {
            let turned = if arc.counterclockwise { stop } else { -stop };
            let (sine, cosine) = libm::sincos((self.angle + turned).to_radians());
            let [first, second] = axes;
            let along = arc.plane.normal();
            to[first] = arc.center[0] + arc.radius * cosine;
            to[second] = arc.center[1] + arc.radius * sine;
            to[along] = arc.from[along] + (arc.to[along] - arc.from[along]) * stop / arc.sweep;
        }
        // The record's point is where the whole arc ends, not a part of it.
        let word = if self.over { arc.word } else { 0 };
        let (from, start, sweep) = (self.from, self.start, stop - self.done);
        let part = PlaneArc { from, start, to, sweep, word, ..*arc };
        let mut on_tape = [0.0; 2];
        for (end, number) in on_tape.iter_mut().zip(axes) {
            *end = control.tables.axis(number).on_tape(to[number])?;
        }
        self.start = control.family().end_of_arc(control, &part, on_tape)?;
        (self.from, self.done) = (to, stop);
        Ok(Some(part))
    }
}

/// An arc that is written as lines.
#[derive(Clone, Debug)]
pub(crate) struct Chords {
    pub(super) base: Point3<f64>,
    pub(super) from: Vector3<f64>,
    pub(super) across: Vector3<f64>,
    pub(super) rise: Vector3<f64>,
    pub(super) sweep: f64,
    pub(super) axes: [Vector3<f64>; 2],
    pub(super) end: Target,
    pub(super) count: u32,
    /// How many of them are written.
    pub(super) done: u32,
}

/// Degrees of an arc as long as two last digits: a part shorter than that would be
/// rounded away.
pub(super) fn least_angle(control: &Control, arc: &PlaneArc) -> f64 {
    let digits = arc.plane.axes().map(|number| control.tables.axis(number).resolution());
    (2.0 * digits[0].max(digits[1]) / arc.radius).to_degrees().max(1e-6)
}

#[cfg(test)]
mod tests;
