//! END, REWIND, FINI: the end of the program. Creo writes no END, so FINI ends the
//! program too.

use fil_diag::Result;

use crate::control::word_address::spindle;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::{CountedSpindle, End, Operation, Spindle};
use crate::path::sense::Verdict;
use crate::path::{Choice, carry_out};
use crate::path::{thread, way_home};
use crate::post::Post;

/// END: end of the program without rewinding it.
///
/// # Errors
/// The machine has no such code; a CIRCLE waits for its end.
pub fn end(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    finish(post, End::Stay)
}

/// REWIND\[/0]: end of the program, back to its start.
///
/// # Errors
/// As [`end`].
pub fn rewind(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.number().is_some_and(|count| count != 0.0) {
        return Err(items.error("only REWIND and REWIND/0 are known"));
    }
    items.deny_rest()?;
    finish(post, End::Rewind)
}

/// FINI: end of the CL file.
///
/// # Errors
/// As [`end`].
pub fn fini(post: &mut Post, items: &mut Items) -> Result<()> {
    items.deny_rest()?;
    finish(post, End::OfFile)
}

/// Ends the program once.
///
/// # Errors
/// A CIRCLE waits for its end point; cutter compensation is still on.
pub fn finish(post: &mut Post, end: End) -> Result<()> {
    if post.path.arc.is_some() {
        return PostCode::ArcEnd.err("no GOTO followed the last CIRCLE");
    }
    judge_arcs(post)?;
    way_home::write_held(&mut post.control)?;
    thread::end(post)?;
    post.path.cycle = None;
    leave_side_spindle(post)?;
    carry_out(post, Operation::End(end))
}

/// Stops both spindles where the control counts the one that it is told to: M30 stops the one
/// that is counted. The next program begins with the main spindle counted, as this one has.
fn leave_side_spindle(post: &mut Post) -> Result<()> {
    if !(post.control.spindle.is_side || post.control.spindle.other_turns) {
        return Ok(());
    }
    let (began_with_side, other_turns) =
        (post.control.spindle.is_side, post.control.spindle.other_turns);
    if spindle::may_turn(&post.control) {
        carry_out(post, Operation::Spindle(Spindle::Off))?;
    }
    if other_turns {
        count(post, !began_with_side)?;
        carry_out(post, Operation::Spindle(Spindle::Off))?;
    }
    count(post, false)
}

fn count(post: &mut Post, is_side: bool) -> Result<()> {
    let chosen = CountedSpindle { is_side, is_whole: true };
    carry_out(post, Operation::Spindle(Spindle::Counted(chosen)))
}

/// Refuses a program whose arcs, taken together, turn the wrong way.
fn judge_arcs(post: &mut Post) -> Result<()> {
    match post.path.sense.course.conclude() {
        Verdict::Fits => {}
        Verdict::Contradicted(why) => return PostCode::ArcSense.err(why),
        Verdict::Doubtful(why) if post.path.sense.choice != Choice::Made => {
            post.path.sense.choice = Choice::WouldSettle;
            return PostCode::ArcSense.err(why);
        }
        Verdict::Open(_) if post.path.sense.choice == Choice::Made => {}
        Verdict::Doubtful(why) | Verdict::Unproved(why) | Verdict::Open(why) => {
            post.warn(PostCode::ArcUnproved, why)
        }
    }
    Ok(())
}
