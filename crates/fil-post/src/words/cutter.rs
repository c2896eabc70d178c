//! CUTTER/d,…: the cutter; its diameter is kept, nothing is written.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Remembers the diameter.
///
/// # Errors
/// No number.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    post.state.cutter = Some(form.required("the diameter")?);
    Ok(())
}
