//! Options of a post: choices for each program, such as `preload = no`.
//!
//! A `machine.toml` or a FIL file declares them; `[options]`, `--option` and the library give
//! their values. A value makes settings, or FIL reads it by OPTIONF.

use std::fmt;

use fil_diag::suggest::did_you_mean;
use fil_diag::{Diag, Result, TextSpan};

use crate::errors::MachineCode;
use crate::modes::INCH;

/// Longest value of an option that is a text.
const LONGEST_TEXT: usize = 54;

/// What values an option takes.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionKind {
    /// Yes or no.
    Bool,
    /// A whole number between two bounds, both included.
    Integer {
        /// The smallest.
        min: i64,
        /// The largest.
        max: i64,
    },
    /// A length between two bounds in mm, both included.
    Length {
        /// The smallest, mm.
        min: f64,
        /// The largest, mm.
        max: f64,
    },
    /// One of some names.
    Choice(Vec<String>),
    /// A text in printing ASCII characters.
    Text,
}

/// The value of an option.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionValue {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// A length, mm.
    Length(f64),
    /// The name of a choice.
    Choice(String),
    /// A text.
    Text(String),
}

/// An option of a post with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct PostOption {
    /// Its name, in small letters.
    pub name: String,
    /// What values it takes.
    pub kind: OptionKind,
    /// Its value where nobody gives one, as far as the style of the post sets no other.
    pub default: OptionValue,
    /// The heading that it is listed under.
    pub group: String,
    /// What it does, in one line.
    pub help: String,
    /// Its value.
    pub value: OptionValue,
    /// Somebody gave the value.
    pub is_given: bool,
}

/// A value that somebody gives an option by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenOption {
    /// Name of the option.
    pub name: String,
    /// The value as it is written.
    pub text: String,
    /// Where; `None` for the command line and the library.
    pub place: Option<TextSpan>,
}

/// The options of a machine, and the values that are given.
#[derive(Clone, Debug, Default)]
pub struct PostOptions {
    declared: Vec<PostOption>,
    given: Vec<GivenOption>,
    /// The machine is the base of another one, or was chosen because nothing named one.
    pub is_base: bool,
}

impl OptionKind {
    /// The word of a declaration.
    pub fn name(&self) -> &'static str {
        match self {
            OptionKind::Bool => "bool",
            OptionKind::Integer { .. } => "integer",
            OptionKind::Length { .. } => "length",
            OptionKind::Choice(_) => "choice",
            OptionKind::Text => "text",
        }
    }

    /// The values it takes, for people.
    pub fn values(&self) -> String {
        match self {
            OptionKind::Bool => "yes or no".into(),
            OptionKind::Integer { min, max } => format!("a whole number from {min} to {max}"),
            OptionKind::Length { min, max } => {
                format!("a length from {min} to {max} mm, such as 50, 50mm or 2in")
            }
            OptionKind::Choice(names) => format!("one of {}", names.join(", ")),
            OptionKind::Text => {
                format!("a text of at most {LONGEST_TEXT} printing ASCII characters")
            }
        }
    }

    /// Reads a value; `None` for one that it does not take.
    pub fn read(&self, text: &str) -> Option<OptionValue> {
        let text = text.trim();
        match self {
            OptionKind::Bool => match text.to_ascii_lowercase().as_str() {
                "yes" | "true" | "on" => Some(OptionValue::Bool(true)),
                "no" | "false" | "off" => Some(OptionValue::Bool(false)),
                _ => None,
            },
            OptionKind::Integer { min, max } => {
                let number = text.parse().ok().filter(|number| (min..=max).contains(&number));
                number.map(OptionValue::Integer)
            }
            OptionKind::Length { min, max } => {
                let length = length(text).filter(|length| (min..=max).contains(&length));
                length.map(OptionValue::Length)
            }
            OptionKind::Choice(names) => {
                let named = names.iter().find(|name| name.eq_ignore_ascii_case(text));
                named.cloned().map(OptionValue::Choice)
            }
            OptionKind::Text => {
                let prints = text.bytes().all(|byte| (0x20..0x7f).contains(&byte));
                let fits = prints && text.len() <= LONGEST_TEXT;
                fits.then(|| OptionValue::Text(text.to_string()))
            }
        }
    }
}

/// A length in mm: `50`, `50mm`, `2in`.
fn length(text: &str) -> Option<f64> {
    let (digits, factor) = match (text.strip_suffix("mm"), text.strip_suffix("in")) {
        (Some(digits), _) => (digits, 1.0),
        (_, Some(digits)) => (digits, INCH),
        _ => (text, 1.0),
    };
    let number: f64 = digits.trim_end().parse().ok()?;
    Some(number * factor).filter(|length| length.is_finite())
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OptionValue::Bool(true) => f.write_str("yes"),
            OptionValue::Bool(false) => f.write_str("no"),
            OptionValue::Integer(number) => write!(f, "{number}"),
            OptionValue::Length(length) => write!(f, "{length}mm"),
            OptionValue::Choice(text) | OptionValue::Text(text) => f.write_str(text),
        }
    }
}

impl PostOptions {
    /// The options with these values given, none declared yet.
    pub fn given(given: Vec<GivenOption>, is_base: bool) -> Self {
        PostOptions { declared: Vec::new(), given, is_base }
    }

    /// Takes the values that are given, for options that are still to be declared.
    pub fn give(&mut self, others: PostOptions) {
        self.given = others.given;
        self.is_base = others.is_base;
    }

    /// All options that are declared, in their order.
    pub fn all(&self) -> &[PostOption] {
        &self.declared
    }

    /// The option of a name, letters in any case.
    pub fn find(&self, name: &str) -> Option<&PostOption> {
        self.declared.iter().find(|option| option.name.eq_ignore_ascii_case(name))
    }

    /// Adds an option; one of the same name is replaced.
    pub fn declare(&mut self, option: PostOption) {
        match self.declared.iter_mut().find(|known| known.name == option.name) {
            Some(known) => *known = option,
            None => self.declared.push(option),
        }
    }

    /// The value that is given to an option of this name and kind; `None` where nobody gives
    /// one.
    ///
    /// # Errors
    /// A value that the option does not take.
    pub fn value_for(&self, name: &str, kind: &OptionKind) -> Result<Option<OptionValue>> {
        let of_name = |given: &&GivenOption| given.name.eq_ignore_ascii_case(name);
        let Some(given) = self.given.iter().rev().find(of_name) else { return Ok(None) };
        match kind.read(&given.text) {
            Some(value) => Ok(Some(value)),
            None => Err(wrong_value(given, kind)),
        }
    }

    /// Refuses values for options that nobody has declared.
    ///
    /// # Errors
    /// E0610, one for each.
    pub fn refuse_unknown(&self) -> std::result::Result<(), Vec<Diag>> {
        let unknown = self.given.iter().filter(|given| self.find(&given.name).is_none());
        let unknown: Vec<Diag> = unknown.map(|given| *self.unknown(given)).collect();
        if unknown.is_empty() { Ok(()) } else { Err(unknown) }
    }

    fn unknown(&self, given: &GivenOption) -> Box<Diag> {
        let names = || self.declared.iter().map(|option| option.name.as_str());
        let mut diag =
            MachineCode::UnknownOption.diag(format!("the post has no option `{}`", given.name));
        let all: Vec<&str> = names().collect();
        diag.hint = did_you_mean(&given.name, names()).or(match all.is_empty() {
            true => Some("the post has no options".into()),
            false => Some(format!("there are {}", all.join(", "))),
        });
        placed(diag, given)
    }
}

fn wrong_value(given: &GivenOption, kind: &OptionKind) -> Box<Diag> {
    let message = format!("option `{}` can't be `{}`", given.name, given.text);
    let mut diag = MachineCode::OptionValue.diag(message);
    let near = match kind {
        OptionKind::Choice(names) => did_you_mean(&given.text, names.iter().map(String::as_str)),
        _ => None,
    };
    let values = format!("it is {}", kind.values());
    diag.hint = Some(near.map_or(values.clone(), |near| format!("{near} {values}")));
    placed(diag, given)
}

fn placed(diag: Box<Diag>, given: &GivenOption) -> Box<Diag> {
    match &given.place {
        Some(place) => Box::new(diag.at(place.clone())),
        None => diag,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_reads_its_values() {
        assert_eq!(OptionKind::Bool.read("Yes"), Some(OptionValue::Bool(true)));
        assert_eq!(OptionKind::Bool.read("maybe"), None);
        let integer = OptionKind::Integer { min: 1, max: 10 };
        assert_eq!(integer.read("10"), Some(OptionValue::Integer(10)));
        assert_eq!((integer.read("11"), integer.read("1.5")), (None, None));
        let length = OptionKind::Length { min: 0.0, max: 100.0 };
        assert_eq!(length.read("2in"), Some(OptionValue::Length(50.8)));
        assert_eq!(length.read("50 mm"), Some(OptionValue::Length(50.0)));
        assert_eq!((length.read("5in"), length.read("nan"), length.read("x")), (None, None, None));
        let choice = OptionKind::Choice(vec!["g28".into(), "g53".into()]);
        assert_eq!(choice.read("G53"), Some(OptionValue::Choice("g53".into())));
        assert_eq!((choice.read("g54"), OptionKind::Text.read("a\tb")), (None, None));
    }
}
