//! An arc as short lines within the chord tolerance.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::arc_parts::{Chords, flat};
use super::{Transformation, linear, linearization};
use crate::errors::PostCode;
use crate::operation::{Arc, MotionKind, Target};
use crate::post::Post;
use nalgebra::Point3;

/// Smallest angle of a chord, degrees.
const FINEST: f64 = 0.05;

/// Most lines of one CIRCLE, all its turns taken together: more of them the check of a program
/// would not follow as one arc.
const MOST_LINES: u32 = 100_000;

/// Chord tolerance where the machine names none, mm.
const TOLERANCE: f64 = 0.005;

impl Chords {
    /// `sweep`: degrees.
    ///
    /// # Errors
    /// Too many lines; as [`linearization::count`].
    pub fn new(
        post: &Post,
        arc: &Arc,
        start: Point3<f64>,
        sweep: f64,
        end: Target,
    ) -> Result<Self> {
        let from = flat(arc, start);
        let mut chords = Chords {
            base: start - from,
            from,
            across: arc.axis.cross(&from),
            rise: arc.axis * arc.axis.dot(&(end.point - start)),
            sweep,
            axes: [post.path.axis.stands, end.axis],
            end,
            count: 0,
            done: 0,
        };
        let count = chords.needed(post)?;
        if count > MOST_LINES {
            let message =
                format!("the arc with all its turns is {count} lines, {MOST_LINES} at most");
            return PostCode::TooManyParts.err(message);
        }
        chords.count = count;
        Ok(chords)
    }

    /// Writes up to so many lines more; false when the last one is written.
    ///
    /// # Errors
    /// As a straight motion.
    pub fn write(&mut self, post: &mut Post, most: u32) -> Result<bool> {
        let until = self.count.min(self.done + most);
        while self.done < until {
            self.done += 1;
            let point = self.at(f64::from(self.done) / f64::from(self.count));
            linear::carry_out(post, &point, MotionKind::Feed)?;
        }
        Ok(self.done < self.count)
    }

    /// The point at a share of the arc, with the tool between its ends.
    fn at(&self, share: f64) -> Target {
        if share >= 1.0 {
            return self.end;
        }
        let (sine, cosine) = libm::sincos((self.sweep * share).to_radians());
        let point = self.base + self.from * cosine + self.across * sine + self.rise * share;
        let axis = self.axes[0].lerp(&self.axes[1], share).normalize();
        Target { point, axis, word: 0 }
    }

    /// How many lines keep within the chord tolerance, and the tip near its arc where the
    /// machine turns on the way.
    ///
    /// # Errors
    /// As [`linearization::count`].
    fn needed(&self, post: &Post) -> Result<u32> {
        let mm = post.control.require_unit()?.in_mm();
        let chord = post.control.commons.dbl_opt(loc::CIRCLE_CHORD_TOLERANCE).unwrap_or(TOLERANCE);
        let within = |tolerance: f64| {
            let radius = self.from.norm();
            let step = 2.0 * libm::acos((1.0 - tolerance / radius).clamp(-1.0, 1.0)).to_degrees();
            (self.sweep / step.max(FINEST)).ceil().max(1.0) as u32
        };
        // Scales of TRANS draw the heights of chords out.
        let stretch = post.path.transformation.as_ref().map_or(1.0, Transformation::stretch);
        let chord = chord / stretch;
        let allowed = linearization::tolerance(post)?;
        match allowed.filter(|_| self.axes[0] != self.axes[1]) {
            Some(allowed) => {
                // The tip is off by the height of the chord and by its way beside the chord.
                let half = allowed / 2.0;
                let least = within(half.min(chord / mm));
                linearization::count(post, least, half, |share| self.at(share))
            }
            None => Ok(within(chord / mm)),
        }
    }
}

#[cfg(test)]
mod tests;
