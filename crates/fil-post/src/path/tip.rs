//! Where the tip of the tool is while the axes move.
//!
//! A block moves all axes evenly. The tip then goes along a curve where a rotary axis
//! is among them. Its distance from a line is sampled, and a bound of how strongly
//! the curve can bend between two samples is added, so that nothing is missed.

use fil_machine::axes::Position;
use fil_machine::axis_chain::{AxisChain, Carries, Rotary, Turn};
use nalgebra::{Point3, Vector3};

/// Intervals between the samples of one motion.
const INTERVALS: u32 = 8;

/// The tip in the part frame where the axes stand: what [`AxisChain::linear`] undoes.
#[inline]
pub(super) fn tip(chain: &AxisChain, at: &Position) -> Point3<f64> {
    tip_beside(chain, at, [Turn::default(); 2])
}

/// The same where the rotary axes stand near positions whose sines are known.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(super) fn tip_beside(chain: &AxisChain, at: &Position, turns: [Turn; 2]) -> Point3<f64> {
    let mut point = Point3::new(at[0], at[1], at[2]);
    if let Some(length) = chain.pivot {
        let tool = chain.tool.into_inner();
        let turned = [1, 0].into_iter().fold(tool, |tool, n| match head(chain, n) {
            Some(axis) => axis.turned_by(tool, turns[n].beside(at[n + 3])),
            None => tool,
        });
        point -= (turned - tool) * length;
    }
    for number in [1, 0] {
        if let Some(axis) = table(chain, number) {
            let turn = turns[number].beside(at[number + 3]);
            point = axis.center + axis.turned_by(point - axis.center, turn);
        }
    }
    point
}

/// The largest distance of the tip from a line while the axes go evenly from one
/// position to another, at most this much; exact enough to compare with `enough`. `ends`:
/// the larger distance at those two positions.
pub(super) fn largest_distance(
    chain: &AxisChain,
    [from, to]: [&Position; 2],
    line: [Point3<f64>; 2],
    ends: f64,
    enough: f64,
) -> f64 {
    let bend = bounds(chain, from, to, &Position::default()).bend;
    let off = |share: f64| distance(line, tip(chain, &between(from, to, share)));
    if ends + bend / 8.0 <= enough {
        return ends + bend / 8.0;
    }
    let step = 1.0 / f64::from(INTERVALS);
    let sampled = (1..INTERVALS).map(|n| off(f64::from(n) * step)).fold(ends, f64::max);
    sampled + bend / 8.0 * step * step
}

/// A distance that the tip can't be from the line between two exact positions while the axes
/// go evenly between the same two as the tape has them: `digits` is the last digit of each
/// axis. It takes no sine, and is far too large where the machine turns much.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(super) fn certain_distance(
    chain: &AxisChain,
    from: &Position,
    to: &Position,
    digits: &Position,
) -> f64 {
    let Bounds { bend, turned } = bounds(chain, from, to, digits);
    // As far as the last digits of X, Y and Z together reach at most.
    let linear = digits[0] + digits[1] + digits[2];
    linear + turned + bend / 8.0
}

/// The axes at a share (0 to 1) of the way between two positions.
pub(super) fn between(from: &Position, to: &Position, share: f64) -> Position {
    std::array::from_fn(|n| from[n] + (to[n] - from[n]) * share)
}

/// Distance of a point from the line between two others.
pub(super) fn distance(line: [Point3<f64>; 2], point: Point3<f64>) -> f64 {
    (point - nearest(line, point)).norm()
}

/// The point of the line between two others that is nearest to a third.
pub(super) fn nearest([from, to]: [Point3<f64>; 2], point: Point3<f64>) -> Point3<f64> {
    let way = to - from;
    let length = way.norm_squared();
    let share =
        if length > 0.0 { (way.dot(&(point - from)) / length).clamp(0.0, 1.0) } else { 0.0 };
    from + way * share
}

/// Bounds of how the tip moves between two positions.
struct Bounds {
    /// Most that its second derivative by the share of the motion can be.
    bend: f64,
    /// Most that the last digits of the rotary axes move it.
    turned: f64,
}

/// By the product rule, from the tool to the part.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn bounds(chain: &AxisChain, from: &Position, to: &Position, digits: &Position) -> Bounds {
    let angle = |n: usize| (to[n + 3] - from[n + 3]).abs().to_radians();
    let [start, end] = [from, to].map(|at| Vector3::new(at[0], at[1], at[2]));
    let (mut speed, mut bend, mut swing) = ((end - start).norm(), 0.0, 0.0);
    let mut by_digits = 0.0;
    if let Some(length) = chain.pivot {
        let heads = || [0, 1].into_iter().filter(|n| head(chain, *n).is_some());
        let turned: f64 = heads().map(angle).sum();
        speed += turned * length;
        bend += turned * turned * length;
        by_digits += heads().map(|n| digits[n + 3].to_radians()).sum::<f64>() * length;
        // A head that leans holds the tip away from where X, Y and Z say, turning or not.
        let leans = |at: &Position| heads().map(|n| at[n + 3].to_radians().abs()).sum::<f64>();
        swing = length * leans(from).max(leans(to)).min(2.0);
    }
    let mut outer: Option<(Point3<f64>, f64)> = None;
    for number in [1, 0] {
        let Some(axis) = table(chain, number) else { continue };
        let center = axis.center.coords;
        let radius = match outer {
            None => {
                let squares = [start, end].map(|at| (at - center).norm_squared());
                squares[0].max(squares[1]).sqrt() + swing
            }
            Some((before, radius)) => radius + (before - axis.center).norm(),
        };
        let turned = angle(number);
        bend += 2.0 * turned * speed + turned * turned * radius;
        speed += turned * radius;
        by_digits += digits[number + 3].to_radians() * radius;
        outer = Some((axis.center, radius));
    }
    Bounds { bend, turned: by_digits }
}

/// A rotary axis, 0 or 1, if it carries the tool.
#[inline]
pub(super) fn head(chain: &AxisChain, number: usize) -> Option<&Rotary> {
    chain.rotaries[number].as_ref().filter(|axis| axis.carries == Carries::Head)
}

#[inline]
fn table(chain: &AxisChain, number: usize) -> Option<&Rotary> {
    chain.rotaries[number].as_ref().filter(|axis| axis.carries == Carries::Table)
}
