//! The zones in which a rotary axis may stand: each position on its way must lie in them.

use fil_machine::axis_chain::Rotary;

/// A turn, degrees.
const TURN: f64 = 360.0;

/// Degrees from one position that is looked at to the next.
const STEP: f64 = 0.25;

/// Most steps of one way.
const MOST: f64 = 4_000.0;

/// A position of an axis on the way to another, degrees, at which it may not stand; from where
/// nobody knows or it may not stand either, its end. `slack`: of the last digit.
pub(super) fn outside(axis: &Rotary, from: Option<f64>, to: f64, slack: f64) -> Option<f64> {
    let from = from.filter(|from| holds(axis, *from, slack)).unwrap_or(to);
    let steps = ((to - from).abs() / STEP).ceil().clamp(1.0, MOST);
    let places = (1..=steps as u32).map(|number| from + (to - from) * f64::from(number) / steps);
    places.into_iter().find(|at| !holds(axis, *at, slack))
}

/// True in one of the ranges, and in the zone, where the machine has them.
fn holds(axis: &Rotary, angle: f64, slack: f64) -> bool {
    let within = |[low, high]: [f64; 2]| {
        let above = (angle - (low - slack)).rem_euclid(TURN);
        above <= high - low + 2.0 * slack
    };
    let mut ranges = axis.zones.ranges.iter().flatten().peekable();
    let in_ranges = ranges.peek().is_none() || ranges.any(|range| within(*range));
    in_ranges && axis.zones.zone.is_none_or(within)
}
