//! OPSKIP/ON, OPSKIP/OFF: blocks the operator can skip.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::control::needs::Act;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Switches the block-delete character on or off.
///
/// # Errors
/// Neither ON nor OFF; OP/THREAD still waits for its points.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let on = match items.any_of(&[w::ON, w::OFF]) {
        Some(word) => word == w::ON,
        None => return Err(items.error("ON or OFF is needed")),
    };
    items.deny_rest()?;
    post.require(Act::Word)?;
    if let Some(cycle) = &mut post.path.cycle {
        cycle.in_force = None;
    }
    carry_out(post, Operation::Skip(on))
}
