//! A straight line of the CL file that a program makes in several blocks, as a post
//! does to keep the tip near its line while the machine turns.

use nalgebra::Vector3;

use super::ahead::Steps;
use super::between::Asked;
use super::between::way::Way;
use super::division::{Division, End, Turning};
use super::lines::is_line;
use super::report::FindingKind;
use super::say::short;
use super::verifier::Verifier;
use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Position, Rate};

/// Most blocks of one line.
const MOST_PARTS: usize = 1_000;

/// Only a point so near to the end of a line is looked at more closely, mm.
const NEAR: f64 = 1.0;

/// A point so far off a line, in parts of its length, belongs to another motion.
const BESIDE: f64 = 0.1;

/// A tool this near to a direction, as the distance of the tips, lies along it.
const EXACT: f64 = 1e-9;

/// A place known so well is known exactly, mm.
const NEGLIGIBLE: f64 = 1e-5;

/// Degrees.
const HALF_TURN: f64 = 180.0;

/// What is wrong with a point on the way.
enum Fault {
    /// The tip is so far off the line, mm.
    Tip(f64),
    /// The tool does not lie between the directions of the ends.
    Axis,
    /// The tip is so far from where it is on its line when the machine has turned so far, mm.
    Step(f64),
    /// The tip goes back.
    Back,
}

/// Where a line that is divided begins.
#[derive(Clone, Copy)]
enum Begin {
    /// Where the CL file has the tool, known so well, mm.
    OfPath(f64),
    /// Where the tape has it.
    OfTape,
    /// Near where the tape has it: the exact place is not known.
    Rounded,
}

/// Blocks that lead to the end of a line.
struct Parts {
    blocks: Vec<Move>,
    /// What is wrong with their ends.
    faults: Vec<(u32, Fault)>,
}

impl<C: Steps> Verifier<'_, C> {
    /// Takes the blocks that make a line, when all of them end on it.
    pub(super) fn parts(&mut self, cl_line: u32, pose: &Pose, rate: Option<Rate>) -> bool {
        self.parts_of(cl_line, (pose, 0.0), rate)
    }

    /// The same to a pose that may be off by so much, mm.
    pub(super) fn parts_of(
        &mut self,
        cl_line: u32,
        (pose, rough): (&Pose, f64),
        rate: Option<Rate>,
    ) -> bool {
        match self.parts_to(pose, rough) {
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
        let Some(parts) = self.parts_to(pose, 0.0) else { return false };
        for (line, fault) in &parts.faults {
            let (kind, message) = match fault {
                Fault::Tip(off) => (
                    FindingKind::Position,
                    format!("during the move the tip is {} off its line", short(*off)),
                ),
                Fault::Axis => (
                    FindingKind::Axis,
                    "during the move the tool axis is not between its end positions".to_string(),
                ),
                Fault::Step(off) => (
                    FindingKind::Position,
                    format!(
                        "during the move the tip is {} from its position on the machine",
                        short(*off)
                    ),
                ),
                Fault::Back => {
                    (FindingKind::Position, "during the move the tip goes back".to_string())
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
    fn parts_to(&self, pose: &Pose, rough: f64) -> Option<Parts> {
        if !self.is_known(&self.known) {
            return None;
        }
        let (from, begin) = self.begin_of_parts();
        let parts = self.parts_from(from, begin, (pose, rough));
        if parts.as_ref().is_none_or(|parts| parts.faults.is_empty()) {
            return parts;
        }
        let stands = self.settings.forward.pose(&self.at);
        let of_tape = self.parts_from(stands, Begin::OfTape, (pose, rough));
        of_tape.filter(|parts| parts.faults.is_empty()).or(parts)
    }

    /// The same from a pose.
    fn parts_from(&self, from: Pose, begin: Begin, (pose, rough): (&Pose, f64)) -> Option<Parts> {
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
        if parts.faults.is_empty() && parts.blocks.len() > 1 {
            let ends = [self.begin_of_line(from, begin), self.end_of_line(pose, rough, &parts)];
            self.check_steps(ends, &mut parts);
        }
        Some(parts)
    }

    /// Where a line that is divided begins, and how well that is known.
    fn begin_of_parts(&self) -> (Pose, Begin) {
        let from = self.begins();
        let of_path = self.watch.stands_at().filter(|(stands, _)| *stands == from);
        (from, of_path.map_or(Begin::Rounded, |(_, rough)| Begin::OfPath(rough)))
    }

    /// The exact place of a block that ends on a line at which the machine changes its positions,
    /// and how well it is known, mm.
    pub(super) fn place_on_line(&self, found: &Move, pose: &Pose) -> (Pose, f64) {
        let forward = &self.settings.forward;
        let on_tape = (forward.pose(&found.to), self.tip_slack(&found.to));
        let free = forward.refine(found.to.rotary, pose.axis);
        let turns_on = (0..2).all(|n| (free[n] - found.to.rotary[n]).abs() <= HALF_TURN);
        if !turns_on || (forward.axis(free) - pose.axis).norm() > EXACT {
            return on_tape;
        }
        let (from, begin) = self.begin_of_parts();
        let end = End { pose: *pose, rotary: free, rough: 0.0, rough_turn: [0.0; 2] };
        let division = Division { forward, ends: [self.begin_of_line(from, begin), end] };
        let mut slack = self.slack_of_moved(&self.at, &found.to);
        // At its limit an axis stands exactly.
        for n in 0..2 {
            let at = |limit: Option<f64>| {
                limit.is_some_and(|limit| (limit - found.to.rotary[n]).abs() <= slack.rotary[n])
            };
            if forward.rotaries()[n].as_ref().is_some_and(|axis| at(axis.min) || at(axis.max)) {
                slack.rotary[n] = 0.0;
            }
        }
        let Some([low, high]) = division.shares(Turning::Axes, &found.to, &slack) else {
            return on_tape;
        };
        let (place, way) = (division.pose(0.5 * (low + high)), (pose.tip - from.tip).norm());
        if !self.reaches(found, &place) {
            return on_tape;
        }
        let rough = 0.5 * (high - low) * way;
        (place, if rough > NEGLIGIBLE { rough } else { 0.0 })
    }

    /// The begin of a line that is divided.
    fn begin_of_line(&self, pose: Pose, begin: Begin) -> End {
        let kept = |n: usize| {
            let near = (self.exact[n] - self.at.rotary[n]).abs() <= self.slack.rotary[n];
            if near { self.exact[n] } else { self.at.rotary[n] }
        };
        match begin {
            Begin::OfPath(rough) => self.end_at(pose, [0, 1].map(kept), &self.at, rough),
            Begin::OfTape => End { pose, rotary: self.at.rotary, rough: 0.0, rough_turn: [0.0; 2] },
            Begin::Rounded => self.end_at(pose, self.at.rotary, &self.at, self.tip_slack(&self.at)),
        }
    }

    /// The end of one.
    fn end_of_line(&self, pose: &Pose, rough: f64, parts: &Parts) -> End {
        let at = parts.blocks.last().map_or(self.at, |last| last.to);
        self.end_at(*pose, self.gap(&at, pose).rotary, &at, rough)
    }

    /// An end of a line, where the tape has the axes at a position, and the rotary ones exactly
    /// near `rotary`, as far as the direction of the tool says it.
    fn end_at(&self, pose: Pose, rotary: [f64; 2], at: &Position, rough: f64) -> End {
        let forward = &self.settings.forward;
        let exact = forward.refine(rotary, pose.axis);
        let near = (0..2).all(|n| (exact[n] - at.rotary[n]).abs() <= self.slack.rotary[n]);
        let is_exact = near && (forward.axis(exact) - pose.axis).norm() < EXACT && rough == 0.0;
        match is_exact {
            true => End { pose, rotary: exact, rough, rough_turn: [0.0; 2] },
            false => End { pose, rotary: at.rotary, rough, rough_turn: self.slack.rotary },
        }
    }

    /// At each point on the way the tip is where the line has it when the machine has turned so
    /// far, and goes on.
    fn check_steps(&self, ends: [End; 2], parts: &mut Parts) {
        let forward = &self.settings.forward;
        let Some((last, on_the_way)) = parts.blocks.split_last() else { return };
        // In the plane of X and C the turn follows from the way; a direction that is written as a
        // vector says no turn of the axes.
        let written_as_vectors = self.settings.direction_rounding().is_some();
        if self.settings.is_mill_turn() || written_as_vectors && self.at.tip_control {
            return;
        }
        let turnings = if forward.has_rotary() { &Turning::ALL[..] } else { &Turning::ALL[..1] };
        let of_tape = [ends[0].on_tape(forward, &self.at), ends[1].on_tape(forward, &last.to)];
        let divisions = [ends, of_tape].map(|ends| Division { forward, ends });
        let ways =
            divisions.iter().flat_map(|division| turnings.iter().map(move |way| (division, *way)));
        let mut fewest = None;
        for (division, turning) in ways {
            let faults = self.steps(division, turning, on_the_way);
            if faults.is_empty() {
                return;
            }
            if fewest.as_ref().is_none_or(|fewest: &Vec<_>| faults.len() < fewest.len()) {
                fewest = Some(faults);
            }
        }
        parts.faults.extend(fewest.unwrap_or_default());
    }

    /// What is wrong with the points on the way where the machine turns so.
    fn steps(
        &self,
        division: &Division,
        turning: Turning,
        on_the_way: &[Move],
    ) -> Vec<(u32, Fault)> {
        let (mut faults, mut before, mut reached) = (Vec::new(), self.at, 0.0);
        for part in on_the_way {
            let slack = self.slack_of_moved(&before, &part.to);
            before = part.to;
            match division.shares(turning, &part.to, &slack) {
                None => faults.push((part.line, Fault::Step(division.off(&part.to)))),
                Some([_, high]) if high < reached => faults.push((part.line, Fault::Back)),
                Some([low, _]) => reached = low,
            }
        }
        faults
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
