//! The compat file: readings of FIL that a site corrects without a new build.
//!
//! ```toml
//! section = "process"      # or "take"
//! [postf]
//! 13 = "process"           # number = operation, see docs/compat.md
//! 18 = "none"
//! [words]
//! without_effect = ["SITEWD"]   # on top of those that the machine lists
//! ```

use fil_diag::{Diag, LineIndex};
use fil_vm::postf::POSTF;
use fil_vm::{Compat, PostfOp, SectionMode};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::RunCode;

/// Most words that a file lists.
const MOST_WORDS: usize = 1000;

/// What a compat file says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct CompatFile {
    /// Readings of FIL.
    #[doc(hidden)]
    pub readings: Compat,
    /// Major words that the post passes over, besides those that the machine lists.
    pub without_effect: Vec<String>,
}

impl From<Compat> for CompatFile {
    fn from(readings: Compat) -> Self {
        CompatFile { readings, without_effect: Vec::new() }
    }
}

/// Reads a compat file over the built-in readings.
///
/// # Errors
/// Text that is not TOML, an unknown key, number or operation.
pub fn read_compat(file: &str, text: &str) -> Result<CompatFile, Box<Diag>> {
    let index = LineIndex::new(text);
    let wrong = |range: std::ops::Range<usize>, message: String| {
        Box::new(Diag::new(RunCode::CompatFile, message).at(index.place(file, text, range)))
    };
    let table = DeTable::parse(text)
        .map_err(|error| wrong(error.span().unwrap_or(0..0), error.message().to_string()))?;
    let mut found = CompatFile::default();
    let compat = &mut found.readings;
    for (key, value) in table.get_ref().iter() {
        match (key.get_ref().as_ref(), value.get_ref()) {
            ("section", DeValue::String(mode)) if mode == "take" => {
                compat.section = SectionMode::Take;
            }
            ("section", DeValue::String(mode)) if mode == "process" => {
                compat.section = SectionMode::Process;
            }
            ("section", _) => {
                return Err(wrong(value.span(), "section is \"take\" or \"process\"".into()));
            }
            ("postf", DeValue::Table(rows)) => {
                for (number, operation) in rows.iter() {
                    let wrong_row = |message: String| wrong(operation.span(), message);
                    assign(compat, number.get_ref(), operation).map_err(wrong_row)?;
                }
            }
            ("words", DeValue::Table(rows)) => {
                for (key, words) in rows.iter() {
                    if key.get_ref() != "without_effect" {
                        return Err(wrong(key.span(), format!("no key `words.{}`", key.get_ref())));
                    }
                    found.without_effect =
                        listed(words).map_err(|message| wrong(words.span(), message))?;
                }
            }
            (other, _) => return Err(wrong(key.span(), format!("no key `{other}`"))),
        }
    }
    Ok(found)
}

/// The words of a list.
fn listed(words: &Spanned<DeValue>) -> Result<Vec<String>, String> {
    let DeValue::Array(items) = words.get_ref() else {
        return Err("a list of words is needed here".into());
    };
    if items.len() > MOST_WORDS {
        return Err(format!("at most {MOST_WORDS} words fit"));
    }
    let word = |item: &Spanned<DeValue>| match item.get_ref() {
        DeValue::String(word) if !word.trim().is_empty() => Ok(word.to_string()),
        _ => Err("a list holds words only".into()),
    };
    items.iter().map(word).collect()
}

fn assign(compat: &mut Compat, number: &str, operation: &Spanned<DeValue>) -> Result<(), String> {
    let number: u16 = number.parse().map_err(|_| format!("`{number}` is no POSTF number"))?;
    let DeValue::String(name) = operation.get_ref() else {
        return Err("the name of an operation is needed".into());
    };
    if name == "none" {
        compat.postf.remove(&number);
        return Ok(());
    }
    let found = POSTF.iter().find(|row| operation_name(row.op).eq_ignore_ascii_case(name));
    let row = found.ok_or_else(|| {
        let names: Vec<String> = POSTF.iter().map(|row| operation_name(row.op)).collect();
        format!("no operation `{name}`; there are {}", names.join(", "))
    })?;
    compat.postf.insert(number, row.op);
    Ok(())
}

/// The name of an operation in a compat file: `get-common`, `process`, ….
pub fn operation_name(operation: PostfOp) -> String {
    let mut name = String::new();
    for character in format!("{operation:?}").chars() {
        if character.is_ascii_uppercase() && !name.is_empty() {
            name.push('-');
        }
        name.push(character.to_ascii_lowercase());
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_sections_can_be_corrected() {
        let text = "section = 'process'\n[postf]\n18 = 'process'\n13 = 'none'\n3 = 'set-common'";
        let compat = read_compat("c", text).unwrap().readings;
        assert_eq!(compat.section, SectionMode::Process);
        assert_eq!(compat.operation(18.0), Some(PostfOp::Process));
        assert_eq!(compat.operation(13.0), None);
        assert_eq!(compat.operation(3.0), Some(PostfOp::SetCommon));
    }

    #[test]
    fn words_without_effect_are_listed() {
        let found = read_compat("c", "[words]\nwithout_effect = ['SITEWD', 'other']").unwrap();
        assert_eq!(found.without_effect, ["SITEWD", "other"]);
        assert_eq!(found.readings, Compat::default());
    }

    #[test]
    fn mistakes_have_their_place() {
        let at = |text: &str| {
            let diag = read_compat("c", text).unwrap_err();
            format!("{} {}", diag.code.name(), diag.spans[0])
        };
        assert_eq!(at("[postf]\n13 = 'fly'"), "E0704 c:2:6");
        assert_eq!(at("sections = 'take'"), "E0704 c:1:1");
        assert_eq!(at("section = 3"), "E0704 c:1:11");
        assert_eq!(at("[words]\nwithout = ['A']"), "E0704 c:2:1");
        assert_eq!(at("words.without_effect = 'A'"), "E0704 c:1:24");
        assert_eq!(at("words.without_effect = ['A', 3]"), "E0704 c:1:24");
    }
}
