//! COOLNT/ON|FLOOD|MIST|THRU|OFF[,LOW|HIGH].

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::locations as loc;
use crate::post::Post;
use crate::state::Placement;

/// Writes the coolant code, in a block of its own or with a motion; OFF at once.
///
/// # Errors
/// A kind of coolant that is not known.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let pressure = form.any_of(&[w::LOW, w::MEDIUM, w::HIGH]);
    let kind = form.any_of(&[w::ON, w::OFF, w::FLOOD, w::MIST, w::THRU]);
    post.due_to(&form);
    let location = match (kind, pressure) {
        (Some(w::ON), None) => loc::COOLANT_DEFAULT_CODE,
        (Some(w::OFF), None) => loc::COOLANT_OFF_CODE,
        (Some(w::MIST), None) => loc::COOLANT_MIST_CODE,
        (Some(w::FLOOD), None) => loc::COOLANT_FLOOD_CODE,
        (Some(w::FLOOD), Some(w::HIGH)) => loc::COOLANT_FLOOD_HIGH_CODE,
        (Some(w::FLOOD), Some(w::LOW)) => loc::COOLANT_FLOOD_LOW_CODE,
        (Some(w::THRU), None | Some(w::HIGH)) => loc::COOLANT_THRU_HIGH_CODE,
        (Some(w::THRU), Some(w::LOW)) => loc::COOLANT_THRU_LOW_CODE,
        _ => return Err(form.error("ON, OFF, MIST, FLOOD or THRU, with LOW or HIGH, is needed")),
    };
    form.end()?;
    match post.commons.int_opt(location) {
        Some(code) => post.block.m(code),
        None => post.warn_no_code("this coolant"),
    }
    if kind == Some(w::OFF) {
        let words = post.block.take();
        post.flush_pending()?;
        post.block = words;
        return post.write_block();
    }
    post.place_block(Placement::from_setting(post.commons.int(loc::COOLANT_PLACEMENT)))
}
