//! MULTAX[/ON|OFF] and TLAXIS/i,j,k: tool axes in GOTO.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use nalgebra::Vector3;

use super::form::Form;
use crate::post::Post;

/// OFF brings the axis back to 0,0,1; ON changes nothing, a GOTO with an axis
/// of its own is always taken by it.
///
/// # Errors
/// None.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let off = form.flag(w::OFF);
    form.flag(w::ON);
    form.end()?;
    if off {
        post.state.axis = Vector3::z();
    }
    Ok(())
}

/// Sets the tool axis of the points to come.
///
/// # Errors
/// Other than three numbers.
pub fn tlaxis(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let [i, j, k] = form.numbers()[..] else {
        return Err(form.error("three components of the tool axis are needed"));
    };
    form.end()?;
    post.state.axis = Vector3::new(i, j, k);
    Ok(())
}
