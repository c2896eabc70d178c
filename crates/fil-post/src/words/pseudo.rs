//! `$$-> KEY / …`: what Creo says in comments. Only CUTTER matters to the
//! post; the rest (FEATNO, CSYS, MFGNO, END, …) is information for people.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::cutter;
use crate::post::Post;

/// Takes the cutter's diameter; all else passes.
///
/// # Errors
/// As [`cutter::handle`].
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    if record.major == w::CUTTER { cutter::handle(post, record, vocabulary) } else { Ok(()) }
}
