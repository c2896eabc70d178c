//! `[option.NAME]`, which declares an option of the post, and `[options]`, which gives values.

use std::ops::Range;

use fil_diag::suggest::did_you_mean;
use fil_diag::{Diag, LineIndex, Result};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::TomlReader;
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::locations::Location;
use crate::post_options::{GivenOption, OptionKind, OptionValue, PostOption};
use crate::user_blocks;

/// The table that declares options.
pub(super) const DECLARED: &str = "option";

/// The table that gives options their values.
pub(super) const VALUES: &str = "options";

/// What a declaration may hold.
const FIELDS: &[&str] = &[
    "type",
    "default",
    "base_default",
    "group",
    "help",
    "min",
    "max",
    "set",
    "yes",
    "no",
    "choices",
];

/// A declaration, and what its values do.
struct Declared<'t> {
    option: PostOption,
    place: Range<usize>,
    /// The default where the machine is a base.
    base_default: Option<OptionValue>,
    /// Settings by the shown value: those of `yes`, `no`, and of choices.
    effects: Vec<(String, &'t DeTable<'t>)>,
    /// The setting that takes a number or a text as it is.
    set: Option<String>,
}

impl Declared<'_> {
    /// The settings that a value makes.
    fn effect(&self, value: &OptionValue) -> Option<&DeTable<'_>> {
        let shown = value.to_string();
        self.effects.iter().find(|(name, _)| *name == shown).map(|(_, table)| *table)
    }
}

/// The values that `[options]` of a machine.toml gives; none where the text is broken, which
/// reading it says.
pub fn given_options(file: &str, text: &str) -> Vec<GivenOption> {
    let index = LineIndex::new(text);
    let (table, _) = DeTable::parse_recoverable(text);
    let Some(values) = table.get_ref().iter().find(|(key, _)| key.get_ref() == VALUES) else {
        return Vec::new();
    };
    let DeValue::Table(values) = values.1.get_ref() else { return Vec::new() };
    let given = values.iter().map(|(name, value)| GivenOption {
        name: name.get_ref().to_string(),
        text: match value.get_ref() {
            DeValue::String(text) => text.to_string(),
            _ => text[value.span()].to_string(),
        },
        place: Some(index.place(file, text, value.span())),
    });
    given.collect()
}

/// Declares the options that comments of a FIL file declare,
/// `$$ filpost: option probe = { type = "bool", … }`, and gives them their values.
///
/// # Errors
/// Declarations that are wrong.
pub fn declare_fil_options(
    commons: &mut Commons,
    file: &str,
    text: &str,
) -> std::result::Result<(), Vec<Diag>> {
    let Some(declarations) = declarations(text) else { return Ok(()) };
    super::read_over(commons, file, &declarations, false).map(|_| ())
}

/// A FIL file with its declarations alone, each at its place; `None` where it has none.
fn declarations(text: &str) -> Option<String> {
    if !text.lines().any(|line| declaration(line).is_some()) {
        return None;
    }
    let mut made = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let blank = |byte: u8| if byte == b'\n' || byte == b'\r' { char::from(byte) } else { ' ' };
        match declaration(line) {
            Some(at) => {
                made.extend(line[..at].bytes().map(blank));
                made.push_str("option.");
                made.push_str(&line[at + DECLARED.len() + 1..]);
            }
            None => made.extend(line.bytes().map(blank)),
        }
    }
    Some(made)
}

/// Where the word `option` of a declaration stands in a line.
fn declaration(line: &str) -> Option<usize> {
    let comment = line.trim_start().strip_prefix("$$")?.trim_start();
    let (ours, rest) = comment.split_at_checked("filpost:".len())?;
    let rest = rest.trim_start();
    let (word, after) = rest.split_at_checked(DECLARED.len())?;
    let is_ours = ours.eq_ignore_ascii_case("filpost:") && word.eq_ignore_ascii_case(DECLARED);
    (is_ours && after.starts_with(' ')).then(|| line.len() - rest.len())
}

impl TomlReader<'_> {
    /// Declares the options of a text and makes the settings of their values.
    pub(super) fn options(&mut self, commons: &mut Commons, table: &DeTable) {
        let Some((_, value)) = table.iter().find(|(key, _)| key.get_ref() == DECLARED) else {
            return;
        };
        let DeValue::Table(options) = value.get_ref() else {
            let diag = wrong("`option` declares options: [option.NAME]");
            return self.refuse(value.span(), *diag);
        };
        let mut declared = Vec::new();
        for (name, value) in options.iter() {
            let read = self.declared(name, value);
            declared.extend(self.noted(name.span(), read));
        }
        self.set_presets(commons, &mut declared);
        for one in &mut declared {
            let given = commons.options().value_for(&one.option.name, &one.option.kind);
            match given {
                Ok(Some(value)) => (one.option.value, one.option.is_given) = (value, true),
                Ok(None) => {}
                Err(diag) => self.errors.push((one.place.start, *diag)),
            }
            commons.options_mut().declare(one.option.clone());
        }
        // What an option sets may differ from what the machine sets for itself.
        let said = std::mem::take(&mut self.said);
        declared.iter().for_each(|one| self.apply(commons, one));
        self.said.extend(said);
    }

    /// Values that set the defaults of other options, as a style does.
    fn set_presets(&mut self, commons: &Commons, declared: &mut [Declared<'_>]) {
        for one in declared.iter_mut() {
            if let Some(default) = one.base_default.take().filter(|_| commons.options().is_base) {
                one.option.value = default;
            }
        }
        let mut presets = Vec::new();
        for one in declared.iter() {
            let given = commons.options().value_for(&one.option.name, &one.option.kind);
            let value = given.ok().flatten().unwrap_or_else(|| one.option.value.clone());
            let preset = one.effect(&value).and_then(|table| table.get(VALUES));
            let Some(DeValue::Table(preset)) = preset.map(Spanned::get_ref) else { continue };
            for (name, value) in preset.iter() {
                presets.push((name.get_ref().to_string(), self.shown(value), value.span()));
            }
        }
        for (name, text, span) in presets {
            let Some(one) = declared.iter_mut().find(|one| one.option.name == name) else {
                self.refuse(span, *wrong(format!("no option `{name}` is declared here")));
                continue;
            };
            match one.option.kind.read(&text) {
                Some(value) => one.option.value = value,
                None => self.refuse(span, *wrong(format!("option `{name}` can't be `{text}`"))),
            }
        }
    }

    /// Makes the settings of the value of an option.
    fn apply(&mut self, commons: &mut Commons, one: &Declared<'_>) {
        if let Some(table) = one.effect(&one.option.value) {
            self.table(commons, table, "");
        }
        let Some(key) = &one.set else { return };
        let result = self.set_by_option(commons, key, one);
        self.noted(one.place.clone(), result);
    }

    fn set_by_option(
        &mut self,
        commons: &mut Commons,
        key: &str,
        one: &Declared<'_>,
    ) -> Result<()> {
        let number = match &one.option.value {
            OptionValue::Integer(number) => *number as f64,
            OptionValue::Length(length) => *length,
            OptionValue::Text(text) => {
                let Some((_, list)) = user_blocks::LISTS.iter().find(|(name, _)| *name == key)
                else {
                    return Err(wrong(format!("`{key}` is no list of texts")));
                };
                let texts: Vec<String> =
                    Some(text.clone()).filter(|text| !text.is_empty()).into_iter().collect();
                list.store(commons, &texts);
                return Ok(());
            }
            OptionValue::Bool(_) | OptionValue::Choice(_) => {
                return Err(wrong("`set` takes a number or a text; a choice has tables"));
            }
        };
        let Some(location) = Location::named(key) else {
            let mut diag = wrong(format!("no setting `{key}`"));
            diag.hint = did_you_mean(key, crate::locations::TABLE.iter().map(|row| row.name));
            return Err(diag);
        };
        self.store(commons, (location.kind, location.number.into()), number, one.place.clone())
    }

    /// Reads a declaration.
    fn declared<'t>(
        &self,
        name: &Spanned<std::borrow::Cow<'_, str>>,
        value: &'t Spanned<DeValue<'t>>,
    ) -> Result<Declared<'t>> {
        let name_text = name.get_ref();
        let is_name = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        if name_text.is_empty() || !name_text.bytes().all(is_name) {
            let text = "the name of an option has small letters, digits and hyphens";
            return Err(self.at(name.span(), *wrong(text)));
        }
        let DeValue::Table(fields) = value.get_ref() else {
            return Err(self.at(value.span(), *wrong("an option is declared by a table")));
        };
        let unknown = fields.keys().find(|key| !FIELDS.contains(&key.get_ref().as_ref()));
        if let Some(key) = unknown {
            let mut diag = wrong(format!("a declaration has no `{}`", key.get_ref()));
            diag.hint = did_you_mean(key.get_ref(), FIELDS.iter().copied());
            return Err(self.at(key.span(), *diag));
        }
        let text = |field: &str| fields.get(field).map(|value| self.shown(value));
        let need = |field: &str| {
            text(field).ok_or_else(|| {
                let message = format!("option `{name_text}` has no `{field}`");
                self.at(name.span(), *wrong(message))
            })
        };
        let kind = self.kind(fields, &need("type")?).map_err(|diag| self.at(name.span(), *diag))?;
        let default = self.default(fields, "default", &kind)?.ok_or_else(|| {
            let message = format!("option `{name_text}` has no `default`");
            self.at(name.span(), *wrong(message))
        })?;
        let base_default = self.default(fields, "base_default", &kind)?;
        let mut effects = Vec::new();
        for field in ["yes", "no"] {
            if let Some(DeValue::Table(table)) = fields.get(field).map(Spanned::get_ref) {
                effects.push((field.to_string(), table));
            }
        }
        if let Some(DeValue::Table(choices)) = fields.get("choices").map(Spanned::get_ref) {
            for (choice, value) in choices.iter() {
                if let DeValue::Table(table) = value.get_ref() {
                    effects.push((choice.get_ref().to_string(), table));
                }
            }
        }
        let option = PostOption {
            name: name_text.to_string(),
            kind,
            value: default.clone(),
            default,
            group: need("group")?,
            help: need("help")?,
            is_given: false,
        };
        Ok(Declared { option, place: name.span(), base_default, effects, set: text("set") })
    }

    fn default(
        &self,
        fields: &DeTable<'_>,
        field: &str,
        kind: &OptionKind,
    ) -> Result<Option<OptionValue>> {
        let Some(value) = fields.get(field) else { return Ok(None) };
        let text = self.shown(value);
        match kind.read(&text) {
            Some(value) => Ok(Some(value)),
            None => {
                let message = format!("`{field}` can't be `{text}`; it is {}", kind.values());
                Err(self.at(value.span(), *wrong(message)))
            }
        }
    }

    fn kind(&self, fields: &DeTable<'_>, name: &str) -> Result<OptionKind> {
        let number = |field: &str, default: f64| match fields.get(field) {
            Some(value) => self.plain_number(value),
            None => Ok(default),
        };
        match name {
            "bool" => Ok(OptionKind::Bool),
            "integer" => Ok(OptionKind::Integer {
                min: number("min", 0.0)? as i64,
                max: number("max", 99_999.0)? as i64,
            }),
            "length" => {
                Ok(OptionKind::Length { min: number("min", 0.0)?, max: number("max", 10_000.0)? })
            }
            "text" => Ok(OptionKind::Text),
            "choice" => match fields.get("choices").map(Spanned::get_ref) {
                Some(DeValue::Table(choices)) => {
                    let names = choices.keys().map(|key| key.get_ref().to_string());
                    Ok(OptionKind::Choice(names.collect()))
                }
                Some(DeValue::Array(names)) => {
                    Ok(OptionKind::Choice(names.iter().map(|name| self.shown(name)).collect()))
                }
                _ => Err(wrong("a choice names its `choices`")),
            },
            _ => Err(wrong(format!(
                "no type `{name}`; there are bool, integer, length, choice and text"
            ))),
        }
    }

    /// A value as text.
    fn shown(&self, value: &Spanned<DeValue<'_>>) -> String {
        match value.get_ref() {
            DeValue::String(text) => text.to_string(),
            _ => self.text[value.span()].to_string(),
        }
    }
}

fn wrong(message: impl Into<String>) -> Box<Diag> {
    MachineCode::OptionDeclaration.diag(message)
}
