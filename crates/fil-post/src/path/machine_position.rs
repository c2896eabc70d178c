//! A rapid motion to a position of the machine: home, or a level to retract to.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};

use super::{frame, rapid, rapid_lean, tip_control};
use crate::control::machine_frame::{self, Before};
use crate::control::needs::Act;
use crate::control::word_address::cycle;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Moves X, Y and Z to these positions, Z first where it goes up. Where the CL file stands
/// is not known then, until its next point.
///
/// # Errors
/// Cutter compensation that is on, and all that a rapid motion refuses.
pub fn carry_out(post: &mut Post, to: [Option<f64>; 3]) -> Result<()> {
    carry_out_before(post, to, Before::Others)
}

/// The same where it is known what comes behind it.
///
/// # Errors
/// As [`carry_out`].
pub fn carry_out_before(post: &mut Post, to: [Option<f64>; 3], before: Before) -> Result<()> {
    post.control.ready_for(Act::MachinePosition)?;
    let was_in_part = post.path.point.is_some();
    post.path.interrupt();
    cycle::cancel(&mut post.control)?;
    let mut position = Position::default();
    let mut axes = AxisSet::NONE;
    for (number, value) in to.into_iter().enumerate() {
        if let Some(value) = value {
            position[number] = value;
            axes = axes.or(AxisSet::of(number));
        }
    }
    let cause = post.control.block.cause.whole();
    let motion = Motion::new(position, axes, 0);
    if machine_frame::is_meant(&post.control) {
        if was_in_part && axes.has(2) {
            rapid_lean::warn_straight_up(&mut post.control);
        }
        tip_control::end(&mut post.control)?;
        frame::end(&mut post.control)?;
        machine_frame::go(&mut post.control, &motion, before, cause)?;
    } else {
        post.control.ready_length()?;
        post.control.tables.check_travel(&position, axes)?;
        rapid::to_machine_position(&mut post.control, &motion, cause)?;
    }
    post.control.tip.is_away = true;
    post.path.rapid = None;
    post.path.point = None;
    post.path.last.in_cut = false;
    Ok(())
}
