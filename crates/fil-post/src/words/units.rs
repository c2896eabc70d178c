//! UNITS/MM, UNITS/INCHES: the unit of the CL file and of the tape.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::locations as loc;
use crate::post::Post;
use crate::program;

/// Sets the unit; once the program has started, its code is written at once.
///
/// # Errors
/// Neither MM nor INCHES, or a unit the machine does not take.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let metric = match form.any_of(&[w::MM, w::INCHES]) {
        Some(w::MM) => true,
        Some(_) => false,
        None => return Err(form.error("MM or INCHES is needed")),
    };
    let only = match post.commons.int(loc::UNITS_MODE) {
        1 => Some(false),
        2 => Some(true),
        _ => None,
    };
    if only.is_some_and(|only| only != metric) {
        return Err(form.error("the machine takes the other unit only (units.mode)"));
    }
    form.end()?;
    let changes = metric != post.state.metric;
    post.state.metric = metric;
    if changes && post.state.started {
        post.machine.refresh(&post.commons, metric)?;
        program::units_code(post);
        return post.write_block();
    }
    Ok(())
}
