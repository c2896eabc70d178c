//! Tool change: T and the change code, length offset.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::letters::T;
use fil_machine::locations::{self as loc, ToolFormat};

use super::compensation::OFFSETS;
use super::motion::length_number;
use super::{modes, motion};
use crate::control::Control;
use crate::control::needs::Act;
use crate::control_state::{Source, modal};
use crate::errors::PostCode;
use crate::operation::ToolChange;
use crate::operation::motion::Motion;

/// What a LOADTL changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// The tool.
    Tool,
    /// The offset alone: another tip of the tool in the spindle.
    Offset,
    /// Nothing.
    Nothing,
}

/// Ends what a tool change must not interrupt; says what is to be changed.
///
/// # Errors
/// Cutter compensation that is still on; a station that the turret lacks.
pub fn prepare(control: &mut Control, wanted: &ToolChange) -> Result<Changes> {
    check_station(control, wanted.tool)?;
    control.begin()?;
    super::cycle::cancel(control)?;
    modes::leave_plane_of_its_own(control)?;
    control.flush_waiting()?;
    control.ready_for(Act::ToolChange)?;
    modes::before_length(control)?;
    let modal = control.commons.read(loc::TOOL_MODAL);
    let offset = control.family().offset_of(wanted);
    let stays = control.state.is(modal::TOOL, wanted.tool) && !wanted.by_hand;
    Ok(match control.state.get(modal::TOOL_OFFSET).filter(|_| stays) {
        Some(before) if before != offset => Changes::Offset,
        Some(_) if modal => Changes::Nothing,
        _ => Changes::Tool,
    })
}

/// Refuses a tool that no station of the turret holds.
fn check_station(control: &Control, tool: i64) -> Result<()> {
    match control.commons.int_opt(loc::TURRET_STATIONS) {
        Some(stations) if tool < 1 || tool > i64::from(stations) => {
            PostCode::Station.err(format!("tool {tool} of a turret with stations 1 to {stations}"))
        }
        _ => Ok(()),
    }
}

/// Changes the tool and calls its length offset.
///
/// # Errors
/// A tool or offset that does not fit, an offset the machine can't call.
pub fn change(control: &mut Control, wanted: ToolChange) -> Result<()> {
    let before = control.state.get(modal::MOTION);
    let one_word = control.commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode;
    if one_word {
        tool_and_offset(control, wanted)?;
        restate(control);
    } else {
        if wanted.by_hand {
            // Nothing but the operator moves the machine.
            control.state.doubt_axes();
            control.state.forget(modal::MOTION, Source::Post);
        } else {
            tool_blocks(control, wanted.tool)?;
            restate(control);
        }
        control.because(wanted.causes[1], |control| length_offset(control, wanted, before))?;
    }
    control.state.has_tool(Some(wanted.tool));
    control.state.length_of_new_tool(one_word);
    control.state.set(modal::TOOL_OFFSET, wanted.offset);
    Ok(())
}

/// Takes another offset for the tool in the spindle: another of its tips makes the next motions.
///
/// # Errors
/// As [`change`].
pub fn change_offset(control: &mut Control, wanted: ToolChange) -> Result<()> {
    let before = control.state.get(modal::MOTION);
    let one_word = control.commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode;
    control.because(wanted.causes[1], |control| match one_word {
        true => tool_and_offset(control, wanted),
        false => length_offset(control, wanted, before),
    })?;
    if one_word || control.code_if_any(loc::TOOL_LENGTH_CODE).is_some() {
        counts_from_another_tip(control);
    }
    control.state.length_of_new_tool(one_word);
    control.state.set(modal::TOOL_OFFSET, wanted.offset);
    Ok(())
}

/// The machine stands where it stood, and counts from another tip of its tool: along Z on a mill.
pub(in crate::control) fn counts_from_another_tip(control: &mut Control) {
    let axes = if control.commons.read(loc::LATHE_DIAMETER) { AxisSet::LINEAR } else { AxisSet::Z };
    for number in axes.and(control.tables.present()).numbers() {
        let letter = control.tables.axis(number).letter;
        control.state.shifts(letter, Source::Post);
    }
}

/// Names the next tool, on a machine that prepares it.
///
/// # Errors
/// A number that does not fit.
pub fn select(control: &mut Control, tool: i64) -> Result<()> {
    if !control.commons.read(loc::TOOL_PRESELECT) || control.tools.prepared == Some(tool) {
        return Ok(());
    }
    control.tools.prepared = Some(tool);
    control.state.forget(modal::NAMED_TOOL, Source::Post);
    control.word(T, tool as f64)?;
    control.write_block()
}

/// Writes tool and offset in one word, two digits each: T0303; of a control that takes the nose
/// radius by a number of its own that of the offset before them: T030303.
fn tool_and_offset(control: &mut Control, wanted: ToolChange) -> Result<()> {
    if wanted.offset >= OFFSETS {
        return PostCode::WordForm
            .err(format!("LOADTL: offset {} has more than two digits", wanted.offset));
    }
    let names_nose =
        control.commons.read(loc::TOOL_FORMAT) == ToolFormat::NoseAndToolAndOffsetInOneTWord;
    if names_nose && wanted.tool >= OFFSETS {
        return PostCode::WordForm
            .err(format!("LOADTL: tool {} has more than two digits", wanted.tool));
    }
    let nose = if names_nose { wanted.offset * OFFSETS * OFFSETS } else { 0 };
    control.word(T, (nose + wanted.tool * OFFSETS + wanted.offset) as f64)?;
    control.write_block()
}

/// Where axes and motion stand is not known: the change may have moved the machine.
pub(in crate::control) fn restate(control: &mut Control) {
    if control.commons.read(loc::TOOL_RESTATE) {
        control.tool_change_moves();
        control.state.forget(modal::MOTION, Source::Post);
    }
}

/// Writes T and the change code, in one block or two.
///
/// # Errors
/// A number that does not fit.
pub(in crate::control) fn tool_blocks(control: &mut Control, tool: i64) -> Result<()> {
    let code = control.code_if_any(loc::TOOL_CHANGE_CODE);
    if code.is_some() || control.tables.addresses.required(T)?.is_some() {
        control.word(T, tool as f64)?;
    }
    if control.commons.read(loc::TOOL_SEPARATE_BLOCKS) {
        control.write_block()?;
    }
    match code {
        Some(code) => control.block.m(code, control.block.cause.whole()),
        None => without_code(control, tool)?,
    }
    control.write_block()
}

/// A machine without a code for tool changes: its first tool is in the spindle already, or T
/// changes it. Another one would never come there.
fn without_code(control: &mut Control, tool: i64) -> Result<()> {
    let calls = control.tables.addresses.required(T)?.is_some();
    if let Some(before) = control.state.get(modal::TOOL).filter(|before| *before != tool && !calls)
    {
        return PostCode::NoCode.err(format!(
            "tool {tool} after tool {before}, and the machine has no tool change: post one tool a \
             file, or stop for a change by hand (LOADTL/{tool},MANUAL)"
        ));
    }
    // T of a SINUMERIK without a code changes the tool at once.
    if !(calls && control.can().cutting_edges) {
        control.warn_no_code("a tool change");
    }
    Ok(())
}

/// Warns of a length offset that another tool has called: the offsets are one table for all tools.
fn warn_of_shared_offset(control: &mut Control, wanted: ToolChange) {
    let first = *control.tools.of_offset.entry(wanted.offset).or_insert(wanted.tool);
    if first != wanted.tool {
        let message =
            format!("tools {first} and {} have one length offset, {}", wanted.tool, wanted.offset);
        control.warnings.add(PostCode::SharedOffset, message);
    }
}

/// A tool for which no length offset is called.
///
/// # Errors
/// The offset of the tool before it, which OSETNO has called, would stay in force.
fn without_offset(control: &mut Control, wanted: ToolChange, has_code: bool) -> Result<()> {
    if let Some(before) = control.state.get(modal::LENGTH_OFFSET).filter(|_| has_code) {
        return PostCode::NoCode.err_with(
            format!("LOADTL names no offset, and offset {before} of the tool before is in force"),
            "Give LOADTL its OSETNO, or set tool.length_from_tool = 1, by which the offset has the \
             number of the tool.",
        );
    }
    if wanted.is_offset_given() && wanted.offset != wanted.tool {
        let message = format!(
            "LOADTL asks for offset {}, and the machine calls no length offset",
            wanted.offset
        );
        control.warnings.add(PostCode::IgnoredPart, message);
    }
    Ok(())
}

/// Calls the length offset: with the Z position of the machine (own location
/// `tool.length_z`) in a block of its own, else with the next Z motion.
fn length_offset(
    control: &mut Control,
    wanted: ToolChange,
    before: Option<FunctionCode>,
) -> Result<()> {
    if control.tables.tip_output {
        control.tip.offset = Some((wanted.offset, control.block.cause));
        control.await_length(control.tip.offset);
        return Ok(());
    }
    // OSETNO names the offset itself; else it is the number of the tool, where the machine says so.
    let calls = control.commons.read(loc::TOOL_LENGTH_FROM_TOOL) || wanted.is_offset_given();
    let code = control.code_if_any(loc::TOOL_LENGTH_CODE);
    let Some(code) = code.filter(|_| calls) else {
        return without_offset(control, wanted, code.is_some());
    };
    warn_of_shared_offset(control, wanted);
    if let Some(cancel) = control.code_if_any(loc::TOOL_LENGTH_CANCEL_CODE) {
        control.g_of_record(cancel);
        control.write_block()?;
    }
    if control.commons.read(loc::TOOL_LENGTH_AT_CHANGE) {
        control.g_of_record(code);
        length_number(control, wanted.offset)?;
        control.write_block()?;
        control.state.doubt_axes();
        return Ok(());
    }
    let Some(z) = control.commons.dbl_opt(loc::TOOL_LENGTH_Z) else {
        control.await_length(Some((wanted.offset, control.block.cause)));
        control.state.doubt(control.tables.axis(2).letter);
        return Ok(());
    };
    let mut position = Position::default();
    position[2] = z;
    // Without a motion function Z would go as the last motion did.
    let rapid = control.code(loc::RAPID_CODE_Z, "rapid move")?;
    if before != Some(rapid) {
        let cause = control.block.cause.whole();
        control.block.g(rapid, cause);
        if !control.commons.read(loc::MODE_SEVERAL_G) {
            control.write_block()?;
        }
    }
    control.g_of_record(code);
    motion::axis_word(control, 2, &Motion::new(position, AxisSet::Z, 0))?;
    length_number(control, wanted.offset)?;
    control.write_block()?;
    control.state.forget(modal::MOTION, Source::Post);
    Ok(())
}
