//! Arcs whose sense fights the motions before and after them, or that are all the longer way
//! round: a CL file read in the wrong dialect has such arcs, so a post may refuse them.

use crate::path::Point;

use super::expected::{Act, Arc, Step};
use super::geometry::{add, axes, times};

/// An arc turns back from the motion before it and into the one after it.
pub(super) fn has_arc_against_neighbours(steps: &[Step]) -> bool {
    let mut ways: Vec<Way> = Vec::new();
    let mut at = None;
    for step in steps {
        let Some(end) = end(&step.act) else { continue };
        match &step.act {
            Act::Arc(arc) => ways.push(of_arc(arc)),
            _ => ways.extend(at.and_then(|from| of_line(from, end))),
        }
        at = Some(end);
    }
    let fights = ways.windows(3).any(|ways| {
        let [before, here, after] = ways else { return false };
        here.angle > 0.0 && back(before.last, here.first) && back(here.last, after.first)
    });
    // One that is not the shorter way round tells as much with one end.
    let half = 0.99 * std::f64::consts::PI;
    let long = |way: &Way| way.angle > half;
    let one_end = ways.windows(2).any(|ways| {
        let [before, after] = ways else { return false };
        (long(before) != long(after)) && back(before.last, after.first)
    });
    let all_long = ways.iter().filter(|way| way.angle > 0.0).all(long);
    fights || one_end || all_long && ways.iter().filter(|way| long(way)).count() >= 4
}

/// The directions in which a motion begins and ends.
struct Way {
    first: Point,
    last: Point,
    /// How far an arc turns, radians; 0 for a line.
    angle: f64,
}

fn back(a: Point, b: Point) -> bool {
    (0..3).map(|axis| a[axis] * b[axis]).sum::<f64>() < 0.0
}

fn end(act: &Act) -> Option<Point> {
    match act {
        Act::Rapid(to) | Act::Feed(to) | Act::Thread { to, .. } => Some(*to),
        Act::Arc(arc) => Some(arc.to),
        Act::Hole(hole) => Some([hole.at[0], hole.at[1], hole.clear]),
        _ => None,
    }
}

fn of_line(from: Point, to: Point) -> Option<Way> {
    let way = add(to, times(from, -1.0));
    (way != [0.0; 3]).then_some(Way { first: way, last: way, angle: 0.0 })
}

fn of_arc(arc: &Arc) -> Way {
    let [first, second, along] = axes(arc.normal);
    let tangent = |point: Point| {
        let (a, b) = (point[first] - arc.center[first], point[second] - arc.center[second]);
        let turn = if arc.ccw { 1.0 } else { -1.0 };
        let mut way = [0.0; 3];
        way[first] = -b * turn;
        way[second] = a * turn;
        way[along] = (arc.to[along] - arc.from[along]) / arc.total;
        way
    };
    Way { first: tangent(arc.from), last: tangent(arc.to), angle: arc.total.abs() }
}
