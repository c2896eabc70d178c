//! Cylindrical interpolation: C turns, and the feed of such a motion counts on a cylinder.
//!
//! With G7.1 C stays an angle. With TRACYL the way around the cylinder is a length Y, and X a
//! radius.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations::{self as loc, MillTurnMode};
use nalgebra::{Point3, Vector3};

use super::live_tool;
use super::live_tool::tenths;
use crate::control::Control;
use crate::control::family;
use crate::control::needs::Act;
use crate::control::sinumerik::transformation;
use crate::control::word_address::motion;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::operation::motion::Motion;
use crate::path::{linearization, position, rotary};
use crate::post::Post;

/// Largest turn of C in one motion at feed, degrees: more would be the way round that its
/// travel forces.
const HALF_TURN: f64 = 180.0 + 1e-6;

/// Cuts along a cylinder.
///
/// # Errors
/// Another radius at the end than at the start, or none; a tool beside the axis; a line
/// that the cylinder leaves by more than the tolerance; no feed a minute; blocks that may be
/// skipped.
pub(super) fn feed(post: &mut Post, from: Position, to: Position, target: Target) -> Result<()> {
    post.control.require(Act::MillTurnMotion)?;
    let resolution = post.control.tables.axis(0).resolution();
    let radius = to[0];
    // Under TRACYL the last Y is the way around the cylinder.
    let began = if post.control.tables.is_unrolled() { 0.0 } else { from[1] };
    if began.abs() > resolution || to[1].abs() > resolution {
        return PostCode::Cylinder.err("the tool axis does not go through the axis of the spindle");
    }
    if radius <= resolution {
        return PostCode::Cylinder.err("the cylinder has no radius: the tip is at the axis");
    }
    if (from[0] - radius).abs() > resolution {
        return PostCode::Cylinder.err(format!(
            "C turns while the tip goes from {:.4} to {radius:.4} from the axis of the spindle",
            from[0]
        ));
    }
    if (to[3] - from[3]).abs() > HALF_TURN {
        return PostCode::Cylinder.err(format!(
            "C would turn the long way round, from {:.3} to {:.3} degrees, as its travel ends",
            from[3], to[3]
        ));
    }
    let turn = (to[3] - from[3]).to_radians();
    let off = radius * (1.0 - libm::cos(turn / 2.0));
    if let Some(allowed) = linearization::tolerance(post)?.filter(|allowed| off > *allowed) {
        return PostCode::Cylinder.err(format!(
            "the cylinder leaves the line to the next point by {off:.4}, {allowed:.4} is allowed"
        ));
    }
    if post.path.cylinder.is_none_or(|now| (now - radius).abs() > resolution) {
        end(post)?;
        begin(post, radius)?;
    }
    go(post, to, target)
}

/// Writes a motion to a position of the axes.
fn go(post: &mut Post, to: Position, target: Target) -> Result<()> {
    let word = position::word_of(post, target);
    let feed = post.path.feed;
    let control = &mut post.control;
    let unrolled = post.path.cylinder.filter(|_| control.tables.is_unrolled());
    let Some(radius) = unrolled else {
        let motion = Motion::new(to, AxisSet::ALL, word);
        return family::feed(control, &motion, feed.as_ref());
    };
    let around = radius * to[3].to_radians();
    let position = [to[0], around, to[2], 0.0, 0.0];
    let feed = feed.map(|feed| super::limit_to_axes(post, feed, &position));
    let control = &mut post.control;
    let motion = Motion::new(position, AxisSet::LINEAR, word);
    family::feed(control, &motion, feed.as_ref())?;
    let spindle = *control.tables.axis(3);
    control.commons.set_last_output(spindle.letter, spindle.value(to[3])?);
    control.state.trust(spindle.letter);
    Ok(())
}

/// C stands on the way to a point.
///
/// # Errors
/// As [`live_tool::position_of`].
pub(super) fn stands(post: &Post, point: Point3<f64>, axis: Vector3<f64>) -> Result<bool> {
    let (to, _) = live_tool::position_of(post, point, axis)?;
    Ok(post.path.rotary.is_some_and(|before| before[0] == to[3]))
}

/// Goes to a target while C stands, and the way around the cylinder stays a length.
///
/// # Errors
/// As [`live_tool::position_of`]; no feed.
pub(super) fn along(post: &mut Post, target: Target) -> Result<()> {
    post.control.require(Act::MillTurnMotion)?;
    let (point, axis) = position::transformed(post, target);
    let (to, solution) = live_tool::position_of(post, point, axis)?;
    rotary::establish(post, solution)?;
    go(post, to, target)?;
    post.path.arrive(target);
    Ok(())
}

/// Begins it; the control must be in G1.
fn begin(post: &mut Post, radius: f64) -> Result<()> {
    let control = &mut post.control;
    control.ready_for(Act::CylinderOn)?;
    motion::ready(control)?;
    if control.tables.transforms {
        super::refuse_travel_of_c(control, PostCode::Cylinder)?;
        let said = transformation::tracyl(control, radius)?;
        super::set_mode(control, MillTurnMode::CylindricalInterpolationByTracyl)?;
        post.path.cylinder = Some(said);
        return Ok(());
    }
    let line = control.code(loc::LINEAR_CODE, "linear motion")?;
    if !control.state.is(modal::MOTION, line) {
        control.g(line);
        control.write_block()?;
    }
    call(control, radius)?;
    control.state.set(modal::MOTION, line);
    post.path.cylinder = Some(radius);
    Ok(())
}

/// Ends it where it is on.
///
/// # Errors
/// Cutter compensation, blocks that may be skipped.
pub(super) fn end(post: &mut Post) -> Result<()> {
    if post.path.cylinder.take().is_none() {
        return Ok(());
    }
    let control = &mut post.control;
    control.ready_for(Act::CylinderOff)?;
    let waiting = control.block.take();
    if control.tables.is_unrolled() {
        let knows_z = control.axis_position(2).is_some();
        let z = control.tables.axis(2).letter;
        transformation::end(control)?;
        super::set_mode(control, MillTurnMode::Milling)?;
        if knows_z {
            control.state.trust(z);
        }
    } else {
        call(control, 0.0)?;
    }
    control.block = waiting;
    Ok(())
}

/// The block of a radius; what C says in it is no angle.
fn call(control: &mut Control, radius: f64) -> Result<()> {
    let Some(code) = tenths(control, loc::MILL_TURN_CYLINDER_CODE) else {
        return PostCode::Cylinder.err("the machine has no code for it (mill_turn.cylinder_code)");
    };
    let letter = control.tables.axis(3).letter;
    let stands = control.commons.last_output(letter);
    control.g_of_record(code);
    control.word(letter, radius)?;
    control.write_block()?;
    control.commons.set_last_output(letter, stands);
    control.state.doubt(letter);
    Ok(())
}
