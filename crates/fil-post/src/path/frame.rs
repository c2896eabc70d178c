//! Tilted frames: while the tool axis stands still, X, Y and Z count in a frame of the
//! control that lies as the machine's axes do when the tables and heads have turned there.
//!
//! So arcs and cycles stay what they are on the face they are cut on. The machine turns
//! where a tool change or a position of the machine has brought the tool away, or after a
//! way up to `home.retract_z`; then the frame begins. It ends before the next tool, a
//! position of the machine, another work offset and the end of the program.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use fil_machine::commons::EMPTY;
use fil_machine::functions::WorkPlane;
use nalgebra::{Point3, Vector3};

use super::height;
use super::position::Solution;
use super::state::TiltedFrame;
use crate::control::Control;
use crate::control::needs::Act;
use crate::control::word_address::cycle;
use crate::control_state::{Meaning, modal};
use crate::errors::PostCode;
use crate::operation::Operation;
use crate::post::Post;

/// Two tool axes nearer than this are one.
pub(super) const SAME_AXIS: f64 = 1e-6;

/// A smaller turn of a rotary axis counts as none, degrees.
pub(super) const STILL: f64 = 1e-9;

/// The words of a motion to a point, in the frame in force.
///
/// # Errors
/// None is in force for this tool axis; a position outside the travel.
#[cold]
pub(super) fn position_of(
    post: &Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<(Position, Solution)> {
    let frame = along(post, normalized(axis)?).filter(|frame| is_in_force(&post.control, frame));
    let Some(frame) = frame else {
        return PostCode::Frame.err("no tilted work plane has begun for this tool axis");
    };
    let tables = &post.control.tables;
    let linear = tables.chain().linear(point, frame.angles);
    tables.check_travel(&[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    let point = frame.turn.map_or(point, |turn| turn.inverse() * point);
    let [first, second] = frame.angles;
    Ok(([point.x, point.y, point.z, first, second], Solution::InFrame))
}

/// Refuses a point on the way, as the words of the frame in force name it, outside the travel
/// of X, Y and Z.
///
/// # Errors
/// It lies outside.
pub(super) fn check_on_the_way(post: &Post, point: [f64; 3]) -> Result<()> {
    let Some(frame) = post.path.frame else { return Ok(()) };
    let point = Point3::from(point);
    let point = frame.turn.map_or(point, |turn| turn * point);
    let at = post.control.tables.chain().linear(point, frame.angles);
    post.control.tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], AxisSet::LINEAR)
}

/// The direction of a tool axis.
pub(super) fn normalized(axis: Vector3<f64>) -> Result<Vector3<f64>> {
    axis.try_normalize(1e-9)
        .ok_or_else(|| PostCode::AxisLength.diag("the tool axis has length zero"))
}

/// The frame that motions were last written in, where it is that of a tool axis.
pub(super) fn along(post: &Post, axis: Vector3<f64>) -> Option<TiltedFrame> {
    post.path.frame.filter(|frame| (frame.axis - axis).norm() < SAME_AXIS)
}

/// The control is in a frame, and the machine stands as it wants it.
pub(super) fn is_in_force(control: &Control, frame: &TiltedFrame) -> bool {
    let turned = if frame.turn.is_some() { WorkPlane::Tilted } else { WorkPlane::Off };
    control.state.is(modal::WORK_PLANE, turned) && stands_at(control, frame.angles)
}

/// The rotary axes need not turn.
pub(super) fn still(from: [f64; 2], to: [f64; 2]) -> bool {
    from.iter().zip(to).all(|(from, to)| (from - to).abs() <= STILL)
}

/// A head holds the tool away from the machine's Z.
pub(super) fn leans(chain: &AxisChain, angles: [f64; 2]) -> bool {
    (chain.tool_at(angles) - chain.tool.into_inner()).norm() > SAME_AXIS
}

/// The control has the rotary axes at these angles, to their last digits.
fn stands_at(control: &Control, angles: [f64; 2]) -> bool {
    knows_rotary(control)
        && control.tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
            let (axis, angle) = (control.tables.axis(number), angles[number - 3]);
            let here = control.axis_position(number).map(|here| axis.near(here, angle));
            here.is_some_and(|here| (here - angle).abs() <= axis.resolution())
        })
}

/// Refuses a text that turns the machine in a tilted frame, which stands still: where X, Y and Z
/// count from then, no control says alike.
///
/// # Errors
/// It does.
pub(super) fn refuse_turned(control: &Control, stood: [Option<f64>; 2]) -> Result<()> {
    let is_in_frame =
        control.tables.frame_output && control.state.is(modal::WORK_PLANE, WorkPlane::Tilted);
    let turned = |n: usize| control.stands(n + 3).is_some() && control.stands(n + 3) != stood[n];
    if is_in_frame && (0..2).any(turned) {
        return PostCode::Frame.err_with(
            "a text turns a rotary axis in a tilted work plane",
            "Put it after GOHOME or LOADTL, where no tilted work plane is active.",
        );
    }
    Ok(())
}

/// The control has the rotary axes where the program has last brought them.
pub(super) fn knows_rotary(control: &Control) -> bool {
    let tables = &control.tables;
    tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
        let letter = tables.axis(number).letter;
        control.commons.last_output(letter) != EMPTY && control.state.has_last(letter)
    })
}

/// The rotary axes stand where they were, whatever begins or ends around them.
pub(super) fn keep_rotary(control: &mut Control) {
    for number in AxisSet::ROTARY.numbers() {
        let letter = control.tables.axis(number).letter;
        control.state.trust(letter);
    }
}

/// Where X, Y and Z stand in another frame is not known.
pub(super) fn forget_positions(control: &mut Control) {
    for number in AxisSet::LINEAR.numbers() {
        let letter = control.tables.axis(number).letter;
        control.commons.set_last_output(letter, EMPTY);
        control.state.clears(letter, None);
    }
}

/// Ends a tilted frame where the control may be in one.
///
/// # Errors
/// The machine has no code for it; blocks that may be skipped.
pub fn end(control: &mut Control) -> Result<()> {
    if !control.may_be_tilted() {
        return Ok(());
    }
    control.require(Act::WorkPlaneOff)?;
    cycle::cancel(control)?;
    let known = knows_rotary(control);
    let slides = height::slides_in_frame(control);
    control.family().end_frame(control)?;
    control.state.set(modal::WORK_PLANE, WorkPlane::Off);
    if known {
        keep_rotary(control);
    }
    forget_positions(control);
    match slides {
        Some(slides) => height::stand(control, slides),
        None => Ok(()),
    }
}

/// What an operation that is no motion of the path asks of a tilted frame.
///
/// # Errors
/// Functions that would change the frame.
pub(super) fn before(control: &mut Control, operation: &Operation) -> Result<()> {
    if !control.tables.frame_output {
        return Ok(());
    }
    match operation {
        Operation::MachinePosition(_) | Operation::WorkOffset(_) | Operation::End(_) => {
            end(control)
        }
        Operation::Function(letter, code)
            if *letter == fil_machine::letters::G && control.may_be_tilted() =>
        {
            match control.meaning(*code) {
                Meaning::Origin(_) | Meaning::WorkPlane(_) | Meaning::Tcpc | Meaning::Unit(_) => {
                    PostCode::Frame.err_with(
                        "PREFUN: the function would move the frame in force",
                        "Put it where the tool is along the machine's Z, or output axis positions with rotary.frame_output = 0.",
                    )
                }
                _ => Ok(()),
            }
        }
        _ => Ok(()),
    }
}
