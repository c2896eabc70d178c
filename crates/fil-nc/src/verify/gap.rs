//! How far the axes stand from where a pose asks them to be.

use nalgebra::Point3;

use super::settings::{Settings, Tolerances};
use super::verifier::STILL;
use crate::forward::Pose;
use crate::motion::Position;

/// A tool axis this near (radians) to the one asked for is reached: a post need not
/// turn the machine for less, as CL files round the axis.
pub(super) const REACHED: f64 = 1.1e-5;

/// Turn of a rotary axis, at most, for a lean of the tool: more than 2 where the
/// axes lie at 45 degrees to each other, once for each way to lean.
const LEAN: f64 = 3.0;

/// A tilted frame this near (radians) to the tool axis asked for is the one asked for: its
/// angles stand on the tape rounded, three of them to half a thousandth of a degree.
const FRAMED: f64 = 3e-5;

/// The difference between where the axes stand and where they should.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// Of X, Y, Z in the machine, mm; above 0 when it stands too far in plus.
    pub(super) linear: [f64; 3],
    /// What of it is more than the last digits explain.
    pub(super) excess: [bool; 3],
    /// Angle between the tool axes, degrees, where the last digits don't explain it.
    pub(super) turned: Option<f64>,
    /// Rotary positions for which X, Y, Z were compared, degrees.
    pub(super) rotary: [f64; 2],
    /// Distance of the tips in the part, mm.
    pub(super) tip: f64,
    /// Angle between the tool axes, degrees.
    pub(super) axis: f64,
}

impl Gap {
    /// The gap of a position. `last` are the exact rotary positions of the motion before:
    /// an axis that does not turn the tool stays at the exact position, of which the
    /// tape shows only the rounded one.
    pub(super) fn of(
        settings: &Settings,
        slack: &Tolerances,
        at: &Position,
        pose: &Pose,
        last: [f64; 2],
    ) -> Gap {
        if settings.is_mill_turn() {
            return Gap::of_live_tool(settings, slack, at, pose);
        }
        let forward = &settings.forward;
        if !forward.has_rotary() && !at.names_tip() && pose.axis == forward.tool() {
            return Gap::upright(slack, at, pose);
        }
        let widened = forward.has_rotary().then(|| beside_the_pole(settings, slack, at, pose));
        let slack = widened.as_ref().unwrap_or(slack);
        let stays = |n: usize| (last[n] - at.rotary[n]).abs() <= slack.rotary[n];
        let kept = [0, 1].map(|n| if stays(n) { last[n] } else { at.rotary[n] });
        let gap = Gap::at(settings, slack, at, pose, forward.refine(kept, pose.axis));
        if gap.closed() || !forward.has_rotary() {
            return gap;
        }
        // A post need not turn for a difference that small.
        let unturned = Gap::at(settings, slack, at, pose, last);
        if unturned.closed() {
            return unturned;
        }
        // An axis that turned the tool before may have come to rest on its rounded position.
        let said = Gap::at(settings, slack, at, pose, forward.refine(at.rotary, pose.axis));
        let nearer = said.turned.is_none() && said.off() < gap.off() - STILL;
        if said.closed() || nearer { said } else { gap }
    }

    /// Sum of what X, Y and Z are off by, mm.
    fn off(&self) -> f64 {
        self.linear.iter().map(|off| off.abs()).sum()
    }

    /// The gap of a machine of three axes along its tool: X, Y, Z are the tip.
    fn upright(slack: &Tolerances, at: &Position, pose: &Pose) -> Gap {
        let (mut linear, mut excess) = ([0.0; 3], [false; 3]);
        for n in 0..3 {
            let wanted = pose.tip[n];
            linear[n] = at.linear[n] - slack.before_scale(n, wanted);
            excess[n] = linear[n].abs() > slack.linear[n];
        }
        let tip = (Point3::from(at.linear) - pose.tip).norm();
        Gap { linear, excess, turned: None, rotary: at.rotary, tip, axis: 0.0 }
    }

    /// The gap of a tool of a mill-turn machine: C stands where the tape has it, and X, Y and
    /// Z are compared there. What rounding of C leaves across the tool no axis can make good
    /// where the machine has no Y.
    fn of_live_tool(settings: &Settings, slack: &Tolerances, at: &Position, pose: &Pose) -> Gap {
        let forward = settings.forward.with_tool_for(pose.axis);
        let stands = forward.pose(at);
        let radius = libm::hypot(pose.tip.x, pose.tip.y);
        let axis = stands.axis.angle(&pose.axis);
        let (mut slack, mut half_digit) = (*slack, slack.rotary[0].to_radians());
        if at.transformed && radius > 0.0 {
            // TRACYL rounds the way around the cylinder, and no angle.
            half_digit = slack.linear[1] / radius;
            slack.linear[1] += REACHED * radius;
        } else if !at.transformed {
            slack.linear[0] = slack.outside_transformations;
        }
        if !at.transformed && !settings.written()[1] {
            slack.linear[1] += half_digit * radius;
        }
        let mut gap = Gap {
            linear: [0.0; 3],
            excess: [false; 3],
            turned: (axis > half_digit + REACHED).then_some(axis.to_degrees()),
            rotary: at.rotary,
            tip: (stands.tip - pose.tip).norm(),
            axis: axis.to_degrees(),
        };
        gap.compare(settings, &slack, at, pose);
        gap
    }

    /// The gap when these are the exact rotary positions.
    fn at(
        settings: &Settings,
        slack: &Tolerances,
        at: &Position,
        pose: &Pose,
        exact: [f64; 2],
    ) -> Gap {
        let forward = &settings.forward;
        let stands = forward.pose(at);
        let same = stands.axis == pose.axis && exact == at.rotary;
        let axis = if same { 0.0 } else { stands.axis.angle(&pose.axis).to_degrees() };
        let near = |n: usize| (exact[n] - at.rotary[n]).abs() <= slack.rotary[n];
        let reached = same || (forward.axis(exact) - pose.axis).norm() < REACHED;
        let solved = reached && near(0) && near(1);
        let within = |most: f64| (stands.axis - pose.axis).norm() < most;
        let framed = at.tilt.is_some() && within(FRAMED);
        let directed = at.tip_control && settings.direction_rounding().is_some_and(within);
        let mut gap = Gap {
            linear: [0.0; 3],
            excess: [false; 3],
            turned: (!solved && !framed && !directed).then_some(axis),
            // A vector near a pole is rounded by more than the last digits of an angle.
            rotary: if solved || directed && reached { exact } else { at.rotary },
            tip: (stands.tip - pose.tip).norm(),
            axis,
        };
        gap.compare(settings, slack, at, pose);
        gap
    }

    /// Compares X, Y, Z with where they should be at the rotary positions found.
    fn compare(&mut self, settings: &Settings, slack: &Tolerances, at: &Position, pose: &Pose) {
        let exact = Position { rotary: self.rotary, ..*at };
        let wanted = settings.forward.frame_of(&exact).linear(pose.tip);
        for (n, wanted) in wanted.into_iter().enumerate() {
            self.linear[n] = at.linear[n] - slack.before_scale(n, wanted);
            self.excess[n] = self.linear[n].abs() > slack.linear[n];
        }
    }

    /// True when the pose is reached.
    pub(super) fn closed(&self) -> bool {
        self.turned.is_none() && self.excess == [false; 3]
    }
}

/// A tool axis that all but lies along the primary rotary axis leaves open which way it
/// leans: the angle it leans by widens what is allowed, of X, Y, Z where they follow it.
fn beside_the_pole(
    settings: &Settings,
    slack: &Tolerances,
    at: &Position,
    pose: &Pose,
) -> Tolerances {
    let mut slack = *slack;
    let Some(primary) = &settings.forward.rotaries()[0] else { return slack };
    let lean = primary.direction.cross(&pose.axis).norm();
    if lean >= REACHED {
        return slack;
    }
    let lever = if at.names_tip() { 0.0 } else { settings.forward.lever(pose.tip) };
    for n in 0..3 {
        slack.linear[n] += LEAN * lean * lever;
    }
    for n in 0..2 {
        slack.rotary[n] += LEAN * lean.to_degrees();
    }
    slack
}
