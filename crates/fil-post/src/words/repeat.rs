//! REPEAT/letter,value,… and REPEAT/OFF: words added to each motion block.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use super::postn::letter_number;
use crate::block::no_address;
use crate::cause::Cause;
use crate::post::Post;

/// Sets or clears the words; a motion block that has a word of that letter is
/// left as it is.
///
/// # Errors
/// Any other form, or a letter the machine does not write.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.flag(w::OFF) {
        post.state.repeat.clear();
        form.end()?;
        return Ok(());
    }
    let numbers = form.numbered();
    if numbers.is_empty() || !numbers.len().is_multiple_of(2) {
        return Err(form.error("pairs of a letter and a value, or OFF, are needed"));
    }
    for pair in numbers.chunks(2) {
        let [(letter, _), (value, word)] = [pair[0], pair[1]];
        let letter = letter_number(letter)
            .ok_or_else(|| form.error(format!("{letter} is no letter, A is 1 and Z is 26")))?;
        if post.machine.addresses.position(letter).is_none() {
            return Err(no_address(letter));
        }
        post.state.repeat.insert(letter, (value, Cause { word, ..post.block.cause }));
    }
    form.end()?;
    Ok(())
}
