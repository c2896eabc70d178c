//! An arc as short lines within the chord tolerance.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::arc::flat;
use super::linear;
use crate::operation::{Arc, MotionKind, Target};
use crate::post::Post;
use nalgebra::Point3;

/// Smallest angle of a chord, degrees.
const FINEST: f64 = 0.05;

/// Chord tolerance where the machine names none, mm.
const TOLERANCE: f64 = 0.005;

/// Writes an arc as lines. `sweep`: degrees.
///
/// # Errors
/// As a straight motion.
pub fn carry_out(
    post: &mut Post,
    arc: &Arc,
    start: Point3<f64>,
    sweep: f64,
    target: Target,
) -> Result<()> {
    let radius = flat(arc, start).norm();
    let mm = post.control.require_unit()?.in_mm();
    let tolerance =
        post.control.commons.dbl_opt(loc::CIRCLE_CHORD_TOLERANCE).unwrap_or(TOLERANCE) / mm;
    let step = 2.0 * (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos().to_degrees();
    let count = (sweep / step.max(FINEST)).ceil().max(1.0) as u32;
    let from_axis = post.path.axis;
    let from = flat(arc, start);
    let across = arc.axis.cross(&from);
    let rise = arc.axis.dot(&(target.point - start));
    let base = start - from;
    for number in 1..count {
        let share = f64::from(number) / f64::from(count);
        let (sine, cosine) = (sweep * share).to_radians().sin_cos();
        let point = base + from * cosine + across * sine + arc.axis * (rise * share);
        let axis = from_axis.lerp(&target.axis, share).normalize();
        linear::carry_out(post, Target { point, axis, word: 0 }, MotionKind::Feed)?;
    }
    linear::carry_out(post, target, MotionKind::Feed)
}
