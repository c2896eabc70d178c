//! A line of a control whose blocks are more than words of a letter: its items, and
//! numbers as the addresses write them.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::letters::F;
use fil_machine::rounding::Rounding;

use super::Control;
use crate::block::named;
use crate::cause::Cause;
use crate::noted::TEXT;

/// The items of a line, each with its cause.
#[derive(Clone, Debug, Default)]
pub struct Line {
    pub(super) text: String,
    pub(super) items: Vec<(u8, usize, Cause)>,
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
