//! The place where a curve is farthest from the way it should go.
//!
//! Between two points of a curve it is never farther from the way than the chord is,
//! and an eighth of its bend times the square of the step more. So the step with the
//! largest such bound is halved until none can hold more than what was found.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Point3;

use super::way::{Foot, Way};

/// Most points of one curve.
const MOST: usize = 2_000;

/// A step of a curve.
struct Step {
    /// How far the curve can be from the way within it.
    bound: f64,
    shares: [f64; 2],
    feet: [Foot; 2],
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Step {}

impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Step {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(self.shares[0].total_cmp(&other.shares[0]))
    }
}

/// The largest distance of a curve, from share 0 to 1, from its way, when it is more
/// than `enough`; else some value up to that.
///
/// `bend` bounds the length of the curve's second derivative. The result is too small
/// by at most `exact`. Of a curve with so many turns that 2,000 points don't suffice
/// for that, it is the bound, and rather too large.
pub(super) fn farthest(
    curve: impl Fn(f64) -> Point3<f64>,
    way: &Way,
    bend: f64,
    enough: f64,
    exact: f64,
) -> f64 {
    let foot = |share: f64| way.foot(curve(share), share);
    let step = |shares: [f64; 2], feet: [Foot; 2]| {
        let length = shares[1] - shares[0];
        let bound = way.most(feet[0], feet[1]) + bend * length * length / 8.0;
        Step { bound, shares, feet }
    };
    let ends = [foot(0.0), foot(1.0)];
    let mut found = ends[0].distance.max(ends[1].distance);
    let mut steps = BinaryHeap::from([step([0.0, 1.0], ends)]);
    for _ in 0..MOST {
        let Some(widest) = steps.pop() else { return found };
        if widest.bound <= found + exact || widest.bound <= enough {
            return found;
        }
        let [from, to] = widest.shares;
        let middle = 0.5 * (from + to);
        let half = foot(middle);
        found = found.max(half.distance);
        steps.push(step([from, middle], [widest.feet[0], half]));
        steps.push(step([middle, to], [half, widest.feet[1]]));
    }
    steps.pop().map_or(found, |widest| widest.bound.max(found))
}
