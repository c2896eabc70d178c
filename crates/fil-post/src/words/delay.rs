//! DELAY/t: a dwell of t seconds; DELAY/REV,n: of n revolutions.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::commons::{Dbl, EMPTY};
use crate::errors::PostCode;
use crate::locations as loc;
use crate::post::Post;

/// Writes the dwell block.
///
/// # Errors
/// No time, or the machine has no dwell.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let revolutions = form.couplet(w::REV)?;
    form.flag(w::DWELL);
    let value = match revolutions {
        Some(turns) => in_revolutions(post, turns)?,
        None => {
            let seconds = form.required("the time in seconds")?;
            in_seconds(post, seconds)
        }
    };
    post.due_to(&form);
    form.end()?;
    write(post, value)
}

/// Writes a dwell block; `value` is in the control's unit.
///
/// # Errors
/// The machine has no dwell, or the value does not fit.
pub fn write(post: &mut Post, value: f64) -> Result<(), Box<Diag>> {
    let letter = letter_of(post)?;
    let code = post.code(loc::DWELL_CODE, "a dwell")?;
    post.block.g_of_record(code);
    post.word(letter, value)?;
    post.write_block()?;
    post.commons.set_last_output(letter, EMPTY);
    Ok(())
}

/// The address of a dwell.
///
/// # Errors
/// The machine has none.
fn letter_of(post: &Post) -> Result<u8, Box<Diag>> {
    post.letter(loc::DWELL_ADDRESS, "the address of a dwell")
}

/// Seconds in the control's unit (DBLCOM 980: 1000 for milliseconds, 0 as they
/// are), brought within its range.
pub fn in_seconds(post: &mut Post, seconds: f64) -> f64 {
    let factor = post.commons.dbl_opt(loc::DWELL_UPM_FACTOR).filter(|factor| *factor > 0.0);
    within(post, seconds, (loc::DWELL_UPM_MIN, loc::DWELL_UPM_MAX)) * factor.unwrap_or(1.0)
}

fn in_revolutions(post: &mut Post, turns: f64) -> Result<f64, Box<Diag>> {
    let factor = post.commons.dbl_opt(loc::DWELL_UPR_FACTOR).filter(|factor| *factor > 0.0);
    let factor = factor.ok_or_else(|| {
        Box::new(Diag::new(PostCode::NoCode, "the machine can't dwell in revolutions"))
    })?;
    Ok(within(post, turns, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX)) * factor)
}

fn within(post: &mut Post, amount: f64, (min, max): (Dbl, Dbl)) -> f64 {
    let low = post.commons.dbl_opt(min).unwrap_or(0.0);
    let high = post.commons.dbl_opt(max).filter(|max| *max > 0.0).unwrap_or(f64::MAX);
    let within = amount.max(low).min(high);
    if within != amount {
        post.warn(PostCode::Clamped, format!("dwell {amount} became {within}"));
    }
    within
}
