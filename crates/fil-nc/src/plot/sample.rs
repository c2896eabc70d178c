//! Curves as points: arcs, and straight motions of the axes that are curves on the
//! part.

use crate::forward::Forward;
use crate::motion::{Arc, Position};

use super::Point;

/// Most degrees that a rotary axis turns between two points.
const TURN: f64 = 2.0;

/// Most points of one motion.
const MOST: f64 = 720.0;

/// Positions of the axes along a motion, without its start; the end is the last one.
pub(super) fn positions(
    from: &Position,
    to: &Position,
    arc: Option<&Arc>,
    tolerance: f64,
) -> impl Iterator<Item = Position> {
    let turned = (0..2).map(|axis| (to.rotary[axis] - from.rotary[axis]).abs()).fold(0.0, f64::max);
    let radius = arc.map(|arc| radius(arc, from));
    let swept = arc.map_or(0.0, |arc| arc.angle);
    let step = radius.map_or(360.0, |radius| arc_step(radius, tolerance));
    let count = (swept / step).max(turned / TURN).ceil().clamp(1.0, MOST) as u32;
    let (from, to, arc) = (*from, *to, arc.copied());
    (1..=count).map(move |index| {
        let share = f64::from(index) / f64::from(count);
        if index == count { to } else { between(&from, &to, arc.as_ref(), share) }
    })
}

/// Degrees of an arc whose chord stays within the tolerance.
pub(super) fn arc_step(radius: f64, tolerance: f64) -> f64 {
    let step = 2.0 * (1.0 - tolerance / radius.max(1e-9)).clamp(-1.0, 1.0).acos().to_degrees();
    step.clamp(0.5, 60.0)
}

fn plane(arc: &Arc) -> [usize; 2] {
    [(arc.normal + 1) % 3, (arc.normal + 2) % 3]
}

fn radius(arc: &Arc, from: &Position) -> f64 {
    let [first, second] = plane(arc);
    let centre = arc.centre;
    (from.linear[first] - centre[first]).hypot(from.linear[second] - centre[second])
}

fn between(from: &Position, to: &Position, arc: Option<&Arc>, share: f64) -> Position {
    let mix = |a: f64, b: f64| a + (b - a) * share;
    let mut at = Position {
        linear: std::array::from_fn(|axis| mix(from.linear[axis], to.linear[axis])),
        rotary: std::array::from_fn(|axis| mix(from.rotary[axis], to.rotary[axis])),
    };
    if let Some(arc) = arc {
        let [first, second] = plane(arc);
        let turned = (arc.angle * share * if arc.ccw { 1.0 } else { -1.0 }).to_radians();
        let (sine, cosine) = turned.sin_cos();
        let arm =
            [from.linear[first] - arc.centre[first], from.linear[second] - arc.centre[second]];
        at.linear[first] = arc.centre[first] + arm[0] * cosine - arm[1] * sine;
        at.linear[second] = arc.centre[second] + arm[0] * sine + arm[1] * cosine;
    }
    at
}

/// The tool tip in the part frame.
pub(super) fn tip(forward: &Forward, position: &Position) -> Point {
    if forward.has_rotary() { forward.pose(position).tip.into() } else { position.linear }
}
