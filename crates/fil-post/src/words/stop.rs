//! STOP and OPSTOP: the machine waits for its operator.

use fil_diag::Result;

use crate::items::Items;
use crate::operation::{Operation, Stop};
use crate::path::carry_out;
use crate::post::Post;

/// Stops.
///
/// # Errors
/// The machine has no such code.
pub fn stop(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    carry_out(post, Operation::Stop(Stop::Always))
}

/// Stops when the operator wants it.
///
/// # Errors
/// The machine has no such code.
pub fn opstop(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    carry_out(post, Operation::Stop(Stop::Optional))
}
