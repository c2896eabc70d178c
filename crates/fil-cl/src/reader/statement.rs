//! One statement: its physical lines joined, and the way back to them.

use std::ops::Range;

use fil_diag::{Diag, TextSpan};

use super::Options;
use super::frame_rows::FrameRows;
use super::lines::{LineError, Lines};
use crate::dialect::{DialectRules, Recognition};
use crate::errors::ClCode;
use crate::vocabulary::WordId;
use crate::words;

/// What kind of statement was gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `MAJOR / items`
    Plain,
    /// `$$-> KEY / items`; the joined text starts at the key.
    Pseudo,
    /// A frame that stands in comments; the joined text is the note made of it.
    Frame,
    /// A text statement; the joined text is the free text.
    Text(WordId),
    /// `NAME : text`, which stands for a statement of Creo (an NC alias of PTC's help); the name
    /// takes so many bytes.
    Alias(usize),
}

impl Form {
    /// What follows the word is one text, and no list of items.
    fn is_text(self) -> bool {
        matches!(self, Form::Text(_) | Form::Alias(_))
    }
}

/// Why no statement could be gathered.
pub(super) enum GatherError {
    Line(LineError),
    /// A continuation at the end of the file, an invalid line end.
    Refused(Box<Diag>),
}

impl From<LineError> for GatherError {
    fn from(error: LineError) -> Self {
        GatherError::Line(error)
    }
}

/// A piece of the joined text that comes from one physical line.
struct Piece {
    /// Where it starts in the joined text.
    joined: usize,
    /// The physical line, within the statement's bytes.
    line: Range<usize>,
    /// Where the piece starts in that line.
    column: usize,
    /// Number of the line.
    number: u32,
}

/// How the next line continues a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Join {
    /// Between two items.
    Between,
    /// Anywhere, within an item too.
    Within,
}

/// What an excerpt needs besides the line.
#[derive(Clone, Copy)]
struct Context<'a> {
    file: &'a str,
    options: &'a Options,
}

/// The statement under way. Its buffers are used again for the next one.
pub(super) struct Statement {
    /// The text without continuation signs, comments and line ends.
    pub(super) joined: Vec<u8>,
    /// Line where the statement starts.
    pub(super) line: u32,
    pieces: Vec<Piece>,
    frame_rows: FrameRows,
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
        Statement {
            joined: Vec::new(),
            line: 0,
            pieces: Vec::new(),
            frame_rows: FrameRows::default(),
        }
    }

    /// Gathers the next statement; `None` at the end of the input. Comments are shown to
    /// the recognition of the dialect.
    pub(super) fn gather(
        &mut self,
        lines: &mut Lines<'_>,
        recognition: &mut Recognition,
        file: &str,
        options: &Options,
    ) -> Result<Option<Form>, GatherError> {
        let context = Context { file, options };
        loop {
            self.joined.clear();
            self.pieces.clear();
            lines.begin();
            self.line = lines.line();
            let Some(line) = next_line(lines, context)? else { return Ok(None) };
            let bytes = lines.bytes(line.clone());
            if is_comment(bytes) {
                let range = line.clone();
                self.comment(lines, line, recognition, context)?;
                let in_comments = recognition.rules().frame_in_comments;
                let comment = trim_end(lines.bytes(range.clone()));
                let note = in_comments.then(|| self.frame_rows.take(comment, self.line)).flatten();
                match note {
                    Some(note) => return Ok(Some(self.frame(&note, range))),
                    None => continue,
                }
            }
            if let Some(note) = self.frame_rows.end(self.line) {
                // The statement comes again, behind the note.
                lines.go_back(self.line);
                return Ok(Some(self.frame(&note, 0..0)));
            }
            let (form, start) = opening(bytes);
            let Some(end) = content(bytes, start, form) else { continue };
            self.add(bytes, line, start, end, self.line);
            while let Some(join) = self.continuation(lines, form, recognition.rules()) {
                self.join_next(lines, form, join, context)?;
            }
            return Ok(Some(form));
        }
    }

    /// Makes the statement a note of a frame, which stands in a line.
    fn frame(&mut self, note: &str, line: Range<usize>) -> Form {
        self.pieces.push(Piece { joined: 0, line, column: 0, number: self.line });
        self.joined.extend_from_slice(note.as_bytes());
        Form::Frame
    }

    /// Looks at a comment and passes over the lines it goes on in.
    fn comment(
        &mut self,
        lines: &mut Lines<'_>,
        mut line: Range<usize>,
        recognition: &mut Recognition,
        context: Context<'_>,
    ) -> Result<(), GatherError> {
        let mut number = self.line;
        loop {
            let bytes = trim_end(lines.bytes(line.clone()));
            let place = || excerpt(context.file, number, bytes, 0..bytes.len(), context.options);
            if is_comment(bytes) {
                recognition.comment(bytes.trim_ascii_start(), place);
            } else if is_statement(bytes) {
                let message = "a comment continues here, and the line reads as a statement";
                return refuse(ClCode::OpenContinuation, message.to_string(), place());
            }
            if !breaks_at(bytes, recognition.rules()) {
                return Ok(());
            }
            number = lines.line();
            match next_line(lines, context)? {
                Some(next) => line = next,
                None => return Ok(()),
            }
        }
    }

    /// Whether the statement goes on in the next line, and how; the sign is taken away.
    fn continuation(
        &mut self,
        lines: &Lines<'_>,
        form: Form,
        rules: &DialectRules,
    ) -> Option<Join> {
        let before = self.joined.strip_suffix(b"$")?;
        let last = self.pieces.last()?;
        let join = if breaks_at(trim_end(lines.bytes(last.line.clone())), rules) {
            Join::Within
        } else {
            let goes_on = match form {
                Form::Plain | Form::Frame => true,
                // Creo continues a list of values; a name may end in the sign.
                Form::Pseudo => before.trim_ascii_end().ends_with(b","),
                Form::Text(_) | Form::Alias(_) => false,
            };
            goes_on.then_some(Join::Between)?
        };
        self.joined.pop();
        Some(join)
    }

    /// Appends the next line that says something.
    fn join_next(
        &mut self,
        lines: &mut Lines<'_>,
        form: Form,
        join: Join,
        context: Context<'_>,
    ) -> Result<(), GatherError> {
        let is_text = form.is_text();
        loop {
            let number = lines.line();
            let Some(line) = next_line(lines, context)? else {
                return self.open(lines, "nothing follows the $", context);
            };
            let bytes = lines.bytes(line.clone());
            if is_pseudo(bytes) || is_text && is_statement(bytes) {
                return self.open(lines, "the line after the $ is a statement of its own", context);
            }
            if let Some(end) = content(bytes, 0, form) {
                if join == Join::Between {
                    // Two items never become one where a comma is missing.
                    self.joined.push(b' ');
                }
                self.add(bytes, line, 0, end, number);
                return Ok(());
            }
        }
    }

    /// Refuses a `$` that nothing follows.
    fn open(
        &self,
        lines: &Lines<'_>,
        message: &str,
        context: Context<'_>,
    ) -> Result<(), GatherError> {
        let at = self.joined.len();
        let place = self.place(lines, context.file, context.options, at..at + 1);
        refuse(ClCode::OpenContinuation, message.to_string(), place)
    }

    /// True when the text follows a slash at once that has a blank before it: the slash is
    /// either the one of the statement or the first character of the text.
    pub(super) fn has_skip_mark(&self, lines: &Lines<'_>) -> bool {
        let Some(piece) = self.pieces.first() else { return false };
        let before = &lines.bytes(piece.line.clone())[..piece.column];
        let text = self.joined.first().is_some_and(|byte| *byte != b'/');
        text && matches!(before, [.., b' ' | b'\t', b'/'])
    }

    fn add(&mut self, bytes: &[u8], line: Range<usize>, column: usize, end: usize, number: u32) {
        self.pieces.push(Piece { joined: self.joined.len(), line, column, number });
        self.joined.extend_from_slice(&bytes[column..end]);
    }

    /// The place of a range of the joined text, cut to the line it starts in.
    pub(super) fn place(
        &self,
        lines: &Lines<'_>,
        file: &str,
        options: &Options,
        range: Range<usize>,
    ) -> TextSpan {
        let index = self.pieces.partition_point(|piece| piece.joined <= range.start);
        let Some(piece) = self.pieces.get(index.saturating_sub(1)) else {
            return TextSpan::line(file, self.line, "");
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
    span: Range<usize>,
    options: &Options,
) -> TextSpan {
    let cut = bytes.len().min(EXCERPT.max(span.end.min(span.start + EXCERPT)));
    let decode = |part: &[u8]| decoded(part, options.decode);
    let head = decode(&bytes[..span.start]);
    let marked = decode(&bytes[span.start..span.end.min(cut)]);
    let tail = decode(&bytes[span.end.min(cut)..cut]);
    let span = head.len()..head.len() + marked.len();
    let mut place = TextSpan::line(file, number, head + &marked + &tail);
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

/// The next line; one with a carriage return inside is refused, because in a file of such
/// line ends a comment would take all that follows with it.
fn next_line(
    lines: &mut Lines<'_>,
    context: Context<'_>,
) -> Result<Option<Range<usize>>, GatherError> {
    let number = lines.line();
    let Some(line) = lines.next_line()? else { return Ok(None) };
    let bytes = trim_end(lines.bytes(line.clone()));
    if let Some(at) = memchr::memchr(b'\r', bytes) {
        let place = excerpt(context.file, number, bytes, at..at + 1, context.options);
        return refuse(ClCode::BinaryData, super::control(b'\r'), place);
    }
    Ok(Some(line))
}

fn refuse<T>(code: ClCode, message: String, place: TextSpan) -> Result<T, GatherError> {
    Err(GatherError::Refused(Box::new(Diag::new(code, message).at(place))))
}

fn is_pseudo(line: &[u8]) -> bool {
    note_start(line.trim_ascii_start()).is_some()
}

/// Where the key of a note begins: behind `$$->`, which some write with blanks before the arrow,
/// and behind `REMARK ->`, as Creo writes for its post.
fn note_start(line: &[u8]) -> Option<usize> {
    const REMARK: &[u8] = b"REMARK";
    let rest = match line.strip_prefix(b"$$") {
        Some(rest) => rest,
        None => {
            let (word, rest) = line.split_at_checked(REMARK.len())?;
            rest.first().filter(|byte| word.eq_ignore_ascii_case(REMARK) && is_blank(**byte))?;
            rest
        }
    };
    let arrow = rest.trim_ascii_start();
    arrow.starts_with(b"->").then(|| line.len() - arrow.len() + 2)
}

fn is_comment(line: &[u8]) -> bool {
    line.trim_ascii_start().starts_with(b"$$") && !is_pseudo(line)
}

/// True when a line ends in the `$` by which the dialect breaks any line. Bytes that are
/// no UTF-8 are one character each.
fn breaks_at(line: &[u8], rules: &DialectRules) -> bool {
    let Some(column) = rules.break_column else { return false };
    let length = || std::str::from_utf8(line).map_or(line.len(), |text| text.chars().count());
    line.ends_with(b"$") && length() == column
}

/// True when a line reads as a statement of its own: it is a comment, or a known major
/// word stands alone or before a slash.
fn is_statement(line: &[u8]) -> bool {
    let line = trim_end(line).trim_ascii_start();
    let end = memchr::memchr(b'/', line).unwrap_or(line.len());
    line.starts_with(b"$$") || words::is_major_name(line[..end].trim_ascii_end())
}

/// The form of a statement by its first line, and where its text starts there.
fn opening(line: &[u8]) -> (Form, usize) {
    let blanks = line.len() - line.trim_ascii_start().len();
    let rest = &line[blanks..];
    if let Some(key) = note_start(rest) {
        return (Form::Pseudo, blanks + key);
    }
    let first = rest.first().map(u8::to_ascii_uppercase);
    for (name, id) in TEXT_WORDS {
        if first == Some(name[0])
            && let Some(length) = begins_with(rest, name)
            && let Some(text) = text_start(rest, length)
        {
            return (Form::Text(id), blanks + text);
        }
    }
    match alias(rest) {
        Some(name) => (Form::Alias(name), blanks),
        None => (Form::Plain, 0),
    }
}

/// Length of the name before the colon of an NC alias.
fn alias(line: &[u8]) -> Option<usize> {
    let name = line[..memchr::memchr(b':', line)?].trim_ascii_end();
    let is_of_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let is_name = name.first().is_some_and(u8::is_ascii_alphabetic)
        && name.iter().all(is_of_name)
        && !words::is_major_name(name);
    is_name.then_some(name.len())
}

/// Length of the text word at the start of a line, in any case; where the name has a blank
/// there may be several.
fn begins_with(line: &[u8], name: &[u8]) -> Option<usize> {
    let mut at = 0;
    for letter in name {
        if *letter == b' ' {
            let blanks = line[at..].iter().take_while(|byte| is_blank(**byte)).count();
            at += (blanks > 0).then_some(blanks)?;
        } else {
            at += usize::from(line.get(at)?.eq_ignore_ascii_case(letter).then_some(true)?);
        }
    }
    Some(at)
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
    if form.is_text() {
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

/// Without trailing blanks and carriage returns.
pub(super) fn trim_end(line: &[u8]) -> &[u8] {
    let end = line.iter().rposition(|byte| !matches!(byte, b' ' | b'\t' | b'\r'));
    &line[..end.map_or(0, |at| at + 1)]
}
