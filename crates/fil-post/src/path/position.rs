//! Points of the CL file as positions of the machine's axes, as far as no mode of the control matters.

use crate::control::Control;
use crate::operation::Target;
use crate::post::Post;
use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::axis_chain::Turn;
use nalgebra::{Point3, Vector3};

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

/// The rotary positions that those of the next motion are the nearest to, degrees.
#[inline]
pub(super) fn nearest_to(post: &Post) -> [f64; 2] {
    post.path.turning.chosen.or(post.path.rotary).unwrap_or_else(|| on_tape(post))
}

/// Where the rotary axes stood before a feed motion that turns them; `None` for one that
/// does not, or where they stood is not known.
#[inline]
pub fn turned(before: Option<[f64; 2]>, now: Option<[f64; 2]>) -> Option<[f64; 2]> {
    let (before, now) = (before?, now?);
    let turns = before.into_iter().zip(now).any(|(from, to)| (to - from).abs() > STILL);
    turns.then_some(before)
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

/// Where the axes stand, whoever has brought them there.
pub(super) fn stands(control: &Control) -> [Option<f64>; AXES] {
    std::array::from_fn(|number| control.stands(number))
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
