//! Ways to positions of the machine out of the tilted frame of a head that leans the tool: up is
//! along Z of the frame, and the frame ends above.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ToolChangeBlock};

use super::{frame, height, rapid_lean};
use crate::control::word_address::motion::{Motion, RapidCode};
use crate::control::{Control, family, machine_frame};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::Operation;
use crate::post::Post;

const OUT_FIRST: &str = "Bring the tool out by RAPID and GOTO before it, or turn it upright there.";

/// Goes up along the tool to the level of Z in the machine that an operation names, while the
/// frame of a leaning head is in force.
///
/// # Errors
/// Where the tool stands is not known; it lies across Z; a position outside the travel.
pub(super) fn go_up(post: &mut Post, operation: &Operation) -> Result<()> {
    let Operation::MachinePosition([_, _, Some(level)]) = operation else { return Ok(()) };
    let control = &post.control;
    let Some(angles) = post.path.rotary.filter(|_| is_in_frame(control)) else { return Ok(()) };
    let in_machine = machine_frame::is_meant(control) || control.is_compensated();
    if in_machine || !frame::leans(control.tables.chain(), angles) {
        return Ok(());
    }
    let (Some(height), Place::At(z)) = (height::machine_height(control), control.place(2)) else {
        return unknown();
    };
    let rise = level - height;
    if rise <= 0.0 {
        return Ok(());
    }
    let z = z + rapid_lean::way_along(control, angles, rise)?;
    if let (Some(x), Some(y)) = (control.stands(0), control.stands(1)) {
        frame::check_on_the_way(post, [x, y, z])?;
    }
    let control = &mut post.control;
    family::cancel_cycle(control)?;
    let cause = control.block.cause.whole();
    family::rapid(control, &Motion::along(2, z), RapidCode::Along, cause)
}

/// Refuses a change position of Z out of the frame of a leaning head.
///
/// # Errors
/// The tool would go straight up in the machine.
pub(super) fn refuse_change_position(control: &Control) -> Result<()> {
    let goes = control.commons.read(loc::TOOL_CHANGE_BLOCK) != ToolChangeBlock::None
        && control.commons.dbl_opt(loc::CHANGE_POSITION[2]).is_some();
    if !goes || !is_in_frame(control) || machine_frame::is_meant(control) {
        return Ok(());
    }
    let leans = |angles: [f64; 2]| frame::leans(control.tables.chain(), angles);
    if rapid_lean::turned(control).is_none_or(leans) { unknown() } else { Ok(()) }
}

fn is_in_frame(control: &Control) -> bool {
    control.tables.frame_output && control.state.tilted != Some(false) && !control.tip.is_away
}

fn unknown<T>() -> Result<T> {
    PostCode::Leaning.err_with(
        "a head leans the tool in a tilted frame, and where it stands in the machine is not \
         known: straight up would not be along it",
        OUT_FIRST,
    )
}
