//! OPSKIP/ON, OPSKIP/OFF: blocks the operator can skip.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Switches the block-delete character on or off.
///
/// # Errors
/// Neither ON nor OFF.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    post.tape.skip = match form.any_of(&[w::ON, w::OFF]) {
        Some(word) => (word == w::ON).then_some(post.block.cause),
        None => return Err(form.error("ON or OFF is needed")),
    };
    form.end()?;
    Ok(())
}
