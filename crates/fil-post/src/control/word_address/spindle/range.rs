//! The ranges of the spindle: which one holds a speed, and a speed within them.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::is_main;
use crate::control::{Control, Function};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::SpindleRange;

/// Brings a speed within the range that was chosen, else within the ranges of the
/// machine, with a warning.
pub(super) fn within_range(control: &mut Control, speed: f64) -> f64 {
    let within = speed_in_range(control, speed);
    if within != speed {
        let message = format!("spindle speed {speed} became {within}");
        control.warnings.add(PostCode::Clamped, message);
    }
    within
}

/// Warns of a highest speed above the top of the range in force, or of all ranges where none was
/// chosen: a surface speed goes no higher than that.
pub(super) fn warn_of_limit(control: &mut Control, limit: f64) {
    let top = speed_in_range(control, f64::MAX);
    if limit > top {
        let message =
            format!("SPINDL: a highest speed of {limit}, and the spindle turns {top} at the most");
        control.warnings.add(PostCode::Clamped, message);
    }
}

/// A speed within the range that was chosen, else within the ranges of the machine.
pub(in crate::control) fn speed_in_range(control: &Control, speed: f64) -> f64 {
    if !is_main(control) {
        return speed;
    }
    let commons = &control.commons;
    let open = match control.spindle.range {
        Some(chosen) => chosen..chosen + 1,
        None => 0..ranges(control),
    };
    let limits = loc::RANGE_SPEEDS[open].iter();
    let low = limits.clone().filter_map(|(min, _)| commons.rel_opt(*min)).reduce(f64::min);
    let tops: Option<Vec<f64>> = limits.map(|(_, max)| commons.rel_opt(*max)).collect();
    let high = tops.and_then(|tops| tops.into_iter().reduce(f64::max));
    speed.max(low.unwrap_or(0.0)).min(high.unwrap_or(f64::MAX))
}

/// Number of the ranges of the machine.
fn ranges(control: &Control) -> usize {
    control.commons.int(loc::SPINDLE_RANGES).clamp(1, 6) as usize
}

/// Index of the range that a record names.
///
/// # Errors
/// The machine has none of this number, or none that lies between two others.
pub(super) fn range_of(control: &Control, range: SpindleRange) -> Result<usize> {
    let count = ranges(control);
    match range {
        SpindleRange::Low => Ok(0),
        SpindleRange::High => Ok(count - 1),
        SpindleRange::Medium if count == 3 => Ok(1),
        SpindleRange::Medium => PostCode::WordForm
            .err(format!("SPINDL: none of {count} spindle ranges is the medium one")),
        SpindleRange::Number(number) => {
            (1..=6).position(|one| f64::from(one) == number).ok_or_else(|| {
                PostCode::WordForm.diag(format!("SPINDL: there is no spindle range {number}"))
            })
        }
    }
}

/// Takes the range that holds a speed: that in force, else the machine's first choice,
/// else the lowest one.
///
/// # Errors
/// No range holds the speed, nor one at the ends of all ranges; the range has no code.
pub(in crate::control) fn take_range_of(control: &mut Control, speed: f64) -> Result<()> {
    let holds = |control: &Control, index: usize, speed: f64| {
        let (min, max) = loc::RANGE_SPEEDS[index];
        let above = control.commons.rel_opt(min).is_none_or(|min| speed >= min);
        above && control.commons.rel_opt(max).is_none_or(|max| speed <= max)
    };
    let before = control.spindle.range.take().filter(|index| {
        let code = control.code_if_any(loc::RANGE_CODES[*index]);
        code.is_some() && control.state.get(modal::GEAR) == code
    });
    let speed = within_range(control, speed);
    control.spindle.range = before;
    let count = ranges(control);
    let first = control.commons.int(loc::SPINDLE_DEFAULT_RANGE) - 1;
    let first = before.or(usize::try_from(first).ok()).filter(|first| *first < count);
    let found = first.into_iter().chain(0..count).find(|index| holds(control, *index, speed));
    match found {
        Some(index) if before == Some(index) => Ok(()),
        Some(index) => control.because(control.block.cause, |control| select_range(control, index)),
        None => PostCode::WordForm.err(format!("SPINDL: no spindle range holds {speed} rpm")),
    }
}

pub(super) fn select_range(control: &mut Control, index: usize) -> Result<()> {
    let code = control.code(loc::RANGE_CODES[index], "this spindle range")?;
    control.flush_function(Function::Spindle)?;
    control.spindle.range = Some(index);
    control.m(code);
    control.write_block()
}
