//! What the values of a machine file stand for.

use std::ops::Range;

use fil_diag::{Diag, Result};
use fil_text::CodePage;
use toml::Spanned;
use toml::de::DeValue;

use super::TomlReader;
use crate::commons::EMPTY;
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{Location, ValueUnit};
use crate::stored;
use crate::user_blocks::BLOCK_INTEGERS;

/// The setting whose choices have names of their own.
const TAPE_ENCODING: &str = "tape.encoding";

impl TomlReader<'_> {
    /// The number a value stands for, by the unit of its location.
    pub(super) fn value(&self, location: &Location, value: &Spanned<DeValue>) -> Result<f64> {
        let choices = location.choice_list();
        let number = match value.get_ref() {
            DeValue::String(text) if text == "none" => return Ok(EMPTY),
            DeValue::String(text) if text.len() == 1 && location.unit == ValueUnit::Letter => {
                let letter = text.chars().next().and_then(Letter::of_character);
                letter.map(|letter| f64::from(letter.number()))
            }
            DeValue::String(text) if text.len() == 1 && location.unit == ValueUnit::Char => {
                Some(f64::from(text.as_bytes()[0]))
            }
            DeValue::String(label) if location.name == TAPE_ENCODING => {
                CodePage::named(label).map(|page| f64::from(page.number()))
            }
            DeValue::Boolean(flag) => {
                let word = if *flag { "yes" } else { "no" };
                choices.iter().find(|(_, text)| *text == word).map(|(value, _)| *value)
            }
            DeValue::Integer(_) | DeValue::Float(_) => Some(self.plain_number(value)?),
            _ => None,
        };
        let number = number.ok_or_else(|| {
            self.at(value.span(), *stored::wrong_value(location, &self.text[value.span()]))
        })?;
        let checked = stored::check(location.kind, location.number.into(), number);
        checked.map_err(|diag| self.at(value.span(), *diag)).map(|()| number)
    }

    pub(super) fn plain_number(&self, value: &Spanned<DeValue>) -> Result<f64> {
        let number = match value.get_ref() {
            DeValue::Integer(digits) => {
                i64::from_str_radix(digits.as_str(), digits.radix()).ok().map(|n| n as f64)
            }
            DeValue::Float(digits) => digits.as_str().parse().ok(),
            DeValue::String(text) if text == "none" => Some(EMPTY),
            _ => None,
        };
        number.filter(|number: &f64| number.is_finite()).ok_or_else(|| {
            self.at(value.span(), Diag::new(MachineCode::SettingValue, "a number is needed here"))
        })
    }

    /// A list of texts: `blocks.start`, `words.without_effect`, `verify.allowed_offsets`,
    /// `verify.allowed_functions`.
    pub(super) fn texts(&self, value: &Spanned<DeValue>, most: usize) -> Result<Vec<String>> {
        self.texts_up_to(value, most, usize::from(BLOCK_INTEGERS) * 2)
    }

    /// The same with texts of at most `longest` characters.
    pub(super) fn texts_up_to(
        &self,
        value: &Spanned<DeValue>,
        most: usize,
        longest: usize,
    ) -> Result<Vec<String>> {
        let wrong = |span: Range<usize>, message: String| {
            self.at(span, Diag::new(MachineCode::SettingValue, message))
        };
        let DeValue::Array(items) = value.get_ref() else {
            let mut refused = wrong(value.span(), "a list of texts is needed here".into());
            refused.hint = Some("put brackets around the text: [\"G54\"]".into());
            return Err(refused);
        };
        if items.len() > most {
            return Err(wrong(value.span(), format!("at most {most} texts fit")));
        }
        items
            .iter()
            .map(|item| match item.get_ref() {
                DeValue::String(text) if text.is_ascii() && text.len() <= longest => {
                    Ok(text.to_string())
                }
                _ => Err(wrong(
                    item.span(),
                    format!("an ASCII text of at most {longest} characters"),
                )),
            })
            .collect()
    }
}
