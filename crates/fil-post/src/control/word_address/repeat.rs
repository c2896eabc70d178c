//! REPEAT: words that each motion block carries.

use fil_diag::Result;
use fil_machine::{FunctionCode, Letter, letters};

use crate::cause::Cause;
use crate::control::Control;
use crate::control_state::Meaning;
use crate::errors::PostCode;

/// Sets the words, or ends all of them. What they left on the tape is not where the
/// post believes the axes and the feed to be, so the next motion says these again.
///
/// # Errors
/// A letter the machine does not write, or a function that changes a mode.
pub fn set(control: &mut Control, words: Vec<(Letter, f64, Cause)>) -> Result<()> {
    if words.is_empty() {
        control.ended_repeats.extend(std::mem::take(&mut control.repeats).into_keys());
        return Ok(());
    }
    for (letter, value, cause) in words {
        control.require_letter(letter)?;
        refuse_mode(control, letter, value)?;
        control.ended_repeats.retain(|ended| *ended != letter);
        control.repeats.insert(letter, (value, cause));
    }
    Ok(())
}

/// Refuses a function that changes a mode: the post would count on the old one.
fn refuse_mode(control: &Control, letter: Letter, value: f64) -> Result<()> {
    let meaning = FunctionCode::of_value(value).map(|code| control.meaning(code));
    if letter == letters::G && meaning != Some(Meaning::OneBlock) {
        return PostCode::WordForm
            .err(format!("REPEAT: G{value} in each motion would change a mode"));
    }
    Ok(())
}

/// Puts what a REPEAT that is over left on the tape in doubt.
#[cold]
pub fn doubt_ended(control: &mut Control) {
    for letter in std::mem::take(&mut control.ended_repeats) {
        control.state.doubt(letter);
    }
}

/// Writes the block under construction with the words of REPEAT whose letters it
/// does not have. The last output values stay those of the motion.
///
/// # Errors
/// As [`Control::write_block`].
pub fn write_with_repeats(control: &mut Control) -> Result<()> {
    let mut kept = Vec::new();
    for (letter, (value, cause)) in control.repeats.clone() {
        if !control.block_has(letter) {
            kept.push((letter, control.commons.last_output(letter)));
            control.because(cause, |control| control.word(letter, value))?;
        }
    }
    control.write_block()?;
    for (letter, value) in kept {
        control.commons.set_last_output(letter, value);
    }
    Ok(())
}
