//! A preparatory or auxiliary function by its number (PREFUN, AUXFUN).

use fil_diag::Result;
use fil_machine::{FunctionCode, Letter};

use crate::control::Control;

/// Writes the function in a block of its own; the control learns what it means.
///
/// # Errors
/// A function that the address can't write; a tool change or another plane within
/// cutter compensation.
pub fn write(control: &mut Control, letter: Letter, code: FunctionCode) -> Result<()> {
    control.write_words(&[(letter, code.value(), control.block.cause)])
}
