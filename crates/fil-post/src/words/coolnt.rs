//! COOLNT/ON|FLOOD|MIST|THRU|OFF[,LOW|HIGH].

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::items::Items;
use crate::operation::{Coolant, Operation};
use crate::path::carry_out;
use crate::post::Post;

/// Switches the coolant.
///
/// # Errors
/// A kind of coolant that is not known.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let pressure = items.any_of(&[w::LOW, w::MEDIUM, w::HIGH]);
    let kind = items.any_of(&[w::ON, w::OFF, w::FLOOD, w::MIST, w::THRU]);
    post.due_to(items);
    let coolant = match (kind, pressure) {
        (Some(w::ON), None) => Coolant::On,
        (Some(w::OFF), None) => Coolant::Off,
        (Some(w::MIST), None) => Coolant::Mist,
        (Some(w::FLOOD), None) => Coolant::Flood,
        (Some(w::FLOOD), Some(w::HIGH)) => Coolant::FloodHigh,
        (Some(w::FLOOD), Some(w::LOW)) => Coolant::FloodLow,
        (Some(w::THRU), None | Some(w::HIGH)) => Coolant::Through,
        (Some(w::THRU), Some(w::LOW)) => Coolant::ThroughLow,
        _ => return Err(items.error("ON, OFF, MIST, FLOOD or THRU, with LOW or HIGH, is needed")),
    };
    items.deny_rest()?;
    carry_out(post, Operation::Coolant(coolant))
}
