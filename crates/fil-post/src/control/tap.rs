//! The pitch of a tap, and the feed that cuts it at the speed that is on the tape.
//!
//! A tap moves by its pitch in each turn of the spindle. Words that name the pitch (a feed per
//! revolution, Q239, PIT of CYCLE84, K of G331) hold at any speed. A feed per minute holds at the S
//! of the program only, which rounding and the spindle ranges may have changed: it is that S times
//! the pitch, and no feed limit may change it.

use fil_diag::Result;
use fil_machine::commons::EMPTY;
use fil_machine::letters::S;
use fil_machine::locations::{self as loc, ControlFamily};
use fil_machine::modes::FeedMode;
use fil_machine::rounding::Rounding;

use super::Control;
use super::word_address::spindle::speed_in_range;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed};
use crate::operation::{Feed, SpindleSpeed};

/// Largest share of a pitch that rounding may change.
pub(super) const SHARE: f64 = 0.0005;

/// Share of a feed that is only the arithmetic of floating point.
const SAME: f64 = 1e-9;

/// The pitch without its sign, mm or inch per revolution.
///
/// # Errors
/// A feed per minute without a speed in rev/min, or outside the limits of the machine.
pub fn pitch(control: &Control, cycle: &Cycle) -> Result<f64> {
    let feed = match cycle.feed {
        CycleFeed::Lead(lead) => return Ok(lead.value),
        CycleFeed::Feed(feed) => feed,
    };
    match (feed.mode, control.spindle.speed) {
        (FeedMode::PerRevolution, _) => Ok(feed.value),
        (FeedMode::PerMinute, Some(SpindleSpeed::Revolutions(turns))) if turns > 0.0 => {
            a_minute(control, cycle)?;
            Ok(feed.asked / control.upm_factor() / turns)
        }
        _ => PostCode::CycleForm.err_with(
            "a tap at feed per minute has its pitch from the spindle speed, which is not known",
            "Put SPINDL / RPM before CYCLE / TAP, or name the pitch: CYCLE / TAP, MMPR, 1.5.",
        ),
    }
}

/// The feed per minute of a tap, as F counts it: its pitch times the S on the tape.
///
/// # Errors
/// The speed is not known; a feed outside the limits of the machine.
pub fn a_minute(control: &Control, cycle: &Cycle) -> Result<f64> {
    let Some(SpindleSpeed::Revolutions(turns)) = control.spindle.speed else {
        return PostCode::CycleForm.err("a tap needs the spindle speed in rev/min (SPINDL / RPM)");
    };
    let speed = speed_on_tape(control, turns)?;
    let feed = match cycle.feed {
        // The quotient is exactly 1 where the tape has the speed that was asked for.
        CycleFeed::Feed(feed) if feed.mode == FeedMode::PerMinute => feed.asked * (speed / turns),
        _ => pitch(control, cycle)? * speed * control.upm_factor(),
    };
    refuse_outside_limits(control, feed, speed)?;
    Ok(feed)
}

/// F of a tap counts minutes, as the machine has no code for a feed per revolution.
pub fn counts_minutes(control: &Control) -> bool {
    let is_lacking = control.code_if_any(loc::FEED_UPR_CODE).is_none();
    let by_word_address = control.tables.family == ControlFamily::WordAddress;
    is_lacking && by_word_address && !control.state.is(modal::FEED_MODE, FeedMode::PerRevolution)
}

/// The feed of a tap by a cycle of word address: a feed per minute at the speed on the tape, else
/// the pitch, or on a machine without a code for a feed per revolution what cuts it per minute.
///
/// # Errors
/// Constant surface speed, or a highest speed below that of the tap, where F counts minutes; and as
/// [`a_minute`].
pub fn feed(control: &Control, cycle: &Cycle) -> Result<Feed> {
    let feed = match cycle.feed {
        CycleFeed::Feed(feed) if feed.mode == FeedMode::PerMinute => feed,
        CycleFeed::Feed(feed) => return of_pitch(control, cycle, feed),
        CycleFeed::Lead(lead) => {
            let mode = FeedMode::PerRevolution;
            let feed = Feed { value: lead.value, asked: lead.value, mode, cause: lead.cause };
            return of_pitch(control, cycle, feed);
        }
    };
    match control.spindle.speed {
        Some(SpindleSpeed::Revolutions(_)) => {
            refuse_above_highest_speed(control)?;
            Ok(Feed { value: a_minute(control, cycle)?, ..feed })
        }
        Some(_) => PostCode::CycleForm.err_with(
            "a tap at feed per minute and at constant surface speed: the pitch would change with \
             the speed",
            "Put SPINDL / RPM before CYCLE / TAP, or name the pitch: CYCLE / TAP, MMPR, 1.5.",
        ),
        None => {
            refuse_outside_limits(control, feed.asked, 0.0)?;
            Ok(Feed { value: feed.asked, ..feed })
        }
    }
}

/// The feed of a tap whose pitch is named.
///
/// # Errors
/// Where F counts minutes, as [`a_minute`].
fn of_pitch(control: &Control, cycle: &Cycle, feed: Feed) -> Result<Feed> {
    if !counts_minutes(control) {
        return Ok(feed);
    }
    refuse_above_highest_speed(control)?;
    Ok(Feed { value: a_minute(control, cycle)?, mode: FeedMode::PerMinute, ..feed })
}

/// The speed as the tape has it: within its range, rounded to the digits of S.
///
/// # Errors
/// S does not fit its address, or the last S is another one.
fn speed_on_tape(control: &Control, turns: f64) -> Result<f64> {
    let asked = speed_in_range(control, turns);
    let format = control.tables.addresses.format(S).copied().unwrap_or_default();
    let speed = format.unscale(Rounding::of(S).scale(asked, &format)?);
    let last = control.commons.last_output(S);
    let is_limit = control.state.get(modal::SPEED_LIMIT) == Some(last);
    if last == EMPTY || !control.state.has_last(S) || is_limit || last == asked || last == speed {
        return Ok(speed);
    }
    PostCode::CycleForm.err_with(
        format!("a tap at {speed} rev/min, and the last S of the program is {last}"),
        "Put SPINDL with the speed of the tap before its CYCLE.",
    )
}

/// Refuses a feed that the machine would limit: the pitch would become another one.
///
/// # Errors
/// The feed, in the units of F at this speed in rev/min (0 where it is not known), is outside the
/// limits.
fn refuse_outside_limits(control: &Control, feed: f64, speed: f64) -> Result<()> {
    let commons = &control.commons;
    let value = feed / control.upm_factor();
    let least = commons.dbl_opt(loc::FEED_UPM_MIN).unwrap_or(0.0);
    let most = commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::MAX);
    let of_z = control.tables.motion.largest_of[1].unwrap_or(f64::MAX);
    let (limit, setting, word) = match value {
        _ if value > of_z * (1.0 + SAME) => (of_z, "feed.upm_max_z", "highest"),
        _ if value > most * (1.0 + SAME) => (most, "feed.upm_max", "highest"),
        _ if value < least * (1.0 - SAME) => (least, "feed.upm_min", "lowest"),
        _ => return Ok(()),
    };
    let mut diag = PostCode::CycleForm.diag(format!(
        "the feed {value} of a tap is beyond {setting} = {limit}, which would change its pitch"
    ));
    if speed > 0.0 {
        let turns = speed * limit / value;
        let turns = if word == "lowest" { turns.ceil() } else { turns.floor() };
        diag.hint =
            Some(format!("The {word} speed that keeps this pitch is SPINDL / RPM, {turns}."));
    }
    Err(diag)
}

/// Refuses a tap above the highest speed that MAXRPM has set: whether the control holds the spindle
/// to it, while the feed per minute stays, is not known.
fn refuse_above_highest_speed(control: &Control) -> Result<()> {
    let (Some(SpindleSpeed::Revolutions(speed)), Some(limit)) =
        (control.spindle.speed, control.state.get(modal::SPEED_LIMIT))
    else {
        return Ok(());
    };
    if speed <= limit || control.tables.mills() {
        return Ok(());
    }
    PostCode::CycleForm.err_with(
        format!(
            "a tap at feed per minute and {speed} rev/min, above the highest speed {limit} of \
             MAXRPM: a control that holds the spindle to it would cut another pitch"
        ),
        "Name the pitch (CYCLE / TAP, MMPR, 1.5), or raise SPINDL / MAXRPM.",
    )
}

/// A pitch with so many digits after the point.
///
/// # Errors
/// One that they can't say.
pub fn text(pitch: f64, digits: usize) -> Result<String> {
    let text = format!("{pitch:.digits$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - pitch).abs() > SHARE * pitch {
        return PostCode::Family.err(format!("a pitch of {pitch} would be written as {written}"));
    }
    Ok(text.to_string())
}
