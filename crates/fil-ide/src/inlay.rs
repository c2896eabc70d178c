//! Hints inside the text: what a number stands for.

use std::ops::Range as Bytes;

use filpost::Letter;
use filpost::postf::POSTF;
use filpost::resolve::SymbolKind;

use crate::context::{parts, postf_calls, statements};
use crate::positions::meaning;
use crate::script::Script;
use crate::tables;
use crate::text::Position;

/// A hint behind a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inlay {
    /// Right behind this place.
    pub position: Position,
    /// Its text.
    pub label: String,
}

impl Script {
    /// Operations of POSTF, names of commons and of words of the record, letters behind the
    /// numbers of addresses.
    pub fn inlays(&self) -> Vec<Inlay> {
        let mut found = Vec::new();
        for call in postf_calls(&self.text) {
            self.of_call(&call.arguments, &mut found);
        }
        for (range, letter) in self.letters() {
            found.push(self.behind(range, letter.to_string()));
        }
        found.sort_by_key(|inlay| inlay.position);
        found
    }

    fn behind(&self, range: Bytes<usize>, label: String) -> Inlay {
        Inlay { position: self.text.position(range.end), label: format!(": {label}") }
    }

    fn of_call(&self, arguments: &[Bytes<usize>], found: &mut Vec<Inlay>) {
        let text = self.text.as_str();
        let number = |index: usize| text.get(arguments.get(index)?.clone())?.parse::<u32>().ok();
        let mut tell = |index: usize, label: Option<String>| {
            let named = arguments.get(index).zip(label);
            found.extend(named.map(|(range, label)| self.behind(range.clone(), label)));
        };
        let Some(operation) = number(0) else { return };
        let row = POSTF.iter().find(|row| u32::from(row.number) == operation);
        tell(0, row.map(|row| filpost::operation_name(row.op).to_string()));
        match (operation, number(1), number(2)) {
            (1..=3, Some(kind), Some(common)) => {
                tell(2, tables::common_name(kind, common));
                let holds_letter = tables::holds_letter(kind, common);
                tell(3, number(3).filter(|_| holds_letter).and_then(letter_of).map(String::from));
            }
            (6..=8, Some(word), _) => {
                tell(1, self.word_at(arguments[0].start, word as usize).map(str::to_string));
            }
            _ => {}
        }
    }

    /// What a word of the record is, in the section around a byte.
    fn word_at(&self, byte: usize, word: usize) -> Option<&str> {
        let section = self.section_at(byte)?;
        let (major, minor) = match section.split_once(',') {
            Some((major, minor)) => (major, Some(minor)),
            None => (section, None),
        };
        // The minor word that a section asks for is there.
        if word == FIRST_MINOR && minor.is_some() {
            return minor;
        }
        meaning(major, minor, word)
    }

    /// Numbers that stand for letters: addresses of POSTN and REPEAT.
    fn letters(&self) -> Vec<(Bytes<usize>, char)> {
        let mut found = Vec::new();
        for (start, statement) in statements(&self.text) {
            let Some((word, items)) = statement.split_once('/') else { continue };
            // POSTN has its word OUT or NORMAL before the pairs.
            let first = match word.trim().to_ascii_uppercase().as_str() {
                "POSTN" => 1,
                "REPEAT" => 0,
                _ => continue,
            };
            let mut at = start + word.len() + 1;
            for (index, item) in parts(items).into_iter().enumerate() {
                let own = at + (item.len() - item.trim_start().len());
                let letter = item.trim().parse().ok().and_then(letter_of);
                if index >= first
                    && (index - first).is_multiple_of(2)
                    && let Some(letter) = letter
                {
                    found.push((own..own + item.trim().len(), letter));
                }
                at += item.len() + 1;
            }
        }
        found
    }

    /// The key of the section around a byte.
    pub(crate) fn section_at(&self, byte: usize) -> Option<&str> {
        let sections = self.analysis.resolution.of_kind(SymbolKind::Section);
        let mut around = sections.filter(|section| {
            section.extent.is_some_and(|extent| {
                extent.file == self.file && extent.span.range().contains(&byte)
            })
        });
        around.next().map(|section| section.name.as_str())
    }
}

/// Number of the word that a section with a minor word asks for.
const FIRST_MINOR: usize = 4;

/// The letter of an address by its number, A is 1.
fn letter_of(number: u32) -> Option<char> {
    Letter::numbered(i32::try_from(number).ok()?).map(Letter::character)
}
