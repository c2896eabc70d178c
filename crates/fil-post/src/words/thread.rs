//! Thread passes, and THREAD/…: G32 or G33 with the pitch as feed.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::commons::EMPTY;
use crate::letters::F;
use crate::locations as loc;
use crate::motion::{Position, XY, Z};
use crate::post::Post;

/// THREAD/TPI,pitch: the feed motions that follow are thread passes, as after
/// OP/THREAD. THREAD/AUTO asks for a whole cycle whose form is the machine's
/// own, so it is left to a FIL section.
///
/// # Errors
/// THREAD/AUTO, or no pitch.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.any_of(&[w::OFF, w::NOMORE]).is_some() {
        post.state.thread = None;
        form.finish(post);
        return Ok(());
    }
    if form.flag(w::AUTO) {
        return Err(form.error("AUTO needs a FIL section that writes the machine's thread cycle"));
    }
    let pitch = form.couplet(w::TPI)?.filter(|pitch| *pitch > 0.0);
    post.due_to(&form);
    let pitch = pitch.ok_or_else(|| form.error("TPI and a pitch above zero are needed"))?;
    form.flag(w::TURN);
    form.finish(post);
    post.state.thread = Some((pitch, post.block.cause));
    Ok(())
}

/// One pass to a position: thread code, axis words, pitch.
///
/// # Errors
/// The machine has no thread code; a value that does not fit.
pub fn cut(post: &mut Post, position: &Position) -> Result<(), Box<Diag>> {
    let Some((pitch, cause)) = post.state.thread else { return Ok(()) };
    if post.axis_words(position, XY | Z)? {
        let code = post.code(loc::THREAD_CODE, "a thread")?;
        post.because(cause.whole(), |post| post.motion_code(code, false));
        post.because(cause, |post| post.word(F, pitch))?;
        post.write_motion()?;
        post.commons.set_last_output(F, EMPTY);
    }
    Ok(())
}
