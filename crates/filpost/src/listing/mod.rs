//! The listing: each CL record, what its section did, the blocks it made, where the tool
//! is afterwards with its feed and time, messages that stay off the tape and warnings;
//! at the end totals and the tools.

mod rules;
mod texts;

use std::io::{self, Write};
use std::mem;

use fil_cl::{Record, words};

use crate::event::{Event, LineEditor};
use crate::statement::Statements;
use crate::tally::Motion;

pub use rules::ListingRules;

/// Writes a listing while a run goes; give [`Listing::observer`] to the run.
///
/// ```
/// use filpost::{Program, listing::Listing};
///
/// let program = Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let mut listing = Listing::new(Vec::new());
/// program.start().observe(listing.observer()).stream(cl.as_bytes(), std::io::sink())?;
/// let text = String::from_utf8(listing.finish()?)?;
/// assert!(text.contains("GOTO") && text.contains("X1. Y2. Z3."), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Listing<W> {
    writer: W,
    statements: Statements,
    /// Lines of the record that is being carried out, and where each ends in their text.
    pending: Vec<(Row, usize)>,
    text: Vec<u8>,
    /// The line that is being written.
    line: Vec<u8>,
    /// Lines on the page.
    lines: usize,
    pages: usize,
    /// The first error of the writer; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<W: Write + Send> Listing<W> {
    /// A listing to a writer.
    pub fn new(writer: W) -> Self {
        let statements = Statements::default();
        let (pending, text, line) = (Vec::new(), Vec::new(), Vec::new());
        Listing { writer, statements, pending, text, line, lines: 0, pages: 0, failure: None }
    }

    /// The observer that writes it.
    pub fn observer(&mut self) -> impl FnMut(Event<'_>) + Send + '_ {
        |event| {
            if self.failure.is_none() {
                self.failure = self.take(&event).err();
            }
        }
    }

    /// Ends the listing and gives the writer back.
    ///
    /// # Errors
    /// The first error of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        if self.failure.is_none() {
            self.failure = self.write(None, ListingRules::default()).err();
        }
        match self.failure {
            Some(error) => Err(error),
            None => self.writer.flush().map(|()| self.writer),
        }
    }

    fn take(&mut self, event: &Event<'_>) -> io::Result<()> {
        match event {
            Event::Record { record, vocabulary, .. } => {
                for number in [record.line, record.number] {
                    texts::right(&mut self.text, number);
                }
                let statement = self.statements.text(record, vocabulary);
                self.text.push(b' ');
                self.text.extend_from_slice(statement.as_bytes());
                self.end_line(Row::of(record));
            }
            Event::Section { key, swallowed, traced, .. } if *traced || *swallowed => {
                let end = if *swallowed { ": record swallowed" } else { "" };
                write!(self.text, "{:NOTE$}FIL section {key}{end}", "")?;
                self.end_line(Row::Section);
            }
            Event::Block { text, origin, .. } => {
                self.text.extend_from_slice(&[b' '; BLOCK]);
                self.text.extend_from_slice(text.as_bytes());
                for at in &origin.fil {
                    write!(self.text, " <{}:{}>", at.file, at.line)?;
                }
                self.end_line(Row::Block { length: text.len() });
            }
            Event::Motion(motion) => self.end_line(Row::Position(*motion)),
            Event::Message(text) => {
                write!(self.text, "{:NOTE$}{text}", "")?;
                self.end_line(Row::Message);
            }
            Event::Warning(diag) => {
                write!(self.text, "{:NOTE$}{diag}", "")?;
                self.end_line(Row::Warning);
            }
            Event::RecordDone { lines, rules, .. } => self.write(Some(lines), *rules)?,
            Event::End(end) => {
                for (row, line) in texts::totals(end) {
                    self.text.extend_from_slice(line.as_bytes());
                    self.end_line(row);
                }
            }
            Event::Section { .. } => {}
        }
        Ok(())
    }

    /// What was written last is a line.
    fn end_line(&mut self, row: Row) {
        self.pending.push((row, self.text.len()));
    }

    fn write(&mut self, editor: Option<&LineEditor<'_>>, rules: ListingRules) -> io::Result<()> {
        let (mut pending, text) = (mem::take(&mut self.pending), mem::take(&mut self.text));
        let mut start = 0;
        for (row, end) in pending.drain(..) {
            let text = &text[mem::replace(&mut start, end)..end];
            if !rules.shows(row) {
                continue;
            }
            self.line.clear();
            match row {
                Row::Position(motion) => texts::position(&mut self.line, &motion, rules.feeds),
                Row::Block { length } if rules.bare_blocks => {
                    self.line.extend_from_slice(&text[BLOCK..BLOCK + length]);
                }
                _ => self.line.extend_from_slice(text),
            }
            if let Some(editor) = editor {
                self.edit(editor);
                if self.line.is_empty() {
                    continue;
                }
            }
            self.begin_page(rules)?;
            self.line.push(b'\n');
            self.writer.write_all(&self.line)?;
        }
        // The next record uses their memory again.
        (self.pending, self.text) = (pending, text);
        self.text.clear();
        Ok(())
    }

    /// Gives the line to the macro of the script, where it has one.
    fn edit(&mut self, editor: &LineEditor<'_>) {
        if editor.is_in_use() {
            let mut line = String::from_utf8_lossy(&self.line).into_owned();
            editor.edit(&mut line);
            self.line = line.into_bytes();
        }
    }

    /// Writes the heading of a page where one begins.
    fn begin_page(&mut self, rules: ListingRules) -> io::Result<()> {
        let Some(length) = rules.lines_per_page else { return Ok(()) };
        if self.lines == 0 || self.lines >= length.max(2) {
            self.pages += 1;
            self.lines = 1;
            writeln!(self.writer, "Page {}", self.pages)?;
        }
        self.lines += 1;
        Ok(())
    }
}

/// Blanks before a block, and before a note on a record.
const BLOCK: usize = 20;
const NOTE: usize = 17;

/// What a line of a listing is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Row {
    /// A statement of the CL file.
    Statement,
    /// PPRINT, whose text may follow as a message.
    Pprint,
    /// INSERT
    Insert,
    /// PARTNO
    Partno,
    /// What a FIL section did.
    Section,
    /// A block of so many bytes.
    Block {
        /// Its bytes.
        length: usize,
    },
    /// Where a motion ends; its text depends on the rules.
    Position(Motion),
    /// A message that stays off the tape.
    Message,
    /// A warning.
    Warning,
    /// Totals of the program.
    Total,
    /// Totals of a tool.
    Tool,
}

impl Row {
    fn of(record: &Record) -> Self {
        match record.major {
            words::PPRINT => Row::Pprint,
            words::INSERT => Row::Insert,
            words::PARTNO => Row::Partno,
            _ => Row::Statement,
        }
    }
}
