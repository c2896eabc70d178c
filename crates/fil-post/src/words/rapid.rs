//! RAPID: the next motion is rapid, only that one.

use fil_diag::Result;

use crate::items::Items;
use crate::path::thread;
use crate::post::Post;

/// Marks the next motion.
///
/// # Errors
/// RAPID with items; RAPID between OP/THREAD and its points.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    thread::refuse_awaited(post)?;
    post.path.rapid = Some(post.control.block.cause);
    post.path.rapids += 1;
    Ok(())
}
