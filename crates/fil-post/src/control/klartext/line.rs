//! A line of Klartext under construction, and its numbers: `X+10.5`.

use fil_diag::Result;
use fil_machine::letters::F;
use fil_machine::rounding::Rounding;
use fil_machine::{Letter, locations as loc};

use crate::block::named;
use crate::cause::Cause;
use crate::control::Control;
use crate::errors::PostCode;
use crate::noted::TEXT;

/// Digits after the point of seconds.
const SECONDS: usize = 3;

/// Longest dwell of cycle 9 and of the drilling cycles, seconds.
const LONGEST_DWELL: f64 = 3600.0;

/// The items of a line, each with its cause.
#[derive(Clone, Debug, Default)]
pub struct Line {
    text: String,
    items: Vec<(u8, usize, Cause)>,
}

impl Line {
    /// A line that is one text.
    pub fn of_text(text: &str, cause: Cause) -> Self {
        let mut line = Line::default();
        line.item(TEXT, text, cause);
        line
    }

    /// Adds an item behind a blank; `letter` stands for it in maps.
    pub fn item(&mut self, letter: u8, text: &str, cause: Cause) {
        let blank = usize::from(!self.text.is_empty());
        self.items.push((letter, self.text.len() + blank, cause));
        if blank == 1 {
            self.text.push(' ');
        }
        self.text.push_str(text);
    }
}

/// Puts a line on the tape with its number.
///
/// # Errors
/// A line longer than the control reads.
pub fn put(control: &mut Control, line: &Line) -> Result<()> {
    warn_of_letters(control, &line.text);
    let number = control.tape.numbers(&control.tables).then_some(control.klartext.next_line);
    control.klartext.next_line += 1;
    control.tape.phrase(number, &line.text, &line.items, &control.tables)
}

/// Puts a line on the tape that goes on with the one before, so it has no number.
///
/// # Errors
/// As [`put`].
pub fn put_more(control: &mut Control, text: &str, cause: Cause) -> Result<()> {
    control.tape.phrase(None, text, &[(TEXT, 0, cause)], &control.tables)
}

fn warn_of_letters(control: &mut Control, text: &str) {
    if !text.is_ascii() {
        control.warnings.add(PostCode::TapeText, format!("`{text}`"));
    }
}

/// A scaled value of a letter, by its format; `None` where the machine writes none.
pub fn scaled_text(control: &Control, letter: Letter, scaled: i64) -> Option<String> {
    let format = control.tables.addresses.format(letter)?;
    let mut text = Vec::new();
    format.write(scaled, &mut text);
    Some(String::from_utf8_lossy(&text).into_owned())
}

/// A length as an address writes it, `+10.5`, and the value that it then has.
///
/// # Errors
/// The machine has no such address, or the value does not fit it.
pub fn length(control: &Control, letter: Letter, value: f64) -> Result<(String, f64)> {
    let addresses = &control.tables.addresses;
    control.require_letter(letter)?;
    let format = addresses.format(letter).copied().unwrap_or_default();
    let scaled = format.scale(value).map_err(|diag| named(diag, letter))?;
    let mut text = Vec::new();
    format.write(scaled, &mut text);
    Ok((String::from_utf8_lossy(&text).into_owned(), format.unscale(scaled)))
}

/// A feed as F writes it.
///
/// # Errors
/// As [`length`]; rounding that changes it by more than the format's promise.
pub fn feed(control: &Control, value: f64) -> Result<String> {
    control.require_letter(F)?;
    let format = control.tables.addresses.format(F).copied().unwrap_or_default();
    let scaled = Rounding::Rate.scale(value, &format).map_err(|diag| named(diag, F))?;
    Ok(scaled_text(control, F, scaled).unwrap_or_default())
}

/// Seconds, within what the machine and the control take.
///
/// # Errors
/// Longer than the control waits.
pub fn seconds(control: &mut Control, asked: f64) -> Result<String> {
    let low = control.commons.dbl_opt(loc::DWELL_UPM_MIN).unwrap_or(0.0);
    let high = control.commons.dbl_opt(loc::DWELL_UPM_MAX).filter(|max| *max > 0.0);
    let within = asked.max(low).min(high.unwrap_or(f64::MAX));
    if within != asked {
        control.warnings.add(PostCode::Clamped, format!("dwell {asked} became {within}"));
    }
    if within > LONGEST_DWELL {
        return super::refuse(format!(
            "a dwell of {within} s; a TNC waits {LONGEST_DWELL} s at most"
        ));
    }
    let text = format!("{within:.SECONDS$}");
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - within).abs() > 0.01 * within {
        return super::refuse(format!("a dwell of {within} s would be written as {written}"));
    }
    Ok(text.trim_end_matches('0').trim_end_matches('.').to_string())
}
