//! MODE/MILL and MODE/TURN: a mill-turn machine's way of writing X.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::commons::{EMPTY, Kind};
use crate::locations as loc;
use crate::post::Post;

/// Output scale of X when it is a diameter.
const DIAMETER: f64 = 2.0;

/// TURN writes X as a diameter (output scale 486 = 2), MILL as it is (1); X is
/// said again in the next block.
///
/// # Errors
/// Any other form.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let scale = match form.any_of(&[w::MILL, w::TURN]) {
        Some(w::TURN) => DIAMETER,
        Some(_) => 1.0,
        None => return Err(form.error("MILL or TURN is needed")),
    };
    form.end()?;
    let letter = post.machine.axis(0).letter;
    post.commons.set(Kind::Dbl, u32::from(loc::SCALE_X.0), scale)?;
    post.commons.set_last_output(letter, EMPTY);
    Ok(())
}
