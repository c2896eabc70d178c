//! A straight line of the CL file that a program makes in several blocks, as a post
//! does to keep the tip near its line while the machine turns.

use nalgebra::Vector3;

use super::ahead::Steps;
use super::between::Asked;
use super::between::way::Way;
use super::lines::is_line;
use super::report::FindingKind;
use super::say::short;
use super::walk::Walk;
use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Position, Rate};

/// Most blocks of one line.
const MOST_PARTS: usize = 1_000;

/// Only a point so near to the end of a line is looked at more closely, mm.
const NEAR: f64 = 1.0;

/// A point so far off a line, in parts of its length, belongs to another motion.
const BESIDE: f64 = 0.1;

/// What is wrong with a point on the way.
enum Fault {
    /// The tip is so far off the line, mm.
    Tip(f64),
    /// The tool does not lie between the directions of the ends.
    Axis,
}

/// Blocks that lead to the end of a line.
struct Parts {
    blocks: Vec<Move>,
    /// What is wrong with their ends.
    faults: Vec<(u32, Fault)>,
}

impl<C: Steps> Walk<'_, C> {
    /// Takes the blocks that make a line, when all of them end on it.
    pub(super) fn parts(&mut self, cl_line: u32, pose: &Pose, rate: Option<Rate>) -> bool {
        match self.parts_to(pose) {
            Some(parts) if parts.faults.is_empty() => {
                self.take_parts(cl_line, &parts, pose, rate);
                true
            }
            _ => false,
        }
    }

    /// Takes the blocks of a line of which some end beside it, and says which; false
    /// when the next ones lead elsewhere.
    pub(super) fn parts_beside(&mut self, cl_line: u32, pose: &Pose, rate: Option<Rate>) -> bool {
        let Some(parts) = self.parts_to(pose) else { return false };
        for (line, fault) in &parts.faults {
            let (kind, message) = match fault {
                Fault::Tip(off) => (
                    FindingKind::Position,
                    format!("on the way the tip is {} off its line", short(*off)),
                ),
                Fault::Axis => {
                    (FindingKind::Axis, "on the way the tool is not between its ends".to_string())
                }
            };
            self.find(kind, Some(cl_line), Some(*line), message);
        }
        self.take_parts(cl_line, &parts, pose, rate);
        true
    }

    fn take_parts(&mut self, cl_line: u32, parts: &Parts, pose: &Pose, rate: Option<Rate>) {
        let from = self.begins();
        for part in &parts.blocks {
            self.check_rate(cl_line, self.at, part, rate);
            self.look_between(cl_line, part, |_| Asked::line(from, *pose));
            self.take(cl_line, part);
        }
        if let Some(last) = parts.blocks.last() {
            self.measure(last, pose);
        }
        self.next += parts.blocks.len();
    }

    /// The lines from here on to a pose, when the tip goes along its line steadily: from where the
    /// CL file begins it, or from where the tape has the tool, which rounding moves. A post
    /// begins there where it has no other point, as behind TRANS or FROM.
    fn parts_to(&self, pose: &Pose) -> Option<Parts> {
        if !self.is_known(&self.known) {
            return None;
        }
        let parts = self.parts_from(self.begins(), pose);
        if parts.as_ref().is_none_or(|parts| parts.faults.is_empty()) {
            return parts;
        }
        let of_tape = self.parts_from(self.settings.forward.pose(&self.at), pose);
        of_tape.filter(|parts| parts.faults.is_empty()).or(parts)
    }

    /// The same from a pose.
    fn parts_from(&self, from: Pose, pose: &Pose) -> Option<Parts> {
        let line = Way::line(from.tip, pose.tip);
        let length = (pose.tip - from.tip).norm();
        let mut parts = Parts { blocks: Vec::new(), faults: Vec::new() };
        let mut reached = 0.0;
        loop {
            let Some(Event::Move(found)) = self.nc.get(self.next + parts.blocks.len()) else {
                return None;
            };
            if parts.blocks.len() == MOST_PARTS || !is_line(&found, Course::Feed) {
                return None;
            }
            parts.blocks.push(found);
            let tip = self.settings.forward.pose(&found.to).tip;
            let slack = self.tip_slack(&found.to);
            if (tip - pose.tip).norm() < NEAR + slack && self.reaches(&found, pose) {
                break;
            }
            let foot = line.foot(tip, 0.0);
            let along = foot.along * length;
            if foot.distance > slack.max(BESIDE * length) || along < reached - slack {
                return None;
            }
            let off = tip - (from.tip + (pose.tip - from.tip) * foot.along);
            if foot.distance > self.rounded_by(&found.to, off) {
                parts.faults.push((found.line, Fault::Tip(foot.distance)));
            }
            reached = along;
        }
        self.check_turning(&from, pose, &mut parts);
        Some(parts)
    }

    /// At each point on the way the tool lies in the plane of turning, or each rotary
    /// axis between where it was and where it ends.
    fn check_turning(&self, from: &Pose, to: &Pose, parts: &mut Parts) {
        let Some((last, on_the_way)) = parts.blocks.split_last() else { return };
        let mut before = self.at;
        for part in on_the_way {
            let at = part.to;
            if !self.is_between(&before, &at, &last.to) && !self.is_in_plane(&before, &at, from, to)
            {
                parts.faults.push((part.line, Fault::Axis));
            }
            before = at;
        }
    }

    /// How far rounding of each axis on the tape can move the tip in a direction, mm.
    fn rounded_by(&self, at: &Position, direction: Vector3<f64>) -> f64 {
        let forward = &self.settings.forward;
        let Some(direction) = direction.try_normalize(f64::MIN_POSITIVE) else { return 0.0 };
        let turn = forward.frame_of(at).turn;
        let linear = (0..3).map(|n| turn.column(n).dot(&direction).abs() * self.slack.linear[n]);
        let rotary = (0..2).map(|n| {
            let turned = |by: f64| {
                let mut at = *at;
                at.rotary[n] += by;
                forward.pose(&at).tip
            };
            let slack = self.slack.rotary[n];
            (turned(slack) - turned(-slack)).dot(&direction).abs() * 0.5
        });
        linear.chain(rotary).sum()
    }

    fn is_between(&self, before: &Position, at: &Position, end: &Position) -> bool {
        (0..2).all(|n| {
            let slack = 2.0 * self.slack.rotary[n];
            let low = before.rotary[n].min(end.rotary[n]) - slack;
            let high = before.rotary[n].max(end.rotary[n]) + slack;
            (low..=high).contains(&at.rotary[n])
        })
    }

    /// The tool lies in the plane of turning, and nearer to its end than before.
    fn is_in_plane(&self, before: &Position, at: &Position, from: &Pose, to: &Pose) -> bool {
        let [before, axis] = [before, at].map(|at| self.settings.forward.axis(at.rotary));
        let slack = 2.0 * self.axis_slack();
        let plane = Way::turn(from.axis, to.axis, axis);
        plane.foot(axis.into(), 0.5).distance <= slack
            && axis.angle(&to.axis) <= before.angle(&to.axis) + slack
    }
}
