//! OP/THREAD,TURN,…,TPI,pitch,…: the GOTOs that follow cut a thread, each feed
//! motion one pass with the thread code.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::post::Post;

/// Remembers the pitch. FEDRAT, LOADTL or OP/NOMORE end the thread.
///
/// # Errors
/// Another OP than THREAD with TPI.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.flag(w::NOMORE) {
        post.state.thread = None;
        form.finish(post);
        return Ok(());
    }
    if !form.flag(w::THREAD) {
        return Err(form.error("only OP/THREAD is known"));
    }
    let pitch = form.couplet(w::TPI)?.filter(|pitch| *pitch > 0.0);
    post.due_to(&form);
    let pitch = pitch.ok_or_else(|| form.error("TPI and a pitch above zero are needed"))?;
    if form.couplet(w::MULTRD)?.is_some_and(|starts| starts > 1.0) {
        return Err(form.error("a thread of several starts needs a FIL section"));
    }
    for word in [w::TURN, w::FACE] {
        form.flag(word);
    }
    for word in [w::DEPTH, w::CUTS, w::FINCUT, w::CUTANG] {
        form.couplet(word)?;
    }
    form.finish(post);
    post.state.thread = Some((pitch, post.block.cause));
    Ok(())
}
