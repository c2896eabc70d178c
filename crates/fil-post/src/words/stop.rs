//! STOP and OPSTOP: the machine waits for its operator.

use fil_diag::Result;

use crate::control::Held;
use crate::items::Items;
use crate::operation::{Operation, Stop};
use crate::path::{carry_out, way_home};
use crate::post::Post;

/// Stops.
///
/// # Errors
/// The machine has no such code.
pub fn stop(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    make(post, Stop::Always)
}

/// Stops when the operator wants it.
///
/// # Errors
/// The machine has no such code.
pub fn opstop(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    make(post, Stop::Optional)
}

/// Stops, or leaves the stop to a tool change right behind it, where the machine or its operator stops
/// there anyway.
fn make(post: &mut Post, stop: Stop) -> Result<()> {
    let waits_for_operator = std::mem::take(&mut post.path.ahead.change_by_hand);
    let control = &mut post.control;
    if waits_for_operator || way_home::stops_at_change(control) == Some(stop) {
        control.tools.held.push((Held::Stop(stop), control.block.cause.whole()));
        return Ok(());
    }
    carry_out(post, Operation::Stop(stop))
}
