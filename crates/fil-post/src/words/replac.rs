//! REPLAC/'old','new',…: texts of the tape that are written otherwise; REPLAC/OFF.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Has texts replaced in each line of the tape that comes, or ends that.
///
/// # Errors
/// Texts that are not in pairs, an empty text to look for, a character that must not reach
/// the tape; a control whose blocks are no words.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.flag(w::OFF) {
        items.deny_rest()?;
        post.control.end_replacing();
        return Ok(());
    }
    let texts = items.texts();
    items.deny_rest()?;
    if texts.is_empty() || !texts.len().is_multiple_of(2) {
        return Err(items.error("texts come in pairs, 'old','new'"));
    }
    if !post.control.can().edits_lines {
        return PostCode::Family.err("REPLAC: lines of Klartext are not edited");
    }
    for pair in texts.chunks_exact(2) {
        if pair[0].trim().is_empty() {
            return Err(items.error("an empty text can't be looked for"));
        }
        post.control.replace(pair[0], pair[1])?;
    }
    Ok(())
}
