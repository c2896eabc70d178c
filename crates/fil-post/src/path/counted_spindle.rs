//! Texts and functions of others that would make the control count another spindle.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ControlFamily};
use fil_machine::{FunctionCode, Letter, letters};

use crate::control::Control;
use crate::control::sinumerik::reader;
use crate::control::word_address::spindle::counted;
use crate::control_state::text;
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
    let chooses = |letter: Letter, code: Option<FunctionCode>| {
        letter == letters::M && code.is_some() && choices.contains(&code)
    };
    let by_value = |(letter, value): (Letter, f64)| chooses(letter, FunctionCode::of_value(value));
    let found = match operation {
        Operation::Function(letter, code) => chooses(*letter, Some(*code)),
        Operation::WithMotion(code) => chooses(letters::M, Some(*code)),
        Operation::Words(words) | Operation::Repeat(words) => {
            words.iter().any(|(letter, value, _)| by_value((*letter, *value)))
        }
        Operation::Text(text) if control.tables.family == ControlFamily::Sinumerik => {
            reader::transforms(text)
        }
        Operation::Text(text) => {
            text::read(text).is_some_and(|read| read.words.into_iter().any(by_value))
        }
        _ => false,
    };
    match found {
        true => PostCode::WordForm.err(
            "a function that makes the control count another spindle; SPINDL with SIDE, and \
             without it, does it",
        ),
        false => Ok(()),
    }
}
