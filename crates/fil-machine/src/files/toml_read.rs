//! Reading `machine.toml`: named settings over the commons.
//!
//! Keys are the names of the table of locations (`rapid.split = 1`), or
//! `int.1870 = 1`, `rel.11 = 1.0`, `dbl.486 = 2.0`; `[address.X]` holds `slot`,
//! `format`, `spec` and `char` of a letter; `blocks.start` and `blocks.end` are
//! lists of texts, and so is `words.without_effect`, the major words that pass. A flag takes true or false, a letter or character a text of
//! one character, and every setting takes `"none"` for absent.

use fil_diag::suggest::did_you_mean;
use fil_diag::{Diag, LineIndex, Result};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::commons::{Commons, EMPTY, Kind};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, Location, default_commons};
use crate::user_blocks::{self, BLOCK_INTEGERS, MAX_BLOCKS};

/// Most words that a machine lists as without effect.
const MOST_WORDS: usize = 1000;

/// What a `machine.toml` may say about itself without it being a setting.
const ABOUT: &[&str] = &["name", "description", "origin"];

/// Reads a `machine.toml` over the default machine.
///
/// # Errors
/// Text that is not TOML, an unknown key, a value of the wrong kind. The
/// second part of the result are warnings: settings the post does not act on.
pub fn read_toml(file: &str, text: &str) -> Result<(Commons, Vec<Diag>)> {
    let mut reader = TomlReader::new(file, text);
    let table = DeTable::parse(text).map_err(|error| {
        let range = error.span().unwrap_or(0..0);
        reader.at(range, Diag::new(MachineCode::MachineSyntax, error.message().to_string()))
    })?;
    let mut commons = default_commons();
    reader.table(&mut commons, table.get_ref(), "")?;
    reader.one_letter_a_position(&mut commons)?;
    Ok((commons, reader.unused_settings()))
}

/// Sets one setting from text, as `--set key=value` gives it.
///
/// # Errors
/// As [`read_toml`].
pub fn apply_setting(commons: &mut Commons, setting: &str) -> Result<()> {
    let quoted = setting.split_once('=').map(|(key, value)| format!("{key}={value:?}"));
    let sources = [Some(setting.to_string()), quoted];
    let mut result = Ok(());
    for source in sources.into_iter().flatten() {
        let mut reader = TomlReader::new("--set", &source);
        result = match DeTable::parse(&source) {
            Ok(table) => reader
                .table(commons, table.get_ref(), "")
                .and_then(|()| reader.one_letter_a_position(commons)),
            Err(error) => {
                Err(Box::new(Diag::new(MachineCode::MachineSyntax, error.message().to_string())))
            }
        };
        if result.is_ok() {
            break;
        }
    }
    result
}

struct TomlReader<'a> {
    file: &'a str,
    text: &'a str,
    index: LineIndex,
    /// Settings the post does not act on: where, and their names.
    unused: Vec<(usize, Range<usize>, &'static str)>,
    /// Letters that are named, with their tape position and where that is said.
    named: Vec<(u8, u32, Range<usize>)>,
}

impl<'a> TomlReader<'a> {
    fn new(file: &'a str, text: &'a str) -> Self {
        let index = LineIndex::new(text);
        TomlReader { file, text, index, unused: Vec::new(), named: Vec::new() }
    }

    fn table(&mut self, commons: &mut Commons, table: &DeTable, prefix: &str) -> Result<()> {
        for (key, value) in table.iter() {
            let name = match prefix {
                "" => key.get_ref().to_string(),
                prefix => format!("{prefix}.{}", key.get_ref()),
            };
            if prefix == "address" {
                self.address(commons, key, value)?;
            } else if let DeValue::Table(inner) = value.get_ref() {
                self.table(commons, inner, &name)?;
            } else if !(prefix.is_empty() && ABOUT.contains(&name.as_str())) {
                self.setting(commons, &name, key.span(), value)?;
            }
        }
        Ok(())
    }

    fn setting(
        &mut self,
        commons: &mut Commons,
        name: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        match name {
            "blocks.start" => {
                user_blocks::START.store(commons, &self.texts(value, MAX_BLOCKS.into())?);
                return Ok(());
            }
            "blocks.end" => {
                user_blocks::END.store(commons, &self.texts(value, MAX_BLOCKS.into())?);
                return Ok(());
            }
            "words.without_effect" => {
                let words = self.texts(value, MOST_WORDS)?;
                words.iter().for_each(|word| commons.list_without_effect(word));
                return Ok(());
            }
            _ => {}
        }
        if let Some((kind, number)) = numbered(name) {
            let value_of = self.plain_number(value)?;
            return commons
                .set(kind, number, value_of)
                .map_err(|diag| self.at(value.span(), *diag));
        }
        let Some(location) = Location::named(name) else {
            let mut diag = Diag::new(MachineCode::UnknownSetting, format!("no setting `{name}`"));
            diag.hint = did_you_mean(name, loc::TABLE.iter().map(|row| row.name));
            return Err(self.at(key, diag));
        };
        let number = self.value(location, value)?;
        if !location.used && number != location.default_value() {
            self.unused.push((key.start, key.clone(), location.name));
        }
        commons
            .set(location.kind, u32::from(location.number), number)
            .map_err(|diag| self.at(value.span(), *diag))
    }

    /// The number a value stands for, by the unit of its location.
    fn value(&self, location: &Location, value: &Spanned<DeValue>) -> Result<f64> {
        let choices = location.choice_list();
        let number = match value.get_ref() {
            DeValue::String(text) if text == "none" => return Ok(EMPTY),
            DeValue::String(text) if text.len() == 1 && location.unit == "letter" => {
                let letter = text.chars().next().and_then(Letter::of_character);
                letter.map(|letter| f64::from(letter.number()))
            }
            DeValue::String(text) if text.len() == 1 && location.unit == "char" => {
                Some(f64::from(text.as_bytes()[0]))
            }
            DeValue::Boolean(flag) => {
                let word = if *flag { "yes" } else { "no" };
                choices.iter().find(|(_, text)| *text == word).map(|(value, _)| *value)
            }
            DeValue::Integer(_) | DeValue::Float(_) => Some(self.plain_number(value)?),
            _ => None,
        };
        let allowed =
            |number: &f64| choices.is_empty() || choices.iter().any(|(choice, _)| choice == number);
        number.filter(allowed).ok_or_else(|| {
            let mut diag = Diag::new(
                MachineCode::SettingValue,
                format!("`{}` does not take this value (unit {})", location.name, location.unit),
            );
            if !choices.is_empty() {
                diag = diag.hint(format!("choose one of {}", location.choices.replace('|', ", ")));
            }
            self.at(value.span(), diag)
        })
    }

    fn plain_number(&self, value: &Spanned<DeValue>) -> Result<f64> {
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

    /// A list of texts: `blocks.start`, `words.without_effect`.
    fn texts(&self, value: &Spanned<DeValue>, most: usize) -> Result<Vec<String>> {
        let longest = usize::from(BLOCK_INTEGERS) * 2;
        let wrong = |span: Range<usize>, message: String| {
            self.at(span, Diag::new(MachineCode::SettingValue, message))
        };
        let DeValue::Array(items) = value.get_ref() else {
            return Err(wrong(value.span(), "a list of texts is needed here".into()));
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

    /// `[address.X]`: tape position, format, specification, printed character.
    fn address(
        &mut self,
        commons: &mut Commons,
        key: &Spanned<std::borrow::Cow<'_, str>>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        let name = key.get_ref().as_bytes();
        let (&[name], DeValue::Table(fields)) = (name, value.get_ref()) else {
            let diag =
                Diag::new(MachineCode::UnknownSetting, "an address is a letter with a table");
            return Err(self.at(key.span(), diag));
        };
        if !name.is_ascii_uppercase() {
            let diag = Diag::new(MachineCode::UnknownSetting, "addresses are the letters A to Z");
            return Err(self.at(key.span(), diag));
        }
        let index = u32::from(Letter::of(name).number());
        let mut set = |location: u32, number: f64, span: Range<usize>| {
            commons.set(Kind::Int, location, number).map_err(|diag| self.at(span, *diag))
        };
        let slot = match fields.get("slot") {
            Some(slot) => Some((self.plain_number(slot)?, slot.span())),
            None => None,
        };
        if let Some((number, span)) = &slot {
            if !(1.0..=53.0).contains(number) {
                let diag =
                    Diag::new(MachineCode::SettingValue, "tape positions are 1 to 52, 53 is none");
                return Err(self.at(span.clone(), diag));
            }
            set(index, *number, span.clone())?;
        }
        let slot = slot.map_or_else(
            || commons.get(Kind::Int, index).map(|number| number as u32),
            |(number, _)| Ok(number as u32),
        )?;
        for (field, value) in fields.iter() {
            let base = match field.get_ref().as_ref() {
                "slot" => continue,
                "format" => 105,
                "spec" => 158,
                "char" => 52,
                other => {
                    let diag =
                        Diag::new(MachineCode::UnknownSetting, format!("no field `{other}`"));
                    return Err(self.at(field.span(), diag));
                }
            };
            let number = match value.get_ref() {
                DeValue::String(text) if base == 52 && text.len() == 1 => {
                    f64::from(text.as_bytes()[0])
                }
                _ => self.plain_number(value)?,
            };
            commons
                .set(Kind::Int, base + slot.min(53), number)
                .map_err(|diag| self.at(value.span(), *diag))?;
        }
        if fields.get("char").is_none() && slot < 53 {
            commons.set(Kind::Int, 52 + slot, f64::from(name))?;
        }
        self.named.push((name, slot, fields.get("slot").map_or(key.span(), |slot| slot.span())));
        Ok(())
    }

    /// Two letters at one tape position would be written as one of them. A letter
    /// the file does not name gives way: the machine does not have it.
    fn one_letter_a_position(&self, commons: &mut Commons) -> Result<()> {
        for (at, (name, slot, span)) in self.named.iter().enumerate().filter(|(_, l)| l.1 < 53) {
            if let Some((other, ..)) = self.named[..at].iter().find(|other| other.1 == *slot) {
                let (one, other) = (char::from(*other), char::from(*name));
                let message = format!("{one} and {other} are both at tape position {slot}");
                let diag = Diag::new(MachineCode::SettingValue, message);
                return Err(self.at(span.clone(), diag));
            }
            for other in (b'A'..=b'Z').filter(|other| other != name) {
                let index = u32::from(Letter::of(other).number());
                if commons.get(Kind::Int, index)? == f64::from(*slot) {
                    commons.set(Kind::Int, index, EMPTY)?;
                }
            }
        }
        Ok(())
    }

    /// One warning for all settings the post does not act on.
    fn unused_settings(mut self) -> Vec<Diag> {
        self.unused.sort_by_key(|(start, ..)| *start);
        let Some((_, first, _)) = self.unused.first().cloned() else { return Vec::new() };
        let names: Vec<&str> = self.unused.iter().map(|(.., name)| *name).collect();
        let message = format!("the post does not act on {}", names.join(", "));
        vec![*self.at(first, Diag::new(MachineCode::UnusedSetting, message))]
    }

    fn at(&self, range: Range<usize>, diag: Diag) -> Box<Diag> {
        Box::new(diag.at(self.index.place(self.file, self.text, range)))
    }
}

/// `int.1870` and the like.
fn numbered(name: &str) -> Option<(Kind, u32)> {
    let (kind, number) = name.split_once('.')?;
    let kind = match kind {
        "int" => Kind::Int,
        "rel" => Kind::Rel,
        "dbl" => Kind::Dbl,
        _ => return None,
    };
    Some((kind, number.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commons::Int;

    fn error(text: &str) -> (String, String) {
        let diag = read_toml("machine.toml", text).unwrap_err();
        (diag.code.name(), diag.places[0].to_string())
    }

    #[test]
    fn names_numbers_letters_and_texts_reach_the_commons() {
        let text = "name = 'mill'\n[rapid]\nsplit = 0\n[cycle]\nstep_address = 'Q'\n\
                    [tape]\nstart_char = 'none'\n[int]\n1861 = 7\n[dbl]\n486 = 2.0\n\
                    [blocks]\nstart = ['G90G80', 'G40']\n[address.Y]\nslot = 53\n";
        let (commons, warnings) = read_toml("machine.toml", text).unwrap();
        assert!(warnings.is_empty(), "{warnings:?}");
        assert_eq!(commons.read(loc::RAPID_SPLIT), loc::RapidSplit::OneBlock);
        assert_eq!(commons.read(loc::CYCLE_STEP_ADDRESS), Some(Letter::of(b'Q')));
        assert_eq!(commons.read(loc::TAPE_START_CHAR), None);
        assert_eq!(commons.int(Int(1861)), 7);
        assert_eq!(commons.dbl(loc::SCALE_X), 2.0);
        assert_eq!(commons.int(Int(25)), 53);
        assert_eq!(user_blocks::START.read(&commons), ["G90G80", "G40"]);
    }

    #[test]
    fn what_is_not_understood_is_refused_with_its_place() {
        assert_eq!(error("rapid = {\n"), ("E0603".into(), "machine.toml:1:10".into()));
        assert_eq!(error("[rapid]\nspilt = 1"), ("E0604".into(), "machine.toml:2:1".into()));
        assert_eq!(error("[rapid]\nsplit = 9"), ("E0605".into(), "machine.toml:2:9".into()));
        assert_eq!(error("[scale]\nx = 'a'"), ("E0605".into(), "machine.toml:2:5".into()));
        assert_eq!(error("int.10000 = 1"), ("E0601".into(), "machine.toml:1:13".into()));
        assert_eq!(error("[address.x]\nslot = 1"), ("E0604".into(), "machine.toml:1:10".into()));
    }

    #[test]
    fn two_letters_never_stand_at_one_tape_position() {
        let twice = "[address]\nK = { slot = 8 }\nM = { slot = 8 }\n";
        assert_eq!(error(twice), ("E0605".into(), "machine.toml:3:14".into()));
        // K stands at 8 when nothing else is said.
        let (mut commons, _) = read_toml("m", "[address]\nM = { slot = 8 }\n").unwrap();
        assert_eq!((commons.int(Int(13)), commons.int_opt(Int(11))), (8, None));
        apply_setting(&mut commons, "address.Q.slot=8").unwrap();
        assert_eq!((commons.int(Int(17)), commons.int_opt(Int(13))), (8, None));
    }

    #[test]
    fn a_setting_without_effect_warns() {
        let (_, warnings) = read_toml("m", "[list]\npages = true").unwrap();
        assert_eq!(warnings[0].code.name(), "W0651");
    }

    #[test]
    fn a_single_setting_takes_numbers_and_letters() {
        let mut commons = default_commons();
        apply_setting(&mut commons, "rapid.split=0").unwrap();
        apply_setting(&mut commons, "cycle.step_address=Q").unwrap();
        assert_eq!(commons.read(loc::CYCLE_STEP_ADDRESS), Some(Letter::of(b'Q')));
        assert!(apply_setting(&mut commons, "rapid.split=Q").is_err());
    }
}
