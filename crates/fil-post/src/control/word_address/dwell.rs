//! Dwells: in seconds or in turns of the spindle.

use fil_diag::Result;
use fil_machine::commons::Dbl;
use fil_machine::modes::FeedMode;
use fil_machine::{Letter, locations as loc};

use crate::control::Control;
use crate::errors::PostCode;
use crate::operation::Dwell;

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
        return PostCode::NoCode.err("the machine can't dwell in revolutions");
    };
    // Code and letter are those of a dwell in seconds: the feed mode tells them apart.
    if control.state.feed_mode != Some(FeedMode::PerRevolution) {
        return PostCode::NoCode
            .err("a dwell in revolutions where the feed is not one a revolution would be seconds");
    }
    Ok(within(control, turns, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX)) * factor)
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
