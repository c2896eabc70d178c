//! Curves as points: arcs, and straight motions of the axes that are curves on the
//! part.

use crate::forward::Forward;
use crate::motion::{Arc, Position};

use super::Point;

/// Most degrees that a rotary axis turns between two points.
const TURN: f64 = 2.0;

/// Most points of one motion.
const MOST: f64 = 720.0;

/// Tool tips along a motion, without its start; the end is the last one.
pub(super) fn tips(
    forward: &Forward,
    (from, to): (&Position, &Position),
    arc: Option<&Arc>,
    tolerance: f64,
) -> impl Iterator<Item = Point> {
    let swept = arc.map_or(0.0, |arc| arc.angle / arc_step(radius(arc, from), tolerance));
    let count = swept.max(turned(from, to) / TURN).ceil().clamp(1.0, MOST) as u32;
    let (from, to, arc) = (*from, *to, arc.copied());
    (1..=count).map(move |index| {
        let share = f64::from(index) / f64::from(count);
        let at = if index == count { to } else { forward.along(&from, &to, arc.as_ref(), share) };
        tip(forward, &at)
    })
}

/// Degrees of the rotary axes that bend the way of the tip.
fn turned(from: &Position, to: &Position) -> f64 {
    if to.names_tip() {
        return 0.0;
    }
    (0..2).map(|axis| (to.rotary[axis] - from.rotary[axis]).abs()).fold(0.0, f64::max)
}

/// Degrees of an arc whose chord stays within the tolerance.
pub(super) fn arc_step(radius: f64, tolerance: f64) -> f64 {
    let step = 2.0 * libm::acos((1.0 - tolerance / radius.max(1e-9)).clamp(-1.0, 1.0)).to_degrees();
    step.clamp(0.5, 60.0)
}

fn radius(arc: &Arc, from: &Position) -> f64 {
    let [first, second] = arc.plane();
    let center = arc.center;
    libm::hypot(from.linear[first] - center[first], from.linear[second] - center[second])
}

/// The tool tip in the part frame.
pub(super) fn tip(forward: &Forward, position: &Position) -> Point {
    if forward.has_rotary() { forward.pose(position).tip.into() } else { position.linear }
}
