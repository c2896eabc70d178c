//! Places in a text: lines and UTF-16 units outside, bytes inside.

use std::ops::Range as Bytes;

/// A place as editors count it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// Line, 0-based.
    pub line: u32,
    /// UTF-16 units from the start of the line.
    pub character: u32,
}

/// From a place to another, the end not included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Range {
    /// First place.
    pub start: Position,
    /// Place behind the last.
    pub end: Position,
}

/// A text with the starts of its lines. A byte order mark is left out of it and counted
/// in the places of the first line.
#[derive(Clone, Debug)]
pub struct Text {
    text: String,
    starts: Vec<usize>,
    mark: u32,
}

impl Text {
    /// A text as an editor has it.
    pub fn new(text: &str) -> Self {
        let plain = text.strip_prefix('\u{feff}');
        let mark = u32::from(plain.is_some());
        let text = plain.unwrap_or(text).to_string();
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let starts = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        Text { text, starts, mark }
    }

    /// The text without a byte order mark.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Number of lines; the last may be empty.
    pub fn line_count(&self) -> usize {
        self.starts.len()
    }

    /// The line of a byte, 0-based.
    pub fn line_of(&self, byte: usize) -> usize {
        self.starts.partition_point(|start| *start <= byte).saturating_sub(1)
    }

    /// Bytes of a line without its end; empty behind the last line.
    pub fn line_bytes(&self, line: usize) -> Bytes<usize> {
        let Some(start) = self.starts.get(line).copied() else {
            return self.text.len()..self.text.len();
        };
        let end = self.starts.get(line + 1).map_or(self.text.len(), |next| next - 1);
        let kept = self.text[start..end].trim_end_matches('\r').len();
        start..start + kept
    }

    /// A line without its end.
    pub fn line(&self, line: usize) -> &str {
        &self.text[self.line_bytes(line)]
    }

    /// The place of a byte; one inside of a character counts as its start.
    pub fn position(&self, byte: usize) -> Position {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let line = self.line_of(byte);
        let units = self.text[self.starts[line]..byte].encode_utf16().count() as u32;
        let mark = if line == 0 { self.mark } else { 0 };
        Position { line: line as u32, character: units + mark }
    }

    /// The byte of a place; a place behind a line's end counts as that end.
    pub fn byte(&self, position: Position) -> usize {
        let line = position.line as usize;
        let bytes = self.line_bytes(line);
        let mark = if line == 0 { self.mark } else { 0 };
        let mut left = position.character.saturating_sub(mark) as usize;
        for (at, character) in self.text[bytes.clone()].char_indices() {
            if left < character.len_utf16() {
                return bytes.start + at;
            }
            left -= character.len_utf16();
        }
        bytes.end
    }

    /// The places of a range of bytes.
    pub fn range(&self, bytes: Bytes<usize>) -> Range {
        Range { start: self.position(bytes.start), end: self.position(bytes.end) }
    }

    /// From the first place to the last.
    pub fn whole(&self) -> Range {
        Range { start: Position::default(), end: self.position(self.text.len()) }
    }
}

/// True for a character of names and words.
pub(crate) fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// The word around a byte, or right before it.
pub(crate) fn word_around(text: &str, byte: usize) -> Bytes<usize> {
    let byte = byte.min(text.len());
    let Some((head, tail)) = text.split_at_checked(byte) else { return byte..byte };
    let start = head
        .rfind(|c| !is_word(c))
        .map_or(0, |at| at + head[at..].chars().next().map_or(0, char::len_utf8));
    let end = tail.find(|c| !is_word(c)).unwrap_or(tail.len());
    start..byte + end
}
