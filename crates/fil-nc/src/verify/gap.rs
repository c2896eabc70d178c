//! How far the axes stand from where a pose asks them to be.

use super::settings::{Settings, Slack};
use crate::forward::Pose;
use crate::motion::Position;

/// A tool axis this near (radians) to the one asked for is reached by the angles found.
const SOLVED: f64 = 2e-5;

/// Difference of axes in degrees that no CL file writes for sure.
const AXIS_DUST: f64 = 1e-3;

/// The difference between where the axes stand and where they should.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// Of X, Y, Z in the machine, mm; above 0 when it stands too far in plus.
    pub(super) linear: [f64; 3],
    /// What of it is more than the last digits explain.
    pub(super) excess: [bool; 3],
    /// Angle between the tool axes, degrees, where the last digits don't explain it.
    pub(super) turned: Option<f64>,
    /// Distance of the tips in the part, mm.
    pub(super) tip: f64,
    /// Angle between the tool axes, degrees.
    pub(super) axis: f64,
}

impl Gap {
    /// The gap of a position.
    pub(super) fn of(settings: &Settings, slack: &Slack, at: &Position, pose: &Pose) -> Gap {
        let forward = &settings.forward;
        let stands = forward.pose(at);
        let axis = stands.axis.angle(&pose.axis).to_degrees();
        let mut gap = Gap {
            linear: [0.0; 3],
            excess: [false; 3],
            turned: None,
            tip: (stands.tip - pose.tip).norm(),
            axis,
        };
        let mut allowed = slack.linear;
        let mut rotary = at.rotary;
        if forward.has_rotary() {
            let exact = forward.refine(at.rotary, pose.axis);
            let solved = (forward.axis(exact) - pose.axis).norm() < SOLVED;
            let near = [0, 1].iter().all(|n| (exact[*n] - at.rotary[*n]).abs() <= slack.rotary[*n]);
            if solved && near {
                rotary = exact;
                widen(settings, slack, rotary, pose, &mut allowed);
            } else {
                gap.turned = Some(axis);
            }
        } else if axis > AXIS_DUST {
            gap.turned = Some(axis);
        }
        let wanted = forward.frame(rotary).linear(pose.tip);
        for n in 0..3 {
            gap.linear[n] = at.linear[n] - wanted[n];
            gap.excess[n] = gap.linear[n].abs() > allowed[n];
        }
        gap
    }

    /// True when the pose is reached.
    pub(super) fn closed(&self) -> bool {
        self.turned.is_none() && self.excess == [false; 3]
    }
}

/// An axis that does not turn the tool may stand anywhere within its last digit; X Y Z
/// then follow an angle that the tape does not show.
fn widen(settings: &Settings, slack: &Slack, at: [f64; 2], pose: &Pose, allowed: &mut [f64; 3]) {
    let here = settings.forward.frame(at).linear(pose.tip);
    for index in 0..2 {
        if settings.forward.rotaries()[index].is_none() || settings.forward.turns_tool(at, index) {
            continue;
        }
        let mut beside = at;
        beside[index] += slack.rotary[index];
        let there = settings.forward.frame(beside).linear(pose.tip);
        for n in 0..3 {
            allowed[n] += (there[n] - here[n]).abs();
        }
    }
}
