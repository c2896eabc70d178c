//! STOP and OPSTOP: the machine waits for its operator.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::commons::Int;
use crate::locations as loc;
use crate::post::Post;

/// Writes the stop code.
///
/// # Errors
/// A code that does not fit.
pub fn stop(post: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    write(post, loc::PROGRAM_STOP_CODE, "STOP")
}

/// Writes the optional stop code.
///
/// # Errors
/// A code that does not fit.
pub fn opstop(post: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    write(post, loc::PROGRAM_OPSTOP_CODE, "OPSTOP")
}

fn write(post: &mut Post, code: Int, what: &str) -> Result<(), Box<Diag>> {
    post.flush_pending()?;
    let code = post.code(code, what)?;
    post.block.m(code);
    post.write_block()
}
