//! Controls whose tools bring length and radius with them: what becomes of the numbers of
//! offsets that a CL file gives for another control.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ControlToolOffsets};

use super::Control;
use crate::errors::PostCode;

/// True where the tool's own length and radius take the place of each offset.
pub fn of_tool(control: &Control) -> bool {
    control.commons.read(loc::CONTROL_TOOL_OFFSETS) == ControlToolOffsets::OfTheTool
}

/// Leaves out the number of an offset where the machine wants that: with a warning, unless it
/// is the number of `tool` itself, which CAM systems give the offsets of a tool by default.
///
/// # Errors
/// The machine does not want it: `message` says why the control can't take the number.
pub fn leave_out(
    control: &mut Control,
    tool: Option<i64>,
    offset: f64,
    message: &str,
) -> Result<()> {
    if !of_tool(control) {
        return PostCode::Family
            .err(format!("{message} (control.tool_offsets = 1 leaves the number out)"));
    }
    if tool.is_some_and(|tool| tool as f64 == offset) {
        return Ok(());
    }
    let message = format!("offset {offset}: length and radius come with the tool");
    control.warnings.add(PostCode::IgnoredPart, message);
    Ok(())
}
