//! CUTTER/d,…: the cutter; its diameter is kept, nothing is written.

use fil_diag::Result;

use crate::items::Items;
use crate::post::Post;

/// Remembers the diameter; the other measures of an APT cutter do not change the
/// program.
///
/// # Errors
/// No number.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    post.path.cutter = Some(items.required("the diameter")?);
    items.numbers();
    Ok(())
}
