//! Words that change the path or the frame and that this post does not carry
//! out. Passing over them would move the machine somewhere else, so they are
//! refused; a FIL section can take them.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Refuses the record.
///
/// # Errors
/// Always.
pub fn handle(_: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let form = Form::new(record, vocabulary);
    Err(form
        .error("it changes the path, and the post does not know how; a FIL section must take it"))
}
