//! A surface speed (G96) that begins behind the approach: until the first cut the spindle turns at
//! the rev/min (G97) of the end of the first rapid motion.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::rotary;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::waiting::SurfaceSpeed;
use crate::control::word_address::spindle;
use crate::control_state::Place;
use crate::operation::{MotionKind, Operation, Spindle, SpindleSpeed, SpindleTurn, Target};
use crate::post::Post;

/// Keeps a surface speed for the first cut, where the machine asks for it and the tool is away from
/// the part; says whether it waits.
pub(crate) fn keep(control: &mut Control, turn: SpindleTurn, limit: Option<f64>) -> bool {
    let of_surface = matches!(turn.speed, Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_)));
    let is_away = matches!(control.place(0), Place::Clear | Place::Unsaid);
    let waits = of_surface && is_away && control.commons.read(loc::SPINDLE_CSS_LEAD_IN);
    if waits {
        let cause = control.block.cause;
        control.waiting.surface_speed = Some(SurfaceSpeed { turn, limit, cause, leads_in: false });
    }
    waits
}

/// Turns the spindle for a motion to a target, where a surface speed waits: at the rev/min of its
/// end for the first rapid motion, and at the surface speed for a cut.
///
/// # Errors
/// A position out of reach; as SPINDL.
pub(super) fn before(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    let Some(waits) = post.control.waiting.surface_speed else { return Ok(()) };
    if !matches!(kind, MotionKind::Rapid(_)) {
        return end(&mut post.control);
    }
    if waits.leads_in {
        return Ok(());
    }
    let radius = rotary::position_of(post, target)?.0[0];
    let control = &mut post.control;
    let Some(speed) = spindle::turns_at(control, &waits.turn, waits.limit, radius) else {
        return end(control);
    };
    let speed = Some(SpindleSpeed::Revolutions(speed));
    write(control, waits.cause, Spindle::Turn(SpindleTurn { speed, ..waits.turn }))?;
    control.waiting.surface_speed = Some(SurfaceSpeed { leads_in: true, ..waits });
    Ok(())
}

/// Begins a surface speed that waits before an operation that is no motion. Messages, coolant, a work
/// offset and the next tool belong to the approach.
///
/// # Errors
/// As SPINDL.
pub(super) fn before_operation(control: &mut Control, operation: &Operation) -> Result<()> {
    match operation {
        Operation::Message(_)
        | Operation::Coolant(_)
        | Operation::WorkOffset(_)
        | Operation::SelectTool(_) => Ok(()),
        _ => end(control),
    }
}

/// Ends the approach: the surface speed that waits begins, with its highest speed.
///
/// # Errors
/// As SPINDL.
pub(crate) fn end(control: &mut Control) -> Result<()> {
    let Some(waits) = control.waiting.surface_speed.take() else { return Ok(()) };
    if let Some(limit) = waits.limit {
        write(control, waits.cause, Spindle::Limit(limit))?;
    }
    write(control, waits.cause, Spindle::Turn(waits.turn))
}

fn write(control: &mut Control, cause: Cause, spindle: Spindle) -> Result<()> {
    control.because(cause, |control| control.family().write(control, Operation::Spindle(spindle)))
}
