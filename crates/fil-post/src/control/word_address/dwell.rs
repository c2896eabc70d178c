//! Dwells: in seconds or in turns of the spindle.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::commons::{Dbl, Int};
use fil_machine::letters::S;
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, INCH};
use fil_machine::number::NumberFormat;
use fil_machine::rounding::Rounding;

use super::spindle::{counted, speed_in_range, surface_in_unit};
use crate::control::{Control, Function};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::{Dwell, SpindleSpeed};

/// Writes a dwell block.
///
/// # Errors
/// The machine has no dwell, or the value does not fit.
pub fn write(control: &mut Control, dwell: Dwell) -> Result<()> {
    let value = match dwell {
        Dwell::Seconds(seconds) => {
            leave_turns(control)?;
            in_seconds(control, seconds)
        }
        Dwell::Revolutions(turns) => {
            // The turns are those of the speed that was asked for last.
            control.flush_function(Function::Spindle)?;
            in_revolutions(control, turns)?
        }
    };
    let letter = control.letter(loc::DWELL_ADDRESS, "the address of a dwell")?;
    let code = control.code(loc::DWELL_CODE, "a dwell")?;
    let at = match dwell {
        Dwell::Seconds(_) => loc::DWELL_UPM_FORMAT,
        Dwell::Revolutions(_) => loc::DWELL_UPR_FORMAT,
    };
    let usual = take_format(control, letter, at);
    control.g_of_record(code);
    let value = match dwell {
        Dwell::Revolutions(_) if !dwells_in_turns(control) => rounded_up(control, letter, value),
        _ => value,
    };
    control.word(letter, value)?;
    control.write_block()?;
    restore_format(control, usual);
    control.state.doubt(letter);
    Ok(())
}

/// Seconds in whole last digits of their address, not less: so many turns, or more, are waited for.
fn rounded_up(control: &Control, letter: Letter, value: f64) -> f64 {
    const EXACT: f64 = 1e-6;
    let Some(format) = control.tables.addresses.format(letter) else { return value };
    let digit = format.unscale(1);
    (value / digit - EXACT).ceil() * digit
}

/// Writes the words of a letter with the digits of a setting until [`restore_format`];
/// 0 keeps those of the address.
fn take_format(control: &mut Control, letter: Letter, at: Int) -> Option<UsualFormat> {
    let digits = control.commons.int_opt(at).filter(|digits| *digits > 0)?;
    let usual = *control.tables.addresses.format(letter)?;
    let own = usual.with_digits(digits, control.is_metric());
    control.tables.addresses.set_format(letter, own);
    Some(UsualFormat { letter, format: usual })
}

/// Goes back to the format of the address.
pub fn restore_format(control: &mut Control, usual: Option<UsualFormat>) {
    if let Some(UsualFormat { letter, format }) = usual {
        control.tables.addresses.set_format(letter, format);
    }
}

/// The format that a letter has when it is no dwell.
#[derive(Clone, Copy, Debug)]
pub struct UsualFormat {
    letter: Letter,
    format: NumberFormat,
}

/// The format for the dwell of a cycle in its block; to be given back behind it.
pub fn format_of_cycle(control: &mut Control) -> Option<UsualFormat> {
    let letter = control.commons.read(loc::CYCLE_DWELL_ADDRESS)?;
    take_format(control, letter, loc::DWELL_UPM_FORMAT)
}

/// Adds the dwell of a cycle, in seconds.
///
/// # Errors
/// The machine has no address for it, or the value does not fit; the control would wait
/// turns of the spindle, as the feed of the cycle is one a revolution.
pub fn cycle_word(control: &mut Control, seconds: f64, mode: FeedMode) -> Result<()> {
    if dwells_in_turns(control) && mode == FeedMode::PerRevolution {
        return PostCode::CycleForm.err(
            "a dwell in seconds in a cycle whose feed is one a revolution: this control would \
             wait turns of the spindle",
        );
    }
    let letter: Letter = control.letter(loc::CYCLE_DWELL_ADDRESS, "the dwell of a cycle")?;
    let value = in_seconds(control, seconds);
    control.word(letter, value)
}

/// On a control that dwells in turns of the spindle while its feed is one a revolution,
/// a dwell in seconds needs a feed a minute; the next feed motion says its own mode again.
fn leave_turns(control: &mut Control) -> Result<()> {
    // F of a SINUMERIK's G4 is seconds in any mode, and G94 would end a surface speed.
    if control.can().speed_modes_say_feed || !waits_turns(control) {
        return Ok(());
    }
    let code = control.code(loc::FEED_UPM_CODE, "feed per minute")?;
    control.g_of_record(code);
    control.write_block()
}

/// True for a machine that can dwell in turns of the spindle.
fn dwells_in_turns(control: &Control) -> bool {
    control.commons.dbl_opt(loc::DWELL_UPR_FACTOR).is_some_and(|factor| factor > 0.0)
}

/// True while the control takes a dwell as turns of the spindle.
fn waits_turns(control: &Control) -> bool {
    dwells_in_turns(control) && control.state.is(modal::FEED_MODE, FeedMode::PerRevolution)
}

/// Seconds in the control's unit (DBLCOM 980: 1000 for milliseconds, 0 as they
/// are), brought within its range.
fn in_seconds(control: &mut Control, seconds: f64) -> f64 {
    let factor = control.commons.dbl_opt(loc::DWELL_UPM_FACTOR).filter(|factor| *factor > 0.0);
    seconds_within(control, seconds) * factor.unwrap_or(1.0)
}

/// Seconds brought within the range of the machine.
pub(in crate::control) fn seconds_within(control: &mut Control, seconds: f64) -> f64 {
    within(control, seconds, (loc::DWELL_SECONDS_MIN, loc::DWELL_SECONDS_MAX))
}

/// Turns of the spindle as the seconds that they take.
///
/// # Errors
/// How fast the spindle turns is not known.
pub(in crate::control) fn seconds_of_turns(control: &Control, turns: f64) -> Result<f64> {
    Ok(turns * 60.0 / turns_a_minute(control)?)
}

fn in_revolutions(control: &mut Control, turns: f64) -> Result<f64> {
    let factor = control.commons.dbl_opt(loc::DWELL_UPR_FACTOR).filter(|factor| *factor > 0.0);
    let Some(factor) = factor else {
        let seconds = seconds_of_turns(control, turns)?;
        return Ok(in_seconds(control, seconds));
    };
    // Code and letter are those of a dwell in seconds: the feed mode tells them apart.
    if !control.state.is(modal::FEED_MODE, FeedMode::PerRevolution) {
        return PostCode::NoCode
            .err("a dwell in revolutions where the feed is not one a revolution would be seconds");
    }
    Ok(within(control, turns, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX)) * factor)
}

/// The speed of the spindle, turns a minute; `None` where it is not known or changes with the
/// radius.
pub(crate) fn known_speed(control: &Control) -> Option<f64> {
    // The last S may be that of a limit.
    let Some(SpindleSpeed::Revolutions(asked)) = control.spindle.speed else { return None };
    let speed = speed_in_range(control, asked);
    Some(speed).filter(|speed| *speed > 0.0 && !counted::is_unknown(control))
}

/// The slowest that the spindle may turn at the surface speed in force, turns a minute: that of
/// the diameter at which the tool stands, no more than the highest speed in force. `None` where
/// X, that speed or its top are not known.
fn lowest_of_surface(control: &Control) -> Option<f64> {
    let is_said = control.state.is(modal::SURFACE_SPEED, true) && !control.tables.mills();
    if !is_said || counted::is_unknown(control) {
        return None;
    }
    let metric = control.is_metric();
    let (speed, mm) = (surface_in_unit(control.spindle.speed?, metric)?, control.unit?.in_mm());
    let format = control.tables.addresses.format(S)?;
    // What S says, where rounding makes it less.
    let said = format.unscale(Rounding::of(S).scale(speed, format).ok()?);
    let way = speed.min(said) * if metric { 1000.0 } else { 12.0 * INCH };
    let diameter = 2.0 * control.stands(0)?.abs() * mm;
    // No speed is above all ranges but one that nothing holds.
    let of_ranges = Some(speed_in_range(control, f64::MAX)).filter(|top| *top < f64::MAX);
    let top = [control.state.get(modal::SPEED_LIMIT), of_ranges]
        .into_iter()
        .flatten()
        .reduce(f64::min)?;
    let turns = (way / (std::f64::consts::PI * diameter)).min(top);
    Some(turns).filter(|turns| *turns > 0.0)
}

/// The speed of the spindle, for a machine that waits seconds only.
///
/// # Errors
/// None is known.
fn turns_a_minute(control: &Control) -> Result<f64> {
    known_speed(control).or_else(|| lowest_of_surface(control)).ok_or_else(|| {
        let mut diag = PostCode::NoCode.diag(
            "the machine can't dwell in revolutions, and how fast the spindle turns is not known",
        );
        diag.hint = Some("Put SPINDL / RPM before it, or give the dwell in seconds.".into());
        diag
    })
}

pub(in crate::control) fn within(
    control: &mut Control,
    amount: f64,
    (min, max): (Dbl, Dbl),
) -> f64 {
    let low = control.commons.dbl_opt(min).unwrap_or(0.0);
    let high = control.commons.dbl_opt(max).filter(|max| *max > 0.0).unwrap_or(f64::MAX);
    let within = amount.max(low).min(high);
    if within != amount {
        control.warnings.add(PostCode::Clamped, format!("dwell {amount} became {within}"));
    }
    within
}
