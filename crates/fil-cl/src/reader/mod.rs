//! The streaming reader: CL text to records.
//!
//! One statement makes one record; a GOTO with several points makes one for
//! each point. Memory does not depend on the length of the input: a chunk
//! buffer, one statement, and a checkpoint for every some thousand records.

mod dialect;
mod items;
mod lines;
mod number;
mod repeated;
mod seek;
mod statement;

use std::io::Read;

use fil_diag::{Diag, Place};

use crate::errors::ClCode;
use crate::record::{Record, Word, kind};
use crate::vocabulary::Vocabulary;
use crate::words;

pub use dialect::Dialect;
pub(crate) use items::reads_as_text;
use lines::{LineError, Lines};
use repeated::Repeated;
use seek::Seeking;
use statement::{Form, GatherError, Statement};

/// How a CL text is to be read.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The family; `None`: told from the first lines.
    pub dialect: Option<Dialect>,
    /// Turns bytes that are not UTF-8 into text.
    pub decode: fn(&[u8]) -> String,
    /// Longest statement in bytes, continuation lines included.
    pub statement_limit: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options { dialect: None, decode: latin1, statement_limit: 1 << 20 }
    }
}

/// Each byte as the character of the same number (ISO 8859-1): nothing is lost.
pub fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| char::from(*byte)).collect()
}

/// Bytes looked at to tell the family.
const HEAD: usize = 16 * 1024;

/// How far the length of a tool axis may be from 1 where six values of a GOTO
/// could as well be two points: CL files round to six decimals.
const AXIS_TOLERANCE: f64 = 1e-4;

/// What a statement leaves for the later ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Modal {
    multax: bool,
    axis: Option<[f64; 3]>,
}

/// The points of a GOTO not yet handed out.
#[derive(Default)]
struct Pending {
    values: Vec<f64>,
    next: usize,
    /// Values of one point: 3 or 6.
    group: usize,
    line: u32,
}

/// Reads the records of a CL text one after the other.
pub struct Reader<R> {
    lines: Lines<R>,
    statement: Statement,
    repeated: Repeated,
    /// Start and end of each item in the statement, to point at it.
    item_ranges: Vec<std::ops::Range<usize>>,
    pending: Pending,
    modal: Modal,
    file: String,
    options: Options,
    /// Known after the first bytes are read.
    dialect: Option<Dialect>,
    /// Number of the last record read.
    number: u32,
    seeking: Seeking<R>,
    /// The reader does not go on after an error.
    failed: Option<Box<Diag>>,
}

impl<R: Read> Reader<R> {
    /// A reader of a stream, which cannot go back. `file_name` is what messages show.
    pub fn new(input: R, file_name: &str, options: Options) -> Self {
        Reader {
            lines: Lines::new(input, options.statement_limit),
            statement: Statement::new(),
            repeated: Repeated::default(),
            item_ranges: Vec::new(),
            pending: Pending::default(),
            modal: Modal::default(),
            file: file_name.to_string(),
            options,
            dialect: options.dialect,
            number: 0,
            seeking: Seeking::none(),
            failed: None,
        }
    }

    /// Reads the next record into `record`, whose buffers are used again; false
    /// at the end of the input.
    ///
    /// # Errors
    /// What is wrong with the statement, with its place. After an error every
    /// further call gives the same error.
    pub fn read(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool, Box<Diag>> {
        if let Some(diag) = &self.failed {
            return Err(diag.clone());
        }
        let result = self.read_wanted(vocab, record);
        if let Err(diag) = &result {
            self.failed = Some(diag.clone());
        }
        result
    }

    /// Number of the last record read; 0 before the first.
    pub fn record_number(&self) -> u32 {
        self.number
    }

    /// The family of the text; `None` before the first record is read, unless
    /// the options name it.
    pub fn dialect(&self) -> Option<Dialect> {
        self.dialect
    }

    /// Reads on to the record [`Reader::seek_record`] asked for.
    fn read_wanted(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<bool, Box<Diag>> {
        while self.read_next(vocab, record)? {
            if record.number >= self.seeking.wanted {
                self.seeking.wanted = 0;
                return Ok(true);
            }
        }
        if self.seeking.wanted > self.number {
            let message = format!("record {} of {} records", self.seeking.wanted, self.number);
            let place = Place::line(&self.file, self.lines.line(), "");
            return Err(Box::new(Diag::new(ClCode::NoSuchRecord, message).at(place)));
        }
        Ok(false)
    }

    fn read_next(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<bool, Box<Diag>> {
        if self.pending.next < self.pending.values.len() {
            self.next_pending(record);
            return Ok(true);
        }
        let dialect = match self.dialect {
            Some(dialect) => dialect,
            None => self.detect()?,
        };
        if self.seeking.is_due(self.number) {
            self.seeking.keep(self.number, self.lines.offset(), self.lines.line(), self.modal);
        }
        if self.read_plain_goto(dialect, record) || self.read_repeated(record) {
            return Ok(true);
        }
        let Some(form) = self.gather()? else { return Ok(false) };
        record.text.clear();
        record.data.clear();
        record.line = self.statement.line;
        match form {
            Form::Text(major) => self.take_text(record, major)?,
            Form::Pseudo => {
                self.parse_items(vocab, record, true)?;
                record.kind = kind::PSEUDO;
                record.sub = 0;
            }
            Form::Plain => {
                self.parse_items(vocab, record, false)?;
                self.finish(dialect, record)?;
            }
        }
        let lines = self.lines.line().saturating_sub(self.statement.line);
        self.repeated.keep(self.lines.taken(), lines, record);
        self.count(record);
        Ok(true)
    }

    fn count(&mut self, record: &mut Record) {
        self.number = self.number.saturating_add(1);
        record.number = self.number;
    }

    fn detect(&mut self) -> Result<Dialect, Box<Diag>> {
        match self.lines.peek(HEAD) {
            Ok(head) => Ok(*self.dialect.insert(Dialect::detect(head))),
            Err(error) => Err(self.read_failed(&error)),
        }
    }

    /// The short way for the most frequent statement: `GOTO / x, y, z[, i, j, k]`
    /// in one line, with numbers in fixed point. Anything else is left to the
    /// long way, which gives the same record.
    #[inline]
    fn read_plain_goto(&mut self, dialect: Dialect, record: &mut Record) -> bool {
        let mut values = [0.0; 6];
        let Some((count, length)) = items::plain_goto(self.lines.unread(), &mut values) else {
            return false;
        };
        let [x, y, z, i, j, k] = values;
        let axis = [i, j, k];
        if count == 6 && !self.is_axis(dialect, axis) {
            return false;
        }
        record.line = self.take_lines(length, 1);
        let axis = if count == 6 { Some(axis) } else { None };
        self.give_point(dialect, record, [x, y, z], axis);
        true
    }

    /// Takes a whole statement; gives the number of its first line.
    #[inline]
    fn take_lines(&mut self, length: usize, lines: u32) -> u32 {
        self.statement.line = self.lines.line();
        self.lines.take_lines(length, lines);
        self.statement.line
    }

    /// The short way for a statement that was read before.
    #[inline]
    fn read_repeated(&mut self, record: &mut Record) -> bool {
        let Some((length, lines)) = self.repeated.read(self.lines.unread(), record) else {
            return false;
        };
        record.line = self.take_lines(length, lines);
        self.count(record);
        true
    }

    /// True when the last three of six values are a tool axis, not a second point.
    fn is_axis(&self, dialect: Dialect, axis: [f64; 3]) -> bool {
        let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        self.modal.multax || dialect.writes_axes() || (length - 1.0).abs() < AXIS_TOLERANCE
    }

    /// Makes `record` a GOTO; a tool axis left out is the last one where the
    /// family means that.
    #[inline]
    fn give_point(
        &mut self,
        dialect: Dialect,
        record: &mut Record,
        point: [f64; 3],
        axis: Option<[f64; 3]>,
    ) {
        if axis.is_some() {
            self.modal.axis = axis;
        }
        let kept = if dialect.keeps_axis(self.modal.multax) { self.modal.axis } else { None };
        record.fill_goto(&point, axis.or(kept).as_ref());
        self.count(record);
    }

    fn next_pending(&mut self, record: &mut Record) {
        let Pending { values, next, group, line } = &mut self.pending;
        let mut point = [0.0; 6];
        point[..*group].copy_from_slice(&values[*next..*next + *group]);
        *next += *group;
        record.line = *line;
        let [x, y, z, i, j, k] = point;
        let axis = if *group == 6 { Some([i, j, k]) } else { None };
        let dialect = self.dialect.unwrap_or(Dialect::Creo);
        self.give_point(dialect, record, [x, y, z], axis);
    }

    fn gather(&mut self) -> Result<Option<Form>, Box<Diag>> {
        match self.statement.gather(&mut self.lines) {
            Ok(form) => Ok(form),
            Err(GatherError::Open(at)) => {
                Err(self.diag(ClCode::OpenContinuation, "nothing follows the $", at..at + 1))
            }
            Err(GatherError::Line(LineError::Io(error))) => Err(self.read_failed(&error)),
            Err(GatherError::Line(LineError::TooLong)) => Err(self.too_long()),
        }
    }

    fn take_text(&mut self, record: &mut Record, major: crate::WordId) -> Result<(), Box<Diag>> {
        self.check_bytes()?;
        match std::str::from_utf8(&self.statement.joined) {
            Ok(text) => record.text.push_str(text),
            Err(_) => record.text.push_str(&(self.options.decode)(&self.statement.joined)),
        }
        record.data.push(Word::Text { start: 0, len: record.text.len() as u32 });
        (record.major, record.kind, record.sub) = (major, kind::POST, 0);
        Ok(())
    }

    /// From items to words, with what the family means by them.
    fn finish(&mut self, dialect: Dialect, record: &mut Record) -> Result<(), Box<Diag>> {
        if record.major == words::CIRCLE && dialect.turns_circles() {
            for word in record.data.iter_mut().skip(3).take(3) {
                if let Word::Number(part) = word {
                    *part = 0.0 - *part;
                }
            }
        }
        if record.major == words::GOTO {
            self.split_points(dialect, record);
        }
        if let Err(error) = record.arrange() {
            let whole = 0..self.statement.joined.len();
            let range = self.item_ranges.get(error.item).or(self.item_ranges.last());
            let range = range.cloned().unwrap_or(whole);
            return Err(self.diag(error.code, &error.message, range));
        }
        match record.major {
            words::MULTAX => self.modal.multax = !record.has(words::OFF),
            words::GOTO | words::FROM => self.keep_axis(dialect, record),
            _ => {}
        }
        Ok(())
    }

    /// Takes all points but the first out of a GOTO with several.
    fn split_points(&mut self, dialect: Dialect, record: &mut Record) {
        self.pending.values.clear();
        self.pending.next = 0;
        for word in &record.data {
            let Word::Number(value) = word else {
                self.pending.values.clear();
                return;
            };
            self.pending.values.push(*value);
        }
        let values = &self.pending.values;
        let group = match values.len() {
            3 => 3,
            6 if self.is_axis(dialect, [values[3], values[4], values[5]]) => 6,
            _ if self.modal.multax => 6,
            _ => 3,
        };
        if values.is_empty() || !values.len().is_multiple_of(group) {
            self.pending.values.clear();
            return;
        }
        record.data.truncate(group);
        self.pending.next = group;
        self.pending.group = group;
        self.pending.line = record.line;
    }

    fn keep_axis(&mut self, dialect: Dialect, record: &mut Record) {
        match (record.axis(), self.modal.axis) {
            (Some(axis), _) => self.modal.axis = Some(axis),
            (None, Some(axis)) if dialect.keeps_axis(self.modal.multax) => {
                record.data.extend_from_slice(&axis.map(Word::Number));
            }
            (None, _) => {}
        }
    }

    /// Refuses control characters in the statement.
    fn check_bytes(&self) -> Result<(), Box<Diag>> {
        let bytes = &self.statement.joined;
        // Looking at all bytes is faster than stopping at the first.
        if !bytes.iter().fold(false, |found, byte| found | is_control(*byte)) {
            return Ok(());
        }
        let at = bytes.iter().position(|byte| is_control(*byte)).unwrap_or(0);
        let message = format!("byte {:#04x} in the line", bytes[at]);
        Err(self.diag(ClCode::BinaryData, &message, at..at + 1))
    }

    /// A diagnostic at a range of the joined statement.
    fn diag(&self, code: ClCode, message: &str, range: std::ops::Range<usize>) -> Box<Diag> {
        let place = self.statement.place(&self.lines, &self.file, &self.options, range);
        Box::new(Diag::new(code, message).at(place))
    }

    fn read_failed(&self, error: &std::io::Error) -> Box<Diag> {
        let place = Place::line(&self.file, self.lines.line(), "");
        Box::new(Diag::new(ClCode::ReadFailed, error.to_string()).at(place))
    }

    fn too_long(&self) -> Box<Diag> {
        let bytes = self.lines.statement();
        let (code, at, message) = match bytes.iter().position(|byte| is_control(*byte)) {
            Some(at) if bytes[at] != b'\n' && bytes[at] != b'\r' => {
                (ClCode::BinaryData, at, format!("byte {:#04x} in the line", bytes[at]))
            }
            _ => {
                let limit = self.options.statement_limit;
                (ClCode::StatementTooLong, 0, format!("more than {limit} bytes"))
            }
        };
        let line =
            statement::excerpt(&self.file, self.statement.line, bytes, at..at + 1, &self.options);
        Box::new(Diag::new(code, message).at(line))
    }
}

/// True for a byte no CL text has; tabs are blanks.
fn is_control(byte: u8) -> bool {
    (byte < b' ' && byte != b'\t') || byte == 0x7F
}
