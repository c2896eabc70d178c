//! Where the live tools of a lathe point: a program says where the axes stand, and not how its
//! tool lies in the turret. The CL file says it.

use std::collections::HashMap;

use super::{Drawing, Point, Trace};

/// Side of a cell of the part in which points are looked for, and how far the end of a motion
/// may lie from that of the CL file, mm.
const CELL: f64 = 0.1;
const NEAR: f64 = 0.01;

/// The direction of a tool that is not known, or that does not turn.
const NONE: Point = [0.0; 3];

/// Takes the directions of tools that lie square to Z from the path of the CL file, where
/// motions of both end at the same points and the CL file has one direction there. Other
/// motions of a lathe have none.
pub(super) fn take_axes(drawing: &mut Drawing<'_>) {
    let Some(under) = drawing.under.as_ref().filter(|_| drawing.lathe) else { return };
    let ends = ends(under);
    let mut axes = Vec::new();
    for (at, piece) in drawing.path.pieces.iter().enumerate() {
        let axis = axis_at(&ends, &drawing.path.points[piece.last()]).unwrap_or(NONE);
        if axes.last().map_or(NONE, |(_, axis)| *axis) != axis {
            axes.push((at, axis));
        }
    }
    // A lathe without such tools shows none.
    if !axes.is_empty() && axes[0].0 > 0 {
        axes.insert(0, (0, NONE));
    }
    drawing.path.axes = axes;
}

type Ends = HashMap<[i64; 3], Vec<(Point, Point)>>;

/// The ends of motions with the direction of the tool.
fn ends(trace: &Trace) -> Ends {
    let mut ends = Ends::new();
    let mut rows = trace.axes.iter().peekable();
    let mut axis = [0.0, 0.0, 1.0];
    for (at, piece) in trace.pieces.iter().enumerate() {
        while let Some((_, next)) = rows.next_if(|(from, _)| *from <= at) {
            axis = *next;
        }
        let end = trace.points[piece.last()];
        ends.entry(cell(&end)).or_default().push((end, axis));
    }
    ends
}

fn cell(point: &Point) -> [i64; 3] {
    point.map(|value| (value / CELL).floor() as i64)
}

/// The one direction square to Z of motions that end at a point.
fn axis_at(ends: &Ends, point: &Point) -> Option<Point> {
    let [x, y, z] = cell(point);
    let steps = [-1, 0, 1];
    let cells = steps.iter().flat_map(|dx| steps.map(|dy| (dx, dy)));
    let cells = cells.flat_map(|(dx, dy)| steps.map(|dz| [x + dx, y + dy, z + dz]));
    let near = |end: &Point| (0..3).all(|axis| (end[axis] - point[axis]).abs() <= NEAR);
    let mut found: Option<Point> = None;
    for (end, axis) in cells.filter_map(|cell| ends.get(&cell)).flatten() {
        if !near(end) {
            continue;
        }
        let same = |known: Point| (0..3).all(|at| (known[at] - axis[at]).abs() < 1e-3);
        if axis[2].abs() > 1e-3 || !found.is_none_or(same) {
            return None;
        }
        found = Some(*axis);
    }
    found
}
