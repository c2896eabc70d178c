//! One statement: its physical lines joined, and the way back to them.

use std::io::Read;

use fil_diag::Place;

use super::Options;
use super::lines::{LineError, Lines};
use crate::vocabulary::WordId;
use crate::words;

/// What kind of statement was gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `MAJOR / items`
    Plain,
    /// `$$-> KEY / items`; the joined text starts at the key.
    Pseudo,
    /// A text statement; the joined text is the free text.
    Text(WordId),
}

/// Why no statement could be gathered.
pub(super) enum GatherError {
    Line(LineError),
    /// The `$` at this place is followed by nothing; position in the joined text.
    Open(usize),
}

/// A piece of the joined text that comes from one physical line.
struct Piece {
    /// Where it starts in the joined text.
    joined: usize,
    /// The physical line, within the statement's bytes.
    line: std::ops::Range<usize>,
    /// Where the piece starts in that line.
    column: usize,
    /// Number of the line.
    number: u32,
}

/// The statement under way. Its buffers are used again for the next one.
pub(super) struct Statement {
    /// The text without continuation signs, comments and line ends.
    pub(super) joined: Vec<u8>,
    /// Line where the statement starts.
    pub(super) line: u32,
    pieces: Vec<Piece>,
}

/// Words whose statement is free text.
const TEXT_WORDS: [(&[u8], WordId); 8] = [
    (b"PARTNO", words::PARTNO),
    (b"PPRINT", words::PPRINT),
    (b"INSERT", words::INSERT),
    (b"LETTER", words::LETTER),
    (b"REMARK", words::REMARK),
    (b"TITLES", words::TITLES),
    (b"TPRINT", words::TPRINT),
    (b"TOOL PATH", words::TOOL_PATH),
];

/// An excerpt is cut after this many bytes.
const EXCERPT: usize = 400;

impl Statement {
    pub(super) fn new() -> Self {
        Statement { joined: Vec::new(), line: 0, pieces: Vec::new() }
    }

    /// Gathers the next statement; `None` at the end of the input.
    pub(super) fn gather<R: Read>(
        &mut self,
        lines: &mut Lines<R>,
    ) -> Result<Option<Form>, GatherError> {
        loop {
            self.joined.clear();
            self.pieces.clear();
            lines.begin();
            self.line = lines.line();
            let Some(line) = lines.next_line().map_err(GatherError::Line)? else {
                return Ok(None);
            };
            let bytes = lines.bytes(line.clone());
            let (form, start) = opening(bytes);
            let Some(piece) = content(bytes, start, form) else { continue };
            self.add(bytes, line, start, piece, self.line);
            while self.takes_next(form) {
                self.join_next(lines, form)?;
            }
            return Ok(Some(form));
        }
    }

    /// Removes a continuation sign from the end of the joined text.
    fn takes_next(&mut self, form: Form) -> bool {
        let is_comment = matches!(form, Form::Text(_)) && self.joined.ends_with(b"$$");
        let open = self.joined.ends_with(b"$") && !is_comment;
        if open {
            self.joined.pop();
        }
        open
    }

    /// Appends the next line that says something.
    fn join_next<R: Read>(&mut self, lines: &mut Lines<R>, form: Form) -> Result<(), GatherError> {
        loop {
            let number = lines.line();
            let open = GatherError::Open(self.joined.len());
            let line = lines.next_line().map_err(GatherError::Line)?.ok_or(open)?;
            let bytes = lines.bytes(line.clone());
            if bytes.starts_with(b"$$->") {
                return Err(GatherError::Open(self.joined.len()));
            }
            if let Some(piece) = content(bytes, 0, form) {
                self.add(bytes, line, 0, piece, number);
                return Ok(());
            }
        }
    }

    fn add(
        &mut self,
        bytes: &[u8],
        line: std::ops::Range<usize>,
        column: usize,
        end: usize,
        number: u32,
    ) {
        self.pieces.push(Piece { joined: self.joined.len(), line, column, number });
        self.joined.extend_from_slice(&bytes[column..end]);
    }

    /// The place of a range of the joined text, cut to the line it starts in.
    pub(super) fn place<R: Read>(
        &self,
        lines: &Lines<R>,
        file: &str,
        options: &Options,
        range: std::ops::Range<usize>,
    ) -> Place {
        let index = self.pieces.partition_point(|piece| piece.joined <= range.start);
        let Some(piece) = self.pieces.get(index.saturating_sub(1)) else {
            return Place::line(file, self.line, "");
        };
        let bytes = trim_end(lines.bytes(piece.line.clone()));
        let start = (piece.column + range.start - piece.joined).min(bytes.len());
        let end = (start + range.len()).min(bytes.len());
        excerpt(file, piece.number, bytes, start..end, options)
    }
}

/// A place in a line of bytes; a very long line is cut.
pub(super) fn excerpt(
    file: &str,
    number: u32,
    bytes: &[u8],
    span: std::ops::Range<usize>,
    options: &Options,
) -> Place {
    let cut = bytes.len().min(EXCERPT.max(span.end.min(span.start + EXCERPT)));
    let decode = |part: &[u8]| decoded(part, options.decode);
    let head = decode(&bytes[..span.start]);
    let marked = decode(&bytes[span.start..span.end.min(cut)]);
    let tail = decode(&bytes[span.end.min(cut)..cut]);
    let span = head.len()..head.len() + marked.len();
    let mut place = Place::line(file, number, head + &marked + &tail);
    place.span = span;
    place
}

/// UTF-8 where it is valid, else through the hook.
pub(super) fn decoded(bytes: &[u8], decode: fn(&[u8]) -> String) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_string(),
        Err(_) => decode(bytes),
    }
}

/// The form of a statement by its first line, and where its text starts there.
fn opening(line: &[u8]) -> (Form, usize) {
    if line.starts_with(b"$$->") {
        return (Form::Pseudo, 4);
    }
    let blanks = line.len() - line.trim_ascii_start().len();
    let rest = &line[blanks..];
    let first = rest.first().map(u8::to_ascii_uppercase);
    for (name, id) in TEXT_WORDS {
        if first != Some(name[0])
            || rest.len() < name.len()
            || !rest[..name.len()].eq_ignore_ascii_case(name)
        {
            continue;
        }
        if let Some(text) = text_start(rest, name.len()) {
            return (Form::Text(id), blanks + text);
        }
    }
    (Form::Plain, 0)
}

/// Where the free text starts after a text word of `length` bytes: past one
/// slash and past one blank, which belong to the layout. `None` when the word
/// goes on.
fn text_start(line: &[u8], length: usize) -> Option<usize> {
    let line = trim_end(line);
    let after = &line[length..];
    let blanks = after.iter().take_while(|byte| is_blank(**byte)).count();
    let at = match after.get(blanks) {
        Some(b'/') => length + blanks + 1,
        None => return Some(line.len()),
        Some(_) if blanks > 0 => length,
        Some(_) => return None,
    };
    Some(at + usize::from(line.get(at).is_some_and(|byte| is_blank(*byte))))
}

/// Where the text of a line ends that starts at `start`; `None` for a line
/// that says nothing. A text statement says something even without text.
fn content(line: &[u8], start: usize, form: Form) -> Option<usize> {
    if let Form::Text(_) = form {
        return Some(trim_end(line).len().max(start));
    }
    let mut signs = memchr::memchr_iter(b'$', &line[start..]).map(|at| start + at);
    let end = signs.find(|at| line.get(at + 1) == Some(&b'$')).unwrap_or(line.len());
    let text = trim_end(&line[start..end]);
    if text.is_empty() { None } else { Some(start + text.len()) }
}

pub(super) fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte == b'\t'
}

/// Without trailing blanks, carriage return and the end-of-file sign of DOS.
pub(super) fn trim_end(line: &[u8]) -> &[u8] {
    let end = line.iter().rposition(|byte| !matches!(byte, b' ' | b'\t' | b'\r' | 0x1A));
    &line[..end.map_or(0, |at| at + 1)]
}
