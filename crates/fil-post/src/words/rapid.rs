//! RAPID: the next motion is rapid, only that one.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Marks the next motion.
///
/// # Errors
/// None.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    if !record.data.is_empty() {
        Form::new(record, vocabulary).finish(post);
    }
    post.state.rapid = true;
    Ok(())
}
