//! A rapid motion of a live tool on a machine with Y in which C turns: X and Y go straight in the
//! machine, not in the part, and may come nearer to the axis of the spindle than both ends.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::axis_chain::AxisChain;
use nalgebra::Vector2;

use super::polar;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control_state::Place;
use crate::operation::motion::{Motion, RapidCode};

/// A way that comes nearer to the axis of the spindle by less than this does not pass it, mm or inch.
const NEARER: f64 = 1e-3;

/// Makes the motion: in one block, as Z does not say which way is away from the part, or in three
/// where that would come nearer to the axis than both ends.
///
/// # Errors
/// As [`family::rapid`]; a position on the way outside of the travel.
pub(super) fn rapid(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let Some([from, to]) = crosses(control, motion) else {
        return family::rapid(control, motion, RapidCode::Across, cause);
    };
    let parts = if from.x > 0.0 {
        let mut out = *motion;
        out.position[0] = center(control.tables.chain()).x + from.norm().max(to.norm());
        control.tables.check_travel(&out.position, AxisSet::of(0))?;
        let across = AxisSet::ALL.without(AxisSet::of(0));
        [out.of(AxisSet::of(0)), motion.of(across), motion.of(AxisSet::of(0))]
    } else {
        // Of a tool along Z that stands across the axis up is along Z.
        let across = AxisSet::ALL.without(AxisSet::Z);
        let rises = matches!(control.place(2), Place::At(z) if motion.position[2] > z);
        let first = if rises { AxisSet::Z } else { AxisSet::NONE };
        [motion.of(first), motion.of(across), motion.of(AxisSet::Z)]
    };
    for part in parts.iter().filter(|part| !part.axes.is_empty()) {
        family::rapid(control, part, RapidCode::Across, cause)?;
    }
    Ok(())
}

/// Both ends of the motion from the axis of the spindle, where C turns and the way between them
/// comes nearer to it than either.
fn crosses(control: &Control, motion: &Motion) -> Option<[Vector2<f64>; 2]> {
    let at = |number: usize| match control.place(number) {
        Place::At(at) => Some(at),
        _ => None,
    };
    let (x, y, c) = (at(0)?, at(1)?, at(3)?);
    if (c - motion.position[3]).abs() < control.tables.axis(3).resolution() {
        return None;
    }
    let center = center(control.tables.chain());
    let from = Vector2::new(x, y) - center;
    let to = Vector2::new(motion.position[0], motion.position[1]) - center;
    let nearest = polar::nearest(from.into(), to.into());
    (nearest < from.norm().min(to.norm()) - NEARER).then_some([from, to])
}

/// Where the axis of the spindle crosses X and Y, mm or inch.
fn center(chain: &AxisChain) -> Vector2<f64> {
    chain.rotaries[0].as_ref().map_or_else(Vector2::zeros, |spindle| spindle.center.coords.xy())
}
