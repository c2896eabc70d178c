//! UNITS/MM, UNITS/INCHES: the unit of the CL file and of the tape.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;
use crate::program;

/// Sets the unit; once the program has started, its code is written at once.
///
/// # Errors
/// Neither MM nor INCHES.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let metric = match form.any_of(&[w::MM, w::INCHES]) {
        Some(w::MM) => true,
        Some(_) => false,
        None => return Err(form.error("MM or INCHES is needed")),
    };
    form.finish(post);
    let changes = metric != post.state.metric;
    post.state.metric = metric;
    if changes && post.state.started {
        post.machine.refresh(&post.commons, metric)?;
        program::units_code(post);
        return post.write_block();
    }
    Ok(())
}
