//! REWIND: end of the program, back to its start.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::locations as loc;
use crate::post::Post;
use crate::program;

/// Writes the user's end blocks and the rewind code.
///
/// # Errors
/// The machine has no such code.
pub fn handle(post: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    let code = post.code(loc::PROGRAM_REWIND_CODE, "REWIND")?;
    program::end(post, Some(code))
}
