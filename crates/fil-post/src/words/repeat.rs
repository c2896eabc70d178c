//! REPEAT/letter,value,… and REPEAT/OFF: words added to each motion block.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use super::postn::letters_and_values;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Sets or clears the words; a motion block that has a word of that letter is
/// left as it is.
///
/// # Errors
/// Any other form, or a letter the machine does not write.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let off = items.flag(w::OFF);
    let words = letters_and_values(post, items)?;
    items.deny_rest()?;
    if off != words.is_empty() {
        return Err(items.error("pairs of a letter and a value, or OFF, are needed"));
    }
    carry_out(post, Operation::Repeat(words))
}
