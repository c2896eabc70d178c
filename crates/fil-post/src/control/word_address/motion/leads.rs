//! The words of a lead: their mode and digits, and a lead as that of several threads.

use fil_diag::{Code, Diag, Result};
use fil_machine::Letter;
use fil_machine::errors::MachineCode;
use fil_machine::letters::F;
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;
use fil_machine::number::NumberFormat;
use fil_machine::rounding::Rounding;

use crate::cause::Cause;
use crate::control::Control;
use crate::control_state::modal;
use crate::operation::Lead;

/// Most threads whose lead is said at once: as many an inch.
const MOST_THREADS: u32 = 200;

/// A lead of several threads that rounding changes less is held to the digit, mm or inch.
const TO_THE_DIGIT: f64 = 1e-7;

/// Brings the control to feeds a turn, in a block of its own, where F is the lead of a thread: some
/// controls cut no thread in another mode (Haas, G32), the others read the lead in any.
///
/// # Errors
/// As a block.
pub fn lead_mode(control: &mut Control, cause: Cause) -> Result<()> {
    let is_said = control.state.is(modal::FEED_MODE, FeedMode::PerRevolution);
    let Some(code) = control.code_if_any(loc::FEED_UPR_CODE).filter(|_| !is_said) else {
        return Ok(());
    };
    let motion = control.block.take();
    control.block.g(code, cause.whole());
    control.write_block()?;
    control.block = motion;
    Ok(())
}

/// Behind a lead F is a feed again, in the format of its mode.
pub fn end_lead(control: &mut Control) {
    control.state.doubt(F);
    let mode = control.state.get(modal::FEED_MODE).unwrap_or(FeedMode::PerMinute);
    control.tables.format_feed(mode);
}

/// Leads are written in their own format from now on; the formats that the letters had.
pub(super) fn format_leads(control: &mut Control, letters: &[Letter]) -> Vec<Option<NumberFormat>> {
    // A lead is a way a turn.
    control.tables.format_feed(FeedMode::PerRevolution);
    let tables = &mut control.tables;
    letters
        .iter()
        .map(|letter| {
            let usual = tables.addresses.format(*letter).copied();
            if let Some(format) = tables.lead_format(*letter) {
                tables.addresses.set_format(*letter, format);
            }
            usual
        })
        .collect()
}

/// Adds the lead as F, in its own format until [`end_lead`]: where F alone can't hold it, as that
/// of several threads with their number beside it, on a machine that has a word for that.
///
/// # Errors
/// A lead that the address can't hold.
pub fn lead_word(control: &mut Control, lead: &Lead) -> Result<()> {
    format_leads(control, &[F]);
    let threads = counted_threads(control, lead.value);
    control.because(lead.cause, |control| {
        let Some((letter, threads)) = threads else {
            return control.word_rounded(F, lead.value, Rounding::Lead).map_err(of_lead);
        };
        let threads = f64::from(threads);
        control.word_rounded(F, lead.value * threads, Rounding::Lead)?;
        control.word_rounded(letter, threads, Rounding::Exact)?;
        control.state.doubt(letter);
        Ok(())
    })
}

/// A lead that its address can't hold: leads may have digits of their own.
pub fn of_lead(mut diag: Box<Diag>) -> Box<Diag> {
    let inexact: &Code = MachineCode::Inexact.into();
    if diag.code == inexact {
        diag.hint = Some(
            "Where the control takes more digits in a lead than in a feed, thread.lead_format of \
             machine.toml gives its words a format of their own."
                .into(),
        );
    }
    diag
}

/// The least number of threads whose lead F holds to the digit in the format of leads, and the letter
/// of that number; `None` where F holds that of one, or that of no such number, and for a machine
/// without such a letter.
pub fn counted_threads(control: &Control, lead: f64) -> Option<(Letter, u32)> {
    let letter = control.commons.read(loc::THREAD_COUNT_ADDRESS)?;
    Some((letter, threads_in_lead(&control.tables.lead_format(F)?, lead)?))
}

fn threads_in_lead(format: &NumberFormat, lead: f64) -> Option<u32> {
    if Rounding::Lead.scale(lead, format).is_ok() {
        return None;
    }
    (2..=MOST_THREADS).find(|threads| {
        let way = lead * f64::from(*threads);
        let scaled = Rounding::Lead.scale(way, format);
        scaled.is_ok_and(|scaled| (format.unscale(scaled) - way).abs() < TO_THE_DIGIT)
    })
}
