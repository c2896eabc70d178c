//! From a point and a tool axis in the part to positions of the machine's axes.

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::axis_chain;
use fil_machine::errors::MachineCode;
use nalgebra::{Point3, Vector3};

use super::mill_turn::live_tool;
use super::position::{Solution, nearest_to, stands, transformed, turned};
use super::{Since, frame, tip_control, turned_apart};
use crate::control::Control;
use crate::control::needs::Act;
use crate::control::skip::refuse_level;
use crate::control_state::{Place, Source};
use crate::errors::PostCode;
use crate::operation::Target;
use crate::post::Post;

/// Positions of the axes for a target, and how the machine comes to them. A tilted frame or
/// tool-tip control that it needs must be in force.
///
/// # Errors
/// The machine can't reach the tool axis.
pub fn position_of(post: &Post, target: Target) -> Result<(Position, Solution)> {
    let mut position = Position::default();
    let solution = find_position(post, target, &mut position)?;
    Ok((position, solution))
}

/// The same in its place: to copy what was written number by number just before makes the
/// processor wait.
///
/// # Errors
/// As [`position_of`].
#[inline(always)]
pub fn find_position(post: &Post, target: Target, position: &mut Position) -> Result<Solution> {
    let (point, axis) = transformed(post, target);
    let chain = post.control.tables.chain();
    if !chain.has_rotary() && axis == chain.tool.into_inner() {
        *position = [point.x, point.y, point.z, 0.0, 0.0];
        return Ok(Solution::Still);
    }
    if needs_more(post) {
        let (found, solution) = position_in_mode(post, point, axis)?;
        *position = found;
        return Ok(solution);
    }
    let last = nearest_to(post);
    let axis_chain::Place { linear, angles, free, turns } = chain.place(point, axis, last)?;
    *position = [linear.x, linear.y, linear.z, angles[0], angles[1]];
    Ok(Solution::Angles { angles, free, turns })
}

/// Takes the rotary axes to stand where the motion that is made next brings them.
///
/// # Errors
/// The machine turns with another tool or another zero than before.
#[inline(always)]
pub fn establish(post: &mut Post, solution: Solution) -> Result<()> {
    match solution {
        Solution::Still => {}
        Solution::Angles { angles, free, turns } => {
            turned_apart::settle(post, angles)?;
            post.path.turning.chosen = None;
            post.path.rotary = Some(angles);
            post.path.turning.free = Some(free);
            post.path.turning.turns = turns;
        }
        Solution::InFrame | Solution::OfLiveTool(_) | Solution::OfTip { .. } => {
            establish_in_mode(post, solution);
        }
    }
    Ok(())
}

/// The same where X, Y and Z are no positions of the slides.
#[cold]
fn establish_in_mode(post: &mut Post, solution: Solution) {
    match solution {
        Solution::InFrame => {
            post.path.turning.chosen = None;
            post.control.tip.is_away = false;
        }
        Solution::OfLiveTool(angles) => post.path.rotary = Some(angles),
        Solution::OfTip { angles, free, by_vector } => {
            post.path.turning.chosen = None;
            post.path.rotary = Some(angles);
            post.path.turning.free = Some(free);
            post.control.tip.by_vector = by_vector;
        }
        Solution::Still | Solution::Angles { .. } => {}
    }
}

/// True where X, Y and Z are no positions of the slides.
#[inline]
fn needs_more(post: &Post) -> bool {
    let tables = &post.control.tables;
    tables.mills() || tables.frame_output || post.writes_tip()
}

/// The same there.
fn position_in_mode(
    post: &Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<(Position, Solution)> {
    if post.control.tables.mills() {
        return live_tool::position_of(post, point, axis);
    }
    if post.writes_tip() {
        return tip_control::position_of(post, point, axis);
    }
    frame::position_of(post, point, axis)
}

/// Refuses a pass of a thread in which a rotary axis would turn: its block has none.
///
/// # Errors
/// One would.
pub fn refuse_thread(before: Option<[f64; 2]>, now: Option<[f64; 2]>) -> Result<()> {
    match turned(before, now) {
        Some(_) => PostCode::ThreadTurns.err("the tool axis changes in a pass of a thread"),
        None => Ok(()),
    }
}

/// Refuses a motion at feed while a rotary axis may stand anywhere, or at a position of the
/// machine, whose angle in the program is not known: it would turn by any angle, and the tip
/// would leave its line.
///
/// # Errors
/// One may.
#[cold]
pub(super) fn refuse_unknown_start(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    if control.tables.mills() {
        return Ok(());
    }
    for number in AxisSet::ROTARY.and(control.tables.present()).numbers() {
        let letter = control.tables.axis(number).letter;
        match control.place(number) {
            Place::Unknown => {
                let message = format!("the position of {letter} is not known here");
                let by = control.state.lost_by(letter);
                let assumed = "assumed to be at its last programmed position";
                control.doubt(by, PostCode::UnknownTurn.diag(message), assumed)?;
                control.assume_position(number);
            }
            Place::Clear => {
                let message = format!("{letter} is at a machine coordinate");
                let assumed = "taken to be where the motion begins";
                control.doubt(Source::Post, PostCode::UnknownTurn.diag(message), assumed)?;
            }
            Place::Between(_) => return refuse_level(control, number),
            _ => {}
        }
    }
    Ok(())
}

/// Refuses a motion in which a rotary axis turns under cutter compensation, or may turn as
/// nothing has said where it stands: the control offsets in the axes of the machine, and the side
/// of the path turns away under it.
///
/// # Errors
/// One turns.
#[cold]
pub(super) fn refuse_compensated(post: &mut Post, before: Option<[f64; 2]>) -> Result<()> {
    let tables = &post.control.tables;
    let is_first = before.is_none() && tables.chain().has_rotary();
    if tables.mills() || !is_first && turned(before, post.path.rotary).is_none() {
        return Ok(());
    }
    post.control.ready_for(Act::RotaryMove)
}

/// Warns of a motion that begins where nobody knows the axes to stand, as behind a tool change or
/// another work offset, and says whether it does: it can be neither divided nor timed, and goes
/// straight to its end at the plain feed.
///
/// # Errors
/// The skip switch decides where it begins.
#[inline]
pub(super) fn warn_where_lost(post: &mut Post) -> Result<bool> {
    let in_doubt = post.path.last.since == Since::ToolChange
        || post.path.point.is_none()
        || post.control.state.has_doubts();
    if in_doubt { warn_if_lost(post) } else { Ok(false) }
}

/// The same of a motion that may begin there, whether anything has left a doubt or not.
///
/// # Errors
/// As [`warn_where_lost`].
#[cold]
pub(super) fn warn_if_lost(post: &mut Post) -> Result<bool> {
    let tables = &post.control.tables;
    if tables.mills() || post.writes_tip() {
        return Ok(false);
    }
    let depends = |number: &usize| matches!(post.control.place(*number), Place::Between(_));
    if let Some(number) = tables.written().numbers().find(depends) {
        return refuse_level(&post.control, number);
    }
    // Settings may leave the axes of a tool change unsaid; it moves them all the same.
    let lost = post.path.last.since == Since::ToolChange
        || tables.written().numbers().any(|number| post.control.stands(number).is_none());
    if lost {
        let message = "a feed move that turns the machine from an unknown place is not divided";
        post.warn(PostCode::Undivided, message.to_string());
    }
    Ok(lost)
}

/// Refuses a text that has turned a rotary axis past its travel.
///
/// # Errors
/// It has.
pub(super) fn refuse_past_travel(
    control: &Control,
    stood: [Option<f64>; AXES],
    stands: [Option<f64>; AXES],
) -> Result<()> {
    let tables = &control.tables;
    for number in AxisSet::ROTARY.and(tables.present()).numbers() {
        let Some(at) = stands[number].filter(|_| stands[number] != stood[number]) else { continue };
        let Some(rotary) = &tables.chain().rotaries[number - 3] else { continue };
        let axis = tables.axis(number);
        // A position within one turn may be reached by another turn.
        let reached = [at, axis.near(at, at - 360.0), axis.near(at, at + 360.0)];
        if !reached.into_iter().any(|at| rotary.reaches(at)) {
            let message = format!("a text turns {} to {at}, past its travel", axis.letter);
            return MachineCode::AxisLimit.err(message);
        }
    }
    Ok(())
}

/// Takes the rotary axes to stand where a text has brought them: the next motion turns from
/// there.
pub(super) fn follow(post: &mut Post) {
    let now = stands(&post.control);
    let tables = &post.control.tables;
    let Some(mut angles) = post.path.rotary.filter(|_| !tables.mills()) else { return };
    for number in AxisSet::ROTARY.and(tables.present()).numbers() {
        let (axis, angle) = (tables.axis(number), &mut angles[number - 3]);
        let here = now[number].map(|here| axis.near(here, *angle));
        if let Some(here) = here.filter(|here| (here - *angle).abs() > axis.resolution()) {
            *angle = here;
        }
    }
    post.path.rotary = Some(angles);
}

#[cfg(test)]
mod tests;
