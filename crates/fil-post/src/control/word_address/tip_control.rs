//! TCPC: G43.4 H, or G43.5 H where the direction of the tool is a vector, and G49.

use fil_diag::Result;
use fil_machine::letters::H;
use fil_machine::{FunctionCode, locations as loc};

use super::modes;
use crate::cause::Cause;
use crate::control::Control;
use crate::control_state::modal;
use crate::errors::PostCode;

/// Ends all length offsets of the controls that have tool-tip control.
const CANCEL: FunctionCode = FunctionCode::whole(49);

/// Takes up tool-tip control with the length offset of a tool.
///
/// # Errors
/// The machine has no code for it; an offset that does not fit.
pub fn begin(control: &mut Control, (offset, cause): (i64, Cause)) -> Result<()> {
    let (at, name) = match control.tables.tip_vectors {
        true => (loc::ROTARY_VECTOR_CODE, "rotary.vector_code"),
        false => (loc::ROTARY_TIP_CODE, "rotary.tip_code"),
    };
    let tenths = control.commons.int_opt(at);
    let Some(tenths) = tenths.and_then(|tenths| u32::try_from(tenths).ok()) else {
        return PostCode::NoCode.err(format!("{name} has no code for TCPC"));
    };
    modes::before_length(control)?;
    control.because(cause, |control| {
        control.g_of_record(FunctionCode::tenths(tenths));
        control.word(H, offset as f64)?;
        control.write_block()
    })
}

/// Gives tool-tip control up, and any length offset.
///
/// # Errors
/// As [`Control::write_block`].
pub fn end(control: &mut Control) -> Result<()> {
    let waiting = control.block.take();
    let code = control.code_if_any(loc::TOOL_LENGTH_CANCEL_CODE).unwrap_or(CANCEL);
    control.g_of_record(code);
    control.write_block()?;
    control.state.set(modal::TCP, false);
    control.block = waiting;
    Ok(())
}
