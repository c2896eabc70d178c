//! `$$-> KEY / …`: what Creo says in comments. CUTTER matters to the post, and a CSYS that is
//! another one than before ([`csys`](super::csys)); the rest (FEATNO, MFGNO, END, …) is
//! information for people.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use super::cutter;
use crate::items::Items;
use crate::post::Post;

/// Takes the cutter's diameter; all else passes.
///
/// # Errors
/// As [`cutter::handle`].
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.major() == w::CUTTER { cutter::handle(post, items) } else { Ok(()) }
}
