//! Where the tip of the tool is while the axes move.
//!
//! A block moves all axes evenly. The tip then goes along a curve where a rotary axis
//! is among them. Its distance from a line is sampled, and a bound of how strongly
//! the curve can bend between two samples is added, so that nothing is missed.

use fil_machine::axes::Position;
use fil_machine::axis_chain::{AxisChain, Carries, Rotary};
use nalgebra::{Point3, Rotation3, Vector3};

/// Intervals between the samples of one motion.
const INTERVALS: u32 = 8;

/// The tip in the part frame where the axes stand: what [`AxisChain::linear`] undoes.
pub(super) fn tip(chain: &AxisChain, at: &Position) -> Point3<f64> {
    let mut point = Point3::new(at[0], at[1], at[2]);
    if let Some(length) = chain.pivot {
        let tool = chain.tool.into_inner();
        let turned = [1, 0].into_iter().fold(tool, |tool, n| match head(chain, n) {
            Some(axis) => turn(axis, at[n + 3]) * tool,
            None => tool,
        });
        point -= (turned - tool) * length;
    }
    for number in [1, 0] {
        if let Some(axis) = table(chain, number) {
            point = axis.center + turn(axis, at[number + 3]) * (point - axis.center);
        }
    }
    point
}

/// The largest distance of the tip from a line while the axes go evenly from one
/// position to another, at most this much; exact enough to compare with `enough`.
pub(super) fn largest_distance(
    chain: &AxisChain,
    from: &Position,
    to: &Position,
    line: [Point3<f64>; 2],
    enough: f64,
) -> f64 {
    let bend = bend(chain, from, to);
    let off = |share: f64| distance(line, tip(chain, &between(from, to, share)));
    let ends = off(0.0).max(off(1.0));
    if ends + bend / 8.0 <= enough {
        return ends + bend / 8.0;
    }
    let step = 1.0 / f64::from(INTERVALS);
    let sampled = (1..INTERVALS).map(|n| off(f64::from(n) * step)).fold(ends, f64::max);
    sampled + bend / 8.0 * step * step
}

/// The axes at a share (0 to 1) of the way between two positions.
pub(super) fn between(from: &Position, to: &Position, share: f64) -> Position {
    std::array::from_fn(|n| from[n] + (to[n] - from[n]) * share)
}

/// Distance of a point from the line between two others.
fn distance([from, to]: [Point3<f64>; 2], point: Point3<f64>) -> f64 {
    let way = to - from;
    let length = way.norm_squared();
    let share =
        if length > 0.0 { (way.dot(&(point - from)) / length).clamp(0.0, 1.0) } else { 0.0 };
    (point - (from + way * share)).norm()
}

/// Most that the second derivative of the tip by the share of the motion can be: by
/// the product rule, from the tool to the part.
fn bend(chain: &AxisChain, from: &Position, to: &Position) -> f64 {
    let angle = |n: usize| (to[n + 3] - from[n + 3]).abs().to_radians();
    let [start, end] = [from, to].map(|at| Vector3::new(at[0], at[1], at[2]));
    let (mut speed, mut bend, mut swing) = ((end - start).norm(), 0.0, 0.0);
    if let Some(length) = chain.pivot {
        let heads: f64 = [0, 1].into_iter().filter(|n| head(chain, *n).is_some()).map(angle).sum();
        speed += heads * length;
        bend += heads * heads * length;
        swing = if heads > 0.0 { 2.0 * length } else { 0.0 };
    }
    let mut reach: Option<(Point3<f64>, f64)> = None;
    for number in [1, 0] {
        let Some(axis) = table(chain, number) else { continue };
        let center = axis.center.coords;
        let radius = match reach {
            None => (start - center).norm().max((end - center).norm()) + swing,
            Some((before, radius)) => radius + (before - axis.center).norm(),
        };
        let turned = angle(number);
        bend += 2.0 * turned * speed + turned * turned * radius;
        speed += turned * radius;
        reach = Some((axis.center, radius));
    }
    bend
}

fn head(chain: &AxisChain, number: usize) -> Option<&Rotary> {
    chain.rotaries[number].as_ref().filter(|axis| axis.carries == Carries::Head)
}

fn table(chain: &AxisChain, number: usize) -> Option<&Rotary> {
    chain.rotaries[number].as_ref().filter(|axis| axis.carries == Carries::Table)
}

fn turn(axis: &Rotary, degrees: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&axis.direction, degrees.to_radians())
}
