//! Ways to positions of the machine out of the tilted frame of a head that leans the tool: up is
//! along Z of the frame, and the frame ends above.

use fil_diag::Result;

use super::{frame, height, rapid_lean, turned_apart};
use crate::control::word_address::cycle;
use crate::control::{family, machine_frame};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::Operation;
use crate::operation::motion::{Motion, RapidCode};
use crate::post::Post;

const OUT_FIRST: &str = "Bring the tool out by RAPID and GOTO before it, or turn it upright there.";

/// Goes up along the tool to the level of Z in the machine that an operation names, while the
/// frame of a leaning head is in force.
///
/// # Errors
/// As [`go_up_to`].
pub(super) fn go_up(post: &mut Post, operation: &Operation) -> Result<()> {
    match operation {
        Operation::MachinePosition([_, _, Some(level)]) if post.control.tables.frame_output => {
            go_up_to(post, *level)
        }
        _ => Ok(()),
    }
}

/// The same to a level that comes before a tool change.
///
/// # Errors
/// Where the tool stands is not known; it lies across Z; a second tool, of another length; a
/// position outside the travel.
pub(super) fn go_up_to(post: &mut Post, level: f64) -> Result<()> {
    let Some(angles) = leaning(post) else { return Ok(()) };
    let control = &mut post.control;
    if machine_frame::is_meant(control) || control.is_compensated() {
        return Ok(());
    }
    let (Some(height), Place::At(z)) = (height::machine_height(control), control.place(2)) else {
        return unknown();
    };
    let rise = level - height;
    if rise <= 0.0 {
        return Ok(());
    }
    turned_apart::settle_level(post)?;
    let z = z + rapid_lean::way_along(&post.control, angles, rise)?;
    rise_to(post, z)
}

/// Goes up along the tool by a distance, before the frame of a leaning head ends and the control
/// moves along Z of the machine; says whether such a frame is in force.
///
/// # Errors
/// Where the tool stands is not known; a position outside the travel.
pub(super) fn go_up_by(post: &mut Post, distance: f64) -> Result<bool> {
    if leaning(post).is_none() {
        return Ok(false);
    }
    let Place::At(z) = post.control.place(2) else { return unknown() };
    rise_to(post, z + distance)?;
    Ok(true)
}

/// Where the rotary axes stand in the frame of a head that leans the tool, degrees.
fn leaning(post: &Post) -> Option<[f64; 2]> {
    let control = &post.control;
    let is_in_frame = control.may_be_tilted() && !control.tip.is_away;
    let angles = post.path.rotary.filter(|_| is_in_frame)?;
    frame::leans(control.tables.chain(), angles).then_some(angles)
}

/// Goes up to a level of the frame.
fn rise_to(post: &mut Post, z: f64) -> Result<()> {
    let control = &post.control;
    if let (Some(x), Some(y)) = (control.stands(0), control.stands(1)) {
        frame::check_on_the_way(post, [x, y, z])?;
    }
    let control = &mut post.control;
    cycle::cancel(control)?;
    let cause = control.block.cause.whole();
    family::rapid(control, &Motion::along(2, z), RapidCode::Along, cause)
}

fn unknown<T>() -> Result<T> {
    PostCode::Leaning.err_with(
        "the head is tilted in a tilted work plane, and its machine position is not known: straight up would not be along the tool",
        OUT_FIRST,
    )
}
