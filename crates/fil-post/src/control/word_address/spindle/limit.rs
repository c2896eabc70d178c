//! The highest speed of the spindle (MAXRPM): G50 S, LIMS, or a word beside the surface speed.

use fil_diag::Result;
use fil_machine::letters::S;
use fil_machine::locations as loc;

use super::{is_main, speed_words};
use crate::control::Control;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::SpindleSpeed;

/// Says the highest speed, in a block of its own or later in that of the surface speed.
pub(super) fn limit_block(control: &mut Control, limit: f64) -> Result<()> {
    control.begin()?;
    control.state.set(modal::SPEED_LIMIT, limit);
    if control.family().says_limit(control, limit)? {
        return Ok(());
    }
    if control.commons.read(loc::SPINDLE_MAX_ADDRESS).is_some() {
        return limit_beside_surface_speed(control);
    }
    let code = control.code(loc::SPINDLE_MAX_CODE, "SPINDL/MAXRPM")?;
    control.g_of_record(code);
    control.word(S, limit)?;
    control.write_block()
}

/// Says the highest speed in force once more, so that the program can be begun here. Where it is a
/// word beside the surface speed, each surface speed brings it along.
///
/// # Errors
/// As a block on the tape.
pub fn say_limit_again(control: &mut Control) -> Result<()> {
    let is_beside = control.commons.read(loc::SPINDLE_MAX_ADDRESS).is_some();
    let limit = control.state.get(modal::SPEED_LIMIT).filter(|_| is_main(control) && !is_beside);
    limit.map_or(Ok(()), |limit| limit_block(control, limit))
}

/// A surface speed that is in force is said again, as the highest speed is a word beside it;
/// another one brings it along.
fn limit_beside_surface_speed(control: &mut Control) -> Result<()> {
    match control.spindle.speed {
        Some(speed @ (SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_))) => {
            control.flush_waiting()?;
            speed_words(control, speed)?;
            control.write_block()
        }
        _ => Ok(()),
    }
}

/// Sees that a highest speed is in force before a surface speed.
///
/// # Errors
/// Neither the CL file nor the machine gives one.
pub(super) fn require_limit(control: &mut Control) -> Result<()> {
    if control.state.get(modal::SPEED_LIMIT).is_some()
        || control.commons.read(loc::SPINDLE_CSS_UNLIMITED)
    {
        return Ok(());
    }
    match control.commons.dbl_opt(loc::SPINDLE_CSS_LIMIT) {
        Some(limit) => limit_block(control, limit),
        None => PostCode::SpeedLimit.err("SPINDL: no highest speed (MAXRPM) is in force"),
    }
}

/// Warns of turns a minute above the highest speed that MAXRPM has set: it stays in force, and
/// many controls hold each speed to it, not only a surface speed.
pub(super) fn warn_above_limit(control: &mut Control, speed: Option<SpindleSpeed>) {
    let (Some(SpindleSpeed::Revolutions(speed)), Some(limit)) =
        (speed, control.state.get(modal::SPEED_LIMIT))
    else {
        return;
    };
    if speed > limit && !control.tables.mills() {
        let message = format!("SPINDL: {speed} rpm, above the active limit of {limit}");
        control.warnings.add(PostCode::AboveSpeedLimit, message);
    }
}
