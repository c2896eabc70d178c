//! REPEAT: axes and M functions that each straight line carries, and a feed in each motion
//! at feed.

use fil_diag::Result;
use fil_machine::letters::{F, M};
use fil_machine::{FunctionCode, Letter};

use super::phrase::Head;
use super::refuse_auxiliary;
use crate::cause::Cause;
use crate::control::{Control, word_address};
use crate::errors::PostCode;
use crate::operation::Operation;

/// Letters of axes.
const AXES: &[u8] = b"ABCUVWXYZ";

/// Sets the words, or ends all of them.
///
/// # Errors
/// Words other than axes, F and M functions; a letter that the machine does not write.
pub fn set(control: &mut Control, words: Vec<(Letter, f64, Cause)>) -> Result<()> {
    for (letter, value, _) in &words {
        match *letter {
            M => match FunctionCode::of_value(*value) {
                Some(code) => refuse_auxiliary(code)?,
                None => return PostCode::Family.err(format!("REPEAT: M{value} is no function")),
            },
            F => {}
            letter if AXES.contains(&letter.byte()) => {}
            letter => {
                return PostCode::Family.err(format!(
                    "REPEAT: {letter} in each line; a line of Klartext takes axes, F and M of others"
                ));
            }
        }
    }
    word_address::write(control, Operation::Repeat(words))
}

/// Adds the words whose letters the line does not have; FMAX stands in the place of F. Gives the
/// letters of axes and F with their last output values, which stay those of the motion.
///
/// # Errors
/// An axis in an arc or in the line of a hole.
pub fn add(control: &mut Control) -> Result<Vec<(Letter, f64)>> {
    let mut kept = Vec::new();
    control.repeat.written.clear();
    for (letter, (value, cause)) in control.repeat.words.clone() {
        if let Some(code) = FunctionCode::of_value(value).filter(|_| letter == M) {
            let stands = control.block.m_codes().iter().any(|(other, _)| *other == code);
            if !stands {
                control.block.m(code, cause);
            }
        } else if !control.block_has(letter) {
            let phrase = control.klartext.phrase;
            if letter == F && (phrase.rapid || phrase.calls_cycle) {
                continue;
            }
            if letter != F && (phrase.head != Head::Line || phrase.calls_cycle) {
                let what = if phrase.calls_cycle { "the line of a hole" } else { "an arc" };
                return PostCode::WordForm
                    .err(format!("REPEAT: {letter} means something else in {what}"));
            }
            kept.push((letter, control.commons.last_output(letter)));
            control.repeat.written.push((letter, value));
            control.because(cause, |control| control.word(letter, value))?;
        }
    }
    Ok(kept)
}
