//! INSERT text: the text goes to the tape as it is.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::commons::EMPTY;
use crate::letters::G;
use crate::locations as loc;
use crate::post::Post;

/// Writes the text as a block. What it does to the control is unknown, so
/// the next motion says its G code, plane and feed again.
///
/// # Errors
/// As `Post::write_line`.
pub fn handle(post: &mut Post, record: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    let numbered = matches!(post.commons.int(loc::SEQNO_ON_TEXT), 1 | 3);
    post.write_line(record.text.trim(), numbered)?;
    post.state.plane = None;
    post.state.force_feed = true;
    post.commons.set_last_output(G, EMPTY);
    Ok(())
}
