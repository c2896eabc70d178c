//! OP/THREAD,TURN,TPI,n: the GOTOs that follow cut a thread, each feed motion one
//! pass with the thread code. With DEPTH and CUTS the two GOTOs that follow are the ends of
//! its crest, and the thread is cut in all its passes.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use super::csys;
use super::thread::{lead, springs_of, starts, usual_clearance};
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::{Lead, Target, Thread, ThreadPasses, ThreadSide};
use crate::path::{Awaited, Passes, thread};
use crate::post::Post;

/// Remembers the lead, or what the whole thread is. FEDRAT, LOADTL or OP/NOMORE end it.
///
/// # Errors
/// Another OP than THREAD with a lead; CUTS without DEPTH and the other way round; several
/// starts of a thread that is cut pass by pass.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    thread::end(post)?;
    if items.flag(w::NOMORE) {
        return Ok(());
    }
    if !items.flag(w::THREAD) {
        return Err(items.error("only OP/THREAD is known"));
    }
    let on_face = items.any_of(&[w::TURN, w::FACE]) == Some(w::FACE);
    let pitch = lead(post, items)?;
    let starts = starts(items, w::MULTRD)?;
    let given = |value: Option<f64>| value.filter(|value| *value != 0.0);
    let depth = given(items.couplet(w::DEPTH)?);
    let cuts = given(items.couplet(w::CUTS)?);
    let springs = items.couplet(w::FINCUT)?;
    let direction = items.couplet(w::CUTANG)?;
    items.deny_rest()?;
    let (depth, cuts) = match (depth, cuts) {
        (Some(depth), Some(cuts)) => (depth, cuts),
        (None, None) => {
            if starts != 1 || given(springs).is_some() || given(direction).is_some() {
                return Err(items.error("MULTRD, FINCUT and CUTANG need DEPTH and CUTS"));
            }
            post.path.thread.passes = Some(Passes::new(pitch, 0.0));
            return Ok(());
        }
        _ => return PostCode::Thread.err("OP/THREAD needs DEPTH and CUTS, or neither"),
    };
    if cuts.fract() != 0.0 || !(1.0..=1000.0).contains(&cuts) {
        return PostCode::Thread.err(format!("{cuts} passes"));
    }
    csys::settle(post, post.path.axis.given)?;
    let from =
        thread::stands_at(post).map(|point| Target { point, axis: post.path.axis.given, word: 0 });
    let nowhere = Target { point: Default::default(), axis: post.path.axis.given, word: 0 };
    let thread = Thread {
        crest: [nowhere; 2],
        side: ThreadSide::Outside,
        lead: Lead { value: pitch.value * f64::from(starts), ..pitch },
        starts,
        depth,
        passes: ThreadPasses::Count(cuts as u32),
        springs: springs_of(post, items, springs)?,
        angle: 0.0,
        clearance: usual_clearance(post),
    };
    post.path.thread.passes = Some(Passes::new(pitch, 0.0));
    let awaited = Awaited { thread, on_face, direction, from, start: None, is_cut: false };
    post.path.thread.awaited = Some(Box::new(awaited));
    Ok(())
}
