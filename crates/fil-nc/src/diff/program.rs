//! A program read for a comparison: its blocks, and what is in force around each.

use std::hash::{DefaultHasher, Hash, Hasher};

use fil_diag::Diag;

use super::Options;
use super::language::Language;
use super::modal::{Modal, group, tenths};
use crate::text::{Block, Word};

/// Steps of a unit of length that the alignment tells apart.
const STEPS: f64 = 1e4;

/// A line and what is in force.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub block: Block,
    pub before: Modal,
    pub after: Modal,
    /// It only repeats what is in force.
    pub silent: bool,
    /// The same for blocks that say the same.
    pub token: u64,
}

/// A program read for a comparison.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Lines that are not empty.
    pub(super) lines: Vec<Line>,
    name: String,
    texts: Vec<String>,
}

impl Program {
    /// The name it was read by.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text of a line, 1-based; empty where there is none.
    pub fn text(&self, line: u32) -> &str {
        let at = (line as usize).checked_sub(1);
        at.and_then(|at| self.texts.get(at)).map_or("", String::as_str)
    }

    /// The sequence number of a line.
    pub fn sequence_number(&self, line: u32) -> Option<i64> {
        let at = self.lines.binary_search_by_key(&line, |held| held.block.line).ok()?;
        self.lines[at].block.sequence_number()
    }

    pub(super) fn read(text: &[u8], name: &str, options: &Options) -> Result<Self, Box<Diag>> {
        let mut modal = Modal::default();
        let language = Language::of(text);
        let mut program = Program { name: name.to_string(), ..Program::default() };
        for (number, line) in text.split(|byte| *byte == b'\n').enumerate() {
            program.texts.push(String::from_utf8_lossy(line).trim_end().to_string());
            let mut block = language.read(line, name, number as u32 + 1)?;
            leave_out(&mut block, options);
            let before = modal.clone();
            modal.take(&block);
            if is_empty(&block) {
                continue;
            }
            let silent = !options.modal && only_repeats(&block, &before, &modal);
            let token = token(&block, |word| !silent && repeats(word, &before, &modal));
            program.lines.push(Line { block, before, after: modal.clone(), silent, token });
        }
        Ok(program)
    }
}

/// Drops what is not looked at.
fn leave_out(block: &mut Block, options: &Options) {
    let ignore = &options.ignore;
    block.words.retain(|word| !ignore.letters.contains(&word.letter));
    if ignore.numbers {
        block.words.retain(|word| word.letter != b'N');
    }
    if ignore.comments {
        block.comments.clear();
    }
    if ignore.dates {
        block.comments.iter_mut().for_each(|text| *text = without_dates(text));
    }
}

/// A text whose groups of digits joined by `-`, `/`, `.` or `:` are one `#`:
/// dates and times, as no tool's name is written.
fn without_dates(text: &str) -> String {
    let date = |word: &str| {
        let joints = word.bytes().filter(|byte| b"-/.:".contains(byte)).count();
        joints > 0
            && word.starts_with(|first: char| first.is_ascii_digit())
            && word.bytes().all(|byte| byte.is_ascii_digit() || b"-/.:T".contains(&byte))
            && (joints > 1 || word.contains(':'))
    };
    let words = text.split(' ').map(|word| if date(word.trim_matches(',')) { "#" } else { word });
    words.collect::<Vec<_>>().join(" ")
}

fn is_empty(block: &Block) -> bool {
    let marked = block.tape_mark || block.skip || block.statement.is_some();
    !marked && block.words.is_empty() && block.comments.is_empty()
}

/// A block that changes nothing: a cycle would drill again at the same place.
fn only_repeats(block: &Block, before: &Modal, after: &Modal) -> bool {
    let drills =
        after.in_cycle() && block.words.iter().any(|word| b"XYZABC".contains(&word.letter));
    let marked =
        block.tape_mark || block.skip || !block.comments.is_empty() || block.statement.is_some();
    let repeated = |word: &Word| word.letter == b'N' || repeats(word, before, after);
    !drills && !marked && block.words.iter().all(repeated)
}

/// The word says what is in force already.
fn repeats(word: &Word, before: &Modal, after: &Modal) -> bool {
    if word.index.is_some() {
        return false;
    }
    let value = word.number.value();
    match word.letter {
        b'G' | b'M' => {
            let code = tenths(value);
            group(word.letter, code)
                .is_some_and(|group| before.function(word.letter, group) == Some(code))
        }
        letter if after.drills_along(letter) && !before.in_cycle() => false,
        letter => after.keeps(letter) && before.in_force(letter) == Some(value),
    }
}

/// A hash of what a block says, without its number and what is left out.
fn token(block: &Block, left_out: impl Fn(&Word) -> bool) -> u64 {
    let mut said: Vec<(u8, Option<u32>, i64)> = block
        .words
        .iter()
        .filter(|word| word.letter != b'N' && !left_out(word))
        .map(|word| (word.letter, word.index, (word.number.value() * STEPS).round() as i64))
        .collect();
    said.sort_unstable();
    let mut hasher = DefaultHasher::new();
    (block.tape_mark, block.skip, &block.comments, &block.statement, said).hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_of_comments_are_told_from_numbers() {
        assert_eq!(without_dates("MADE 2026-11-21 10:30:05 R2.5 T1"), "MADE # # R2.5 T1");
        assert_eq!(without_dates("DIA 10.5, 21.11.2026, END"), "DIA 10.5, # END");
    }
}
