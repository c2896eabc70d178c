//! Rapids of a machine whose tool lies along another direction than Z: up is along the tool.

use nalgebra::Vector3;

use fil_machine::axis_chain::Carries;

use super::ahead::Steps;
use super::report::FindingKind;
use super::verifier::{Fact, STILL, Verifier};
use crate::motion::{Course, Move, Position};

/// Directions are one where the cosine between them is less than this below 1.
const PARALLEL: f64 = 1e-8;

/// Tools nearer to an axis than this may go along themselves, or as those along it: the post
/// knows more digits than the tape.
const NEARLY: f64 = 1e-6;

/// So many of the last digits of an axis are no way across the tool.
const DIGITS: f64 = 4.0;

/// The least share of Z in a way along the tool that leads up to a level of Z.
const LEAST_RISE: f64 = 0.1;

/// How the tool lies in the directions of X, Y and Z in a part of a rapid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lie {
    /// Along one of them, up where it counts up (1), or down (-1).
    Along { axis: usize, up: f64 },
    /// Along none, or along another one at the end.
    Leaning,
}

/// Where a rapid comes from and leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leg {
    /// From point to point of the CL file.
    OfPath,
    /// From a tool change, where the tool is away from the part.
    FromAfar,
    /// To a position of the machine.
    ToMachine,
}

/// The tool along Z.
pub(super) const UPRIGHT: Lie = Lie::Along { axis: 2, up: 1.0 };

impl<C: Steps> Verifier<'_, C> {
    /// How the tool lies where a rapid begins that has this part, and where it ends.
    pub(super) fn lie(&self, part: &Move, end: &Position, leg: Leg) -> Lie {
        let is_along_z = part.to.names_tip() || end.names_tip() || self.settings.is_mill_turn();
        if is_along_z || self.head_is_anywhere() {
            return UPRIGHT;
        }
        match self.axis_of_tool(end, PARALLEL) {
            Some((axis, up)) => Lie::Along { axis, up },
            // Up along the tool before tool-tip control has ended it is away.
            None if leg == Leg::ToMachine && self.facts.has(Fact::Up) => UPRIGHT,
            None if leg == Leg::FromAfar || self.known[..3] != [true; 3] => UPRIGHT,
            None => Lie::Leaning,
        }
    }

    /// A rapid along a tool that a head leans goes by several axes at once, and this control drives
    /// each of them at its own speed.
    pub(super) fn check_bend(&mut self, cl_line: u32, found: &Move) {
        if found.course != Course::Rapid || !self.settings.bends_rapids() {
            return;
        }
        let leans = [self.at.rotary, found.to.rotary].iter().any(|rotary| {
            self.tool_on_axes(*rotary).iter().all(|part| part.abs() < 1.0 - PARALLEL)
        });
        let moves = |n: usize| {
            found.known[n]
                && !(self.known[n] && (found.to.linear[n] - self.at.linear[n]).abs() <= STILL)
        };
        let count = (0..3).filter(|n| moves(*n)).count();
        let by_several = match found.to.names_tip() {
            true => count > 0,
            false => count > 1 && moves(2),
        };
        if leans && by_several {
            let message = "rapid of several axes with a tilted head: each moves at its own speed, and the tool leaves its line";
            self.find(FindingKind::Order, Some(cl_line), Some(found.line), message.to_string());
        }
    }

    /// The tool lies along one axis all the way, to a share of a degree.
    pub(super) fn lies_nearly_along(&self, end: &Position) -> Option<Lie> {
        self.axis_of_tool(end, NEARLY).map(|(axis, up)| Lie::Along { axis, up })
    }

    /// The axis along which the tool lies both where it stands and at an end, and its sign.
    fn axis_of_tool(&self, end: &Position, slack: f64) -> Option<(usize, f64)> {
        let [begins, ends] = [self.at.rotary, end.rotary].map(|rotary| {
            let tool = self.tool_on_axes(rotary);
            (0..3).find(|n| tool[*n].abs() > 1.0 - slack).map(|axis| (axis, tool[axis].signum()))
        });
        ends.filter(|_| begins == ends)
    }

    /// Z of a position, in its frame or of the machine, goes along the tool.
    pub(super) fn lies_along_z(&self, position: &Position) -> bool {
        position.tilt.is_some() || self.is_upright(position.rotary)
    }

    /// The tool lies along Z of the machine.
    pub(super) fn is_upright(&self, rotary: [f64; 2]) -> bool {
        self.tool_on_axes(rotary).z > 1.0 - PARALLEL
    }

    /// A head stands nobody knows where.
    fn head_is_anywhere(&self) -> bool {
        let mut rotaries = self.settings.forward.rotaries().iter().zip(&self.known[3..]);
        rotaries.any(|(rotary, known)| {
            !known && rotary.as_ref().is_some_and(|it| it.carries == Carries::Head)
        })
    }

    /// The direction of the tool in those of X, Y and Z.
    pub(super) fn tool_on_axes(&self, rotary: [f64; 2]) -> Vector3<f64> {
        let forward = &self.settings.forward;
        forward.frame(rotary).turn.transpose() * forward.axis(rotary)
    }

    /// True for a part of a rapid that leads up along the tool where it stands, or to a place
    /// from which it leads down along the tool to the end, or to the end; to a position of the
    /// machine also across or down, each axis to its own.
    pub(super) fn leads_along_tool(&self, part: &Move, end: &Position, leg: Leg) -> bool {
        let at = self.settings.forward.restated(&self.at, &part.to);
        let end = self.settings.forward.restated(end, &part.to);
        let slack = self.slack_along(&at, &end);
        let rises = self.lies_above(&part.to, &at, slack);
        let comes_down = self.lies_above(&part.to, &end, slack);
        let lies_between = |n: usize| {
            let near = |a: f64, b: f64| (a - b).abs() <= STILL;
            near(part.to.linear[n], at.linear[n]) || near(part.to.linear[n], end.linear[n])
        };
        let way = Vector3::from(part.to.linear) - Vector3::from(at.linear);
        let by_axes = leg == Leg::ToMachine
            && (0..3).all(lies_between)
            && way.dot(&self.tool_on_axes(at.rotary)) <= slack;
        rises || comes_down || by_axes
    }

    /// True for a part of a rapid straight up along the tool out of its cut, as high as the end
    /// lies, before the machine turns.
    pub(super) fn leads_out_of_cut(&self, part: &Move, end: &Position) -> bool {
        let Some(rise) = self.rise_out_of_cut(&part.to, end) else { return false };
        let at = self.settings.forward.restated(&self.at, &part.to);
        let tool = self.tool_on_axes(at.rotary);
        let slack: f64 = (0..3).map(|n| tool[n].abs() * self.slack.linear[n]).sum();
        let beside = 2.0 * self.slack_along(&at, end);
        rise.abs() <= slack + STILL && self.lies_above(&part.to, &at, beside)
    }

    /// How far the end of a rapid out of a cut that turns the machine lies above a position, along
    /// the tool where it stands, mm; `None` for any other rapid.
    fn rise_out_of_cut(&self, from: &Position, end: &Position) -> Option<f64> {
        let holds_axes = ![&self.at, from, end].iter().any(|at| at.names_tip());
        let is_known = self.is_known(&self.known) && !self.settings.is_mill_turn();
        let turns = self.at.rotary != end.rotary;
        if !(self.facts.has(Fact::InCut) && holds_axes && is_known && turns) {
            return None;
        }
        let forward = &self.settings.forward;
        let tip = self.memory.rapid_to.map_or(forward.pose(end).tip, |pose| pose.tip);
        let way = tip - forward.pose(from).tip;
        Some(way.dot(&forward.axis(self.at.rotary)))
    }

    /// A rapid out of a cut that turns the machine begins otherwise than up along the tool.
    pub(super) fn turns_in_cut(&self, part: &Move, end: &Position) -> bool {
        let Some(rise) = self.rise_out_of_cut(&self.at, end) else { return false };
        // A last digit of the tape may be none of the machine's exact positions.
        let turns = |n: usize| {
            let turn = (end.rotary[n] - self.at.rotary[n]).abs();
            turn > 2.0 * self.slack.rotary[n] + STILL
        };
        let slack = 2.0 * self.slack_along(&self.at, end);
        rise > slack && (0..2).any(turns) && !self.lies_above(&part.to, &self.at, slack)
    }

    /// True for a part of a rapid to a place from which it leads down along a leaning tool to the
    /// end.
    pub(super) fn comes_down_along_tool(&self, part: &Move, end: &Position) -> bool {
        let end = self.settings.forward.restated(end, &part.to);
        let leans = !part.to.names_tip() && self.axis_of_tool(&end, PARALLEL).is_none();
        leans && self.lies_above(&part.to, &end, self.slack_along(&part.to, &end))
    }

    /// A position lies on the tool of another one, above it or there.
    fn lies_above(&self, position: &Position, base: &Position, slack: f64) -> bool {
        let way = Vector3::from(position.linear) - Vector3::from(base.linear);
        let tool = self.tool_on_axes(base.rotary);
        let along = way.dot(&tool);
        let beside = (way - tool * along).norm();
        position.rotary == base.rotary && along >= -slack && beside <= slack
    }

    /// What the last digits of X, Y and Z leave open across a way along the tool between two
    /// positions, and those of the rotary axes, mm.
    pub(super) fn slack_along(&self, from: &Position, to: &Position) -> f64 {
        let way = Vector3::from(to.linear) - Vector3::from(from.linear);
        let reach = way.norm() + self.settings.forward.pivot().unwrap_or(0.0);
        let of_angles = self.slack.rotary.into_iter().fold(0.0, f64::max).to_radians();
        let rounding = self.settings.direction_rounding().unwrap_or(0.0);
        let turn = of_angles.max(rounding);
        // The less the tool leans, the more the last digits of its direction turn a table about Z,
        // and with it where the tip stands.
        let tool = self.tool_on_axes(from.rotary);
        let lean = libm::hypot(tool.x, tool.y).max(PARALLEL);
        let beside = libm::hypot(from.linear[0], from.linear[1]);
        let of_table = rounding / lean * beside;
        DIGITS * self.slack.linear.into_iter().fold(STILL, f64::max) + turn * reach + of_table
    }

    /// The same of a way up to a level of Z, which a small angle makes much longer.
    pub(super) fn slack_raised(&self, from: &Position, to: &Position) -> f64 {
        self.slack_along(from, to) / self.tool_on_axes(from.rotary).z.max(LEAST_RISE)
    }

    /// Where a motion up to a level of Z brings the tool that leans: along itself.
    pub(super) fn raised(&self, stands: &Position, level: Option<f64>) -> Position {
        let tool = self.tool_on_axes(stands.rotary);
        let rise = level.map_or(0.0, |level| level - stands.linear[2]);
        let is_known = self.known[..3] == [true; 3];
        let leans = tool.z < 1.0 - PARALLEL && tool.z >= LEAST_RISE;
        if rise <= 0.0
            || !leans
            || !is_known
            || self.facts.has(Fact::Up)
            || self.settings.is_mill_turn()
        {
            return *stands;
        }
        let linear = Vector3::from(stands.linear) + tool * (rise / tool.z);
        Position { linear: linear.into(), ..*stands }
    }
}
