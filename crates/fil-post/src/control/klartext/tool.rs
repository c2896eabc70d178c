//! TOOL CALL and TOOL DEF.

use fil_diag::Result;
use fil_machine::letters::{self, T};
use fil_machine::locations as loc;
use fil_machine::rounding::Rounding;

use super::line::{self, Line};
use crate::block::named;
use crate::control::needs::Act;
use crate::control::word_address::spindle;
use crate::control::{Control, own_offsets};
use crate::control_state::{Rotation, Source, modal};
use crate::noted::TEXT;
use crate::operation::ToolChange;

/// Leaves an offset of its own out, so that a tool that is in the spindle with another one
/// counts as the same.
///
/// # Errors
/// An offset of its own, where the machine does not say that it is left out.
pub fn take_own_offset(control: &mut Control, wanted: &mut ToolChange) -> Result<()> {
    if wanted.is_offset_given() && wanted.offset != wanted.tool {
        let offset = wanted.offset;
        let message = format!("LOADTL asks for offset {offset}: the length comes with the tool");
        own_offsets::leave_out(control, Some(wanted.tool), offset as f64, &message)?;
        wanted.offset = wanted.tool;
    }
    Ok(())
}

/// Calls a tool; its length and radius come from the control's table of tools.
///
/// # Errors
/// Cutter compensation; a number that does not fit.
pub fn change(control: &mut Control, wanted: ToolChange) -> Result<()> {
    control.ready_for(Act::ToolCall)?;
    let number = number(control, wanted.tool)?;
    let mut line = Line::default();
    line.item(TEXT, "TOOL CALL", control.block.cause.whole());
    line.item(T.byte(), &number, wanted.causes[0]);
    line.item(TEXT, "Z", control.block.cause.whole());
    let speed = wanted.speed.filter(|_| control.commons.read(loc::TOOL_CALL_SPEED));
    if let Some(speed) = speed {
        let value = spindle::speed_in_range(control, speed);
        let (written, text) = scaled_speed(control, value)?;
        line.item(letters::S.byte(), &text, control.block.cause.whole());
        control.commons.set_last_output(letters::S, written);
        control.state.trust(letters::S);
    }
    line::put(control, &line)?;
    for number in control.tables.present().numbers() {
        control.state.tool_change_moves(control.tables.axis(number).letter);
    }
    control.state.set(modal::TOOL_CHANGED, true);
    // The control changes the tool with the spindle standing.
    control.state.set(modal::SPINDLE, Rotation::Standing);
    control.state.has_tool(Some(wanted.tool));
    control.state.set(modal::TOOL_OFFSET, wanted.tool);
    Ok(())
}

/// The number of a tool as T writes it.
pub(super) fn number(control: &Control, tool: i64) -> Result<String> {
    control.require_letter(T)?;
    let format = control.tables.addresses.format(T).copied().unwrap_or_default();
    let scaled = Rounding::Exact.scale(tool as f64, &format).map_err(|diag| named(diag, T))?;
    Ok(line::scaled_text(control, T, scaled).unwrap_or_default())
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
    control.begin()?;
    let mut line = Line::default();
    let cause = control.block.cause;
    line.item(TEXT, "TOOL DEF", cause.whole());
    line.item(T.byte(), &number(control, tool)?, cause);
    line::put(control, &line)
}

/// The speed of the spindle, by calling the tool in the spindle again; where it is not known,
/// without its number: the control then keeps it.
///
/// # Errors
/// Cutter compensation; a speed that does not fit.
pub fn speed(control: &mut Control, value: f64) -> Result<()> {
    control.ready_for(Act::ToolCall)?;
    let (written, text) = scaled_speed(control, value)?;
    if control.has_value(letters::S, written) {
        return Ok(());
    }
    let cause = control.block.cause;
    let mut line = Line::default();
    line.item(TEXT, "TOOL CALL", cause.whole());
    if let Some(tool) = control.state.get(modal::TOOL) {
        line.item(T.byte(), &number(control, tool)?, cause.whole());
    }
    line.item(TEXT, "Z", cause.whole());
    line.item(letters::S.byte(), &text, cause);
    line::put(control, &line)?;
    control.commons.set_last_output(letters::S, written);
    control.state.trust(letters::S);
    Ok(())
}

/// A speed as S writes it, rev/min, and its word.
///
/// # Errors
/// It does not fit.
fn scaled_speed(control: &Control, value: f64) -> Result<(f64, String)> {
    control.require_letter(letters::S)?;
    let format = control.tables.addresses.format(letters::S).copied().unwrap_or_default();
    let scaled = Rounding::Rate.scale(value, &format).map_err(|diag| named(diag, letters::S))?;
    let text = line::scaled_text(control, letters::S, scaled).unwrap_or_default();
    Ok((format.unscale(scaled), format!("S{text}")))
}
