//! OP/THREAD,TURN,TPI,n: the GOTOs that follow cut a thread, each feed motion one
//! pass with the thread code.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use super::thread;
use crate::items::Items;
use crate::post::Post;

/// Remembers the lead. FEDRAT, LOADTL or OP/NOMORE end the thread.
///
/// # Errors
/// Another OP than THREAD with TPI; depth, cuts or starts, which ask for passes that
/// the post does not make.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.flag(w::NOMORE) {
        post.path.thread = None;
        return Ok(());
    }
    if !items.flag(w::THREAD) {
        return Err(items.error("only OP/THREAD is known"));
    }
    items.any_of(&[w::TURN, w::FACE]);
    let lead = thread::lead(post, items)?;
    if items.couplet(w::MULTRD)?.is_some_and(|starts| starts != 1.0) {
        return Err(items.error("a thread of several starts needs a FIL section"));
    }
    for word in [w::DEPTH, w::CUTS, w::FINCUT, w::CUTANG] {
        if items.couplet(word)?.is_some_and(|value| value != 0.0) {
            let name = items.name(word).to_string();
            return Err(items.error(format!(
                "{name} asks for passes that the post does not make; a FIL section must take it"
            )));
        }
    }
    items.deny_rest()?;
    post.path.thread = Some(lead);
    Ok(())
}
