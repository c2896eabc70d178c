//! Rotary axes that turn between faces at the machine's top, as `rotary.turn_retract` asks.

use fil_diag::Result;
use fil_machine::axes::AxisSet;

use super::{rapid, rapid_lean, rotary, way_home};
use crate::control_state::modal;
use crate::operation::Target;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Goes up to `home.retract_z` (Z) before a rapid motion to a target that turns the machine, where
/// the tool is not away already, also where tool center point control begins with it. Tilted work planes
/// and motions under tool center point control have rules of their own.
///
/// # Errors
/// A tool axis out of reach; as a motion to a position of the machine.
#[cold]
pub(super) fn go_up(post: &mut Post, target: Target) -> Result<()> {
    let tables = &post.control.tables;
    let has_own_rules = match post.writes_tip() {
        true => post.control.state.is(modal::TCP, true),
        false => tables.frame_output,
    };
    if !tables.turns_at_top || has_own_rules {
        return Ok(());
    }
    if rapid_lean::is_away(&post.control) {
        unwind(post);
        return Ok(());
    }
    let (position, _) = rotary::position_of(post, target)?;
    if !rapid::turns(&post.control, &Motion::new(position, AxisSet::ALL, 0)) {
        return Ok(());
    }
    way_home::go_up(post)
}

/// Turns axes that the points turn by their tool axes (MULTAX) to the positions nearest to zero,
/// which no tool before has a say in: three-axis work is done at zero, and the program can be
/// begun at each tool.
fn unwind(post: &mut Post) {
    if post.path.multax.is_some() && post.path.transformation.is_none() {
        post.path.turning.chosen.get_or_insert([0.0; 2]);
    }
}
