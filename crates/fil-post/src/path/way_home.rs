//! What a machine does by its settings at the end of a tool, of a work offset and of the program:
//! coolant and spindle off, and the way to its home position.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations::{self as loc, ProgramEndBlock, ToolChangeStop};
use fil_machine::setting::CodeAt;
use fil_machine::user_blocks::{self, Around};

use super::{height, machine_position, mill_turn};
use crate::control::machine_frame::Before;
use crate::control::word_address::{coolant, cycle, fixture, spindle};
use crate::control::{Control, Held, family, program, user_texts};
use crate::control_state::{Source, WorkOffset, modal};
use crate::operation::motion::{Motion, RapidCode};
use crate::operation::{Coolant, Operation, Spindle, Stop};
use crate::post::Post;

/// Ends coolant and spindle before a tool change, where the machine does so or the operator makes it;
/// before the first one no spindle turns. The coolant comes on again at the next point, however many
/// changes come before it.
///
/// # Errors
/// The machine has no codes for it.
pub(super) fn switch_off_for_change(
    control: &mut Control,
    by_hand: bool,
    is_first: bool,
) -> Result<()> {
    if !by_hand && !control.commons.read(loc::HOME_SWITCHES_OFF) {
        return Ok(());
    }
    let coolant = control.coolant.or(control.tools.coolant);
    end_coolant(control)?;
    control.tools.coolant = coolant;
    if by_hand || !is_first {
        end_spindle(control)?;
    }
    Ok(())
}

/// Switches the coolant on again that a tool change has switched off.
///
/// # Errors
/// As its block.
#[cold]
pub(crate) fn resume_coolant(control: &mut Control, at: CodeAt) -> Result<()> {
    control.begin()?;
    coolant::switch_on(control, at)
}

/// Ends coolant and spindle where they are on.
///
/// # Errors
/// The machine has no codes for it.
fn switch_off(control: &mut Control) -> Result<()> {
    end_coolant(control)?;
    end_spindle(control)
}

fn end_coolant(control: &mut Control) -> Result<()> {
    match control.coolant {
        Some(_) => control.family().write(control, Operation::Coolant(Coolant::Off)),
        None => Ok(()),
    }
}

fn end_spindle(control: &mut Control) -> Result<()> {
    match spindle::may_turn(control) {
        true => control.family().write(control, Operation::Spindle(Spindle::Off)),
        false => Ok(()),
    }
}

/// The stop that the machine makes at a tool change, behind its retract.
pub(crate) fn stops_at_change(control: &Control) -> Option<Stop> {
    match control.commons.read(loc::TOOL_CHANGE_STOP) {
        ToolChangeStop::None => None,
        ToolChangeStop::OptionalStop => Some(Stop::Optional),
        ToolChangeStop::Stop => Some(Stop::Always),
    }
}

/// Stops at the tool change position, as the machine asks for it; a stop that the CL file asks for
/// right before the change is that one.
///
/// # Errors
/// The machine has no code for the stop.
pub(super) fn stop_at_change(control: &mut Control) -> Result<()> {
    let Some(stop) = stops_at_change(control) else { return Ok(()) };
    control.tools.held.retain(|(held, _)| *held != Held::Stop(stop));
    control.family().write(control, Operation::Stop(stop))
}

/// Stops for the operator to change the tool by hand, with a message that names it; a stop that waits
/// for the change is this one.
///
/// # Errors
/// The machine has no code for the stop.
pub(super) fn stop_for_operator(control: &mut Control, tool: i64) -> Result<()> {
    control.tools.held.retain(|(held, _)| !matches!(held, Held::Stop(_)));
    write_held(control)?;
    if control.commons.read(loc::MESSAGE_TO_TAPE) {
        let message = Operation::Message(format!("LOAD TOOL {tool}"));
        control.family().write(control, message)?;
    }
    control.family().write(control, Operation::Stop(Stop::Always))
}

/// Writes the messages and stops that have waited for a tool change, or for what has come instead of it.
///
/// # Errors
/// As a line on the tape.
pub(crate) fn write_held(control: &mut Control) -> Result<()> {
    for (held, cause) in std::mem::take(&mut control.tools.held) {
        let operation = match held {
            Held::Message(text) => Operation::Message(text),
            Held::Stop(stop) => Operation::Stop(stop),
        };
        // The whole block is that of the record which has waited.
        let now = std::mem::replace(&mut control.tape.cause, cause);
        control.because(cause, |control| control.family().write(control, operation))?;
        control.tape.cause = now;
    }
    Ok(())
}

/// Restates modes, work offset, the axis C and the highest speed after a tool change, so that the
/// program can be begun there. A work offset that a block of the author has chosen stays.
///
/// # Errors
/// A work offset that the machine lacks.
pub(super) fn restate(control: &mut Control) -> Result<()> {
    let says_modes = control.commons.read(loc::TOOL_CHANGE_MODES);
    if control.commons.read(loc::PROGRAM_SAFE_START) {
        program::end_planes(control)?;
    }
    if says_modes {
        program::say_modes_again(control)?;
    }
    if control.commons.int_opt(loc::FIXTURE_FIRST).is_some() {
        match (offset_of_author(control), work_offset_in_force(control)) {
            (Some(offset), _) => fixture::restate(control, offset)?,
            (None, Some(number)) => write_work_offset(control, number)?,
            (None, None) => {}
        }
    }
    match says_modes {
        true if control.tables.mills() => mill_turn::say_milling_again(control),
        true => spindle::say_limit_again(control),
        false => Ok(()),
    }
}

/// Writes a work offset, one that is not in force between the user's blocks.
fn write_work_offset(control: &mut Control, number: Option<i64>) -> Result<()> {
    let is_other = control.tools.written_offset.replace(number) != Some(number);
    let Around { before, after } = user_blocks::OFFSET;
    if is_other {
        user_texts::write(control, before)?;
    }
    control.family().write(control, Operation::WorkOffset(number))?;
    if is_other { user_texts::write(control, after) } else { Ok(()) }
}

/// The work offset that was named last, or the first one of the machine; `None` where a block of
/// the author has chosen another.
fn work_offset_in_force(control: &Control) -> Option<Option<i64>> {
    let first = control.commons.int_opt(loc::FIXTURE_FIRST).map(|first| Some(i64::from(first)));
    control.tools.work_offset.or(first).filter(|_| offset_of_author(control).is_none())
}

/// The work offset in force, if a block of the author has chosen it.
fn offset_of_author(control: &Control) -> Option<WorkOffset> {
    let offset = control.state.get(modal::WORK_OFFSET)?;
    (control.state.get(modal::ASKED_OFFSET) != Some(offset)).then_some(offset)
}

/// Takes a work offset; before another one the tool goes up, where the machine asks for it. The
/// one that a tool change has just restated is not written twice.
///
/// # Errors
/// As the way up, and as a work offset.
pub(super) fn take_work_offset(post: &mut Post, number: Option<i64>) -> Result<()> {
    let control = &post.control;
    let is_other = work_offset_in_force(control) != Some(number);
    let restates = control.commons.int_opt(loc::FIXTURE_FIRST).is_some();
    if is_other && control.commons.read(loc::FIXTURE_CHANGE_BLOCK) && control.stands(2).is_some() {
        go_up(post)?;
    }
    let control = &mut post.control;
    control.tools.work_offset = Some(number);
    if restates && !is_other && control.state.get(modal::WORK_OFFSET).is_some() {
        return Ok(());
    }
    write_work_offset(control, number)
}

/// Goes up to the level of RETRCT; the next motion says its function again, so that the program can
/// be begun there.
pub(super) fn go_up(post: &mut Post) -> Result<()> {
    match post.control.commons.dbl_opt(loc::HOME_RETRACT_Z) {
        Some(level) if !height::is_above(&post.control, level)? => {
            machine_position::carry_out(post, [None, None, Some(level)])?;
            post.control.state.forget(modal::MOTION, Source::Post);
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Ends coolant and spindle and goes home before the program ends.
///
/// # Errors
/// Cutter compensation that is on, and all that the motion refuses.
pub(super) fn before_end(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    let block = control.commons.read(loc::PROGRAM_END_BLOCK);
    let is_asked = control.commons.read(loc::HOME_SWITCHES_OFF) || block != ProgramEndBlock::None;
    if !is_asked || control.state.may_be(modal::PROGRAM_END, true) {
        return Ok(());
    }
    control.begin()?;
    cycle::cancel(control)?;
    control.skip_blocks(false)?;
    control.flush_waiting()?;
    if control.commons.read(loc::HOME_SWITCHES_OFF) {
        switch_off(control)?;
    }
    let home = loc::HOME.map(|at| control.commons.dbl_opt(at));
    let to = match block {
        ProgramEndBlock::None => return Ok(()),
        ProgramEndBlock::Z => [None, None, home[2]],
        ProgramEndBlock::ZThenXAndY | ProgramEndBlock::ZThenXAndYThenRotaryAxes => home,
    };
    machine_position::carry_out_before(post, to, Before::End)?;
    match block {
        ProgramEndBlock::ZThenXAndYThenRotaryAxes => turn_home(post),
        _ => Ok(()),
    }
}

/// Turns the rotary axes to 0, clear of the part; axes that do not reach 0 stay.
///
/// # Errors
/// As a rapid motion.
fn turn_home(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    let axes = AxisSet::ROTARY.and(control.tables.present());
    if axes.is_empty() || !control.tables.chain().reaches([0.0; 2]) {
        return Ok(());
    }
    // The block stands alone behind the way home.
    control.state.forget(modal::MOTION, Source::Post);
    let cause = control.block.cause.whole();
    let motion = Motion::new(Position::default(), axes, 0);
    family::rapid(control, &motion, RapidCode::Turning, cause)
}
