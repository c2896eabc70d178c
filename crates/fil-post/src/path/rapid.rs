//! The order of a rapid motion: XY, rotary, then Z; Z first where it retracts.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self as loc, RapidSplit};

use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control::skip::refuse_level;
use crate::control::word_address::motion::{Motion, RapidCode};
use crate::control_state::Levels;

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
    if motion.axes.has(2) {
        refuse_between_levels(control, motion)?;
    }
    let z_first = motion.axes.has(2) && retracts(control, motion)?;
    split(control, motion, z_first, cause)
}

/// Makes a rapid motion to a position of the machine, as [`rapid`] does; from a level of
/// Z that is not known Z goes first, since nothing may turn or go across beside the part.
///
/// # Errors
/// As [`family::rapid`].
pub fn to_machine_position(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let one_may_be_unknown = control.levels_behind_skip(2).filter(|levels| levels.unknown);
    let goes_down = |levels: &Levels| motion.position[2] < levels.high;
    if one_may_be_unknown.as_ref().is_some_and(goes_down) && motion.axes.has(2) {
        return refuse_level(control, 2);
    }
    let last = control.commons.last_output(control.tables.axis(2).letter);
    let known = last != EMPTY && one_may_be_unknown.is_none();
    if known || control.commons.read(loc::RAPID_SPLIT) == RapidSplit::OneBlock {
        return rapid(control, motion, cause);
    }
    split(control, motion, true, cause)
}

/// Refuses a motion of Z and other axes that ends between two levels at which the tool may
/// stand behind blocks that may be skipped: up first would be down with the one, and across
/// first beside the part with the other.
///
/// # Errors
/// Such a motion; one above a level, where the other one is not known.
pub(super) fn refuse_between_levels(control: &Control, to: &Motion) -> Result<()> {
    let Some(levels) = control.levels_behind_skip(2) else { return Ok(()) };
    let others = to.axes.without(AxisSet::Z).and(control.tables.present());
    let end = to.position[2];
    let between = levels.low < end && (end < levels.high || levels.unknown);
    if between && !others.is_empty() {
        return refuse_level(control, 2);
    }
    Ok(())
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
/// a way up is better made before the way across. From a point of the machine, where a tool
/// is changed, the tool comes down behind the way across.
fn retracts(control: &Control, motion: &Motion) -> Result<bool> {
    let axis = control.tables.axis(2);
    if control.state.is_at_machine_point(axis.letter) {
        return Ok(false);
    }
    let last = control.commons.last_output(axis.letter);
    let above = (axis.value(motion.position[2])? - last) * axis.scale();
    Ok(last != EMPTY && above > 0.0)
}
