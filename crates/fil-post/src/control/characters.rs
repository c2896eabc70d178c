//! Texts for people in the characters that the tape takes.
//!
//! `data/transliteration.tsv` says how letters outside ASCII are written in ASCII.

use std::collections::HashMap;
use std::sync::OnceLock;

use fil_machine::locations::{self as loc, TapeCharacters};

use super::Control;
use crate::errors::PostCode;

const SOURCE: &str = include_str!("../../data/transliteration.tsv");

/// Stands for a character that the table does not have.
const UNKNOWN: &str = "?";

impl Control {
    /// A text for people, in ASCII where the tape takes nothing else. Warns of
    /// characters that have no other form.
    pub(crate) fn in_tape_characters(&mut self, text: &str) -> String {
        let is_ascii_tape = self.commons.read(loc::TAPE_CHARACTERS) == TapeCharacters::Ascii;
        if text.is_ascii() || !is_ascii_tape {
            return text.to_string();
        }
        let (ascii, lost) = in_ascii(text);
        if let Some(lost) = lost {
            let message = format!("`{lost}` in `{text}`: written as `{UNKNOWN}`");
            self.warnings.add(PostCode::IgnoredPart, message);
        }
        ascii
    }
}

/// The text in ASCII, and the first character that the table does not have.
fn in_ascii(text: &str) -> (String, Option<char>) {
    let mut ascii = String::with_capacity(text.len());
    let mut lost = None;
    for character in text.chars() {
        match table().get(&character) {
            _ if character.is_ascii() => ascii.push(character),
            Some(form) => ascii.push_str(form),
            None => {
                lost = lost.or(Some(character));
                ascii.push_str(UNKNOWN);
            }
        }
    }
    (ascii, lost)
}

fn table() -> &'static HashMap<char, &'static str> {
    static TABLE: OnceLock<HashMap<char, &'static str>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let rows = SOURCE.lines().filter(|line| line.starts_with("U+"));
        rows.filter_map(|row| {
            let (code, form) = row.split_once('\t')?;
            let code = u32::from_str_radix(code.strip_prefix("U+")?, 16).ok()?;
            Some((char::from_u32(code)?, form))
        })
        .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_many_languages_are_written_in_ascii() {
        for (text, ascii) in [
            ("FRÄSER Ø10", "FRAESER OE10"),
            ("Größe ±0,1 mm", "Groesse +-0,1 mm"),
            ("Łódź, Brno: příruba", "Lodz, Brno: priruba"),
            ("ФРЕЗА Щуп", "FREZA SHCHup"),
            ("γωνία 45°", "gonia 45DEG"),
        ] {
            assert_eq!(in_ascii(text), (ascii.to_string(), None));
        }
        assert_eq!(in_ascii("刀 1"), ("? 1".to_string(), Some('刀')));
    }

    #[test]
    fn each_row_of_the_table_is_read_and_is_ascii() {
        let rows = SOURCE.lines().filter(|line| line.starts_with("U+")).count();
        assert_eq!(table().len(), rows);
        assert!(table().iter().all(|(from, to)| !from.is_ascii() && to.is_ascii()));
    }
}
