//! The way of an author's block to a reference point: in absolute coordinates a control goes first
//! to the axis words beside G28 and G30, in the part.

use fil_machine::functions::Origin;
use fil_machine::{Letter, locations as loc};

use super::Control;
use crate::control_state::{Distance, Meaning, functions, modal};
use crate::errors::PostCode;

/// Warns of a way that leads down: Z below the tool, or X of a lathe, or a place that is not known.
pub(super) fn warn(control: &mut Control, words: &[(Letter, f64)]) {
    let home =
        functions(words).find(|code| control.codes.meaning(*code) == Meaning::Origin(Origin::Home));
    let Some(code) = home.filter(|_| counts_absolute(control, words)) else { return };
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    let axes = [0, 2].into_iter().filter(|axis| *axis == 2 || is_lathe);
    let down = axes.filter_map(|axis| {
        let axis = control.tables.axis(axis);
        let value = words.iter().find(|word| word.0 == axis.letter)?.1;
        is_down(control, axis.letter, value, axis.scale() < 0.0).then_some((axis.letter, value))
    });
    let ways: Vec<String> = down.map(|(letter, value)| format!("{letter}{value}")).collect();
    if !ways.is_empty() {
        let message = format!("G{code} goes to {} in the part on its way", ways.join(" "));
        control.warnings.add(PostCode::ReferenceWay, message);
    }
}

/// Coordinates count from the zero in the block of these words.
fn counts_absolute(control: &Control, words: &[(Letter, f64)]) -> bool {
    let said = |distance: Distance| {
        functions(words).any(|code| control.codes.meaning(code) == Meaning::Distance(distance))
    };
    let in_force = control.state.is(modal::DISTANCE, Distance::Absolute);
    !said(Distance::Incremental) && (in_force || said(Distance::Absolute))
}

/// A position is below the one that the axis has, or that one is not known.
fn is_down(control: &Control, letter: Letter, value: f64, counts_down: bool) -> bool {
    if !control.state.has_last(letter) {
        return true;
    }
    let last = control.commons.last_output(letter);
    if counts_down { value > last } else { value < last }
}
