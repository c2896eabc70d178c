//! SEQNO/n\[,INCR,m], SEQNO/ON, SEQNO/OFF: sequence numbers.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Sets the next number and the increment, or switches numbers on or off.
///
/// # Errors
/// A negative number or an increment that is not positive.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let increment = form.couplet(w::INCR)?;
    if increment.is_some_and(|increment| increment <= 0.0) {
        return Err(form.error("the increment must be positive"));
    }
    match form.any_of(&[w::ON, w::OFF]) {
        Some(word) => post.tape.switch_numbers(word == w::ON),
        None => {
            let next = form.required("the number")?;
            if next < 0.0 {
                return Err(form.error("the number must not be negative"));
            }
            post.tape.switch_numbers(true);
            post.tape.renumber(next, increment);
        }
    }
    form.end()?;
    Ok(())
}
