//! RAPID: the next motion is rapid, only that one.

use fil_diag::Result;

use crate::control::needs::Act;
use crate::items::Items;
use crate::post::Post;

/// Marks the next motion.
///
/// # Errors
/// RAPID with items; RAPID between OP/THREAD and its points.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    post.require(Act::Word)?;
    post.path.rapid = Some(post.control.block.cause);
    post.path.rapids += 1;
    Ok(())
}
