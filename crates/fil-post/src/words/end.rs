//! END: end of the program without rewinding it.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::locations as loc;
use crate::post::Post;
use crate::program;

/// Writes the user's end blocks and the end code.
///
/// # Errors
/// The machine has no such code.
pub fn handle(post: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    let code = post.code(loc::PROGRAM_END_CODE, "END")?;
    program::end(post, Some(code))
}
