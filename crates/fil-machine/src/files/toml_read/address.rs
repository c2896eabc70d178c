//! The letters of a machine: `[address.X]`.

use std::borrow::Cow;
use std::ops::Range;

use fil_diag::{Diag, Result};
use toml::Spanned;
use toml::de::DeValue;

use super::{OPTION, TomlReader};
use crate::address::{CHARACTERS, FORMATS, LAST_CELL, OFF, SPECIFICATIONS};
use crate::commons::{Commons, EMPTY, Kind, NA};
use crate::contradictions::without_digits;
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::stored;

/// The tape position of a letter that the machine does not have.
const NO_POSITION: u32 = OFF as u32;

impl TomlReader<'_> {
    /// `[address.X]`: tape position, format, specification, printed character.
    pub(super) fn address(
        &mut self,
        commons: &mut Commons,
        key: &Spanned<Cow<'_, str>>,
        value: &Spanned<DeValue>,
    ) {
        let unknown = |message: &str| Diag::new(MachineCode::UnknownSetting, message);
        let name = key.get_ref().as_bytes();
        let (&[name], DeValue::Table(fields)) = (name, value.get_ref()) else {
            return self.refuse(key.span(), unknown("an address is a letter with a table"));
        };
        if !name.is_ascii_uppercase() {
            return self.refuse(key.span(), unknown("addresses are the letters A to Z"));
        }
        let position = self.position(commons, name, fields.get("slot"));
        let Some(position) = self.noted(key.span(), position) else { return };
        for (field, value) in fields.iter() {
            let base = match field.get_ref().as_ref() {
                "slot" => continue,
                "format" => FORMATS,
                "spec" => SPECIFICATIONS,
                "char" => CHARACTERS,
                other => {
                    let fields = "an address has slot, format, spec and char";
                    let diag = unknown(&format!("no field `{other}`")).hint(fields);
                    self.refuse(field.span(), diag);
                    continue;
                }
            };
            let number = match value.get_ref() {
                DeValue::String(text) if base == CHARACTERS && text.len() == 1 => {
                    Ok(f64::from(text.as_bytes()[0]))
                }
                _ => self.plain_number(value),
            };
            let at = (Kind::Int, base + position.min(NO_POSITION));
            let name = (char::from(name), field.get_ref().as_ref());
            let set = number.and_then(|number| self.cell(commons, name, at, number, field.span()));
            self.noted(value.span(), set);
        }
        let moved = self.take_along(commons, name, position);
        self.noted(fields.get("slot").map_or(key.span(), Spanned::span), moved);
        let said = fields.get("slot").map_or(key.span(), Spanned::span);
        self.named.push((name, position, said));
    }

    /// Format, specification and character belong to the tape position, and the one that a
    /// letter comes to may write whole numbers: what the file does not say of the letter, it
    /// takes along from where it was.
    ///
    /// # Errors
    /// E0607 for a letter that has nothing to take along.
    fn take_along(&self, commons: &mut Commons, name: u8, position: u32) -> Result<()> {
        let before = self.before[usize::from(Letter::of(name).number())];
        if position >= NO_POSITION || before == f64::from(position) {
            return Ok(());
        }
        let had = (1.0..f64::from(OFF)).contains(&before).then_some(before as usize);
        let held =
            |base: usize| had.map(|at| self.before[base + at]).filter(|held| !is_none(*held));
        for (base, own) in [
            (FORMATS, held(FORMATS as usize)),
            (SPECIFICATIONS, had.map(|at| self.before[SPECIFICATIONS as usize + at])),
            (CHARACTERS, held(CHARACTERS as usize).or(Some(f64::from(name)))),
        ] {
            let at = base + position;
            if self.said.iter().any(|said| (said.kind, said.number) == (Kind::Int, at)) {
                continue;
            }
            match own {
                Some(own) => commons.set(Kind::Int, at, own)?,
                // The settings behind this one may say them.
                None if self.file == OPTION => {
                    commons.set(Kind::Int, at, f64::from(NA))?;
                    commons.want_digits(name);
                }
                None => return Err(Box::new(without_digits(char::from(name), position))),
            }
        }
        Ok(())
    }

    /// Stores a field of an address; one that can't hold the value is named as it is
    /// written, `address.X.slot`, and not by its number.
    fn cell(
        &mut self,
        commons: &mut Commons,
        (letter, field): (char, &str),
        at: (Kind, u32),
        value: f64,
        key: Range<usize>,
    ) -> Result<()> {
        stored::check(at.0, at.1, value).map_err(|mut diag| {
            diag.message = format!("`address.{letter}.{field}` can't be {value}");
            diag
        })?;
        self.store(commons, at, value, key)
    }

    /// The tape position of a letter: the one given, else the one it has.
    fn position(
        &mut self,
        commons: &mut Commons,
        name: u8,
        slot: Option<&Spanned<DeValue>>,
    ) -> Result<u32> {
        let index = u32::from(Letter::of(name).number());
        let Some(slot) = slot else {
            return commons.get(Kind::Int, index).map(|number| number as u32);
        };
        let number = self.plain_number(slot)?;
        let at = (Kind::Int, index);
        let set = self.cell(commons, (char::from(name), "slot"), at, number, slot.span());
        set.map_err(|diag| if diag.spans.is_empty() { self.at(slot.span(), *diag) } else { diag })?;
        Ok(number as u32)
    }

    /// Two letters at one tape position would be written as one of them. A letter
    /// the file does not name gives way: the machine does not have it.
    pub(super) fn one_letter_a_position(&mut self, commons: &mut Commons) {
        let named = std::mem::take(&mut self.named);
        for (at, (name, slot, span)) in named.iter().enumerate() {
            if *slot >= NO_POSITION {
                continue;
            }
            if let Some((other, ..)) = named[..at].iter().find(|other| other.1 == *slot) {
                let (one, other) = (char::from(*other), char::from(*name));
                let message = format!("{one} and {other} are both at tape position {slot}");
                self.refuse(span.clone(), Diag::new(MachineCode::SettingValue, message));
                continue;
            }
            for other in (b'A'..=b'Z').filter(|other| other != name) {
                let index = u32::from(Letter::of(other).number());
                if commons.get(Kind::Int, index).is_ok_and(|held| held == f64::from(*slot)) {
                    let given = commons.set(Kind::Int, index, EMPTY);
                    self.noted(span.clone(), given);
                }
            }
        }
    }
}

/// The tables of letters as they are, by INTCOM location.
pub(super) fn cells(commons: &Commons) -> Vec<f64> {
    (0..=LAST_CELL).map(|number| commons.get(Kind::Int, number).unwrap_or(EMPTY)).collect()
}

/// True for a cell that holds nothing.
fn is_none(held: f64) -> bool {
    held == EMPTY || held == f64::from(NA) || held == 0.0
}
