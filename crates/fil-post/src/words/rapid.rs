//! RAPID: the next motion is rapid, only that one.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Marks the next motion.
///
/// # Errors
/// RAPID with items.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    Form::new(record, vocabulary).end()?;
    post.state.rapid = Some(post.block.cause);
    Ok(())
}
