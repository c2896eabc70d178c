//! The order of a rapid motion: XY, rotary, then Z; Z first where it retracts.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self as loc, RapidSplit};

use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control::word_address::motion::{Motion, RapidCode};

/// Makes a rapid motion in the order the machine asks for.
///
/// # Errors
/// As [`family::rapid`].
pub fn rapid(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let of_tip = control.state.tip_control == Some(true);
    if of_tip || control.commons.read(loc::RAPID_SPLIT) == RapidSplit::OneBlock {
        return family::rapid(control, motion, RapidCode::Across, cause);
    }
    in_parts(control, motion, cause)
}

/// Makes a rapid motion X and Y, then the rotary axes, then Z; Z first where it goes up.
///
/// # Errors
/// As [`family::rapid`].
pub(super) fn in_parts(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let z_first = motion.axes.has(2) && retracts(control, motion)?;
    split(control, motion, z_first, cause)
}

/// Makes a rapid motion to a position of the machine, as [`rapid`] does; from a level of
/// Z that is not known Z goes first, since nothing may turn or go across beside the part.
///
/// # Errors
/// As [`family::rapid`].
pub fn to_machine_position(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let known = control.commons.last_output(control.tables.axis(2).letter) != EMPTY;
    if known || control.commons.read(loc::RAPID_SPLIT) == RapidSplit::OneBlock {
        return rapid(control, motion, cause);
    }
    split(control, motion, true, cause)
}

fn split(control: &mut Control, motion: &Motion, z_first: bool, cause: Cause) -> Result<()> {
    let across = (AxisSet::XY, RapidCode::Across);
    let turning = (AxisSet::ROTARY, RapidCode::Turning);
    let along = (AxisSet::Z, RapidCode::Along);
    let order = if z_first { [along, across, turning] } else { [across, turning, along] };
    let present = control.tables.present();
    for (group, code) in order {
        if !group.and(present).is_empty() {
            family::rapid(control, &motion.of(group), code, cause)?;
        }
    }
    Ok(())
}

/// True when Z goes up from the last level on the tape. A level in doubt counts too:
/// a way up is better made before the way across.
fn retracts(control: &Control, motion: &Motion) -> Result<bool> {
    let axis = control.tables.axis(2);
    let last = control.commons.last_output(axis.letter);
    let above = (axis.value(motion.position[2])? - last) * axis.scale();
    Ok(last != EMPTY && above > 0.0)
}
