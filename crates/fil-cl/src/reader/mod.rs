//! The streaming reader: CL text to records.
//!
//! One statement makes one record; a GOTO with several points makes one for
//! each point. Memory does not depend on the length of the input: a chunk
//! buffer, one statement, and a checkpoint for every some thousand records.

mod ahead;
mod arc;
mod arc_points;
mod complete;
mod finish;
mod form;
mod frame_rows;
mod items;
mod known;
mod lines;
mod names;
mod number;
mod plain;
mod points;
mod raw;
mod repeated;
mod resume;
mod seek;
mod spline;
mod statement;
mod subroutine;
mod told_sweep;
mod told_unit;

use std::io::Read;
use std::ops::Range;

use fil_diag::{Diag, Result, TextSpan};

use crate::dialect::{ClDialect, DialectRules, Recognition, Recognized};
use crate::errors::ClCode;
use crate::forms::{FormState, Outcome};
use crate::record::{Record, Word, kind};
use crate::vocabulary::Vocabulary;
use crate::words;

pub(crate) use arc_points::ArcPoints;
pub(crate) use items::reads_as_text;
use known::{KnownAxis, KnownNumbers};
use lines::{Input, LineError, Lines};
pub(crate) use number::{fixed_point as leading_number, number as plain_number};
use points::Pending;
pub use raw::Meaning;
use repeated::Repeated;
use seek::Seeking;
use spline::Gathered;
pub use spline::SplineCounts;
use statement::{Form, GatherError, Statement};
use subroutine::Subroutines;
pub(crate) use told_sweep::ToldSweep;

/// How a CL text is to be read.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The dialect; `None`: as the signs in the text say, see [`Reader::recognized`].
    pub dialect: Option<ClDialect>,
    /// Turns bytes that are not UTF-8 into text.
    pub decode: fn(&[u8]) -> String,
    /// Longest statement in bytes, continuation lines included.
    pub statement_limit: usize,
    /// True to give statements as they are written, and not in the form of Creo; what they
    /// mean is then told by [`Reader::meaning`]. Arcs by geometry are given as CIRCLE.
    pub raw: bool,
    /// True to give the records of a subroutine of Creo's where CALSUB calls it; false to give
    /// DEFSUB, ENDSUB and CALSUB as they are written.
    pub expand_subroutines: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            dialect: None,
            decode: latin1,
            statement_limit: 1 << 20,
            raw: false,
            expand_subroutines: true,
        }
    }
}

/// Each byte as the character of the same number (ISO 8859-1): nothing is lost.
pub fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| char::from(*byte)).collect()
}

/// What a statement leaves for the later ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Modal {
    multax: bool,
    axis: Option<[f64; 3]>,
    /// Where the tool stands, for motions given by geometry.
    point: Option<[f64; 3]>,
    /// A CIRCLE waits for its end.
    in_arc: bool,
    /// What the forms of the dialect keep.
    forms: FormState,
}

/// Reads the records of a CL text one after the other.
pub struct Reader<'r> {
    lines: Lines<'r>,
    statement: Statement,
    repeated: Repeated,
    known_numbers: KnownNumbers,
    known_axis: KnownAxis,
    /// Start and end of each item in the statement, to point at it.
    item_ranges: Vec<Range<usize>>,
    pending: Pending,
    /// The spline under way.
    spline: Gathered,
    spline_counts: SplineCounts,
    /// Splines before this record are counted.
    splines_counted: u32,
    /// Records that the last statement made besides its own, the last one first.
    made: Vec<Record>,
    subroutines: Subroutines,
    modal: Modal,
    file: String,
    options: Options,
    recognition: Recognition,
    /// Number of the last record read.
    number: u32,
    seeking: Seeking,
    /// The reader does not go on by itself after an error.
    failed: Option<Box<Diag>>,
    started: bool,
    /// The next record comes from the next line: none waits, none is looked for, nothing was
    /// refused. One question in place of five for each GOTO.
    at_line: bool,
    /// It only looks for signs ahead of another reader.
    is_scout: bool,
    /// What the record of this number means, where it is given as it is written.
    meaning: Option<(u32, Meaning)>,
    /// Major word of the statement read last, where it was understood.
    major: Option<crate::WordId>,
    /// The last error says that something did not come before the statement.
    leans: bool,
}

impl<'r> Reader<'r> {
    /// A reader of a stream, which cannot go back. `file_name` is what messages show.
    pub fn new(input: impl Read + Send + 'r, file_name: &str, options: Options) -> Self {
        Reader::of(Input::Stream(Box::new(input)), file_name, options)
    }

    fn of(input: Input<'r>, file_name: &str, options: Options) -> Self {
        Reader {
            seeking: Seeking::new(matches!(input, Input::File(_))),
            lines: Lines::new(input, options.statement_limit),
            statement: Statement::new(),
            repeated: Repeated::default(),
            known_numbers: KnownNumbers::default(),
            known_axis: KnownAxis::default(),
            item_ranges: Vec::new(),
            pending: Pending::default(),
            spline: Gathered::default(),
            spline_counts: SplineCounts::default(),
            splines_counted: 0,
            made: Vec::new(),
            subroutines: Subroutines::default(),
            modal: Modal::default(),
            file: file_name.to_string(),
            options,
            recognition: Recognition::new(options.dialect),
            number: 0,
            failed: None,
            started: false,
            at_line: false,
            is_scout: false,
            meaning: None,
            major: None,
            leans: false,
        }
    }

    /// Reads the next record into `record`, whose buffers are used again; false
    /// at the end of the input.
    ///
    /// # Errors
    /// What is wrong with the statement, with its span. After an error every
    /// further call gives the same error, unless [`Reader::resume`] comes between.
    #[inline]
    pub fn read(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        if self.at_line
            && !self.seeking.is_due(self.number)
            && (self.read_plain_goto(record) || self.read_repeated(record))
        {
            return Ok(true);
        }
        self.read_any(vocab, record)
    }

    /// Reads a record of any kind.
    fn read_any(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        if let Some(diag) = &self.failed {
            return Err(diag.clone());
        }
        let result = self.read_expected(vocab, record);
        if let Err(diag) = &result {
            self.failed = Some(diag.clone());
        }
        self.at_line = result.is_ok()
            && self.started
            && self.pending.is_empty()
            && self.made.is_empty()
            && self.seeking.target == 0;
        result
    }

    /// Number of the last record read; 0 before the first.
    pub fn record_number(&self) -> u32 {
        self.number
    }

    /// The dialect by which the text is read, and why. It is settled at the end of the text;
    /// before that a sign may still come, as long as nothing was read that its dialect reads
    /// otherwise.
    pub fn recognized(&self) -> Recognized {
        self.recognition.found()
    }

    /// Reads on to the record [`Reader::seek_record`] asked for.
    fn read_expected(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        while self.read_next(vocab, record)? {
            if record.number >= self.seeking.target {
                self.seeking.target = 0;
                return Ok(true);
            }
        }
        if self.seeking.target > self.number {
            let message = format!("record {} of {} records", self.seeking.target, self.number);
            let place = TextSpan::line(&self.file, self.lines.line(), "");
            return Err(Box::new(Diag::new(ClCode::NoSuchRecord, message).at(place)));
        }
        Ok(false)
    }

    /// Reads the next record of the path; those between DEFSUB and ENDSUB are kept for CALSUB.
    fn read_next(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        while self.read_one(vocab, record)? {
            if !self.subroutines.is_under_way() {
                return Ok(true);
            }
            self.keep_for_subroutine(record)?;
        }
        self.check_subroutines_end().map(|()| false)
    }

    /// Looks at the beginning of the text, before its first record.
    fn begin(&mut self) -> Result<()> {
        if !self.started {
            self.lines.skip_mark().map_err(|error| self.read_failed(&error))?;
            self.recognize_ahead();
            self.refuse_other_files()?;
            self.started = true;
            let is_metric = !self.is_scout && self.told_unit() == Some(words::MM);
            self.modal.forms.is_metric |= is_metric;
        }
        Ok(())
    }

    fn read_one(&mut self, vocab: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        if !self.pending.is_empty() {
            self.next_pending(record);
            return Ok(true);
        }
        if let Some(made) = self.made.pop() {
            *record = made;
            self.count(record);
            return Ok(true);
        }
        self.begin()?;
        // A spline or a subroutine under way is no part of what a checkpoint keeps.
        let is_whole = !self.spline.is_under_way() && !self.subroutines.is_under_way();
        if self.seeking.is_due(self.number) && is_whole {
            self.seeking.keep(self.number, self.lines.offset(), self.lines.line(), self.modal);
        }
        loop {
            if self.read_plain_goto(record) || self.read_repeated(record) {
                return Ok(true);
            }
            if self.take_plain_direction() {
                continue;
            }
            match self.read_statement(vocab, record)? {
                None => return Ok(false),
                // Records that a call has made come before the next statement.
                Some(Outcome::Nothing) if !self.made.is_empty() => {
                    return self.read_one(vocab, record);
                }
                Some(Outcome::Nothing) => {}
                Some(_) => return Ok(true),
            }
        }
    }

    /// Reads a statement; `None` at the end of the input.
    fn read_statement(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<Option<Outcome>> {
        (self.major, self.leans) = (None, false);
        let Some(form) = self.gather()? else {
            self.refuse_expected()?;
            return Ok(None);
        };
        record.text.clear();
        record.data.clear();
        record.inert = false;
        record.line = self.statement.line;
        let mut outcome = Outcome::Free;
        match form {
            Form::Text(major) => self.take_text(record, major, 0)?,
            Form::Alias(length) => self.take_alias(vocab, record, length)?,
            Form::Pseudo | Form::Frame => {
                self.parse_items(vocab, record, true)?;
                if form == Form::Pseudo {
                    self.watch(|recognition, place| recognition.pseudo(place))?;
                }
                record.kind = kind::PSEUDO;
                record.sub = 0;
            }
            Form::Plain if self.names_geometry() => outcome = self.take_geometry(vocab, record)?,
            Form::Plain => {
                self.parse_items(vocab, record, false)?;
                let major = record.major;
                self.watch(|recognition, place| recognition.statement(major, vocab, place))?;
                self.check_complete(vocab, record)?;
                outcome = if self.keeps_meaning() {
                    self.give_as_written(vocab, record)?
                } else {
                    self.bring_to_form(vocab, record)?
                };
            }
        }
        if form == Form::Frame || matches!(record.major, words::MSYS | words::CSYS) {
            // What begins where the tool stands may not begin in another frame.
            self.modal.point = None;
        }
        self.check_end(vocab, record)?;
        if self.rules().trailing_comma && !self.options.raw {
            raw::drop_empty_end(record);
        }
        if self.recognition.take_changed() {
            self.repeated = Repeated::default();
        }
        if outcome == Outcome::Nothing {
            return Ok(Some(outcome));
        }
        if outcome == Outcome::Free && !self.keeps_meaning() {
            let lines = self.lines.line().saturating_sub(self.statement.line);
            self.repeated.keep(self.lines.taken(), lines, record);
        }
        self.count(record);
        Ok(Some(outcome))
    }

    fn count(&mut self, record: &mut Record) {
        self.number = self.number.saturating_add(1);
        record.number = self.number;
    }

    fn rules(&self) -> &'static DialectRules {
        self.recognition.rules()
    }

    /// Shows the statement to the recognition of the dialect.
    fn watch(&mut self, look: impl FnOnce(&mut Recognition, &dyn Fn() -> TextSpan)) -> Result<()> {
        let whole = 0..self.statement.joined.len();
        let (statement, lines) = (&self.statement, &self.lines);
        let place = || statement.place(lines, &self.file, &self.options, whole.clone());
        look(&mut self.recognition, &place);
        self.recognition.refusal().map_or(Ok(()), Err)
    }

    /// Takes a whole statement; gives the number of its first line.
    #[inline]
    fn take_lines(&mut self, length: usize, lines: u32) -> u32 {
        self.statement.line = self.lines.line();
        self.lines.take_lines(length, lines);
        self.statement.line
    }

    fn gather(&mut self) -> Result<Option<Form>> {
        let recognition = &mut self.recognition;
        let gathered =
            self.statement.gather(&mut self.lines, recognition, &self.file, &self.options);
        if let Some(refused) = self.recognition.refusal() {
            return Err(refused);
        }
        match gathered {
            Ok(form) => Ok(form),
            Err(GatherError::Refused(diag)) => Err(diag),
            Err(GatherError::Line(LineError::Io(error))) => Err(self.read_failed(&error)),
            Err(GatherError::Line(LineError::TooLong)) => Err(self.too_long()),
        }
    }

    /// Makes the record of an NC alias, whose name has so many bytes.
    #[cold]
    fn take_alias(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
        length: usize,
    ) -> Result<()> {
        let (name, rest) = self.statement.joined.split_at(length);
        let major = vocab.intern_bytes(name);
        let blanks = rest.len() - rest.trim_ascii_start().len();
        let text = rest[blanks + 1..].trim_ascii_start().len();
        self.take_text(record, major, self.statement.joined.len() - text)
    }

    /// Makes the record of a text statement; `from` is where the text begins in it. Control
    /// characters stay: the writer of the program refuses them, and a comment that is not output
    /// may have them.
    fn take_text(&mut self, record: &mut Record, major: crate::WordId, from: usize) -> Result<()> {
        self.major = Some(major);
        self.refuse_bytes(is_nul)?;
        self.item_ranges.clear();
        if major == words::INSERT && self.statement.has_skip_mark(&self.lines) {
            let message = "INSERT /text: does the text begin with the slash?";
            let hint = "Write INSERT / text, or INSERT //text for a block with a skip mark.";
            let diag = self.diag(ClCode::BadWord, message, 0..self.statement.joined.len());
            return Err(Box::new(diag.hint(hint)));
        }
        let text = &self.statement.joined[from..];
        match std::str::from_utf8(text) {
            Ok(text) => record.text.push_str(text),
            Err(_) => record.text.push_str(&(self.options.decode)(text)),
        }
        record.data.push(Word::Text { start: 0, len: record.text.len() as u32 });
        (record.major, record.kind, record.sub) = (major, kind::POST, 0);
        self.watch(|recognition, place| recognition.text(major, &record.text, place))?;
        record.inert = self.rules().is_without_effect(words::name(major));
        if self.keeps_meaning() {
            self.give_text_as_written(record);
            return Ok(());
        }
        self.rewrite_text(record)
    }

    /// Where an item stands in the joined statement; the last one when there are not so
    /// many, the whole statement when there is none.
    fn item_range(&self, item: usize) -> Range<usize> {
        let range = self.item_ranges.get(item).or(self.item_ranges.last());
        range.cloned().unwrap_or(0..self.statement.joined.len())
    }

    /// Refuses bytes of the statement.
    fn refuse_bytes(&self, refused: fn(u8) -> bool) -> Result<()> {
        let bytes = &self.statement.joined;
        // Looking at all bytes is faster than stopping at the first.
        if !bytes.iter().fold(false, |found, byte| found | refused(*byte)) {
            return Ok(());
        }
        let at = bytes.iter().position(|byte| refused(*byte)).unwrap_or(0);
        Err(self.diag(ClCode::BinaryData, &control(bytes[at]), at..at + 1))
    }

    /// A diagnostic at a range of the joined statement.
    fn diag(&self, code: ClCode, message: &str, range: Range<usize>) -> Box<Diag> {
        let place = self.statement.place(&self.lines, &self.file, &self.options, range);
        Box::new(Diag::new(code, message).at(place))
    }

    fn read_failed(&self, error: &std::io::Error) -> Box<Diag> {
        let place = TextSpan::line(&self.file, self.lines.line(), "");
        Box::new(Diag::new(ClCode::ReadFailed, error.to_string()).at(place))
    }

    fn too_long(&self) -> Box<Diag> {
        let bytes = self.lines.statement();
        let (code, at, message) = match bytes.iter().position(|byte| is_control(*byte)) {
            Some(at) if bytes[at] != b'\n' && !bytes[at..].starts_with(b"\r\n") => {
                (ClCode::BinaryData, at, control(bytes[at]))
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

/// True for the byte that a text has in an encoding of two bytes a letter, or in binary data.
fn is_nul(byte: u8) -> bool {
    byte == 0
}

/// What is said of a control character.
fn control(byte: u8) -> String {
    match byte {
        b'\r' => "a carriage return without a line feed".to_string(),
        _ => format!("byte {byte:#04x} in the line"),
    }
}
