//! A line of Klartext on the tape, and its seconds.

use fil_diag::Result;

use crate::cause::Cause;
use crate::control::Control;
pub use crate::control::line::{Line, feed, length, scaled_text};
use crate::control::word_address::dwell;
use crate::errors::PostCode;
use crate::noted::TEXT;

/// Digits after the point of seconds.
const SECONDS: usize = 3;

/// Longest dwell of cycle 9 and of the drilling cycles, seconds.
const LONGEST_DWELL: f64 = 3600.0;

/// Puts a line on the tape with its number.
///
/// # Errors
/// A line longer than the control reads.
pub fn put(control: &mut Control, line: &Line) -> Result<()> {
    control.warn_of_letters(&line.text);
    let number = control.tape.numbers(&control.tables).then_some(control.klartext.next_line);
    control.klartext.next_line += 1;
    control.tape.phrase(number, &line.text, &line.items, &control.tables)
}

/// Puts a line on the tape that goes on with the one before, so it has no number.
///
/// # Errors
/// As [`put`].
pub fn put_more(control: &mut Control, text: &str, cause: Cause) -> Result<()> {
    control.tape.phrase_more(text, &[(TEXT, 0, cause)], &control.tables)
}

/// Seconds, within what the machine and the control take.
///
/// # Errors
/// Longer than the control waits.
pub fn seconds(control: &mut Control, asked: f64) -> Result<String> {
    let within = dwell::seconds_within(control, asked);
    if within > LONGEST_DWELL {
        return PostCode::Family
            .err(format!("a dwell of {within} s; a TNC waits {LONGEST_DWELL} s at most"));
    }
    let text = format!("{within:.SECONDS$}");
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - within).abs() > 0.01 * within {
        return PostCode::Family
            .err(format!("a dwell of {within} s would be written as {written}"));
    }
    Ok(text.trim_end_matches('0').trim_end_matches('.').to_string())
}
