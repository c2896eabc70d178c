//! Curves as points: arcs, and straight motions of the axes that are curves on the
//! part.

use crate::forward::Forward;
use crate::motion::{Arc, Position};

use super::Point;

/// Most degrees that a rotary axis turns between two points.
const TURN: f64 = 2.0;

/// Most points of one motion.
const MOST: f64 = 720.0;

/// Shares of an arc nearer than this are one.
const SAME: f64 = 1e-9;

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
    let shares = match &arc {
        Some(arc) => {
            let [first, second] = arc.plane().map(|axis| from.linear[axis] - arc.center[axis]);
            let across = if arc.ccw { [-second, first] } else { [second, -first] };
            shares_of(count, &[(first, across[0]), (second, across[1])], arc.angle)
        }
        None => even(count).collect(),
    };
    shares.into_iter().map(move |share| {
        let at = if share < 1.0 { forward.along(&from, &to, arc.as_ref(), share) } else { to };
        tip(forward, &at)
    })
}

/// So many shares of a way, the last of which is all of it.
fn even(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(move |index| f64::from(index) / f64::from(count))
}

/// Shares of an arc of so many degrees at which it gets points: so many as are asked for, and
/// its least and greatest coordinates, so that the box around the points is that of the arc.
/// `spokes` are, for each coordinate, the parts of the spoke at the start and of the one a
/// quarter further on.
pub(super) fn shares_of(count: u32, spokes: &[(f64, f64)], sweep: f64) -> Vec<f64> {
    let mut shares: Vec<f64> = even(count).collect();
    for (start, across) in spokes {
        // start cos a + across sin a has its extremes half a turn apart.
        let first = libm::atan2(*across, *start).to_degrees().rem_euclid(180.0);
        let angles = std::iter::successors(Some(first), |angle| Some(angle + 180.0));
        shares.extend(angles.take_while(|angle| *angle < sweep).map(|angle| angle / sweep));
    }
    shares.retain(|share| *share > SAME);
    shares.sort_by(f64::total_cmp);
    shares.dedup_by(|next, last| *next - *last < SAME && *next < 1.0);
    shares
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
