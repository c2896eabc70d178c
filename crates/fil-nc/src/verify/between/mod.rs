//! The path between the ends of a motion that turns the machine.
//!
//! A block moves all axes evenly. When a rotary axis is among them, the tip leaves the
//! line that the CL file asks for, and the tool the plane in which it should turn.

mod farthest;
#[cfg(test)]
mod tests;
pub(crate) mod way;

use fil_diag::Diag;
use fil_machine::Commons;
use nalgebra::{Point3, Vector3};

use super::ahead::Steps;
use super::expected_step::Arc;
use super::report::{Finding, FindingKind, Report};
use super::say::short;
use super::verifier::{Fact, STILL, Verifier};
use crate::bend;
use crate::forward::{Forward, Pose};
use crate::motion::{Course, Move, Position};
use farthest::farthest;
use way::Way;

/// How exact the distance of the tip is, mm.
const EXACT_TIP: f64 = 1e-5;

/// What rounding of positions adds to angles, degrees.
const ROUNDED: f64 = 0.01;

/// How exact the angle of the tool is, as the distance of the tips of unit vectors:
/// 0.001 degrees.
const EXACT_AXIS: f64 = 1.7e-5;

/// The largest of a kind of deviation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// How large it is, mm or degrees.
    pub max: f64,
    /// Line of the NC program where it is.
    pub nc_line: u32,
}

/// How far the path is from what is asked for between the ends of feed motions in
/// which a rotary axis moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Between {
    /// Distance of the tip from its line or arc, mm; exact to 0.00001 mm.
    pub position: Peak,
    /// Angle between the tool and the plane in which it should turn, degrees; exact
    /// to 0.001 degrees.
    pub axis: Peak,
}

/// What the tip may leave its line by, and where the CL file has the tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch {
    /// Allowed distance, mm; `None` when it is only said.
    limit: Option<f64>,
    /// The limit is that of the user, whatever the CL file says.
    given: bool,
    /// The limit of a motion that begins elsewhere where blocks before it are left out: what
    /// turns the machine in them must not turn it in the motion.
    elsewhere: Option<f64>,
    /// Where the last motion of the CL file ended, when the program made it.
    stands: Option<Pose>,
    /// How far from there the post may have seen it, mm.
    rough: f64,
}

/// What a motion between two poses should go along.
pub(super) struct Asked {
    way: Way,
    ends: [Pose; 2],
}

impl Watch {
    pub(super) fn new(limit: Option<f64>) -> Self {
        Watch { limit, given: limit.is_some(), elsewhere: None, stands: None, rough: 0.0 }
    }

    /// LINTOL of the CL file.
    pub(super) fn ask(&mut self, limit: Option<f64>) {
        if !self.given {
            self.limit = limit;
        }
    }

    /// Blocks were left out, and the next motion begins where the tool stood before them.
    pub(super) fn begin_elsewhere(&mut self, limit: Option<f64>) {
        self.elsewhere = limit;
    }

    /// A motion of the CL file was made, and the tool stands at its end.
    pub(super) fn stand(&mut self, pose: Option<Pose>) {
        self.stand_within(pose, 0.0);
    }

    /// The same at a place that is known so well, mm.
    pub(super) fn stand_within(&mut self, pose: Option<Pose>, rough: f64) {
        (self.stands, self.rough) = (pose, rough);
        self.elsewhere = None;
    }

    /// Where the CL file has the tool, and how well that is known, mm.
    pub(super) fn stands_at(&self) -> Option<(Pose, f64)> {
        self.stands.map(|pose| (pose, self.rough))
    }

    /// Allowed distance of the motion at hand, mm.
    fn limit(&self) -> Option<f64> {
        self.limit.or(self.elsewhere)
    }
}

impl Asked {
    pub(super) fn line(from: Pose, to: Pose) -> Self {
        Asked { way: Way::line(from.tip, to.tip), ends: [from, to] }
    }

    /// A part (degrees) of an arc that begins with the tool as it is in `from`.
    pub(super) fn arc(arc: &Arc, from: Pose, part: [f64; 2]) -> Self {
        Asked { way: Way::arc(arc, part), ends: [from, arc.end] }
    }
}

impl Peak {
    fn add(&mut self, value: f64, nc_line: u32) {
        if self.nc_line == 0 || value > self.max {
            *self = Peak { max: value, nc_line };
        }
    }
}

impl Between {
    /// Takes in a motion from `at` and gives the distance of its tip and the angle of the
    /// tool, which are exact when they are more than the largest before or more than their
    /// limits.
    fn add(
        &mut self,
        forward: &Forward,
        at: &Position,
        found: &Move,
        asked: &Asked,
        limits: [Option<f64>; 2],
    ) -> [f64; 2] {
        let enough = |limit: Option<f64>, max: f64| limit.map_or(max, |limit| limit.min(max));
        let of_tip = enough(limits[0], self.position.max);
        let off = tip_off(forward, at, found, &asked.way, of_tip);
        self.position.add(off, found.line);
        let of_tool = enough(limits[1], self.axis.max);
        let leans = axis_off(forward, at, found, &asked.ends, of_tool);
        self.axis.add(leans, found.line);
        [off, leans]
    }
}

/// Largest distance of the tip from its way, mm, when it is more than `enough`.
fn tip_off(forward: &Forward, at: &Position, found: &Move, way: &Way, enough: f64) -> f64 {
    let arc = found.arc.as_ref();
    let tip = |share| forward.pose(&forward.along(at, &found.to, arc, share)).tip;
    farthest(tip, way, bend::of_tip(forward, at, &found.to, arc), enough, EXACT_TIP)
}

/// Largest angle between the tool and the way it should turn from one pose to the
/// other, degrees, when it is more than `enough`.
fn axis_off(
    forward: &Forward,
    at: &Position,
    found: &Move,
    [from, to]: &[Pose; 2],
    enough: f64,
) -> f64 {
    let axis = |share| forward.axis(forward.along(at, &found.to, None, share).rotary);
    let way = Way::turn(from.axis, to.axis, axis(0.5));
    let curve = |share| Point3::from(axis(share));
    let chord = 2.0 * libm::sin(enough.to_radians() / 2.0);
    let off = farthest(curve, &way, bend::of_axis(forward, at, &found.to), chord, EXACT_AXIS);
    2.0 * libm::asin((off / 2.0).min(1.0)).to_degrees()
}

/// True when a rotary axis moves.
fn turns(forward: &Forward, at: &Position, to: &Position) -> bool {
    let moves = |n: usize| (at.rotary[n] - to.rotary[n]).abs() > STILL;
    (0..2).any(|n| forward.rotaries()[n].is_some() && moves(n))
}

/// Looks at the blocks of a program by themselves, where no CL file says what they
/// should go along: in each the tip should go straight from end to end.
pub(super) struct Blocks {
    forward: Forward,
    /// How far the tip may be off, mm.
    limit: Option<f64>,
    before: Option<Move>,
    /// What was found.
    pub(super) report: Report,
}

impl Blocks {
    /// # Errors
    /// A machine whose kinematics make no sense.
    pub(super) fn new(commons: &Commons, limit: Option<f64>) -> Result<Self, Box<Diag>> {
        let forward = Forward::from_commons(commons)?;
        Ok(Blocks { forward, limit, before: None, report: Report::default() })
    }

    /// Takes in the next motion.
    pub(super) fn look(&mut self, found: &Move) {
        let Some(last) = self.before.replace(*found) else { return };
        let forward = &self.forward;
        let cuts = matches!(found.course, Course::Feed | Course::Thread) && found.arc.is_none();
        if !cuts || found.known != last.known || !turns(forward, &last.to, &found.to) {
            return;
        }
        let asked = Asked::line(forward.pose(&last.to), forward.pose(&found.to));
        let between = self.report.between.get_or_insert_default();
        let [off, _] = between.add(forward, &last.to, found, &asked, [self.limit, None]);
        if let Some(limit) = self.limit.filter(|limit| off > *limit) {
            let message = said(off, limit);
            let (kind, nc_line) = (FindingKind::Between, Some(found.line));
            self.report.find(Finding { kind, cl_line: None, nc_line, message });
        }
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// Where the next motion of the CL file begins: at the end of the one before, when
    /// the tool stands there.
    pub(super) fn begins(&self) -> Pose {
        let at = self.settings.forward.pose(&self.at);
        let near = |pose: &Pose| {
            (pose.tip - at.tip).norm() <= self.tip_slack(&self.at)
                && pose.axis.angle(&at.axis) <= self.axis_slack()
        };
        self.watch.stands.filter(near).unwrap_or(at)
    }

    /// How far rounding on the tape can bring the tip from a point, mm.
    pub(super) fn tip_slack(&self, at: &Position) -> f64 {
        let forward = &self.settings.forward;
        let lever = if at.names_tip() { 0.0 } else { forward.lever(forward.pose(at).tip) };
        Vector3::from(self.slack.linear).norm() + self.axis_slack() * lever
    }

    /// How far rounding on the tape can turn the tool, radians.
    pub(super) fn axis_slack(&self) -> f64 {
        let rotary = self.slack.rotary.iter().sum::<f64>();
        rotary.to_radians()
    }

    /// Looks how far a motion from where the axes stand leaves what is asked for.
    pub(super) fn look_between(
        &mut self,
        cl_line: u32,
        found: &Move,
        asked: impl FnOnce(&Self) -> Asked,
    ) {
        // A tool change may have moved the axes, and another work offset lies elsewhere: the way
        // from there is none of the CL file.
        let known = self.is_known(&self.known) && self.is_known(&found.known);
        let begins_anywhere = self.facts.has(Fact::FreshTool)
            || found.modes.frame.fixture != self.moved.modes.frame.fixture;
        if !known || begins_anywhere || !turns(&self.settings.forward, &self.at, &found.to) {
            return;
        }
        let asked = asked(self);
        let leans_most = self.leans_most(&found.to);
        let between = self.report.between.get_or_insert_default();
        let live = self.settings.is_mill_turn();
        let of_tool = live.then(|| self.settings.forward.with_tool_for(asked.ends[1].axis));
        let forward = of_tool.as_ref().unwrap_or(&self.settings.forward);
        let limits = [self.watch.limit(), leans_most];
        let [off, leans] = between.add(forward, &self.at, found, &asked, limits);
        if let Some(limit) = limits[0].filter(|limit| off > *limit) {
            let message = said(off, limit);
            self.find(FindingKind::Between, Some(cl_line), Some(found.line), message);
        }
        if let Some(most) = leans_most.filter(|most| leans > *most) {
            let message = leaning(leans, most);
            self.find(FindingKind::Between, Some(cl_line), Some(found.line), message);
        }
    }

    /// Along an arc the tool turns evenly from its first direction to its last: at a share of it
    /// by that share of the angle, or of the line between both.
    pub(super) fn check_turn_on_arc(
        &mut self,
        cl_line: u32,
        found: &Move,
        [from, to]: [Vector3<f64>; 2],
        share: f64,
    ) {
        let whole = from.angle(&to);
        if self.settings.is_mill_turn() || whole <= self.axis_slack() || share >= 1.0 {
            return;
        }
        let tip = self.settings.forward.pose(&found.to).tip;
        let stands = |axis| self.gap(&found.to, &Pose { tip, axis }).turned.is_none();
        if stands(from.lerp(&to, share).normalize()) || stands(from.slerp(&to, share)) {
            return;
        }
        let turned = from.angle(&self.settings.forward.pose(&found.to).axis);
        let [turned, even] = [turned, whole * share].map(|angle| short(angle.to_degrees()));
        let message = format!("the tool has turned {turned} degrees on its arc, {even} were even");
        self.find(FindingKind::Between, Some(cl_line), Some(found.line), message);
    }

    /// How far the tool may lean out of the plane of its ends on the way to a position,
    /// degrees; `None` where it is only said: with one rotary axis that has no other way
    /// round, and on a mill-turn machine.
    fn leans_most(&self, to: &Position) -> Option<f64> {
        let most = self.settings.leans_most().filter(|_| !self.settings.is_mill_turn())?;
        let turn = |n: usize| (to.rotary[n] - self.at.rotary[n]).abs();
        let has_two = self.settings.forward.rotaries().iter().all(Option::is_some);
        let goes_round = (0..2).any(|n| turn(n) > 180.0 + ROUNDED);
        (has_two || goes_round).then(|| most + ROUNDED + self.axis_slack().to_degrees())
    }
}

fn leaning(leans: f64, most: f64) -> String {
    let (leans, most) = (short(leans), short(most));
    format!(
        "the tool tilts {leans} degrees out of the plane of its end positions, {most} are allowed"
    )
}

fn said(off: f64, limit: f64) -> String {
    let (off, limit) = (short(off), short(limit));
    format!("the tip leaves its line by {off} during the move, {limit} is allowed")
}
