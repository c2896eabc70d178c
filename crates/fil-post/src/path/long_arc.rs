//! Arcs in several blocks, as many as a CIRCLE with turns asks for: they are written some at a
//! time, so that whoever drives the post can take the finished ones away.

use fil_diag::Result;
use nalgebra::Point3;

use super::arc::{FULL, Step, start_angle};
use super::chords::Chords;
use super::feed_rules;
use super::sense::Course;
use crate::control::family;
use crate::control::word_address::arc::PlaneArc;
use crate::operation::{Arc, Target};
use crate::post::Post;

/// Blocks that are written before the finished ones can be taken away.
const PIECE: u32 = 1_000;

/// What is left of a CIRCLE.
#[derive(Clone, Debug)]
pub(crate) enum Rest {
    /// Lines, and how the motion before the arc ended.
    Lines(Chords, Course),
    /// Arcs, and where the last one ends.
    Arcs(Parts, Point3<f64>),
}

/// Writes an arc as lines. They are no lines of the CL file, so they tell nothing of its sense.
///
/// # Errors
/// As a straight motion; too many lines.
pub(super) fn as_lines(
    post: &mut Post,
    arc: &Arc,
    start: Point3<f64>,
    sweep: f64,
    target: Target,
) -> Result<()> {
    let chords = Chords::new(post, arc, start, sweep, target)?;
    let course = std::mem::take(&mut post.path.sense.course);
    post.path.long_arc.in_chords = true;
    write(post, Rest::Lines(chords, course))
}

/// Writes an arc as its parts, of which the last ends at a point of the CL file.
///
/// # Errors
/// As an arc.
pub(super) fn in_parts(post: &mut Post, parts: Parts, end: Point3<f64>) -> Result<()> {
    write(post, Rest::Arcs(parts, end))
}

/// Writes more of the CIRCLE that is on the tape in part.
///
/// # Errors
/// As the motions it is made of.
pub(crate) fn go_on(post: &mut Post) -> Result<()> {
    match post.path.long_arc.rest.take() {
        Some(rest) => write(post, *rest),
        None => Ok(()),
    }
}

/// Writes a piece, and keeps what is left.
fn write(post: &mut Post, mut rest: Rest) -> Result<()> {
    let more = match &mut rest {
        Rest::Lines(chords, _) => chords.write(post, PIECE)?,
        Rest::Arcs(parts, _) => write_parts(post, parts)?,
    };
    match rest {
        rest if more => post.path.long_arc.rest = Some(Box::new(rest)),
        Rest::Lines(_, course) => {
            post.path.sense.course = course;
            post.path.long_arc.in_chords = false;
        }
        Rest::Arcs(_, end) => post.path.point = Some(end),
    }
    Ok(())
}

/// Writes some parts; false when the last one is written.
fn write_parts(post: &mut Post, parts: &mut Parts) -> Result<bool> {
    for _ in 0..PIECE {
        let Some(part) = parts.next(post)? else { return Ok(false) };
        let feed = feed_rules::settle_of_arc(post, &part)?;
        family::arc(&mut post.control, &part, feed.as_ref())?;
    }
    Ok(!parts.over)
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
    done: f64,
    over: bool,
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
    pub fn next(&mut self, post: &Post) -> Result<Option<PlaneArc>> {
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
            *end = post.control.tables.axis(number).on_tape(to[number])?;
        }
        self.start = family::end_of_arc(&post.control, &part, on_tape)?;
        (self.from, self.done) = (to, stop);
        Ok(Some(part))
    }
}

#[cfg(test)]
mod tests;
