//! DELAY/t: a dwell of t seconds; DELAY/REV,n: of n revolutions.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::control::word_address::spindle;
use crate::items::Items;
use crate::operation::{Dwell, Operation};
use crate::path::carry_out;
use crate::post::Post;

/// Dwells.
///
/// # Errors
/// No time, or one that is not positive; turns of a spindle that stands.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let revolutions = items.couplet(w::REV)?;
    items.flag(w::DWELL);
    let (dwell, amount) = match revolutions {
        Some(turns) => (Dwell::Revolutions(turns), turns),
        None => {
            let seconds = items.required("the time in seconds")?;
            (Dwell::Seconds(seconds), seconds)
        }
    };
    post.due_to(items);
    items.deny_rest()?;
    if revolutions.is_some() && !spindle::may_turn(&post.control) {
        return Err(items.error(
            "the spindle is stopped, and never makes these revolutions; put SPINDL before it",
        ));
    }
    if amount < 0.0 {
        return Err(items.error(format!("a dwell of {amount} is negative")));
    }
    carry_out(post, Operation::Dwell(dwell))
}
