//! RAPID: the next motion is rapid, only that one.

use fil_diag::Result;

use crate::items::Items;
use crate::post::Post;

/// Marks the next motion.
///
/// # Errors
/// RAPID with items; RAPID between a CIRCLE and its end.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    post.path.rapid = Some(post.control.block.cause);
    Ok(())
}
