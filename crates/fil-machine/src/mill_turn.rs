//! Mill-turn machines: a main spindle that is the axis C while live tools mill.

use fil_diag::Result;

use crate::address::Addresses;
use crate::axis_chain::{AxisChain, Carries};
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::letter::{Letter, letters};
use crate::locations::{
    self as loc, ControlFamily, ControlTranslation, MillTurnMode, MillTurnPeckForm,
    RotaryFrameOutput, RotaryTipOutput,
};
use crate::setting::CodeAt;

/// Directions nearer than this are one.
const SAME: f64 = 1e-9;

/// The cycles of live tools.
pub const CYCLE_CODES: [CodeAt; 6] = [
    loc::MILL_TURN_FACE_DRILL_CODE,
    loc::MILL_TURN_SIDE_DRILL_CODE,
    loc::MILL_TURN_FACE_TAP_CODE,
    loc::MILL_TURN_SIDE_TAP_CODE,
    loc::MILL_TURN_FACE_TAP_LEFT_CODE,
    loc::MILL_TURN_SIDE_TAP_LEFT_CODE,
];

/// Refuses a machine that would begin a program while its spindle is an axis: the code that
/// makes it one would be missing.
///
/// # Errors
/// E0607.
pub fn check_start(commons: &Commons) -> Result<()> {
    if commons.read(loc::MILL_TURN_MODE) == MillTurnMode::Turning {
        return Ok(());
    }
    let diag = MachineCode::Contradiction.diag("mill_turn.mode: programs begin with turning (0)");
    Err(Box::new(diag.hint("MODE/MILL in the CL file makes the spindle an axis.")))
}

/// What a mill-turn machine does; `None` for a machine without a code that makes its
/// spindle an axis.
pub fn mode(commons: &Commons) -> Option<MillTurnMode> {
    commons.read(loc::MILL_TURN_MILLING_CODE)?;
    Some(commons.read(loc::MILL_TURN_MODE))
}

/// The letter of the axis that the spindle becomes.
pub(crate) fn letter(chain: &AxisChain) -> Option<Letter> {
    chain.rotaries[0].as_ref().map(|rotary| rotary.letter)
}

/// The axes as they are in a mode: C is an axis of the chain only while the machine mills
/// and C counts degrees.
pub(crate) fn chain_in(mode: Option<MillTurnMode>, chain: AxisChain) -> AxisChain {
    match mode {
        None | Some(MillTurnMode::Milling | MillTurnMode::CylindricalInterpolationByTracyl) => {
            chain
        }
        Some(_) => AxisChain { rotaries: [None, None], ..chain },
    }
}

/// TRANSMIT and TRACYL take the place of an axis Y and of polar and cylindrical interpolation.
pub(crate) fn transforms(commons: &Commons) -> bool {
    commons.read(loc::MILL_TURN_TRANSFORMATIONS) && mode(commons).is_some()
}

/// Refuses what a SINUMERIK says by statements and a word-address control by codes, where the
/// other one is meant.
///
/// # Errors
/// E0606.
fn check_transformations(commons: &Commons) -> Result<()> {
    let refuse = |what: &str| MachineCode::SettingValue.err(format!("mill_turn: {what}"));
    let of_sinumerik = commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik;
    let transforms = commons.read(loc::MILL_TURN_TRANSFORMATIONS);
    let live_spindle = commons.int_opt(loc::MILL_TURN_LIVE_SPINDLE);
    let rigid_tap = commons.read(loc::MILL_TURN_RIGID_TAP);
    if !of_sinumerik {
        return match transforms || live_spindle.is_some() || rigid_tap {
            true => refuse("transformations, live_spindle and rigid_tap are those of a SINUMERIK"),
            false => Ok(()),
        };
    }
    let codes = [loc::MILL_TURN_POLAR_CODE, loc::MILL_TURN_CYLINDER_CODE];
    let named = codes.iter().any(|at| commons.int_opt(*at).is_some());
    let pecks = commons.read(loc::MILL_TURN_PECK_FORM) != MillTurnPeckForm::SingleMoves;
    if pecks || named || CYCLE_CODES.iter().any(|at| commons.read(*at).is_some()) {
        return refuse(
            "a SINUMERIK has no codes of interpolations and of cycles of live tools \
             (transformations = 1 is TRANSMIT and TRACYL)",
        );
    }
    let selects = commons.int_opt(loc::SPINDLE_SELECT_NUMBER).is_some();
    if selects || commons.read(loc::MILL_TURN_LIVE_SPEED_ADDRESS).is_some() {
        return refuse("a SINUMERIK has S for each spindle, and none is selected by P");
    }
    if live_spindle.is_some_and(|number| !(2..=99).contains(&number)) {
        return refuse("live_spindle is the number of another spindle than the first");
    }
    if rigid_tap && live_spindle.is_none() {
        return refuse(
            "rigid_tap positions the master spindle, which live_spindle makes that of live tools",
        );
    }
    if live_spindle.is_some() && commons.int_opt(loc::CONTROL_SPINDLE_INDEX).is_some() {
        return refuse("live_spindle takes S and M without a number (control.spindle_index)");
    }
    if !transforms {
        return Ok(());
    }
    if commons.read(loc::CONTROL_TRANSLATION) == ControlTranslation::Trans {
        return refuse("TRANS of the control (control.translation) and transformations");
    }
    if commons.dbl_opt(loc::SCALE_X) == Some(2.0) {
        return refuse(
            "X is a diameter by lathe.diameter, which TRANSMIT and TRACYL end for a while",
        );
    }
    match Addresses::from_commons(commons, true).position(letters::XYZ[1]) {
        Some(_) => Ok(()),
        None => refuse("TRANSMIT and TRACYL need the address Y"),
    }
}

/// Refuses settings with which no mill-turn machine can work.
///
/// # Errors
/// Another axis than one table C about the spindle; a live tool or a way back to turning
/// without a code.
pub(crate) fn check(commons: &Commons) -> Result<()> {
    if mode(commons).is_none() {
        return Ok(());
    }
    let refuse = |what: &str| MachineCode::SettingValue.err(format!("mill_turn: {what}"));
    let chain = AxisChain::from_commons(commons)?;
    let [Some(spindle), None] = &chain.rotaries else {
        return refuse("the spindle is the only rotary axis (rotary.primary_kind = 1)");
    };
    let along_z = (spindle.direction.z - 1.0).abs() < SAME && spindle.carries == Carries::Table;
    let in_the_middle = libm::hypot(spindle.center.x, spindle.center.y) < SAME;
    if !along_z || !in_the_middle || (chain.tool.z - 1.0).abs() > SAME || chain.pivot.is_some() {
        return refuse("the spindle turns the part about Z through X0 Y0, and tools have no head");
    }
    let scale = commons.dbl_opt(loc::SCALE_C).unwrap_or(1.0);
    let shift = commons.dbl_opt(loc::OUTPUT_TRANSLATE_C).unwrap_or(0.0);
    if spindle.axis != 2 || scale != 1.0 || shift != 0.0 {
        return refuse("C is written as it is (rotary.primary_axis = 3, scale.c = 1)");
    }
    let scaled = |at| commons.dbl_opt(at).is_some_and(|scale| scale != 1.0);
    let has_diameters = commons.dbl_opt(loc::SCALE_X) == Some(2.0);
    if scaled(loc::SCALE_X) && !has_diameters || scaled(loc::SCALE_Y) || scaled(loc::SCALE_Z) {
        return refuse(
            "X is a radius or a diameter, Y and Z are written as they are (scale.z = 1)",
        );
    }
    let shifted = |at| commons.dbl_opt(at).is_some_and(|shift| shift != 0.0);
    if shifted(loc::OUTPUT_TRANSLATE_X) || shifted(loc::OUTPUT_TRANSLATE_Y) {
        return refuse(
            "C turns about X0 Y0, so output.translate_x and output.translate_y must be 0: the program's origin is on the spindle axis",
        );
    }
    let frames = commons.read(loc::ROTARY_FRAME_OUTPUT) == RotaryFrameOutput::TiltedWorkPlane;
    let tips = commons.read(loc::ROTARY_TIP_OUTPUT) == RotaryTipOutput::Tcpc;
    if frames || tips || commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext {
        return refuse(
            "only a word-address control, or a SINUMERIK without tilted work planes and TCPC, has it",
        );
    }
    check_transformations(commons)?;
    let codes = [
        (loc::MILL_TURN_TURNING_CODE, "turning_code"),
        (loc::MILL_TURN_LIVE_CW_CODE, "live_cw_code"),
        (loc::MILL_TURN_LIVE_CCW_CODE, "live_ccw_code"),
        (loc::MILL_TURN_LIVE_STOP_CODE, "live_stop_code"),
    ];
    let missing = codes.iter().find(|(at, _)| commons.read(*at).is_none());
    if let Some((_, name)) = missing {
        return refuse(&format!("{name} is not there"));
    }
    let selects = [loc::SPINDLE_SELECT_NUMBER, loc::MILL_TURN_LIVE_SELECT_NUMBER];
    if selects.map(|at| commons.int_opt(at).is_some()) == [false, true] {
        return refuse("live_select_number needs the P of the main spindle, spindle.select_number");
    }
    let drills = CYCLE_CODES.iter().any(|at| commons.read(*at).is_some());
    if drills && commons.read(loc::CYCLE_OFF_CODE).is_none() {
        return refuse("a cycle of live tools needs its end (cycle.off_code)");
    }
    Ok(())
}
