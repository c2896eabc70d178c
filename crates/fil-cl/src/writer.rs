//! Records to CL text, in the layout of Creo's `.ncl` files.

use std::fmt::Write as _;
use std::io::Write;

use fil_diag::Diag;

use crate::errors::ClCode;
use crate::layout::{is_alias, takes_text};
use crate::reader::reads_as_text;
use crate::record::{Record, Word, kind};
use crate::vocabulary::Vocabulary;
use crate::words;

/// Columns Creo fills before it continues a statement in the next line.
const WIDTH: usize = 71;

/// Sizes of numbers that are written without an exponent; any other has more digits than a
/// line should hold, and none comes from a machine.
const PLAIN: std::ops::Range<f64> = 1e-15..1e16;

/// Numbers of CAM systems have at most ten digits behind the point. No two numbers of fifteen
/// digits are the same double, so the one that a double reads back as is its shortest form.
const SCALE: u64 = 10_000_000_000;
const MOST: f64 = 1e15;

/// Writes records so that the reader makes the same records of them again.
pub struct Writer<W> {
    output: W,
    line: String,
    item: String,
}

impl<W: Write> Writer<W> {
    /// A writer onto an output.
    pub fn new(output: W) -> Self {
        Writer { output, line: String::new(), item: String::new() }
    }

    /// Writes one record as a statement.
    ///
    /// # Errors
    /// The record has no text form (a number that is not finite, a text that would
    /// read as something else, an empty slot at the end), or the output fails.
    pub fn write(&mut self, record: &Record, vocab: &Vocabulary) -> Result<(), Box<Diag>> {
        self.statement(record, vocab, WIDTH)?;
        self.end_line()
    }

    /// The statement of a record on one line, which is not written.
    ///
    /// # Errors
    /// The record has no text form.
    pub fn one_line(&mut self, record: &Record, vocab: &Vocabulary) -> Result<&str, Box<Diag>> {
        self.statement(record, vocab, usize::MAX)?;
        Ok(&self.line)
    }

    fn statement(
        &mut self,
        record: &Record,
        vocab: &Vocabulary,
        width: usize,
    ) -> Result<(), Box<Diag>> {
        self.line.clear();
        if record.kind == kind::PSEUDO {
            self.line.push_str("$$-> ");
        }
        self.line.push_str(vocab.name(record.major));
        if record.kind == kind::POST && takes_text(record.major) {
            self.free_text(record, " / ")
        } else if is_alias(record, vocab) {
            self.free_text(record, " : ")
        } else {
            self.items(record, vocab, width)
        }
    }

    /// Writes a text statement as a comment, which no reader takes for a statement.
    ///
    /// # Errors
    /// As [`Writer::write`].
    pub(crate) fn comment(&mut self, record: &Record, vocab: &Vocabulary) -> Result<(), Box<Diag>> {
        self.line.clear();
        self.line.push_str("$$ ");
        self.line.push_str(vocab.name(record.major));
        self.free_text(record, " / ")?;
        self.end_line()
    }

    fn end_line(&mut self) -> Result<(), Box<Diag>> {
        self.line.push('\n');
        self.output
            .write_all(self.line.as_bytes())
            .map_err(|error| Box::new(Diag::new(ClCode::WriteFailed, error.to_string())))
    }

    /// Gives the output back.
    pub fn into_inner(self) -> W {
        self.output
    }

    fn free_text(&mut self, record: &Record, between: &str) -> Result<(), Box<Diag>> {
        let [word @ Word::Text { .. }] = record.data[..] else {
            return Err(unwritable("a text statement with other words than one text"));
        };
        let text = record.text_of(word);
        if text.contains(['\n', '\r', '\0']) || text.ends_with([' ', '\t']) {
            return Err(unwritable("a text that a line cannot hold"));
        }
        self.line.push_str(between);
        self.line.push_str(text);
        Ok(())
    }

    fn items(&mut self, record: &Record, vocab: &Vocabulary, most: usize) -> Result<(), Box<Diag>> {
        let data = written_items(record);
        if data.is_empty() {
            self.line.push_str(if is_bare(record) { " " } else { " / " });
            return Ok(());
        }
        if data.last() == Some(&Word::Empty) {
            return Err(unwritable("an empty slot at the end"));
        }
        self.line.push_str(" /");
        let mut start = 0;
        for (index, word) in data.iter().enumerate() {
            self.item.clear();
            self.format(record, *word, vocab)?;
            if index > 0 {
                self.line.push(',');
            }
            let width = self.line.len() - start + 1 + self.item.len();
            // A line of its own cannot say an empty item.
            if index > 0 && !self.item.is_empty() && width + ",  $".len() > most {
                self.line.push_str("  $\n");
                start = self.line.len();
            } else {
                self.line.push(' ');
            }
            self.line.push_str(&self.item);
        }
        Ok(())
    }

    /// The shortest digits that read back exactly, with a point: Creo writes no exponent.
    fn number(&mut self, value: f64) {
        let size = value.abs();
        let scaled = (size * SCALE as f64).round();
        if scaled < MOST && scaled / SCALE as f64 == size {
            return self.decimal(scaled as u64, value.is_sign_negative());
        }
        if value != 0.0 && !PLAIN.contains(&value.abs()) {
            return write!(self.item, "{value:?}").unwrap_or_default();
        }
        write!(self.item, "{value}").unwrap_or_default();
        if value.fract() == 0.0 {
            self.item.push_str(".0");
        }
    }

    /// A number counted in the last digit of [`SCALE`].
    fn decimal(&mut self, scaled: u64, negative: bool) {
        let mut digits = itoa::Buffer::new();
        self.item.push_str(if negative { "-" } else { "" });
        self.item.push_str(digits.format(scaled / SCALE));
        self.item.push('.');
        // A digit before them keeps their zeros.
        let fraction = digits.format(scaled % SCALE + SCALE)[1..].trim_end_matches('0');
        self.item.push_str(if fraction.is_empty() { "0" } else { fraction });
    }

    fn format(&mut self, record: &Record, word: Word, vocab: &Vocabulary) -> Result<(), Box<Diag>> {
        match word {
            Word::Number(value) if !value.is_finite() => {
                return Err(unwritable("a number that is not finite"));
            }
            Word::Number(value) => self.number(value),
            Word::Minor(id) => self.item.push_str(vocab.name(id)),
            Word::Text { .. } => {
                let text = record.text_of(word);
                let lenient = record.kind == kind::PSEUDO || !vocab.is_known(record.major);
                if !lenient || !reads_as_text(vocab, text) {
                    return Err(unwritable("a text that an item cannot hold"));
                }
                self.item.push_str(text);
            }
            Word::Empty => {}
        }
        Ok(())
    }
}

/// The items of the statement behind the words of a record.
fn written_items(record: &Record) -> &[Word] {
    match record.kind {
        kind::MOTION => record.data.get(2..).unwrap_or_default(),
        kind::SURFACE => match record.data.get(5..).unwrap_or_default() {
            // A radius that is not known is left out.
            [rest @ .., Word::Empty] if rest.len() == 6 => rest,
            items => items,
        },
        _ => &record.data,
    }
}

/// True for the statements Creo writes without a slash when they have no items.
fn is_bare(record: &Record) -> bool {
    record.kind != kind::PSEUDO && matches!(record.major, words::RAPID | words::FINI)
}

fn unwritable(what: &str) -> Box<Diag> {
    Box::new(Diag::new(ClCode::Unwritable, what))
}
