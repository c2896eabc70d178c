//! Reading `machine.toml`: named settings over the commons.
//!
//! `base = "NAME"` names the machine it begins from. Keys are the names of the table of locations (`rapid.split = 1`), or
//! `int.1870 = 1`, `rel.11 = 1.0`, `dbl.486 = 2.0`; `[address.X]` holds `slot`,
//! `format`, `spec` and `char` of a letter; `blocks.start` and `blocks.end` are
//! lists of texts, and so are `words.without_effect`, the major words that pass, and
//! `verify.allowed_offsets` and `verify.allowed_functions`, what a program may have unasked, and `learned.undecided` and `learned.unequal`; `[levels]` sets levels of codes,
//! `[effects]` says what blocks of the shop do, `[simulate]` what `filpost simulate` cuts, `[option.NAME]` declares an option of the post and
//! `[options]` gives values. A flag takes true or false, a letter or character a text of
//! one character, and every setting takes `"none"` for absent.

mod address;
mod effects;
mod levels;
mod options;
mod simulate;
mod values;

pub use options::{declare_fil_options, given_options};

use std::ops::Range;

use fil_diag::suggest::meant_in_group;
use fil_diag::{Diag, LineIndex, Result, TextSpan};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::chains;
use crate::commons::{Commons, Kind};
use crate::errors::MachineCode;
use crate::locations::{self as loc, Location, default_commons};
use crate::post_options::PostOptions;
use crate::renamed;
use crate::stored;
use crate::user_blocks::{self, MAX_BLOCKS};

/// Most words that a machine lists as without effect.
const MOST_WORDS: usize = 1000;

/// Most work offsets that a machine allows without being asked for.
const MOST_OFFSETS: usize = 1000;

/// Most settings that a machine lists as undecided.
const MOST_UNDECIDED: usize = 10_000;

/// Most characters of settings that are undecided together.
const LONGEST_UNDECIDED: usize = 10_000;

/// What a `machine.toml` may say about itself without it being a setting.
const ABOUT: &[&str] = &["name", "description", "origin"];

/// The key of the machine that a `machine.toml` begins from.
const BASE: &str = "base";

/// What stands before the number of a location whose value the import could not read.
const IMPORTED: &str = "imported.";

/// The key of the chain of axes that comes with the post.
const CHAIN: &str = "chain";

/// What stands before the codes of levels.
const LEVELS: &str = "levels.";

/// What stands before the blocks of effects.
const EFFECTS: &str = "effects.";

/// What stands before the keys of the simulation.
const SIMULATE: &str = "simulate.";

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
    let given = options::given_options(file, text);
    read_toml_given(file, text, bases, PostOptions::given(given, false))
}

/// The same with values for options of the post. What `[options]` of the text gives must be
/// among them.
///
/// # Errors
/// As [`read_toml_with`]; E0611 for a value that its option does not take. Values for options
/// that are not declared are the caller's to refuse.
pub fn read_toml_given(
    file: &str,
    text: &str,
    bases: &dyn Fn(&str) -> Option<&'static str>,
    given: PostOptions,
) -> Result<(Commons, Vec<Diag>), Vec<Diag>> {
    let (table, _) = DeTable::parse_recoverable(text);
    let base = table.get_ref().iter().find(|(key, _)| key.get_ref() == BASE);
    let mut commons = match base {
        None => {
            let mut commons = default_commons();
            *commons.options_mut() = given;
            commons
        }
        Some((_, value)) => base_commons(file, text, value, bases, given)?,
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
    given: PostOptions,
) -> Result<Commons, Vec<Diag>> {
    let name = value.get_ref().as_str().unwrap_or_default();
    let Some(base) = bases(name) else {
        let diag = Diag::new(
            MachineCode::SettingValue,
            format!("no machine `{name}` to begin from"),
        )
        .hint("base names a ready post, as in base = \"fanuc-mill\"; `filpost posts` lists them");
        return Err(vec![*TomlReader::new(file, text).at(value.span(), diag)]);
    };
    let mut given = given;
    given.is_base = true;
    let (mut commons, _) = read_toml_given(name, base, &|_| None, given)?;
    commons.options_mut().is_base = false;
    Ok(commons)
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
        reader.before = address::cells(commons);
        reader.table(commons, table.get_ref(), "");
        reader.options(commons, table.get_ref());
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
    /// Warnings: imported values whose meaning is not known, old keys.
    doubtful: Vec<Diag>,
    /// Letters that are named, with their tape position and where that is said.
    named: Vec<(u8, u32, Range<usize>)>,
    /// The tables of letters before the text, by INTCOM location.
    before: Vec<f64>,
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
            before: Vec::new(),
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
            if prefix.is_empty() && self.is_about(&name) {
                continue;
            }
            if prefix == "address" {
                self.address(commons, key, value);
            } else if let DeValue::Table(inner) = value.get_ref() {
                self.table(commons, inner, &name);
            } else {
                let result = self.setting(commons, &name, key.span(), value);
                self.noted(value.span(), result);
            }
        }
    }

    /// True for a key that is no setting.
    fn is_about(&self, name: &str) -> bool {
        ABOUT.contains(&name)
            || [CHAIN, options::DECLARED, options::VALUES].contains(&name)
            || (name == BASE && self.takes_base)
    }

    fn setting(
        &mut self,
        commons: &mut Commons,
        name: &str,
        key: Range<usize>,
        value: &Spanned<DeValue>,
    ) -> Result<()> {
        if let Some(new) = renamed::key(name) {
            let warning = self.at(key.clone(), renamed::warning(name, new));
            self.doubtful.push(*warning);
            return self.setting(commons, new, key, value);
        }
        if let Some((_, list)) = user_blocks::LISTS.iter().find(|(key, _)| *key == name) {
            let blocks = self.texts(value, MAX_BLOCKS.into())?;
            if let Some(name) = blocks.iter().find_map(|block| user_blocks::unknown_name(block)) {
                let known = user_blocks::NAMES.join(" and ");
                let message = format!("`{name}` stands for nothing; blocks know {known}");
                return Err(self.at(value.span(), Diag::new(MachineCode::SettingValue, message)));
            }
            list.store(commons, &blocks);
            return Ok(());
        }
        if name == "words.without_effect" {
            let words = self.texts(value, MOST_WORDS)?;
            words.iter().for_each(|word| commons.list_without_effect(word));
            return Ok(());
        }
        if let Some(code) = name.strip_prefix(LEVELS) {
            return self.level(commons, code, key, value);
        }
        if let Some(block) = name.strip_prefix(EFFECTS) {
            return self.effect(commons, block, key, value);
        }
        if let Some(simulate) = name.strip_prefix(SIMULATE) {
            return self.simulate(commons, simulate, key, value);
        }
        if let "learned.undecided" | "learned.unequal" = name {
            let texts = self.texts_up_to(value, MOST_UNDECIDED, LONGEST_UNDECIDED)?;
            match name {
                "learned.undecided" => commons.set_undecided(texts),
                _ => commons.set_unequal(texts),
            }
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
        if name == "verify.allowed_functions" {
            return self.allowed_functions(commons, value);
        }
        if let Some((kind, number)) = name.strip_prefix(IMPORTED).and_then(numbered) {
            return self.imported(commons, (kind, number), value, key);
        }
        if let Some((kind, number)) = numbered(name) {
            let number_said = self.plain_number(value)?;
            return self.store(commons, (kind, number), number_said, key);
        }
        if name == BASE {
            let message = "`base` belongs in the machine.toml of a machine, not in an overlay";
            return Err(self.at(key, Diag::new(MachineCode::UnknownSetting, message)));
        }
        let Some(location) = Location::named(name) else {
            let mut diag = Diag::new(MachineCode::UnknownSetting, format!("no setting `{name}`"));
            let lists = user_blocks::LISTS.iter().map(|(name, _)| *name);
            diag.hint = meant_in_group(name, loc::TABLE.iter().map(|row| row.name).chain(lists));
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
mod tests;
