//! Tool change: `T5 M6` or `T="5" M6`, and `D1`, its cutting edge.

use fil_diag::Result;
use fil_machine::letters::D;
use fil_machine::locations as loc;

use crate::control::word_address::tool as words;
use crate::control::{Control, own_offsets};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::{OffsetFrom, ToolChange};

/// The highest number of a cutting edge.
const EDGES: i64 = 9;

/// Leaves out what is no cutting edge of a tool, where the machine wants that: its first edge counts.
/// With `control.tool_offsets`, OSETNO is an offset of the machine and no edge.
///
/// # Errors
/// An edge that no tool has.
pub fn take_own_offset(control: &mut Control, wanted: &mut ToolChange) -> Result<()> {
    let edge = edge_of(wanted);
    let is_of_machine = wanted.offset_from == OffsetFrom::Record;
    if !(1..=EDGES).contains(&edge) || edge > 1 && is_of_machine && own_offsets::of_tool(control) {
        let message = format!(
            "LOADTL asks for offset {edge}: D names one of the cutting edges 1 to {EDGES} of the \
             tool"
        );
        own_offsets::leave_out(control, Some(wanted.tool), edge as f64, &message)?;
        wanted.offset = 1;
    }
    Ok(())
}

/// Changes the tool and takes its cutting edge: that of OSETNO or of its compensation, else the
/// first. Length and radius come from the control's table with it.
///
/// # Errors
/// A tool that does not fit.
pub fn change(control: &mut Control, wanted: ToolChange) -> Result<()> {
    words::tool_blocks(control, wanted.tool)?;
    words::restate(control);
    take_edge(control, &wanted)?;
    control.state.has_tool(Some(wanted.tool));
    Ok(())
}

/// Takes another cutting edge of the tool in the spindle.
///
/// # Errors
/// A number that does not fit.
pub fn change_edge(control: &mut Control, wanted: ToolChange) -> Result<()> {
    take_edge(control, &wanted)?;
    words::counts_from_another_tip(control);
    Ok(())
}

fn take_edge(control: &mut Control, wanted: &ToolChange) -> Result<()> {
    let edge = edge_of(wanted);
    control.because(wanted.causes[1], |control| {
        control.word(D, edge as f64)?;
        control.write_block()
    })?;
    control.state.doubt_axes();
    control.state.set(modal::TOOL_OFFSET, edge);
    control.sinumerik.edge = Some(edge);
    control.state.calls_length(true);
    Ok(())
}

/// The cutting edge that a change asks for.
pub fn edge_of(wanted: &ToolChange) -> i64 {
    if wanted.is_offset_given() { wanted.offset } else { 1 }
}

/// Names the next tool, on a machine that prepares it.
///
/// # Errors
/// A machine whose T changes the tool at once; a number that does not fit.
pub fn select(control: &mut Control, tool: i64) -> Result<()> {
    let prepares = control.commons.read(loc::TOOL_PRESELECT);
    if prepares && control.code_if_any(loc::TOOL_CHANGE_CODE).is_none() {
        return PostCode::Family
            .err("the next tool by T, which changes the tool at once (tool.change_code)");
    }
    words::select(control, tool)
}
