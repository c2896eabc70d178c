//! Reading `machine.toml`: named settings over the commons.
//!
//! `base = "NAME"` names the machine it begins from. Keys are the names of the table of locations (`rapid.split = 1`), or
//! `int.1870 = 1`, `rel.11 = 1.0`, `dbl.486 = 2.0`; `[address.X]` holds `slot`,
//! `format`, `spec` and `char` of a letter; `blocks.start` and `blocks.end` are
//! lists of texts, and so are `words.without_effect`, the major words that pass, and
//! `verify.allowed_offsets`, what a program may choose unasked. A flag takes true or false, a letter or character a text of
//! one character, and every setting takes `"none"` for absent.

use std::borrow::Cow;
use std::ops::Range;

use fil_diag::suggest::did_you_mean;
use fil_diag::{Diag, LineIndex, Result, TextSpan};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::address::OFF;
use crate::chains;
use crate::commons::{Commons, EMPTY, Kind};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, Location, ValueUnit, default_commons};
use crate::stored;
use crate::user_blocks::{self, BLOCK_INTEGERS, MAX_BLOCKS};

/// The tape position of a letter that the machine does not have.
const NO_POSITION: u32 = OFF as u32;

/// Most words that a machine lists as without effect.
const MOST_WORDS: usize = 1000;

/// Most work offsets that a machine allows without being asked for.
const MOST_OFFSETS: usize = 1000;

/// What a `machine.toml` may say about itself without it being a setting.
const ABOUT: &[&str] = &["name", "description", "origin"];

/// The key of the machine that a `machine.toml` begins from.
const BASE: &str = "base";

/// What stands before the number of a location whose value the import could not read.
const IMPORTED: &str = "imported.";

/// The key of the chain of axes that comes with the post.
const CHAIN: &str = "chain";

/// What messages call the text of a single setting.
const OPTION: &str = "--set";

/// How a single setting is written.
const OPTION_FORM: &str = "Write --set key=value, as in --set rapid.split=1.";

/// Reads a `machine.toml` over the default machine. The second part of the result
/// are warnings: settings the post does not act on.
///
/// # Errors
/// All that is wrong: text that is not TOML, unknown keys, values of the wrong kind.
pub fn read_toml(file: &str, text: &str) -> Result<(Commons, Vec<Diag>), Vec<Diag>> {
    read_toml_with(file, text, &|_| None)
}

/// The same where `base = "NAME"` may name a machine to begin from instead of the default
/// one; `bases` gives the text of its `machine.toml`.
///
/// # Errors
/// As [`read_toml`]; E0605 for a base that is not there, and for one that begins from a
/// base of its own.
pub fn read_toml_with(
    file: &str,
    text: &str,
    bases: &dyn Fn(&str) -> Option<&'static str>,
) -> Result<(Commons, Vec<Diag>), Vec<Diag>> {
    let (table, _) = DeTable::parse_recoverable(text);
    let base = table.get_ref().iter().find(|(key, _)| key.get_ref() == BASE);
    let mut commons = match base {
        None => default_commons(),
        Some((_, value)) => base_commons(file, text, value, bases)?,
    };
    let warnings = read_over(&mut commons, file, text, true)?;
    Ok((commons, warnings))
}

/// Lays the settings of a `machine.toml` over those that are there. The result are
/// warnings, as those of [`read_toml`].
///
/// # Errors
/// As [`read_toml`]; E0604 for `base`, which only a machine of its own has; E0606 for an
/// option file.
pub fn lay_over(commons: &mut Commons, file: &str, text: &str) -> Result<Vec<Diag>, Vec<Diag>> {
    if text.lines().any(|line| line.trim_start().starts_with("INTCOM:")) {
        let diag = MachineCode::OptionFile
            .diag("an option file is a whole machine and can't be laid over another one")
            .hint("import it with `filpost machine import` and keep what shall be laid over");
        return Err(vec![diag.at(TextSpan::line(file, 1, text.lines().next().unwrap_or("")))]);
    }
    read_over(commons, file, text, false)
}

/// The machine that `base` names.
fn base_commons(
    file: &str,
    text: &str,
    value: &Spanned<DeValue>,
    bases: &dyn Fn(&str) -> Option<&'static str>,
) -> Result<Commons, Vec<Diag>> {
    let name = value.get_ref().as_str().unwrap_or_default();
    let Some(base) = bases(name) else {
        let diag =
            Diag::new(MachineCode::SettingValue, format!("no machine `{name}` to begin from"))
                .hint("base names a ready post: base = \"fanuc-mill\"");
        return Err(vec![*TomlReader::new(file, text).at(value.span(), diag)]);
    };
    read_toml(name, base).map(|(commons, _)| commons)
}

/// Sets one setting from text, as `--set key=value` gives it; a value that is no TOML
/// is a text. The result are warnings, as those of [`read_toml`].
///
/// # Errors
/// As [`read_toml`].
pub fn apply_setting(commons: &mut Commons, setting: &str) -> Result<Vec<Diag>, Vec<Diag>> {
    let is_toml = DeTable::parse(setting).is_ok();
    let quoted = setting.split_once('=').filter(|_| !is_toml);
    let quoted = quoted.map(|(key, value)| format!("{key}={value:?}"));
    read_over(commons, OPTION, quoted.as_deref().unwrap_or(setting), false)
}

/// Reads settings over those that are there; `is_whole` is a machine of its own, whose
/// `base` has been read.
fn read_over(
    commons: &mut Commons,
    file: &str,
    text: &str,
    is_whole: bool,
) -> Result<Vec<Diag>, Vec<Diag>> {
    let mut reader = TomlReader::new(file, text);
    reader.takes_base = is_whole;
    let (table, broken) = DeTable::parse_recoverable(text);
    for error in &broken {
        let mut diag = MachineCode::MachineSyntax.diag(error.message());
        diag.hint = (file == OPTION).then(|| OPTION_FORM.to_string());
        reader.refuse(error.span().unwrap_or(0..0), *diag);
    }
    // What the rest of a broken text means is not sure.
    if broken.is_empty() {
        if let Some((_, value)) = table.get_ref().iter().find(|(key, _)| key.get_ref() == CHAIN) {
            let chain = chain(value);
            if let Some(settings) = reader.noted(value.span(), chain) {
                read_over(commons, CHAIN, settings, false)?;
            }
        }
        reader.table(commons, table.get_ref(), "");
        reader.one_letter_a_position(commons);
    }
    reader.finish()
}

/// The settings of the chain of axes that a value names.
///
/// # Errors
/// There is none of that name.
fn chain(value: &Spanned<DeValue>) -> Result<&'static str> {
    let name = value.get_ref().as_str().unwrap_or_default();
    let Some(chain) = chains::find(name) else {
        let names: Vec<&str> = chains::CHAINS.iter().map(|chain| chain.name).collect();
        let mut diag = Diag::new(MachineCode::SettingValue, format!("no chain of axes `{name}`"));
        diag.hint = Some(format!("there are {}", names.join(", ")));
        return Err(Box::new(diag));
    };
    Ok(chain.settings)
}

/// A setting of the text.
struct Said {
    key: Range<usize>,
    kind: Kind,
    number: u32,
    value: f64,
}

struct TomlReader<'a> {
    file: &'a str,
    text: &'a str,
    index: LineIndex,
    /// The text may name the machine that it begins from.
    takes_base: bool,
    /// All that is wrong so far, with the places.
    errors: Vec<(usize, Diag)>,
    /// All settings that were said.
    said: Vec<Said>,
    /// Imported values whose meaning is not known.
    doubtful: Vec<Diag>,
    /// Letters that are named, with their tape position and where that is said.
    named: Vec<(u8, u32, Range<usize>)>,
}

impl<'a> TomlReader<'a> {
    fn new(file: &'a str, text: &'a str) -> Self {
        TomlReader {
            file,
            text,
            index: LineIndex::new(text),
            takes_base: false,
            errors: Vec::new(),
            said: Vec::new(),
            doubtful: Vec::new(),
            named: Vec::new(),
        }
    }

    /// Notes something that is wrong.
    fn refuse(&mut self, range: Range<usize>, diag: Diag) {
        let start = range.start;
        self.errors.push((start, *self.at(range, diag)));
    }

    /// Takes a result; an error is noted with its place.
    fn noted<T>(&mut self, range: Range<usize>, result: Result<T>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(diag) if diag.spans.is_empty() => {
                self.refuse(range, *diag);
                None
            }
            Err(diag) => {
                self.errors.push((range.start, *diag));
                None
            }
        }
    }

    /// A table of settings. The letters come last: they look where the others have put them.
    fn table(&mut self, commons: &mut Commons, table: &DeTable, prefix: &str) {
        let is_letters = |key: &str| prefix.is_empty() && key == "address";
        let (letters, others): (Vec<_>, Vec<_>) =
            table.iter().partition(|(key, _)| is_letters(key.get_ref()));
        for (key, value) in others.into_iter().chain(letters) {
            let name = match prefix {
                "" => key.get_ref().to_string(),
                prefix => format!("{prefix}.{}", key.get_ref()),
            };
            if prefix == "address" {
                self.address(commons, key, value);
            } else if let DeValue::Table(inner) = value.get_ref() {
                self.table(commons, inner, &name);
            } else if !(prefix.is_empty() && self.is_about(&name)) {
                let result = self.setting(commons, &name, key.span(), value);
                self.noted(value.span(), result);
            }
        }
    }

    /// True for a key that is no setting.
    fn is_about(&self, name: &str) -> bool {
        ABOUT.contains(&name) || name == CHAIN || (name == BASE && self.takes_base)
    }

    fn setting(
        &mut self,
        commons: &mut Commons,
        name: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        if let Some((_, list)) = user_blocks::LISTS.iter().find(|(key, _)| *key == name) {
            list.store(commons, &self.texts(value, MAX_BLOCKS.into())?);
            return Ok(());
        }
        if name == "words.without_effect" {
            let words = self.texts(value, MOST_WORDS)?;
            words.iter().for_each(|word| commons.list_without_effect(word));
            return Ok(());
        }
        if name == "verify.allowed_offsets" {
            for offset in self.texts(value, MOST_OFFSETS)? {
                if !commons.allow_offset(&offset) {
                    let message = format!("`{offset}` is no work offset; one is G54 or G54.1P3");
                    let wrong = Diag::new(MachineCode::SettingValue, message);
                    return Err(self.at(value.span(), wrong));
                }
            }
            return Ok(());
        }
        if let Some((kind, number)) = name.strip_prefix(IMPORTED).and_then(numbered) {
            return self.imported(commons, (kind, number), value, key);
        }
        if let Some((kind, number)) = numbered(name) {
            let number_said = self.plain_number(value)?;
            return self.store(commons, (kind, number), number_said, key);
        }
        if name == BASE {
            let message = "`base` stands in the machine.toml of a machine, not in one laid over it";
            return Err(self.at(key, Diag::new(MachineCode::UnknownSetting, message)));
        }
        let Some(location) = Location::named(name) else {
            let mut diag = Diag::new(MachineCode::UnknownSetting, format!("no setting `{name}`"));
            diag.hint = did_you_mean(name, loc::TABLE.iter().map(|row| row.name));
            return Err(self.at(key, diag));
        };
        let number = self.value(location, value)?;
        self.store(commons, (location.kind, location.number.into()), number, key)
    }

    /// Stores a value of the vendor's that no choice of its setting means, as the import of
    /// an option file has left it; warns of it.
    fn imported(
        &mut self,
        commons: &mut Commons,
        (kind, number): (Kind, u32),
        value: &Spanned<DeValue>,
        key: Range<usize>,
    ) -> Result<()> {
        let number_said = self.plain_number(value)?;
        commons.set(kind, number, number_said)?;
        if stored::acts(kind, number) {
            let title = stored::title(kind, number);
            let message = format!("`{title}` = {number_said}: meaning not published");
            let diag = Diag::new(MachineCode::DoubtfulImport, message);
            self.doubtful.push(*self.at(key.clone(), diag));
        }
        self.said.push(Said { key, kind, number, value: number_said });
        Ok(())
    }

    /// Stores a value that its location can hold. A location may be said by its name and
    /// by its number, but not twice with different values.
    fn store(
        &mut self,
        commons: &mut Commons,
        (kind, number): (Kind, u32),
        value: f64,
        key: Range<usize>,
    ) -> Result<()> {
        stored::check(kind, number, value)?;
        let same = |said: &&Said| (said.kind, said.number) == (kind, number);
        if let Some(before) = self.said.iter().find(same).filter(|before| before.value != value) {
            let title = stored::title(kind, number);
            let message = format!("{title} is set to {} and to {value}", before.value);
            let place = self.index.place(self.file, self.text, before.key.clone());
            let diag = Diag::new(MachineCode::Contradiction, message);
            return Err(Box::new(self.at(key, diag).at(place.label("set here first"))));
        }
        commons.set(kind, number, value)?;
        self.said.push(Said { key, kind, number, value });
        Ok(())
    }

    /// The number a value stands for, by the unit of its location.
    fn value(&self, location: &Location, value: &Spanned<DeValue>) -> Result<f64> {
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

    /// A list of texts: `blocks.start`, `words.without_effect`, `verify.allowed_offsets`.
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
                "format" => 105,
                "spec" => 158,
                "char" => 52,
                other => {
                    self.refuse(field.span(), unknown(&format!("no field `{other}`")));
                    continue;
                }
            };
            let number = match value.get_ref() {
                DeValue::String(text) if base == 52 && text.len() == 1 => {
                    Ok(f64::from(text.as_bytes()[0]))
                }
                _ => self.plain_number(value),
            };
            let at = (Kind::Int, base + position.min(NO_POSITION));
            let name = (char::from(name), field.get_ref().as_ref());
            let set = number.and_then(|number| self.cell(commons, name, at, number, field.span()));
            self.noted(value.span(), set);
        }
        if fields.get("char").is_none() && position < NO_POSITION {
            let set = commons.set(Kind::Int, 52 + position, f64::from(name));
            self.noted(key.span(), set);
        }
        let said = fields.get("slot").map_or(key.span(), Spanned::span);
        self.named.push((name, position, said));
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
    fn one_letter_a_position(&mut self, commons: &mut Commons) {
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

    /// All errors in the order of the text, else one warning for all settings the
    /// post does not act on.
    fn finish(mut self) -> Result<Vec<Diag>, Vec<Diag>> {
        if !self.errors.is_empty() {
            self.errors.sort_by_key(|(start, _)| *start);
            return Err(self.errors.into_iter().map(|(_, diag)| diag).collect());
        }
        self.said.sort_by_key(|said| said.key.start);
        let idle = |said: &&Said| stored::is_idle(said.kind, said.number, said.value);
        let doubtful = std::mem::take(&mut self.doubtful);
        let idle: Vec<&Said> = self.said.iter().filter(idle).collect();
        let Some(first) = idle.first() else { return Ok(doubtful) };
        let locations: Vec<(Kind, u32)> =
            idle.iter().map(|said| (said.kind, said.number)).collect();
        let diag = stored::without_effect(&locations);
        let idle = *self.at(first.key.clone(), diag);
        Ok(doubtful.into_iter().chain([idle]).collect())
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
        let diags = read_toml("machine.toml", text).unwrap_err();
        (diags[0].code.name(), diags[0].spans[0].to_string())
    }

    #[test]
    fn names_numbers_letters_and_texts_reach_the_commons() {
        let text = "name = 'mill'\n[rapid]\nsplit = 0\n[cycle]\nstep_address = 'Q'\n\
                    [tape]\nstart_char = 'none'\n[int]\n1924 = 3\n[dbl]\n486 = 2.0\n\
                    [blocks]\nstart = ['G90G80', 'G40']\n[address.Y]\nslot = 53\n";
        let (commons, warnings) = read_toml("machine.toml", text).unwrap();
        assert!(warnings.is_empty(), "{warnings:?}");
        assert_eq!(commons.read(loc::RAPID_SPLIT), loc::RapidSplit::OneBlock);
        assert_eq!(commons.read(loc::CYCLE_STEP_ADDRESS), Some(Letter::of(b'Q')));
        assert_eq!(commons.read(loc::TAPE_START_CHAR), None);
        assert_eq!(commons.int(Int(1924)), 3);
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
        assert_eq!(error("int.20000 = 1"), ("E0601".into(), "machine.toml:1:13".into()));
        assert_eq!(error("[address.x]\nslot = 1"), ("E0604".into(), "machine.toml:1:10".into()));
    }

    #[test]
    fn a_machine_begins_from_another_one() {
        let bases = |name: &str| match name {
            "old" => Some("rapid.split = 0\nseqno.increment = 5"),
            "nested" => Some("base = 'old'"),
            _ => None,
        };
        let read = |text: &str| read_toml_with("machine.toml", text, &bases);
        let (mut commons, _) = read("base = 'old'\nseqno.increment = 7").unwrap();
        assert_eq!(commons.read(loc::RAPID_SPLIT), loc::RapidSplit::OneBlock);
        assert_eq!(commons.dbl(loc::SEQNO_INCREMENT), 7.0);
        for text in ["base = 'new'", "base = 3", "base = 'nested'"] {
            assert_eq!(read(text).unwrap_err()[0].code.name(), "E0605", "{text}");
        }
        assert_eq!(error("base = 'old'"), ("E0605".into(), "machine.toml:1:8".into()));
        lay_over(&mut commons, "m", "seqno.increment = 9").unwrap();
        assert_eq!(commons.dbl(loc::SEQNO_INCREMENT), 9.0);
        assert_eq!(
            lay_over(&mut commons, "m", "base = 'old'").unwrap_err()[0].code.name(),
            "E0604"
        );
    }

    #[test]
    fn all_that_is_wrong_is_said_at_once() {
        let text = "rapid.spilt = 1\nrapid.split = 9\nint.1870 = 8\nint.1861 = 0.5\n\
                    [address]\nX = { slot = 0, format = 99999, colour = 1 }\n\
                    K = { slot = 8 }\nM = { slot = 8 }\n";
        let diags = read_toml("machine.toml", text).unwrap_err();
        let found: Vec<(String, u32)> =
            diags.iter().map(|diag| (diag.code.name(), diag.spans[0].line)).collect();
        let code = |code: &str| code.to_string();
        assert_eq!(
            found,
            [
                (code("E0604"), 1),
                (code("E0605"), 2),
                (code("E0605"), 3),
                (code("E0602"), 4),
                (code("E0605"), 6),
                (code("E0605"), 8),
            ],
            "{diags:?}"
        );
        let broken = read_toml("machine.toml", "a = \nb = 1\nc = ]\n").unwrap_err();
        assert_eq!(broken.len(), 2, "{broken:?}");
    }

    #[test]
    fn a_location_is_not_set_twice() {
        for (twice, place) in [
            ("int.1870 = 0\nrapid.split = 1\n", "machine.toml:2:7"),
            ("int.24 = 7\n[address.X]\nslot = 9\n", "machine.toml:3:8"),
            ("int.5001 = 1\nint.05001 = 2\n", "machine.toml:1:5"),
        ] {
            let (code, at) = error(twice);
            assert_eq!((&code[..], &at[..]), ("E0607", place), "{twice}");
        }
        assert!(read_toml("m", "int.1870 = 0\nrapid.split = 0\n").is_ok());
        let (commons, _) = read_toml("m", "int.24 = 30\n[address.X]\nformat = 2222\n").unwrap();
        assert_eq!(commons.int(Int(135)), 2222);
    }

    #[test]
    fn a_number_is_checked_as_its_name_is() {
        for wrong in ["int.1870 = 9", "int.24 = 0", "int.9003 = 40", "address.X.spec = 7"] {
            assert_eq!(error(wrong).0, "E0605", "{wrong}");
        }
        let mut commons = default_commons();
        for wrong in ["int.1870=9", "rapid.split=9", "int.1870=Q", "rapid.split=none of it"] {
            let diags = apply_setting(&mut commons, wrong).unwrap_err();
            assert_eq!(diags[0].code.name(), "E0605", "{wrong}");
        }
        let warnings = apply_setting(&mut commons, "int.5001=1").unwrap();
        assert_eq!(
            warnings[0].to_string(),
            "W0651 --set:1:5: the post does not act on INTCOM 5001"
        );
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
    fn allowed_offsets_are_names_of_offsets() {
        let read = |list: &str| {
            let text = format!("verify.allowed_offsets = {list}");
            read_toml("machine.toml", &text).map(|(commons, _)| commons)
        };
        let commons = read("['G54', 'g54.1p3', 'E2']").unwrap();
        assert_eq!(commons.allowed_offsets(), ["G54", "G54.1P3", "E2"]);
        let text = crate::files::write_toml(&commons);
        assert!(text.contains("verify.allowed_offsets = [\"G54\", \"G54.1P3\", \"E2\"]"), "{text}");
        for wrong in ["G", "G54.1", "G54P", "54", "E2P1", "G54 P1 X", "G5.10P1", "É1", "G1234"] {
            assert!(read(&format!("['{wrong}']")).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_setting_without_effect_warns() {
        let (_, warnings) = read_toml("m", "[tape]\npartno_punched = true").unwrap();
        assert_eq!(warnings[0].code.name(), "W0651");
    }

    #[test]
    fn what_is_wrong_with_a_single_setting_is_said_in_its_words() {
        let refused = |setting| apply_setting(&mut default_commons(), setting).unwrap_err();
        let cut_off = &refused("rapid.split")[0];
        assert_eq!(cut_off.code.name(), "E0603");
        assert!(cut_off.hint.as_ref().is_some_and(|hint| hint.contains("--set key=value")));
        for (setting, key) in
            [("address.X.slot=0", "`address.X.slot`"), ("address.X.char=7", "`address.X.char`")]
        {
            let wrong = &refused(setting)[0];
            assert_eq!(wrong.code.name(), "E0605");
            assert!(wrong.message.contains(key), "{wrong}");
        }
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
