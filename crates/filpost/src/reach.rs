//! How far a motion reaches: the length of an arc and the box around it.

use std::f64::consts::TAU;

use fil_post::operation::Arc;

use crate::report::Extents;

type Vector = [f64; 3];

/// An arc or helix from one point to another.
pub(crate) struct ArcPath {
    center: Vector,
    axis: Vector,
    radius: f64,
    /// Direction of the start in the plane of the arc.
    start: Vector,
    /// Height of start and end along the axis, from the center.
    low: f64,
    high: f64,
    /// Angle from start to end, all turns included.
    angle: f64,
}

impl ArcPath {
    /// The arc between two points.
    pub fn new(arc: &Arc, from: Vector, to: Vector) -> Self {
        let center = [arc.center.x, arc.center.y, arc.center.z];
        let axis = [arc.axis.x, arc.axis.y, arc.axis.z];
        let (start, low) = in_plane(minus(from, center), axis);
        let (end, high) = in_plane(minus(to, center), axis);
        let radius = arc.radius.unwrap_or_else(|| dot(start, start).sqrt());
        let mut angle = turn(axis, start, end);
        // Ends that meet are a full circle.
        if angle < 1e-9 && arc.turns == 0.0 {
            angle = TAU;
        }
        let angle = angle + arc.turns * TAU;
        ArcPath { center, axis, radius, start, low, high, angle }
    }

    /// Length of the path.
    pub fn length(&self) -> f64 {
        libm::hypot(self.radius * self.angle, self.high - self.low)
    }

    /// True when a box holds the point that is `out` off the center along a coordinate, at
    /// whatever height of the path.
    fn is_inside(&self, extents: Option<&Extents>, along: usize, out: f64) -> bool {
        let Some(extents) = extents else { return false };
        let held = extents.min[along]..=extents.max[along];
        let at = |height: f64| self.center[along] + out + self.axis[along] * height;
        held.contains(&at(self.low)) && held.contains(&at(self.high))
    }

    /// Widens a box to where the arc reaches farthest along each axis between its ends; of a
    /// helix the last turn and the first one count.
    pub fn widen(&self, extents: &mut Option<Extents>) {
        for along in 0..3 {
            let mut unit = [0.0; 3];
            unit[along] = 1.0;
            let (farthest, _) = in_plane(unit, self.axis);
            let size = dot(farthest, farthest).sqrt();
            if size < 1e-9 {
                continue;
            }
            for sign in [self.radius / size, -self.radius / size] {
                let out = farthest.map(|part| part * sign);
                // Most arcs lie inside of what was reached before: no angle is needed then.
                if self.is_inside(extents.as_ref(), along, out[along]) {
                    continue;
                }
                let first = turn(self.axis, self.start, out);
                if first > self.angle {
                    continue;
                }
                let last = first + ((self.angle - first) / TAU).floor() * TAU;
                for angle in [first, last] {
                    let height = self.low + (self.high - self.low) * angle / self.angle;
                    let point = [0, 1, 2].map(|i| self.center[i] + out[i] + self.axis[i] * height);
                    Extents::add(extents, point);
                }
            }
        }
    }
}

/// Angle from one direction to another about an axis, 0 to a full turn.
fn turn(axis: Vector, from: Vector, to: Vector) -> f64 {
    let angle = libm::atan2(dot(axis, cross(from, to)), dot(from, to));
    if angle < 0.0 { angle + TAU } else { angle }
}

/// The part of a vector across an axis, and its length along it.
fn in_plane(vector: Vector, axis: Vector) -> (Vector, f64) {
    let along = dot(vector, axis);
    (minus(vector, axis.map(|part| part * along)), along)
}

/// The distance of two points.
pub(crate) fn distance(from: Vector, to: Vector) -> f64 {
    let between = minus(to, from);
    dot(between, between).sqrt()
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
