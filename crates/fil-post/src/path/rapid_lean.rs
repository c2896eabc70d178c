//! Rapid motions of a machine whose tool lies along another direction than Z, where the program
//! holds positions of the axes: up is along the tool, not along Z.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use nalgebra::Vector3;

use super::rapid_turn;
use super::tip::{head, tip};
use crate::cause::Cause;
use crate::control::Control;
use crate::control::place::cross_unknown;
use crate::control::{family, heads};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::motion::{Motion, RapidCode};

/// Directions are one where the cosine between them is less than this below 1.
const PARALLEL: f64 = 1e-8;

/// So many of the last digits of an axis are no way, along the tool or across it.
const DIGITS: f64 = 2.0;

/// Positions of a rotary axis nearer than this are one, degrees.
const SAME: f64 = 1e-6;

/// The least share of Z in a way along the tool that leads up to a level of Z; a tool with less
/// lies across Z.
pub(super) const LEAST_RISE: f64 = 0.1;

const ONLY_Z: &str = "Bring the tool out by RAPID and GOTO before it, and turn it upright there.";

/// How the tool lies in the machine, from where a motion begins to where it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lie {
    /// Along an axis, away from the part where the axis counts up, or down.
    Along { number: usize, up: bool },
    /// Along none, or another one at the end.
    Leaning,
}

/// The tool of a machine without heads.
pub(super) const UPRIGHT: Lie = Lie::Along { number: 2, up: true };

impl Lie {
    /// How the tool lies in a motion.
    pub(super) fn of(control: &Control, motion: &Motion) -> Lie {
        let chain = control.tables.chain();
        let is_fixed = !chain.has_heads() && chain.tool == Vector3::z_axis();
        if is_fixed || !holds_positions(control) {
            return UPRIGHT;
        }
        let Some([from, to]) = heads::angles(control, motion) else { return UPRIGHT };
        let [from, to] = [from, to].map(|at| along(chain.tool_at(at)));
        if from == to { from } else { Lie::Leaning }
    }
}

/// X, Y and Z are positions of the axes: not of the tip, nor those of a tilted frame.
fn holds_positions(control: &Control) -> bool {
    !(control.tables.mills() || control.may_be_tilted() || control.may_name_tip())
}

/// True where a linear axis has no place before its next word, as the tool is away from the part.
pub(super) fn is_away(control: &Control) -> bool {
    let mut linear = AxisSet::LINEAR.and(control.tables.present()).numbers();
    linear.any(|number| matches!(control.place(number), Place::Clear | Place::Unsaid))
}

/// The axis that a direction lies along.
fn along(tool: Vector3<f64>) -> Lie {
    match (0..3).find(|number| tool[*number].abs() > 1.0 - PARALLEL) {
        Some(number) => Lie::Along { number, up: tool[number] > 0.0 },
        None => Lie::Leaning,
    }
}

/// Where the rotary axes stand, degrees, as [`heads::angles`].
pub(super) fn turned(control: &Control) -> Option<[f64; 2]> {
    let nothing = Motion::new(Position::default(), AxisSet::NONE, 0);
    heads::angles(control, &nothing).map(|[at, _]| at)
}

/// How far a leaning tool goes along itself to rise in Z.
///
/// # Errors
/// The tool lies across Z.
pub(super) fn way_along(control: &Control, angles: [f64; 2], rise: f64) -> Result<f64> {
    let share = control.tables.chain().tool_at(angles).z;
    if share < LEAST_RISE {
        return PostCode::Leaning
            .err_with("a Z retract to machine coordinates, while the tool lies across Z", ONLY_Z);
    }
    Ok(rise / share)
}

/// Warns of a motion straight up in the frame of the machine, in which nobody knows how far it
/// leads, while a head leans the tool.
pub(super) fn warn_straight_up(control: &mut Control) {
    let chain = control.tables.chain();
    let leans = |at: [f64; 2]| chain.tool_at(at).z < 1.0 - PARALLEL;
    if chain.has_heads() && turned(control).is_some_and(leans) {
        let message = "Z moves straight up in machine coordinates while the head is tilted";
        control.warnings.add(PostCode::StraightUp, message.to_string());
    }
}

/// Makes a rapid motion up along the tool where it stands, across, and down along the tool where
/// it will stand; in one block each, as X, Y and Z go along a leaning tool together.
///
/// # Errors
/// Where an axis stands is not known; a position outside the travel; as [`family::rapid`].
pub(super) fn rapid(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let present = control.tables.present();
    let moves = motion.axes.and(present);
    if moves.and(AxisSet::LINEAR).is_empty() {
        rapid_turn::warn_of_dip(control, motion, &[AxisSet::ALL]);
        return family::rapid(control, motion, RapidCode::Turning, cause);
    }
    let from = stands(control, motion)?;
    let to: Position =
        std::array::from_fn(|n| if moves.has(n) { motion.position[n] } else { from[n] });
    let mut ends = stops(control, &from, &to);
    let between = ends.len();
    ends.push(to);
    rapid_turn::warn_of_dip_between(control, &from, &ends);
    for stop in &ends[..between] {
        control.tables.check_travel(stop, AxisSet::LINEAR)?;
        let turns = (3..5).any(|n| (stop[n] - from[n]).abs() > SAME);
        let axes = if turns { AxisSet::ALL } else { AxisSet::LINEAR };
        let part = Motion::new(*stop, axes.and(present), motion.word);
        family::rapid(control, &part, RapidCode::Across, cause)?;
    }
    family::rapid(control, motion, RapidCode::Across, cause)
}

/// Where all axes stand.
///
/// # Errors
/// One stands nobody knows where.
fn stands(control: &mut Control, motion: &Motion) -> Result<Position> {
    let mut from = Position::default();
    for number in control.tables.present().numbers() {
        from[number] = match control.place(number) {
            Place::At(at) if number < 3 => at,
            Place::At(at) => control.tables.axis(number).near(at, motion.position[number]),
            _ => {
                cross_unknown(control, number)?;
                control.stands(number).unwrap_or(motion.position[number])
            }
        };
    }
    Ok(from)
}

/// Positions over the start of a motion, along the tool, as high as its end lies; `None` where that
/// is no way up.
pub(super) fn over_start(control: &Control, from: &Position, to: &Position) -> Option<Position> {
    let chain = control.tables.chain();
    let up = (tip(chain, to) - tip(chain, from)).dot(&chain.axis_at([from[3], from[4]]));
    (up > least_way(control)).then(|| above(chain, from, up))
}

/// What is no way, as the last digits of the axes make it.
fn least_way(control: &Control) -> f64 {
    let digits = AxisSet::LINEAR.and(control.tables.present()).numbers();
    DIGITS * digits.map(|n| control.tables.axis(n).resolution()).fold(0.0, f64::max)
}

/// Where a rapid motion stops on its way: over the start and over the end, along the tool.
pub(super) fn stops(control: &Control, from: &Position, to: &Position) -> Vec<Position> {
    let chain = control.tables.chain();
    let least = least_way(control);
    let way = tip(chain, to) - tip(chain, from);
    let [up, down] = [from, to].map(|at| way.dot(&chain.axis_at([at[3], at[4]])));
    let over = |at: &Position, by: f64| above(chain, at, by);
    if (3..5).any(|n| (to[n] - from[n]).abs() > SAME) {
        let begins = (up > least).then(|| over(from, up));
        let ends = (down < -least).then(|| over(to, -down));
        return begins.into_iter().chain(ends).collect();
    }
    let across = (way - chain.axis_at([from[3], from[4]]) * up).norm();
    match across > least {
        true if up > least => vec![over(from, up)],
        true if up < -least => vec![over(to, -up)],
        _ => Vec::new(),
    }
}

/// Positions of the axes so far above others, along the tool.
fn above(chain: &AxisChain, at: &Position, by: f64) -> Position {
    let tool = chain.tool_at([at[3], at[4]]);
    let mut position = *at;
    for number in 0..3 {
        position[number] += tool[number] * by;
    }
    position
}

/// Refuses a way to a position of the machine behind a text that may have turned a head anywhere:
/// up may be along Z, or not. Behind another work offset a head still leans as before, and how
/// far up along it the position lies is in the tables of the control.
///
/// # Errors
/// It may; it does.
pub(super) fn refuse_unknown_lean(control: &mut Control) -> Result<()> {
    if !holds_positions(control) || is_away(control) {
        return Ok(());
    }
    let tables = &control.tables;
    let is_lost = |number: &usize| {
        head(tables.chain(), number - 3).is_some()
            && matches!(control.place(*number), Place::Unknown)
    };
    let mut rotary = AxisSet::ROTARY.and(tables.present()).numbers();
    match rotary.find(is_lost).or_else(|| leaning_behind_a_zero(control)) {
        Some(number) => cross_unknown(control, number),
        None => Ok(()),
    }
}

/// The number of a head that leans the tool and counts from another zero since it was turned.
fn leaning_behind_a_zero(control: &Control) -> Option<usize> {
    let chain = control.tables.chain();
    let is_shifted = |number: &usize| {
        head(chain, number - 3).is_some() && heads::behind_a_zero(control, *number).is_some()
    };
    let rotary = AxisSet::ROTARY.and(control.tables.present());
    let shifted = rotary.numbers().filter(is_shifted).last()?;
    let tool = chain.tool_at(turned(control)?);
    (tool.z < 1.0 - PARALLEL).then_some(shifted)
}

/// Goes up along a leaning tool to the level of Z to which a motion of the machine goes, before
/// its other axes move; false for a level that is not above the tool. From a place that is not
/// known Z goes up by itself.
///
/// # Errors
/// The tool lies across Z; where it stands is not known; a position outside the travel.
pub(super) fn go_up_to(control: &mut Control, motion: &Motion, cause: Cause) -> Result<bool> {
    let Some(angles) = turned(control) else { return Ok(true) };
    if !motion.axes.has(2) || is_away(control) {
        return Ok(true);
    }
    let from = stands(control, motion)?;
    let rises = motion.position[2] - from[2];
    if rises <= DIGITS * control.tables.axis(2).resolution() {
        return Ok(false);
    }
    let mut up = above(control.tables.chain(), &from, way_along(control, angles, rises)?);
    up[2] = motion.position[2];
    control.tables.check_travel(&up, AxisSet::LINEAR)?;
    let part = Motion::new(up, AxisSet::LINEAR.and(control.tables.present()), motion.word);
    family::rapid(control, &part, RapidCode::Across, cause)?;
    Ok(true)
}
