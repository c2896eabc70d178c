//! The blocks of a program, each with what made it: the program beside its line map.

use std::io::{Read, Seek};

use fil_nc::source::{Lines, Source, unreadable};
use fil_post::Cause;

use crate::error::Error;
use crate::map::{Entry, MapReader};

/// A word of a block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Word {
    /// As it is written.
    pub text: String,
    /// Its letter; `_` for a text.
    pub letter: char,
    /// The FIL call stack that caused it; 0 for none.
    pub stack: u32,
    /// A statement of FIL names it as it is.
    pub is_spelt: bool,
}

impl Word {
    /// Its number, for an address with one.
    pub fn number(&self) -> Option<f64> {
        let number = self.text.strip_prefix(self.letter)?.replace(',', ".");
        number.parse().ok()
    }
}

/// A block and what made it.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// Line of the program, 1-based.
    pub nc_line: u32,
    /// What made it.
    pub cause: Cause,
    /// The record in whose place it stands: that of its cause, unless a later one has made a block
    /// before it, as for a message that waits for a tool change.
    pub place: u32,
    /// Its words without the sequence number.
    pub words: Vec<Word>,
}

impl Made {
    /// Both have the same words.
    pub fn is_as(&self, other: &Made) -> bool {
        self.words.iter().map(|word| &word.text).eq(other.words.iter().map(|word| &word.text))
    }

    /// Its words, as they are written.
    pub fn text(&self) -> String {
        self.words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
    }

    /// True where it has a word of one of these letters.
    pub fn has(&self, letters: &str) -> bool {
        self.words.iter().any(|word| letters.contains(word.letter))
    }

    /// The FIL call stack behind a word of it, or behind the block; 0 for none.
    pub fn stack_of(&self, word: Option<&Word>) -> u32 {
        word.map(|word| word.stack).filter(|stack| *stack != 0).unwrap_or(self.cause.stack)
    }
}

/// The letter of a text.
pub(super) const TEXT: char = '_';

/// A text without a sequence number, which a block that an author has replaced holds.
fn without_number(text: &str) -> &str {
    let digits = text.strip_prefix('N').unwrap_or(text);
    let rest = digits.trim_start_matches(|c: char| c.is_ascii_digit());
    match rest.strip_prefix(' ') {
        Some(rest) if !digits.starts_with(' ') => rest.trim_start(),
        _ => text,
    }
}

/// The blocks of a program in their order.
pub(super) struct Blocks<'s, R> {
    pub map: MapReader<R>,
    lines: Lines<'s>,
    name: &'s str,
    next: Option<Made>,
    /// The last record that has made a block.
    place: u32,
}

impl<'s, R: Read + Seek> Blocks<'s, R> {
    /// Begins with the first block.
    ///
    /// # Errors
    /// A map that is none, a program that can't be read.
    pub fn new(map: R, map_name: &str, nc: (&'s Source<'s>, &'s str)) -> Result<Self, Error> {
        let map = MapReader::new(map_name, map)?;
        let lines = Lines::from(nc.0, 0);
        let mut blocks = Blocks { map, lines, name: nc.1, next: None, place: 0 };
        blocks.next = blocks.read()?;
        Ok(blocks)
    }

    /// The record in whose place the next block stands; `None` at the end.
    pub fn record(&self) -> Option<u32> {
        self.next.as_ref().map(|made| made.place)
    }

    /// The blocks up to the next one in the place of another record.
    ///
    /// # Errors
    /// A map that is none, a program that can't be read.
    pub fn of_record(&mut self) -> Result<Vec<Made>, Error> {
        let record = self.record();
        let mut found = Vec::new();
        while self.record() == record {
            let Some(made) = self.next.take() else { break };
            found.push(made);
            self.next = self.read()?;
        }
        Ok(found)
    }

    fn read(&mut self) -> Result<Option<Made>, Error> {
        for entry in self.map.by_ref() {
            let Entry::Line(line) = entry? else { continue };
            let cant = |error: std::io::Error| unreadable(self.name, &error);
            let text = self.lines.next_line().map_err(|error| Error::Run(Box::new(cant(error))))?;
            let text = String::from_utf8_lossy(text.unwrap_or_default());
            let words = line.words.iter().filter(|word| word.letter != '#').map(|word| Word {
                text: match word.letter {
                    TEXT => without_number(word.text(&text)).to_string(),
                    _ => word.text(&text).to_string(),
                },
                letter: word.letter,
                stack: word.cause.stack,
                is_spelt: word.cause.made_by_fil && word.cause.word != 0,
            });
            let nc_line = u32::try_from(line.number).unwrap_or(u32::MAX);
            let (cause, words) = (line.cause, words.collect());
            self.place = self.place.max(cause.record);
            return Ok(Some(Made { nc_line, cause, place: self.place, words }));
        }
        Ok(None)
    }
}
