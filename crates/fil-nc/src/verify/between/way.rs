//! The line or arc that a point should go along, and how far it is from it.

use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};

use crate::verify::expected_step;

/// Tool axes nearer than this lie in no plane that says how one turns to the other.
const PARALLEL: f64 = 1e-5;

/// A line or arc in space.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Way {
    /// A straight line, or a point.
    Line {
        /// Where it begins.
        from: Point3<f64>,
        /// Where it ends.
        to: Point3<f64>,
    },
    /// An arc or helix.
    Arc(Turn),
}

/// An arc or helix: a spoke that turns about a normal and rises along it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Turn {
    center: Point3<f64>,
    normal: Vector3<f64>,
    spoke: Vector3<f64>,
    /// Swept angle, radians.
    sweep: f64,
    /// Along the normal, over the whole arc.
    rise: f64,
    /// What part of it a motion goes along, radians.
    part: [f64; 2],
}

/// A point and the place of a way that lies beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foot {
    point: Point3<f64>,
    /// How far the point is from the way.
    pub(crate) distance: f64,
    /// How far along the way it is: a share of a line, radians of an arc.
    pub(crate) along: f64,
}

impl Way {
    /// A straight line.
    pub(crate) fn line(from: Point3<f64>, to: Point3<f64>) -> Self {
        Way::Line { from, to }
    }

    /// A part (degrees) of an arc of the CL file.
    pub(crate) fn arc(arc: &expected_step::Arc, [from, to]: [f64; 2]) -> Self {
        Way::Arc(Turn {
            center: arc.center + arc.normal * arc.normal.dot(&(arc.start - arc.center)),
            normal: arc.normal,
            spoke: arc.spoke(arc.start),
            sweep: arc.sweep.to_radians(),
            rise: arc.rise_of(arc.end.tip),
            part: [from.to_radians(), to.to_radians()],
        })
    }

    /// The way of the tip of a unit vector that turns from one direction to another
    /// in their plane. For opposite directions it is the plane through `middle`.
    pub(crate) fn turn(from: Vector3<f64>, to: Vector3<f64>, middle: Vector3<f64>) -> Self {
        let cross = from.cross(&to);
        let opposite = cross.norm() < PARALLEL && from.dot(&to) < 0.0;
        let normal = if opposite { from.cross(&middle) } else { cross };
        let Some(normal) = normal.try_normalize(PARALLEL) else {
            return Way::line(Point3::from(from), Point3::from(to));
        };
        let sweep = from.angle(&to);
        let center = Point3::origin();
        Way::Arc(Turn { center, normal, spoke: from, sweep, rise: 0.0, part: [0.5 * sweep; 2] })
    }

    /// Where on the way a point is at a share of the motion.
    pub(crate) fn foot(&self, point: Point3<f64>, share: f64) -> Foot {
        match self {
            Way::Line { from, to } => {
                let way = to - from;
                let length = way.norm_squared();
                let along = if length > 0.0 { way.dot(&(point - from)) / length } else { 0.0 };
                let along = along.clamp(0.0, 1.0);
                Foot { point, distance: (from + way * along - point).norm(), along }
            }
            Way::Arc(turn) => turn.foot(point, share),
        }
    }

    /// How far a point of the chord between two points can be from the way.
    pub(crate) fn most(&self, a: Foot, b: Foot) -> f64 {
        let ends = a.distance.max(b.distance);
        match self {
            // The distance from a line is convex.
            Way::Line { .. } => ends,
            // The chord between the feet, and how far the arc is from that; or as far as
            // the point is from the nearer end of its chord.
            Way::Arc(turn) => {
                let turned = b.along - a.along;
                let sagitta = turn.spoke.norm() * (turned * turned) / 8.0;
                ends + sagitta.min(0.5 * (b.point - a.point).norm())
            }
        }
    }
}

impl Turn {
    /// The place of the arc at the same angle about its normal, or an end: the nearest of
    /// those in the turn that the motion should be in, and in those beside it.
    fn foot(&self, point: Point3<f64>, share: f64) -> Foot {
        let from = point - self.center;
        let aside = self.normal.cross(&self.spoke);
        let angle = libm::atan2(aside.dot(&from), self.spoke.dot(&from));
        let expected = self.part[0] + (self.part[1] - self.part[0]) * share;
        let turns = ((expected - angle) / TAU).round();
        let feet = [0.0, -1.0, 1.0].map(|turn| {
            let along = (angle + (turns + turn) * TAU).clamp(0.0, self.sweep);
            let rise = self.normal * (self.rise * along / self.sweep.max(f64::MIN_POSITIVE));
            let place =
                self.center + self.spoke * libm::cos(along) + aside * libm::sin(along) + rise;
            Foot { point, distance: (place - point).norm(), along }
        });
        feet.into_iter().min_by(|a, b| a.distance.total_cmp(&b.distance)).unwrap_or(feet[0])
    }
}
