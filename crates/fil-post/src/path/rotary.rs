//! From a point and a tool axis in the part to positions of the machine's axes.

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::axis_chain::{self, Turn};
use fil_machine::errors::MachineCode;
use nalgebra::{Point3, Vector3};

use super::{Since, frame, mill_turn, tip_control, turned_apart};
use crate::control::Control;
use crate::control::needs::Act;
use crate::control::skip::refuse_level;
use crate::control_state::{Place, Source};
use crate::errors::PostCode;
use crate::operation::Target;
use crate::post::Post;

/// A smaller turn of a rotary axis counts as none, degrees.
const STILL: f64 = 1e-9;

/// How the machine comes to a position: what is kept of it once it goes there.
#[derive(Clone, Copy, Debug)]
pub enum Solution {
    /// No rotary axis takes part.
    Still,
    /// They stand as the tilted frame in force has turned them.
    InFrame,
    /// They stand at these angles, degrees.
    Angles {
        /// The angles.
        angles: [f64; 2],
        /// Those that are the nearest if no axis has limits.
        free: [f64; 2],
        /// Those with their sines.
        turns: [Turn; 2],
    },
    /// The same of a live tool, where C is the main spindle.
    OfLiveTool([f64; 2]),
    /// The same under tool-tip control.
    OfTip {
        /// The angles.
        angles: [f64; 2],
        /// Those that are the nearest if no axis has limits.
        free: [f64; 2],
        /// The program says the direction of the tool by a vector.
        by_vector: bool,
    },
}

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

/// The rotary positions that those of the next motion are the nearest to, degrees.
#[inline]
pub(super) fn nearest_to(post: &Post) -> [f64; 2] {
    post.path.turning.chosen.or(post.path.rotary).unwrap_or_else(|| on_tape(post))
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
        return mill_turn::position_of(post, point, axis);
    }
    if post.writes_tip() {
        return tip_control::position_of(post, point, axis);
    }
    frame::position_of(post, point, axis)
}

/// Where the rotary axes stood before a feed motion that turns them; `None` for one that
/// does not, or where they stood is not known.
#[inline]
pub fn turned(before: Option<[f64; 2]>, now: Option<[f64; 2]>) -> Option<[f64; 2]> {
    let (before, now) = (before?, now?);
    let turns = before.into_iter().zip(now).any(|(from, to)| (to - from).abs() > STILL);
    turns.then_some(before)
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

/// The words of a motion to a point in the part, after TRANS, with the rotary axes at these
/// angles: positions of the axes, or the tip under tool-tip control.
///
/// # Errors
/// A position outside the travel.
pub(super) fn words_at(post: &Post, point: Point3<f64>, angles: [f64; 2]) -> Result<Position> {
    let tables = &post.control.tables;
    let linear = tables.chain().linear(point, angles);
    let at = |point: Point3<f64>| [point.x, point.y, point.z, angles[0], angles[1]];
    if post.writes_tip() {
        tables.check_travel(&at(linear), AxisSet::LINEAR)?;
        return Ok(at(point));
    }
    Ok(at(linear))
}

/// The target after TRANS and the input translation (DBLCOM 286–288).
#[inline]
pub fn transformed(post: &Post, target: Target) -> (Point3<f64>, Vector3<f64>) {
    let (point, axis) = match &post.path.transformation {
        Some(trans) => (trans.point(target.point), trans.axis(target.axis)),
        None => (target.point, target.axis),
    };
    (point + post.control.tables.input_shift(), axis)
}

/// Rotary positions the last output values stand for, degrees; 0 where unknown.
pub(super) fn on_tape(post: &Post) -> [f64; 2] {
    [3, 4].map(|number| {
        let present = post.control.tables.present().has(number);
        post.control.stands(number).filter(|_| present).unwrap_or(0.0)
    })
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
                let message = format!("where {letter} stands is not known here");
                let by = control.state.lost_by(letter);
                let assumed = "taken to be where its last word says";
                control.doubt(by, PostCode::UnknownTurn.diag(message), assumed)?;
                control.assume_position(number);
            }
            Place::Clear => {
                let message = format!("{letter} stands at a position of the machine");
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
pub(super) fn refuse_compensated(post: &Post, before: Option<[f64; 2]>) -> Result<()> {
    let tables = &post.control.tables;
    let is_first = before.is_none() && tables.chain().has_rotary();
    if tables.mills() || !is_first && turned(before, post.path.rotary).is_none() {
        return Ok(());
    }
    post.control.require(Act::RotaryMove)
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
        let message =
            "a motion at feed that turns the machine from an unknown place is not divided";
        post.warn(PostCode::Undivided, message.to_string());
    }
    Ok(lost)
}

/// Where the axes stand, whoever has brought them there.
pub(super) fn stands(control: &Control) -> [Option<f64>; AXES] {
    std::array::from_fn(|number| control.stands(number))
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

/// The word of the record that the axis words of a target repeat; 0 where a rotary
/// axis or TRANS mixes its coordinates.
#[inline]
pub fn word_of(post: &Post, target: Target) -> u16 {
    let chain = post.control.tables.chain();
    let mixed = post.path.transformation.is_some()
        || chain.has_rotary()
        || target.axis != chain.tool.into_inner();
    if mixed { 0 } else { target.word }
}

#[cfg(test)]
mod tests;
