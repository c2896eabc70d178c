//! Motions of a CL file: points, arcs and holes as poses of the part.

use fil_cl::record::motion;
use fil_cl::{Record, Vocabulary};
use nalgebra::{Point3, Vector3};

use super::{Cycle, Matrix, State, Waiting};
use crate::forward::Pose;
use crate::verify::statements::{numbers, statement};
use crate::verify::wanted::{Arc, Effect, Hole, Wanted};

/// Start and end of an arc nearer than this make a full circle, in CL units.
const SAME_POINT: f64 = 1e-6;

/// With TIMES an end that lacks less than this of the start closes the last full turn:
/// so much may rounded points differ, mm or inch.
const CLOSES: f64 = 1e-3;

impl State {
    pub(super) fn motion(&mut self, record: &Record, vocabulary: &Vocabulary) -> Option<Wanted> {
        let axis = record.axis().map_or(self.axis, Vector3::from);
        let point = match record.point() {
            by if record.sub == motion::GODLTA => self.point_beside(record, by),
            point => point.map(Point3::from),
        };
        let Some(point) = point else {
            let what = statement(record, vocabulary);
            return Some(Wanted::Unknown { what, effect: Effect::Path });
        };
        if record.sub == motion::FROM {
            self.point = Some(point);
            self.axis = axis;
            return None;
        }
        if let Some(what) = self.frames.doubt(axis) {
            return Some(Wanted::Unknown { what, effect: Effect::Path });
        }
        if record.sub == motion::GODLTA && (self.cycle.is_none() || self.rapid) {
            return Some(self.line_to(point, axis));
        }
        if self.awaited.is_some() && !self.rapid {
            self.axis = axis;
            return self.point_of_thread(point);
        }
        Some(match (self.circle.take(), self.cycle) {
            (Some(waiting), _) => self.arc_to(&waiting, point, axis),
            (None, Some(cycle)) if !self.rapid => {
                self.point = Some(point);
                self.axis = axis;
                Wanted::Hole(Box::new(self.hole(&cycle, self.pose(point, axis))))
            }
            _ => self.line_to(point, axis),
        })
    }

    /// Where GODLTA leads from the last point: along the tool axis, or by a vector.
    fn point_beside(&self, record: &Record, by: Option<[f64; 3]>) -> Option<Point3<f64>> {
        let point = self.point?;
        match numbers(record)[..] {
            [along] => Some(point + self.axis * along),
            _ => by.map(|by| point + Vector3::from(by)),
        }
    }

    pub(super) fn line_to(&mut self, point: Point3<f64>, axis: Vector3<f64>) -> Wanted {
        self.point = Some(point);
        self.axis = axis;
        let pose = self.pose(point, axis);
        match self.thread {
            _ if std::mem::take(&mut self.rapid) => Wanted::Rapid(pose),
            Some(pitch) => Wanted::Thread(pose, pitch),
            None => Wanted::Feed(pose, self.rate),
        }
    }

    fn hole(&self, cycle: &Cycle, start: Pose) -> Hole {
        let unit = self.unit();
        let mm = |length: Option<f64>| length.map(|length| length * unit);
        Hole {
            start,
            kind: cycle.kind,
            depth: cycle.depth * unit,
            clear: mm(cycle.clear),
            retract: mm(cycle.retract),
            step: mm(cycle.step),
            dwell: cycle.dwell,
            rate: cycle.rate,
            rigid: cycle.rigid,
        }
    }

    /// The arc by the right-hand rule from the last point to this one; TIMES are
    /// full turns besides. In a frame that keeps no circles it is not followed.
    fn arc_to(&mut self, waiting: &Waiting, end: Point3<f64>, axis: Vector3<f64>) -> Wanted {
        self.rapid = false;
        let keeps_circles = self.matrix.as_ref().is_none_or(|matrix| {
            let turn = matrix.rows.fixed_columns::<3>(0).into_owned();
            (turn.transpose() * turn - nalgebra::Matrix3::identity()).amax() < 1e-6
        });
        let normal = Vector3::from(waiting.circle.axis);
        let (Some(start), Some(normal)) = (self.point, normal.try_normalize(1e-9)) else {
            return Wanted::Unknown { what: "CIRCLE".to_string(), effect: Effect::Path };
        };
        if !keeps_circles {
            let what = "an arc in a frame that makes no circle of it".to_string();
            return Wanted::Unknown { what, effect: Effect::Path };
        }
        let bare = Arc {
            center: Point3::from(waiting.circle.center),
            normal,
            start,
            end: Pose { tip: end, axis },
            sweep: 0.0,
        };
        let sweep = full_sweep(&bare, waiting.turns);
        self.point = Some(end);
        self.axis = axis;
        Wanted::Arc(Box::new(self.in_frame(&Arc { sweep, ..bare })), self.rate)
    }

    /// The arc as TRANS places it; a mirror turns its sense.
    fn in_frame(&self, arc: &Arc) -> Arc {
        let place = |point: Point3<f64>| self.pose(point, Vector3::z()).tip;
        let (center, ahead) = (place(arc.center), place(arc.center + arc.normal));
        let mirrored = self.matrix.as_ref().is_some_and(|matrix| {
            matrix.rows.fixed_columns::<3>(0).into_owned().determinant() < 0.0
        });
        let normal = (ahead - center).normalize() * if mirrored { -1.0 } else { 1.0 };
        Arc {
            center,
            normal,
            start: place(arc.start),
            end: self.pose(arc.end.tip, arc.end.axis),
            sweep: arc.sweep,
        }
    }

    /// A point and a tool axis after TRANS, in mm.
    pub(super) fn pose(&self, point: Point3<f64>, axis: Vector3<f64>) -> Pose {
        let (point, axis) = match &self.matrix {
            Some(Matrix { rows, turns_axis }) => {
                let turned = rows.fixed_columns::<3>(0) * axis;
                let point = Point3::from(rows * point.to_homogeneous());
                (point, if *turns_axis { turned } else { axis })
            }
            None => (point, axis),
        };
        let axis = axis.try_normalize(1e-9).unwrap_or(axis);
        Pose { tip: Point3::from((point.coords + self.shift + self.along) * self.unit()), axis }
    }
}

/// Degrees of an arc from its start to its end, with its full turns.
fn full_sweep(arc: &Arc, turns: f64) -> f64 {
    let apart = (arc.spoke(arc.start) - arc.spoke(arc.end.tip)).norm();
    if turns == 0.0 && apart < SAME_POINT {
        return 360.0;
    }
    let angle = arc.angle_of(arc.end.tip);
    let lacks = turns > 0.0 && apart < CLOSES && angle > 180.0;
    match angle {
        0.0 => 360.0 * turns.max(1.0),
        _ if lacks => angle - 360.0 + 360.0 * turns,
        _ => angle + 360.0 * turns,
    }
}
