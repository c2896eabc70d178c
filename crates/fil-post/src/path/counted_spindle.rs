//! Texts and functions of others that would make the control count another spindle.

use fil_diag::Result;
use fil_machine::letters;
use fil_machine::locations as loc;

use super::functions_of_others;
use crate::control::Control;
use crate::control::sinumerik::reader;
use crate::control::word_address::spindle::counted;
use crate::errors::PostCode;
use crate::operation::Operation;

/// Refuses them: SPINDL chooses the spindle, and knows what that one does.
///
/// # Errors
/// A text, POSTN, PREFUN or AUXFUN with such a statement or code.
pub(super) fn refuse_choices_of_others(control: &Control, operation: &Operation) -> Result<()> {
    if !counted::is_chosen(control) {
        return Ok(());
    }
    let choices = [loc::SPINDLE_SIDE_MASTER_CODE, loc::SPINDLE_MAIN_MASTER_CODE]
        .map(|at| control.code_if_any(at));
    let found = match operation {
        Operation::Text(blocks) if control.can().mode_statements => {
            blocks.iter().any(reader::transforms)
        }
        _ => functions_of_others::has(operation, |letter, code| {
            letter == letters::M && choices.contains(&Some(code))
        }),
    };
    match found {
        true => PostCode::WordForm.err(
            "a function that makes the control count another spindle; SPINDL with SIDE, and \
             without it, does it",
        ),
        false => Ok(()),
    }
}
