//! A preparatory or auxiliary function by its number (PREFUN, AUXFUN).

use fil_diag::Result;
use fil_machine::{FunctionCode, Letter, letters, locations as loc};

use crate::control::{Control, Function};
use crate::control_state::{Meaning, TOOL_CHANGE};
use crate::errors::PostCode;

/// Writes the function in a block of its own; the control learns what it means.
///
/// # Errors
/// A function that the address can't write; a tool change or another plane within
/// cutter compensation.
pub fn write(control: &mut Control, letter: Letter, code: FunctionCode) -> Result<()> {
    control.write_words(&[(letter, code.value(), control.block.cause)])
}

/// Auxiliary functions that stop, end or steer the program, or change the tool: what
/// they do to the motion of their block is not the same on each control.
const ALONE: [u16; 8] = [0, 1, 2, 30, 97, 98, 99, 198];

/// Keeps a function for the next motion.
///
/// # Errors
/// A function that must stand in a block of its own.
pub fn with_motion(control: &mut Control, letter: Letter, code: FunctionCode) -> Result<()> {
    control.begin()?;
    if letter == letters::G {
        if control.meaning(code) != Meaning::OneBlock {
            return PostCode::WordForm.err(format!(
                "PREFUN: G{code} with NEXT; a function that says how a motion goes or counts stands \
                 in a block of its own"
            ));
        }
        control.g_of_record(code);
        control.keep_for_motion(Function::Auxiliary);
        return Ok(());
    }
    let change = control.code_if_any(loc::TOOL_CHANGE_CODE).unwrap_or(TOOL_CHANGE);
    let alone = ALONE.into_iter().map(FunctionCode::whole).chain([TOOL_CHANGE, change]);
    if alone.into_iter().any(|one| one == code) {
        return PostCode::WordForm.err(format!(
            "AUXFUN: M{code} with NEXT; a function that stops, ends or controls the program, or changes the tool, needs its own block"
        ));
    }
    control.m(code);
    control.keep_for_motion(Function::Auxiliary);
    Ok(())
}
