//! The canned cycle in force gives way to the next one.

use fil_diag::Result;
use fil_machine::letters::XYZ;
use fil_machine::locations as loc;

use super::{hole, places, tip_hole};
use crate::control::word_address::cycle;
use crate::operation::cycle::{AboveHoles, Cycle};
use crate::post::Post;

/// Takes a cycle in place of the one before, or ends it.
///
/// # Errors
/// The machine has no code that ends the cycle the control is in.
pub fn replace(post: &mut Post, cycle: Option<Cycle>) -> Result<()> {
    cycle::cancel(&mut post.control)?;
    let mut old = post.path.cycle.take();
    if let (Some(old), None) = (&mut old, &cycle)
        && post.control.commons.read(loc::CYCLE_RETRACT_BLOCK)
    {
        match &mut old.above {
            Some(above) => tip_hole::retract(post, above)?,
            None => hole::retract(post, old)?,
        }
    }
    let stands = XYZ.map(|letter| post.control.commons.last_output(letter));
    let (initial, above) = match old {
        Some(old) => (old.initial, old.above),
        None => {
            // The level before the cycle is the one at which the one before has left the tool.
            let left = post.path.last.above_left.take().filter(|(_, outputs)| *outputs == stands);
            (None, left.map(|(above, _)| AboveHoles { before: above.now, ..above }))
        }
    };
    post.path.last.above_left = above.filter(|_| cycle.is_none()).map(|above| (above, stands));
    let is_over = cycle.is_none();
    post.path.cycle = cycle.map(|cycle| Cycle { initial, above, ..cycle });
    if is_over { places::end_cycle(post) } else { Ok(()) }
}
