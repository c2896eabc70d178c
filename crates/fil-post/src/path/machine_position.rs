//! A rapid motion to a position of the machine: home, or a level to retract to.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};

use super::rapid;
use crate::control::word_address::cycle;
use crate::control::word_address::motion::Motion;
use crate::errors::PostCode;
use crate::post::Post;

/// Moves X, Y and Z to these positions, Z first where it goes up. Where the CL file stands
/// is not known then, until its next point.
///
/// # Errors
/// Cutter compensation that is on, and all that a rapid motion refuses.
pub fn carry_out(post: &mut Post, to: [Option<f64>; 3]) -> Result<()> {
    if post.control.is_compensated() {
        return PostCode::CompensationOn.err("at a motion to a position of the machine");
    }
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
    post.control.tables.check_travel(&position, axes)?;
    let cause = post.control.block.cause.whole();
    rapid::to_machine_position(&mut post.control, &Motion { position, axes, word: 0 }, cause)?;
    post.control.tip.is_away = true;
    post.path.rapid = None;
    post.path.point = None;
    Ok(())
}
