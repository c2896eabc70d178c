//! Dwells: in seconds or in turns of the spindle.

use fil_diag::Result;
use fil_machine::commons::Dbl;
use fil_machine::letters::S;
use fil_machine::modes::FeedMode;
use fil_machine::{Letter, locations as loc};

use crate::control::Control;
use crate::errors::PostCode;
use crate::operation::{Dwell, SpindleSpeed};

/// Writes a dwell block.
///
/// # Errors
/// The machine has no dwell, or the value does not fit.
pub fn write(control: &mut Control, dwell: Dwell) -> Result<()> {
    let value = match dwell {
        Dwell::Seconds(seconds) => in_seconds(control, seconds),
        Dwell::Revolutions(turns) => in_revolutions(control, turns)?,
    };
    let letter = control.letter(loc::DWELL_ADDRESS, "the address of a dwell")?;
    let code = control.code(loc::DWELL_CODE, "a dwell")?;
    control.g_of_record(code);
    control.word(letter, value)?;
    control.write_block()?;
    control.state.doubt(letter);
    Ok(())
}

/// Adds the dwell of a cycle, in seconds.
///
/// # Errors
/// The machine has no address for it, or the value does not fit.
pub fn cycle_word(control: &mut Control, seconds: f64) -> Result<()> {
    let letter: Letter = control.letter(loc::CYCLE_DWELL_ADDRESS, "the dwell of a cycle")?;
    let value = in_seconds(control, seconds);
    control.word(letter, value)
}

/// Seconds in the control's unit (DBLCOM 980: 1000 for milliseconds, 0 as they
/// are), brought within its range.
fn in_seconds(control: &mut Control, seconds: f64) -> f64 {
    let factor = control.commons.dbl_opt(loc::DWELL_UPM_FACTOR).filter(|factor| *factor > 0.0);
    within(control, seconds, (loc::DWELL_UPM_MIN, loc::DWELL_UPM_MAX)) * factor.unwrap_or(1.0)
}

fn in_revolutions(control: &mut Control, turns: f64) -> Result<f64> {
    let factor = control.commons.dbl_opt(loc::DWELL_UPR_FACTOR).filter(|factor| *factor > 0.0);
    let Some(factor) = factor else {
        let seconds = turns * 60.0 / turns_a_minute(control)?;
        return Ok(in_seconds(control, seconds));
    };
    // Code and letter are those of a dwell in seconds: the feed mode tells them apart.
    if control.state.feed_mode != Some(FeedMode::PerRevolution) {
        return PostCode::NoCode
            .err("a dwell in revolutions where the feed is not one a revolution would be seconds");
    }
    Ok(within(control, turns, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX)) * factor)
}

/// The speed of the spindle, for a machine that waits seconds only.
///
/// # Errors
/// None is known, or it changes with the radius.
fn turns_a_minute(control: &Control) -> Result<f64> {
    let of_turns = matches!(control.speed, Some(SpindleSpeed::Revolutions(_)));
    let speed = control.last_value(S).filter(|speed| of_turns && *speed > 0.0);
    speed.ok_or_else(|| {
        let mut diag = PostCode::NoCode.diag(
            "the machine can't dwell in revolutions, and how fast the spindle turns is not known",
        );
        diag.hint = Some(
            "Give the spindle turns a minute (SPINDL / RPM) before it, or the dwell in seconds."
                .into(),
        );
        diag
    })
}

fn within(control: &mut Control, amount: f64, (min, max): (Dbl, Dbl)) -> f64 {
    let low = control.commons.dbl_opt(min).unwrap_or(0.0);
    let high = control.commons.dbl_opt(max).filter(|max| *max > 0.0).unwrap_or(f64::MAX);
    let within = amount.max(low).min(high);
    if within != amount {
        control.warnings.add(PostCode::Clamped, format!("dwell {amount} became {within}"));
    }
    within
}
