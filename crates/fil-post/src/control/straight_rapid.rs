//! Rapid blocks of several axes while a head leans the tool: up along itself it goes by two or three
//! axes at once, and must go straight. Some controls drive each axis at its own speed there, by a
//! parameter (on a Fanuc bit LRP of parameter 1401).

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, RapidStraight};
use nalgebra::Vector3;

use super::{Control, heads};
use crate::errors::PostCode;
use crate::operation::motion::Motion;

/// Directions are one where the cosine between them is less than this below 1.
const PARALLEL: f64 = 1e-8;

/// Looks at a rapid block of a machine with heads.
///
/// # Errors
/// It goes along a leaning tool, and the control drives each axis at its own speed.
pub(super) fn look(control: &mut Control, motion: &Motion) -> Result<()> {
    let goes = control.commons.read(loc::RAPID_STRAIGHT);
    let is_straight = goes == RapidStraight::OnAStraightLine
        || goes == RapidStraight::Unknown && control.can().straight_rapids;
    if is_straight || !control.tables.chain().has_heads() || !leans_in(control, motion) {
        return Ok(());
    }
    if goes == RapidStraight::Unknown {
        let message = "a rapid of several axes with a tilted head: a control with dog-leg rapids leaves the straight line";
        control.warnings.add(PostCode::RapidMayBend, message.to_string());
        return Ok(());
    }
    PostCode::RapidBends.err(
        "a rapid of several axes with a tilted head, and the control moves each at its own speed (rapid.straight = 2)",
    )
}

/// A block in which the tool leans at one end, and that moves Z with others. In the frame of the
/// tip and in a tilted one each axis of it is several of the machine.
fn leans_in(control: &Control, motion: &Motion) -> bool {
    let linear = motion.axes.and(AxisSet::LINEAR).and(control.tables.present());
    let in_frame = control.may_be_tilted() || control.may_name_tip();
    let count = linear.numbers().filter(|number| moves(control, motion, *number)).count();
    let is_one = match in_frame {
        true => count == 0,
        false => count < 2 || !moves(control, motion, 2),
    };
    if is_one {
        return false;
    }
    let Some([from, to]) = ends(control, motion) else { return false };
    let leans = |angles| {
        let tool: Vector3<f64> = control.tables.chain().tool_at(angles);
        tool.amax() < 1.0 - PARALLEL
    };
    leans(from) || leans(to)
}

/// The motion moves an axis, as far as it is known where that stands.
fn moves(control: &Control, motion: &Motion, number: usize) -> bool {
    let axis = control.tables.axis(number);
    let stands = control.stands(number);
    motion.axes.has(number)
        && !axis.is_off()
        && stands.is_none_or(|at| (motion.position[number] - at).abs() >= axis.resolution())
}

/// Where the rotary axes stand before and behind a motion, degrees; `None` where that is not known.
fn ends(control: &Control, motion: &Motion) -> Option<[[f64; 2]; 2]> {
    let of_frame = control.tip.frame.filter(|_| control.may_be_tilted()).map(|(_, angles)| angles);
    match of_frame.or(control.tip.leans) {
        Some(angles) => Some([angles; 2]),
        None => heads::angles(control, motion),
    }
}
