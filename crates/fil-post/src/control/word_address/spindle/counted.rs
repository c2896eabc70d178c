//! Which spindle of a lathe the control counts: a thread, a feed a turn, a surface speed and S are
//! those of one spindle, and a statement or a code says of which.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::{code_of_turns, is_of_surface, may_turn};
use crate::control::Control;
use crate::control::needs::Act;
use crate::control_state::{Rotation, Source, modal};
use crate::errors::PostCode;
use crate::operation::CountedSpindle;

/// The machine says which spindle its control counts.
pub fn is_chosen(control: &Control) -> bool {
    control.commons.int_opt(loc::SPINDLE_SIDE_NUMBER).is_some()
        || control.code_if_any(loc::SPINDLE_SIDE_MASTER_CODE).is_some()
}

/// The second spindle is the one that the CL file speaks of, and its codes are its own.
pub fn has_own_codes(control: &Control) -> bool {
    control.spindle.is_side && control.code_if_any(loc::SPINDLE_SIDE_CW_CODE).is_some()
}

/// A surface speed of the second spindle, and its limit, are its own: SETMS makes it so.
pub fn may_hold_surface_speed(control: &Control) -> bool {
    control.can().mode_statements
}

/// Which spindle the control counts is not known.
pub fn is_unknown(control: &Control) -> bool {
    is_chosen(control) && control.state.get(modal::MASTER_IS_SUB).is_none()
}

/// Makes the control count one of the spindles, in a block of its own; nothing where it does.
///
/// # Errors
/// A record that leaves speed or direction to the spindle before; a surface speed of a spindle
/// that may turn, which would become that of the other one; blocks that may be skipped.
pub fn choose(control: &mut Control, chosen: CountedSpindle) -> Result<()> {
    let changes = control.spindle.is_side != chosen.is_side;
    if changes && !chosen.is_whole {
        return PostCode::WordForm.err(
            "SPINDL of the other spindle without its speed and CLW or CCLW: those before are not \
             its own",
        );
    }
    if control.state.is(modal::MASTER_IS_SUB, chosen.is_side) {
        return Ok(());
    }
    control.require(Act::MasterSpindle)?;
    let turns = may_turn(control);
    control.begin()?;
    control.flush_waiting()?;
    end_surface_speed(control)?;
    write(control, chosen.is_side)?;
    if changes {
        control.spindle.other_turns = turns;
        control.spindle.is_side = chosen.is_side;
        forget_the_other(control);
    }
    control.state.set(modal::MASTER_IS_SUB, chosen.is_side);
    Ok(())
}

/// The surface speed of a spindle that stands ends before another one is counted: S of that one
/// would be read as one.
fn end_surface_speed(control: &mut Control) -> Result<()> {
    if !is_of_surface(control) {
        return Ok(());
    }
    if may_turn(control) {
        return PostCode::WordForm.err_with(
            "SPINDL of the other spindle while this one turns at surface speed, which would \
             become that of the other",
            "Stop it first (SPINDL / OFF), or give its speed in rpm (SPINDL / RPM).",
        );
    }
    if let Some(code) = code_of_turns(control) {
        control.g_of_record(code);
        control.write_block()?;
        control.family().counts_turns(control);
    }
    control.spindle.speed = None;
    Ok(())
}

fn write(control: &mut Control, is_side: bool) -> Result<()> {
    if let Some(number) = control.commons.int_opt(loc::SPINDLE_SIDE_NUMBER) {
        return control.family().choose_master(control, number, is_side);
    }
    let at = if is_side { loc::SPINDLE_SIDE_MASTER_CODE } else { loc::SPINDLE_MAIN_MASTER_CODE };
    let code = control.code(at, "the spindle that is counted")?;
    control.m(code);
    control.write_block()
}

/// Nothing that was said of one spindle holds for the other.
fn forget_the_other(control: &mut Control) {
    control.spindle.switch();
    control.state.set(modal::SPINDLE, Rotation::InDoubt);
    control.state.forget(modal::GEAR, Source::Post);
    control.state.doubt(fil_machine::letters::S);
    if may_hold_surface_speed(control) {
        let limit = control.state.get(modal::SPEED_LIMIT);
        let other = std::mem::replace(&mut control.spindle.limit_of_other, limit);
        control.state.set_if_known(modal::SPEED_LIMIT, other, Source::NotCommanded);
    }
}

/// Refuses a tap by a cycle of the control for the second spindle, whose code turns it back by
/// those of the main one; and any tap where nothing says which spindle is counted.
///
/// # Errors
/// It is such a tap.
pub fn check_tap(control: &Control, by_cycle: bool) -> Result<()> {
    if is_unknown(control) {
        return PostCode::CycleForm.err(WHICH);
    }
    let knows = control.can().mode_statements;
    if control.spindle.is_side && by_cycle && !knows {
        return PostCode::CycleForm.err(
            "a canned tapping cycle on the sub-spindle: no code selects the spindle that it reverses",
        );
    }
    Ok(())
}

/// Why a spindle that nobody knows is none for a thread.
pub const WHICH: &str = "the master spindle is not known; put SPINDL before it";
