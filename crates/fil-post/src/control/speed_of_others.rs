//! The speed of the spindle by words of others: INSERT, POSTN and texts of the machine. What
//! counts on the speed of the last SPINDL behind them would count on a wrong one.

use fil_machine::letters::{M, S};
use fil_machine::locations as loc;
use fil_machine::{FunctionCode, Letter};

use super::Control;
use crate::control_state::{Meaning, Source, functions, modal};
use crate::operation::SpindleSpeed;

/// Learns from the words of a block, behind what its functions do. `is_certain`: it is run, and
/// nothing else stands in it.
pub(super) fn learn(control: &mut Control, words: &[(Letter, f64)], is_certain: bool) {
    let is_certain = is_certain && !control.state.may_be_skipped();
    let said = words.iter().rev().find(|(letter, _)| *letter == S).map(|(_, value)| *value);
    let mode = control.code_if_any(loc::CYCLE_RIGID_TAP_MODE);
    let is_mode = |(letter, value): &(Letter, f64)| {
        *letter == M && mode.is_some() && FunctionCode::of_value(*value) == mode
    };
    if words.iter().any(is_mode) {
        control.spindle.in_step =
            said.filter(|_| is_certain).map(|speed| (control.tape.count, speed));
    }
    let codes = || functions(words);
    let named = |at| {
        let code = control.code_if_any(at);
        code.is_some_and(|code| codes().any(|said| said == code))
    };
    if named(loc::SPINDLE_MAX_CODE) {
        control.state.set_if_known(
            modal::SPEED_LIMIT,
            said.filter(|_| is_certain).or(control.state.get(modal::SPEED_LIMIT)),
            Source::Author,
        );
        return;
    }
    let is_of_speed = |code| matches!(control.meaning(code), Meaning::SpeedMode(_));
    let changes = codes().any(is_of_speed);
    let is_of_feed = |code| matches!(control.meaning(code), Meaning::FeedMode(_));
    let ends_surface = !changes && control.codes.speeds_are_feeds() && codes().any(is_of_feed);
    let pauses = named(loc::DWELL_CODE);
    if ends_surface {
        end_surface_speed(control);
    }
    if pauses || said.is_none() && !changes {
        return;
    }
    let by_surface = control.state.is(modal::SURFACE_SPEED, true);
    let is_open = control.state.surface_speed_is_open();
    let is_speed = is_certain && !is_open && control.commons.read(loc::SPINDLE_DIRECT_RPM);
    control.spindle.speed = match said.filter(|_| is_speed) {
        None => None,
        Some(value) if by_surface && control.is_metric() => Some(SpindleSpeed::Meters(value)),
        Some(value) if by_surface => Some(SpindleSpeed::Feet(value)),
        Some(value) => Some(SpindleSpeed::Revolutions(value)),
    };
}

/// G94 and G95 of a SINUMERIK end G96, which is one of their group.
fn end_surface_speed(control: &mut Control) {
    if matches!(control.spindle.speed, Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_))) {
        control.spindle.speed = None;
        control.state.forget(modal::SURFACE_SPEED, Source::Author);
    }
}
