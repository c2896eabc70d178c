//! GOHOME without a point, and RETRCT: rapid motions to positions of the machine.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::needs::Act;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::{carry_out, height};
use crate::post::Post;

/// GOHOME: to the home position of the machine (DBLCOM 130 to 132).
///
/// # Errors
/// A machine without one; a CIRCLE that waits for its end, and all that the motion refuses.
pub fn gohome(post: &mut Post, items: &Items) -> Result<()> {
    post.require(Act::OtherMotion)?;
    let home = loc::HOME.map(|at| post.control.commons.dbl_opt(at));
    if home == [None; 3] {
        return Err(items.error("no point, and the machine has no home position (home.x, y, z)"));
    }
    carry_out(post, Operation::MachinePosition(home))
}

/// RETRCT: up to the level that the machine names for it; never down, as far as it counts in
/// the frame of the part.
///
/// # Errors
/// A machine that names none, unless it lists the word as without effect; RETRCT with items.
pub fn retrct(post: &mut Post, items: &mut Items) -> Result<()> {
    let commons = &post.control.commons;
    let Some(level) = commons.dbl_opt(loc::HOME_RETRACT_Z) else {
        let name = items.name(w::RETRCT);
        if commons.words_without_effect().iter().any(|word| word == name) {
            items.skip(items.len());
            return Ok(());
        }
        return Err(items.error(
            "no retract height is known: set home.retract_z, or take it with a FIL section",
        ));
    };
    items.deny_rest()?;
    post.require(Act::OtherMotion)?;
    if height::is_above(&post.control, level)? {
        return Ok(());
    }
    carry_out(post, Operation::MachinePosition([None, None, Some(level)]))
}
