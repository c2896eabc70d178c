//! FINI: end of the CL file. Creo writes no END, so FINI ends the program too.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::errors::PostCode;
use crate::locations as loc;
use crate::post::Post;
use crate::program;

/// Ends the program.
///
/// # Errors
/// A CIRCLE still waits for its end point.
pub fn handle(post: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    finish(post)
}

/// Ends the program once: the rewind code, or the end code on a machine
/// without one, unless END or REWIND came before.
///
/// # Errors
/// As [`handle`].
pub fn finish(post: &mut Post) -> Result<(), Box<Diag>> {
    if post.state.arc.is_some() {
        return Err(Box::new(Diag::new(PostCode::ArcEnd, "no GOTO followed the last CIRCLE")));
    }
    if post.state.ended {
        return Ok(());
    }
    let code = post
        .commons
        .int_opt(loc::PROGRAM_REWIND_CODE)
        .or_else(|| post.commons.int_opt(loc::PROGRAM_END_CODE));
    program::end(post, code)
}
