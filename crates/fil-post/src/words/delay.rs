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
    let (amount, factor, range) = match revolutions {
        Some(turns) => (turns, loc::DWELL_UPR_FACTOR, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX)),
        None => {
            let seconds = form.required("the time in seconds")?;
            (seconds, loc::DWELL_UPM_FACTOR, (loc::DWELL_UPM_MIN, loc::DWELL_UPM_MAX))
        }
    };
    form.finish(post);
    let value = dwell_value(post, amount, factor, range)?;
    let letter = letter_of(post)?;
    let code = post.code(loc::DWELL_CODE, "a dwell")?;
    post.block.g(code);
    post.word(letter, value)?;
    post.write_block()?;
    post.commons.set_last_output(letter, EMPTY);
    Ok(())
}

/// The address of a dwell.
///
/// # Errors
/// The machine has none.
pub fn letter_of(post: &Post) -> Result<u8, Box<Diag>> {
    let letter = post.code(loc::DWELL_ADDRESS, "the address of a dwell")?;
    Ok(letter.clamp(1, 26) as u8)
}

/// Seconds or revolutions in the control's unit, brought within its range.
fn dwell_value(
    post: &mut Post,
    amount: f64,
    factor: Dbl,
    (min, max): (Dbl, Dbl),
) -> Result<f64, Box<Diag>> {
    let factor = post.commons.dbl_opt(factor).filter(|factor| *factor > 0.0).ok_or_else(|| {
        Box::new(Diag::new(PostCode::NoCode, "the machine can't dwell in this unit"))
    })?;
    let low = post.commons.dbl_opt(min).unwrap_or(0.0);
    let high = post.commons.dbl_opt(max).filter(|max| *max > 0.0).unwrap_or(f64::MAX);
    let within = amount.max(low).min(high);
    if within != amount {
        post.warn(PostCode::Clamped, format!("dwell {amount} became {within}"));
    }
    Ok(within * factor)
}
