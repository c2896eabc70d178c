//! Motions of a CL file: points, arcs and holes as poses of the part.

use fil_cl::record::motion;
use fil_cl::{Record, Vocabulary};
use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Point3, Vector3};

use super::frame_words::{Matrix, Mover};
use super::{Cycle, State, Waiting};
use crate::forward::Pose;
use crate::motion::Rate;
use crate::verify::expected_step::{Arc, Effect, ExpectedStep, Hole};
use crate::verify::report::FindingKind;
use crate::verify::statements::{numbers, statement};

/// Start and end of an arc nearer than this make a full circle, in CL units: numbers of a CL file
/// have five digits behind the point, or more.
const SAME_POINT: f64 = 1.5e-5;

/// With TIMES an end that lacks less than this of the start closes the last full turn:
/// so much may rounded points differ, mm or inch.
const CLOSES: f64 = 1e-3;

impl State {
    pub(super) fn motion(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Option<ExpectedStep> {
        let axis = record.axis().map_or(self.tool.axis, Vector3::from);
        if record.axis().is_some() && self.frame.is_moved_by(Mover::Author) {
            self.frame.matrix = None;
        }
        let point = match record.point() {
            by if record.sub == motion::GODLTA => self.point_beside(record, by),
            point => point.map(Point3::from),
        };
        let Some(point) = point else {
            let what = statement(record, vocabulary);
            return Some(ExpectedStep::Unknown { what, effect: Effect::Path });
        };
        if record.sub == motion::FROM {
            self.tool.point = Some(point);
            self.tool.axis = axis;
            return None;
        }
        if let Some(what) = self.frame.named.doubt(axis) {
            return Some(ExpectedStep::Unknown { what, effect: Effect::Path });
        }
        if record.sub == motion::GODLTA && (self.cycle.is_none() || self.rapid) {
            return Some(self.line_to(point, axis));
        }
        if self.threads.awaited.is_some() && !self.rapid {
            self.tool.axis = axis;
            return self.point_of_thread(point);
        }
        Some(match (self.circle.take(), self.cycle) {
            (Some(waiting), _) => self.arc_to(&waiting, point, axis),
            (None, Some(cycle)) if !self.rapid && !self.plates.is_empty() => {
                self.hole_through_plates(&cycle, point, axis)
            }
            (None, Some(cycle)) if !self.rapid => {
                self.tool.point = Some(point);
                self.tool.axis = axis;
                if !self.keeps_lengths() {
                    let what = "a hole in a frame that scales its lengths".to_string();
                    let effect = Effect::Doubtful(FindingKind::Cycle);
                    return Some(ExpectedStep::Unknown { what, effect });
                }
                if self.taps_another_lead() {
                    let what = "a hole of CYCLE/TAP at another speed than the one before it, whose \
                                lead is another one";
                    let effect = Effect::Doubtful(FindingKind::Thread);
                    return Some(ExpectedStep::Unknown { what: what.to_string(), effect });
                }
                ExpectedStep::Hole(Box::new(self.hole(&cycle, self.pose(point, axis))))
            }
            _ => self.line_to(point, axis),
        })
    }

    /// Where GODLTA leads from the last point: along the tool axis, or by a vector.
    fn point_beside(&self, record: &Record, by: Option<[f64; 3]>) -> Option<Point3<f64>> {
        let point = self.tool.point?;
        match numbers(record)[..] {
            [along] => Some(point + self.tool.axis * along),
            _ => by.map(|by| point + Vector3::from(by)),
        }
    }

    pub(super) fn line_to(&mut self, point: Point3<f64>, axis: Vector3<f64>) -> ExpectedStep {
        self.tool.point = Some(point);
        self.tool.axis = axis;
        let pose = self.pose(point, axis);
        match self.threads.lead {
            _ if std::mem::take(&mut self.rapid) => ExpectedStep::Rapid(pose),
            Some(pitch) => ExpectedStep::Thread(pose, pitch),
            None => ExpectedStep::Feed(pose, self.rate),
        }
    }

    /// A tap at a feed a minute comes at another speed of the spindle than the first hole of its
    /// cycle, so that its lead is another one.
    fn taps_another_lead(&mut self) -> bool {
        let (Some(cycle), Some(turns)) = (&mut self.cycle, self.spindle.turns) else {
            return false;
        };
        let hangs = cycle.kind == CycleKind::Tap && matches!(cycle.rate, Some(Rate::PerMinute(_)));
        hangs && cycle.turns.replace(turns).is_some_and(|before| before != turns)
    }

    /// The feed of a hole; a tap at a feed per minute asks for its pitch at the speed of SPINDL.
    fn rate_of_hole(&self, cycle: &Cycle) -> Option<Rate> {
        match (cycle.rate, self.spindle.turns) {
            (Some(Rate::PerMinute(rate)), Some(turns))
                if cycle.kind == CycleKind::Tap && turns > 0.0 =>
            {
                Some(Rate::PerTurn(rate / turns))
            }
            (rate, _) => rate,
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
            out_each: cycle.out_each,
            dwell: cycle.dwell,
            rate: self.rate_of_hole(cycle),
            rigid: cycle.rigid,
        }
    }

    /// The arc by the right-hand rule from the last point to this one; TIMES are
    /// full turns besides. In a frame that keeps no circles it is not followed.
    fn arc_to(&mut self, waiting: &Waiting, end: Point3<f64>, axis: Vector3<f64>) -> ExpectedStep {
        self.rapid = false;
        let keeps_circles = self.scale().is_some();
        let normal = Vector3::from(waiting.circle.axis);
        let (Some(start), Some(normal)) = (self.tool.point, normal.try_normalize(1e-9)) else {
            return ExpectedStep::Unknown { what: "CIRCLE".to_string(), effect: Effect::Path };
        };
        if !keeps_circles {
            let what = "an arc in a frame that makes no circle of it".to_string();
            return ExpectedStep::Unknown { what, effect: Effect::Path };
        }
        let bare = Arc {
            center: Point3::from(waiting.circle.center),
            normal,
            start,
            end: Pose { tip: end, axis },
            sweep: 0.0,
        };
        let runs_on = normal.dot(&bare.spoke(start).cross(&bare.spoke(end))) > 0.0;
        let is_tiny = self.exact_turns && runs_on;
        if !is_tiny && is_full_or_none(&bare, waiting.turns, CLOSES / self.unit()) {
            let what = "CIRCLE whose end is nearly its start, a full turn or none".to_string();
            return ExpectedStep::Unknown { what, effect: Effect::Doubtful(FindingKind::Arc) };
        }
        let sweep = full_sweep(&bare, waiting.turns);
        self.tool.point = Some(end);
        self.tool.axis = axis;
        ExpectedStep::Arc(Box::new(self.in_frame(&Arc { sweep, ..bare })), self.rate)
    }

    /// How many times longer TRANS makes all lengths; `None` where not all alike.
    fn scale(&self) -> Option<f64> {
        let Some(matrix) = &self.frame.matrix else { return Some(1.0) };
        let turn = matrix.rows.fixed_columns::<3>(0).into_owned();
        let (squares, scale) = (turn.transpose() * turn, turn.column(0).norm_squared());
        let off = (squares - nalgebra::Matrix3::identity() * scale).amax();
        (off < 1e-6 * scale).then(|| scale.sqrt())
    }

    /// TRANS makes no length of a hole another one.
    fn keeps_lengths(&self) -> bool {
        self.scale().is_some_and(|scale| (scale - 1.0).abs() < 1e-6)
    }

    /// The arc as TRANS places it; a mirror turns its sense.
    fn in_frame(&self, arc: &Arc) -> Arc {
        let place = |point: Point3<f64>| self.pose(point, Vector3::z()).tip;
        let (center, ahead) = (place(arc.center), place(arc.center + arc.normal));
        let mirrored = self.frame.matrix.as_ref().is_some_and(|matrix| {
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
        let (point, axis) = match &self.frame.matrix {
            Some(Matrix { rows, turns_axis, .. }) => {
                let turned = rows.fixed_columns::<3>(0) * axis;
                let point = Point3::from(rows * point.to_homogeneous());
                (point, if *turns_axis { turned } else { axis })
            }
            None => (point, axis),
        };
        let axis = axis.try_normalize(1e-9).unwrap_or(axis);
        Pose {
            tip: Point3::from((point.coords + self.frame.shift + self.frame.along) * self.unit()),
            axis,
        }
    }
}

/// The ends of an arc differ by no more than a rounding `within`, and it is larger than that: no
/// reading of it is certain.
fn is_full_or_none(arc: &Arc, turns: f64, within: f64) -> bool {
    let out = arc.spoke(arc.start);
    let apart = (out - arc.spoke(arc.end.tip)).norm();
    turns == 0.0 && (SAME_POINT..within).contains(&apart) && 2.0 * out.norm() > within
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
