//! The listing: each CL record, what its section did, the blocks it made, where the tool
//! is afterwards with its feed and time, messages that stay off the tape and warnings;
//! at the end totals and the tools.

mod rules;
mod texts;

use std::io::{self, Write};

use fil_cl::{Record, words};

use crate::event::{Event, LineEditor};
use crate::statement::statement_text;
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
    /// Lines of the record that is being carried out.
    pending: Vec<(Row, String)>,
    /// Lines on the page.
    lines: usize,
    pages: usize,
    /// The first error of the writer; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<W: Write + Send> Listing<W> {
    /// A listing to a writer.
    pub fn new(writer: W) -> Self {
        Listing { writer, pending: Vec::new(), lines: 0, pages: 0, failure: None }
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
                let statement = statement_text(record, vocabulary);
                let line = format!("{:>7} {:>7}  {statement}", record.line, record.number);
                self.pending.push((Row::of(record), line));
            }
            Event::Section { key, swallowed, traced, .. } if *traced || *swallowed => {
                let end = if *swallowed { ": record swallowed" } else { "" };
                let line = format!("{:>17}FIL section {key}{end}", "");
                self.pending.push((Row::Section, line));
            }
            Event::Block { text, origin, .. } => {
                let fil: Vec<String> =
                    origin.fil.iter().map(|at| format!(" <{}:{}>", at.file, at.line)).collect();
                self.pending.push((
                    Row::Block { length: text.len() },
                    format!("{:>BLOCK$}{text}{}", "", fil.concat()),
                ));
            }
            Event::Motion(motion) => self.pending.push((Row::Position(*motion), String::new())),
            Event::Message(text) => {
                self.pending.push((Row::Message, format!("{:>17}{text}", "")));
            }
            Event::Warning(diag) => {
                self.pending.push((Row::Warning, format!("{:>17}{diag}", "")));
            }
            Event::RecordDone { lines, rules, .. } => self.write(Some(lines), *rules)?,
            Event::End(end) => self.pending.extend(texts::totals(end)),
            Event::Section { .. } => {}
        }
        Ok(())
    }

    fn write(&mut self, editor: Option<&LineEditor<'_>>, rules: ListingRules) -> io::Result<()> {
        for (row, mut line) in std::mem::take(&mut self.pending) {
            if !rules.shows(row) {
                continue;
            }
            if let Row::Position(motion) = &row {
                line = texts::position(motion, rules.feeds);
            }
            if let Row::Block { length } = row
                && rules.bare_blocks
            {
                line = line[BLOCK..BLOCK + length].to_string();
            }
            if let Some(editor) = editor {
                editor.edit(&mut line);
                if line.is_empty() {
                    continue;
                }
            }
            self.begin_page(rules)?;
            writeln!(self.writer, "{line}")?;
        }
        Ok(())
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

/// Blanks before a block.
const BLOCK: usize = 20;

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
