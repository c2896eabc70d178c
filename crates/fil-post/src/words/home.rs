//! GOHOME without a point, and RETRCT: rapid motions to positions of the machine.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;

use super::goto;
use crate::control::machine_frame;
use crate::control::skip::refuse_level;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::{carry_out, rotary, tip_control};
use crate::post::Post;

/// GOHOME: to the home position of the machine (DBLCOM 130 to 132).
///
/// # Errors
/// A machine without one; a CIRCLE that waits for its end, and all that the motion refuses.
pub fn gohome(post: &mut Post, items: &Items) -> Result<()> {
    goto::refuse_waiting_arc(post)?;
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
            "no level is known to go up to: give home.retract_z, or let a FIL section take it",
        ));
    };
    items.deny_rest()?;
    goto::refuse_waiting_arc(post)?;
    let tables = &post.control.tables;
    let in_frame = tables.frame_output && post.control.state.tilted != Some(false);
    let in_tip = post.writes_tip();
    if let Some(levels) = post.control.levels_behind_skip(2).filter(|_| !in_frame && !in_tip)
        && !machine_frame::is_meant(&post.control)
    {
        if levels.low >= level && !levels.unknown {
            return Ok(());
        }
        if level < levels.high || levels.unknown {
            return refuse_level(&post.control, 2);
        }
    }
    // In a tilted frame Z goes along the tool, and under tool-tip control it is that of the tip.
    let stands = match () {
        () if in_tip => tip_control::machine_height(&post.control),
        () if in_frame => rotary::machine_height(post),
        () => post.control.stands(2),
    };
    let is_above = stands.is_some_and(|z| z >= level);
    // How high the tool stands in the frame of the machine is not known.
    if is_above && !machine_frame::is_meant(&post.control) {
        return Ok(());
    }
    carry_out(post, Operation::MachinePosition([None, None, Some(level)]))
}
