//! ARCSLP/ON, ARCSLP/OFF: blocks of a helix say how far it rises.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations::{self as loc, CircleHelixWord};

use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Switches the word of the rise on or off.
///
/// # Errors
/// Neither ON nor OFF; a number, whose meaning is not published.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let on = match items.any_of(&[w::ON, w::OFF]) {
        Some(word) => word == w::ON,
        None => return Err(items.error("ON or OFF is needed")),
    };
    items.deny_rest()?;
    post.control.helix_words = on;
    let commons = &post.control.commons;
    if on && commons.read(loc::CIRCLE_HELIX_WORD) == CircleHelixWord::NoK {
        let message = "ARCSLP/ON: the machine has no word for it (circle.helix_word)".to_string();
        post.warn(PostCode::IgnoredPart, message);
    }
    Ok(())
}
