//! Rotary axes whose positions count from 0 to 360, and settings that this does not go with.

use fil_diag::Diag;

use crate::axes::SCALE;
use crate::axis_chain::{AxisChain, Rotary};
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::locations::{self as loc, ControlFamily, MotionResolutionManual, RotaryOutput};
use crate::mill_turn;

/// True for an axis whose positions count within one turn: one with travel counts on, as its
/// limits do.
pub(crate) fn is_meant(commons: &Commons, rotary: &Rotary) -> bool {
    !rotary.is_limited() && commons.read(loc::ROTARY_OUTPUT) != RotaryOutput::AnyNumberOfTurns
}

/// Contradictions of a machine that counts within a turn.
pub(crate) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    let mut meant = chain.rotaries.iter().flatten().filter(|rotary| is_meant(commons, rotary));
    let mut add = |message: &str| found.push(Diag::new(MachineCode::Contradiction, message));
    let Some(first) = meant.next() else { return };
    let is_klartext = commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext;
    if is_klartext && commons.read(loc::ROTARY_OUTPUT) != RotaryOutput::ShortestPathWithinATurn {
        add(
            "rotary.output outputs positions within 360 degrees with a direction, but a Klartext control has M126 alone, the shortest path",
        );
    }
    if mill_turn::mode(commons).is_some() {
        add(
            "rotary.output outputs positions within 360 degrees, but the C axis of a mill-turn machine counts on",
        );
    }
    let scaled = |rotary: &Rotary| {
        commons.dbl_opt(SCALE[rotary.axis + 3]).is_some_and(|scale| scale.abs() != 1.0)
    };
    if scaled(first) || meant.any(scaled) {
        add(
            "rotary.output outputs positions within 360 degrees, but the axis is scaled in the program",
        );
    }
    if commons.read(loc::MOTION_RESOLUTION_MANUAL) == MotionResolutionManual::Yes
        && commons.dbl_opt(loc::ROTARY_RESOLUTION).is_some_and(|step| !divides_a_turn(step))
    {
        add(
            "rotary.output outputs positions within 360 degrees, but rotary.resolution does not divide them into whole steps",
        );
    }
}

/// True for a step, degrees, that a turn is a whole number of.
fn divides_a_turn(step: f64) -> bool {
    let steps = 360.0 / step;
    (steps - steps.round()).abs() < 1e-6 * steps.max(1.0)
}
