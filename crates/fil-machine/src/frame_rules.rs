//! Settings that tilted frames do not go with.

use fil_diag::Diag;
use nalgebra::Vector3;

use crate::axis_chain::AxisChain;
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::locations::{
    self as loc, ControlFamily, RotaryFrameOutput, RotaryOutput, RotaryTipForm, RotaryTipOutput,
};

/// The index in the words of a direction on a SINUMERIK: A3, B3, C3.
const INDEX_OF_VECTORS: i32 = 3;

/// Scales and shifts of X, Y and Z on the tape.
const SCALES: [(crate::commons::Dbl, f64); 6] = [
    (loc::SCALE_X, 1.0),
    (loc::SCALE_Y, 1.0),
    (loc::SCALE_Z, 1.0),
    (loc::OUTPUT_TRANSLATE_X, 0.0),
    (loc::OUTPUT_TRANSLATE_Y, 0.0),
    (loc::OUTPUT_TRANSLATE_Z, 0.0),
];

/// True for a machine that cuts under a tilted axis in a frame of its control: by our own
/// setting, or by the vendor's for planar machining (INTCOM 4687).
pub(crate) fn asks_for_frames(commons: &Commons) -> bool {
    commons.read(loc::ROTARY_FRAME_OUTPUT) == RotaryFrameOutput::TiltedWorkPlane
        || commons.read(loc::MOTION_PLANAR)
}

/// Clamps without their codes.
fn clamps(commons: &Commons, found: &mut Vec<Diag>) {
    let in_frames = asks_for_frames(commons) && commons.read(loc::ROTARY_FRAME_CLAMP);
    let at_turns = !asks_for_frames(commons) && commons.read(loc::ROTARY_TURN_CLAMP);
    let codes = [loc::ROTARY_CLAMP_CODE, loc::ROTARY_UNCLAMP_CODE].map(|at| commons.read(at));
    if (in_frames || at_turns) && (codes.contains(&None) || codes[0] == codes[1]) {
        found.push(Diag::new(
            MachineCode::Contradiction,
            "rotary.frame_clamp and rotary.turn_clamp ask for a code that clamps the rotary axes and \
             another that releases them (rotary.clamp_code, rotary.unclamp_code)",
        ));
    }
}

/// Contradictions of a machine that writes tilted frames, or the tool tip.
pub(crate) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    tip_control(commons, found);
    vectors(commons, found);
    clamps(commons, found);
    if !asks_for_frames(commons) {
        return;
    }
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    if !chain.has_rotary() {
        return;
    }
    let mut add = |message: &str| found.push(Diag::new(MachineCode::Contradiction, message));
    if (chain.tool.into_inner() - Vector3::z()).norm() > 1e-9 {
        add("rotary.frame_output needs the tool along Z when the rotary axes are at zero");
    }
    if is_scaled(commons) {
        add(
            "rotary.frame_output outputs tilted work planes, but X, Y or Z is scaled or shifted in the program",
        );
    }
}

/// Under tool-tip control the control turns the words of X, Y and Z into each other, and the
/// code that begins it takes the length of the tool.
fn tip_control(commons: &Commons, found: &mut Vec<Diag>) {
    if commons.read(loc::ROTARY_TIP_OUTPUT) != RotaryTipOutput::Tcpc {
        return;
    }
    let mut add = |message: &str| found.push(Diag::new(MachineCode::Contradiction, message));
    let scaled = [loc::SCALE_X, loc::SCALE_Y, loc::SCALE_Z]
        .into_iter()
        .any(|at| commons.dbl_opt(at).is_some_and(|scale| scale != 1.0));
    if scaled {
        add("rotary.tip_output outputs TCPC, but X, Y or Z is scaled in the program");
    }
    if commons.read(loc::CONTROL_FAMILY) != ControlFamily::WordAddress {
        return;
    }
    if !commons.read(loc::TOOL_LENGTH_FROM_TOOL) {
        add(
            "rotary.tip_output outputs TCPC, which needs a tool length offset, but tool.length_from_tool outputs none",
        );
    }
    if commons.read(loc::TOOL_LENGTH_AT_CHANGE) || commons.dbl_opt(loc::TOOL_LENGTH_Z).is_some() {
        add(
            "rotary.tip_output outputs TCPC, which activates the tool length offset with its first move, but tool.length_at_change or tool.length_z activates it before",
        );
    }
}

/// Directions of the tool have a meaning under tool-tip control alone, and leave whole turns
/// of an axis to the control.
fn vectors(commons: &Commons, found: &mut Vec<Diag>) {
    if commons.read(loc::ROTARY_TIP_FORM) != RotaryTipForm::Vectors {
        return;
    }
    let mut add = |message: &str| found.push(Diag::new(MachineCode::Contradiction, message));
    if commons.read(loc::ROTARY_TIP_OUTPUT) != RotaryTipOutput::Tcpc {
        add(
            "rotary.tip_form outputs tool direction vectors, which need TCPC (rotary.tip_output = 1)",
        );
    }
    if commons.read(loc::ROTARY_OUTPUT) != RotaryOutput::AnyNumberOfTurns {
        add(
            "rotary.tip_form outputs tool direction vectors, but rotary.output outputs positions within 360 degrees",
        );
    }
    if commons.int_opt(loc::CONTROL_ROTARY_INDEX) == Some(INDEX_OF_VECTORS) {
        add(
            "rotary.tip_form asks for directions of the tool, whose words A3, B3 and C3 are those \
             of the rotary axes (control.rotary_index)",
        );
    }
}

/// True for a machine whose X, Y or Z is scaled or shifted on the tape.
pub(crate) fn is_scaled(commons: &Commons) -> bool {
    let other = |(at, usual): &(_, f64)| commons.dbl_opt(*at).is_some_and(|value| value != *usual);
    SCALES.iter().any(other) || commons.read(loc::LATHE_DIAMETER)
}
