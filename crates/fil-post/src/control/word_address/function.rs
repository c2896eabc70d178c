//! A preparatory or auxiliary function by its number (PREFUN, AUXFUN).

use fil_diag::Result;
use fil_machine::letters::{G, M};
use fil_machine::{FunctionCode, Letter};

use crate::control::Control;
use crate::control_state::TOOL_CHANGE;

/// Writes the function in a block of its own; the control learns what it means.
///
/// # Errors
/// A function that the address can't write; a tool change or another plane within
/// cutter compensation.
pub fn write(control: &mut Control, letter: Letter, code: FunctionCode) -> Result<()> {
    match letter {
        G => control.g(code),
        M => control.m(code),
        _ => control.word(letter, code.value())?,
    }
    let before = control.before_others()?;
    control.write_block()?;
    if letter == M && code == TOOL_CHANGE {
        control.state.doubt_axes();
    }
    control.refuse_in_compensation(before)
}
