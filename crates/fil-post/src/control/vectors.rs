//! The direction of the tool as a vector under tool-tip control: I, J, K behind G43.5; A3, B3,
//! C3; TX, TY, TZ. Each motion says all of it, whatever the control has: no word of it is modal
//! in the same way on all controls.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::axes::{AXES, AxisSet};
use fil_machine::letters::IJK;

use super::Control;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::motion::Motion;

/// What helps where a vector can't say the direction.
pub const SAY_ANGLES: &str = "Output angles with rotary.tip_form = 0.";

/// Positions nearer to each other than this are the same, degrees.
const SAME: f64 = 1e-6;

/// A way is the shorter one where it is shorter by this, degrees: a vector is rounded.
const CLEARLY: f64 = 0.5;

/// True while I, J and K are the direction of the tool, and no centers.
pub(super) fn are_in_force(control: &Control) -> bool {
    control.tables.tip_vectors && control.state.is(modal::TCP, true)
}

/// True when the motion at hand is to say the direction of the tool by a vector.
pub(super) fn are_due(control: &Control, motion: &Motion) -> bool {
    control.tip.by_vector
        && control.state.is(modal::TCP, true)
        && !motion.axes.and(AxisSet::ROTARY).and(control.tables.present()).is_empty()
}

/// Adds X, Y, Z and the vector, and says which of the three; what the rotary axes are told by words
/// is in doubt from here on.
///
/// # Errors
/// The machine has no I, J or K; REPEAT turns a rotary axis beside the vector.
#[cold]
pub(super) fn axis_words(
    control: &mut Control,
    motion: &Motion,
    changed: AxisSet,
    scaled: &[i64; AXES],
) -> Result<AxisSet> {
    refuse_repeats(control)?;
    let metric = control.is_metric();
    control.tables.format_vectors(&control.commons, metric, true);
    let linear = changed.and(AxisSet::LINEAR);
    let linear = if linear.is_empty() { AxisSet::LINEAR } else { linear };
    for number in linear.numbers() {
        if let Some(position) = control.tables.axis(number).tape_position()? {
            control.block.put(position, scaled[number]);
        }
    }
    let angles = [motion.position[3], motion.position[4]];
    let direction = control.tables.chain().axis_at(angles).normalize();
    for (letter, part) in IJK.into_iter().zip(direction.iter()) {
        let Some(position) = control.tables.addresses.required(letter)? else {
            return PostCode::TipControl.err_with(
                format!("{letter} is not output, but the tool direction vector needs it"),
                SAY_ANGLES,
            );
        };
        let scaled = control.tables.addresses.slot(position).format.scale(*part)?;
        control.block.put(position, scaled);
    }
    for number in AxisSet::ROTARY.and(control.tables.present()).numbers() {
        let axis = *control.tables.axis(number);
        let value = axis.value(motion.position[number])?;
        control.commons.set_last_output(axis.letter, value);
        control.state.doubt(axis.letter);
    }
    control.tip.leans = Some(angles);
    Ok(linear)
}

/// True where the rotary axes stand in one place only: as words or a vector have said, in no
/// block that may be skipped.
pub fn stand_known(control: &Control) -> bool {
    let said = |number: usize| {
        let letter = control.tables.axis(number).letter;
        control.state.has_last(letter) && control.axis_position(number).is_some()
    };
    let rotary = AxisSet::ROTARY.and(control.tables.present());
    let known = control.tip.leans.is_some() || rotary.numbers().all(said);
    known && !control.state.may_be_skipped()
}

/// REPEAT would bring words of rotary axes, or other vectors, into the block.
fn refuse_repeats(control: &Control) -> Result<()> {
    let rotary = |letter: &Letter| {
        let mut numbers = AxisSet::ROTARY.and(control.tables.present()).numbers();
        numbers.any(|number| control.tables.axis(number).letter == *letter)
    };
    match control.repeat.words.keys().find(|letter| rotary(letter) || IJK.contains(letter)) {
        Some(letter) => PostCode::TipControl.err_with(
            format!("REPEAT of {letter}: the tool direction is output as a vector"),
            SAY_ANGLES,
        ),
        None => Ok(()),
    }
}

/// I, J and K are lengths again, and none of them is known.
pub fn end(control: &mut Control) {
    if !control.tables.tip_vectors {
        return;
    }
    let metric = control.is_metric();
    control.tables.format_vectors(&control.commons, metric, false);
    IJK.into_iter().for_each(|letter| control.state.doubt(letter));
    control.tip.leans = None;
}

/// Notes that words turn a rotary axis.
///
/// # Errors
/// The control is told directions and takes no such words.
pub(super) fn turned_by_words(control: &mut Control) -> Result<()> {
    control.tip.leans = None;
    if are_in_force(control) && !control.can().angles_beside_vectors {
        return PostCode::TipControl
            .err_with("a rotary axis is programmed by its own word after G43.5", SAY_ANGLES);
    }
    Ok(())
}

/// Whether a motion to positions of the rotary axes may be said by a vector: one control takes
/// those positions to which its first axis turns least, another the second one or the sum, so
/// all other positions for the same direction must be farther for one axis and nearer for none.
pub fn say_the_same(solutions: &[[f64; 2]], from: [f64; 2], to: [f64; 2]) -> bool {
    let own = [0, 1].map(|n| (to[n] - from[n]).abs());
    if own.iter().any(|turn| *turn > 180.0 - CLEARLY) {
        return false;
    }
    let farther = |other: &[f64; 2]| {
        let ways = [0, 1].map(|n| shortest(other[n] - from[n]).abs());
        let same = (0..2).all(|n| shortest(other[n] - to[n]).abs() < SAME);
        let nearer = (0..2).any(|n| ways[n] < own[n] - SAME);
        same || (!nearer && (0..2).any(|n| ways[n] > own[n] + CLEARLY))
    };
    solutions.iter().all(farther)
}

/// A turn without whole turns, -180 to 180 degrees.
fn shortest(turn: f64) -> f64 {
    turn - 360.0 * (turn / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positions_that_each_axis_is_nearest_to_go_without_saying() {
        let pair = |a: f64, c: f64| [[a, c], [-a, c + 180.0]];
        assert!(say_the_same(&pair(30.0, 10.0), [25.0, 8.0], [30.0, 10.0]));
        // Through the pole: A turns least the other way, C this way.
        assert!(!say_the_same(&pair(-5.0, 10.0), [5.0, 10.0], [-5.0, 10.0]));
        // From the pole both ways are as far for A.
        assert!(say_the_same(&pair(30.0, 10.0), [0.0, 0.0], [30.0, 10.0]));
        assert!(!say_the_same(&pair(30.0, 100.0), [0.0, 0.0], [30.0, 100.0]));
        assert!(!say_the_same(&pair(30.0, 90.0), [0.0, 0.0], [30.0, 90.0]));
        assert!(!say_the_same(&[[0.0, 180.0]], [0.0, 0.0], [0.0, 180.0]));
        // Whole turns of an axis count for nothing.
        assert!(say_the_same(&pair(30.0, 2.0), [30.0, 358.0], [30.0, 362.0]));
    }
}
