//! INSERT text: the text goes to the tape as it is.

use fil_diag::Result;

use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Writes the text as a block; the control learns from it what it can read.
///
/// # Errors
/// A character that must not reach the tape.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let blocks = post.control.read_insert(items.text());
    items.deny_rest()?;
    carry_out(post, Operation::Text(blocks))
}
