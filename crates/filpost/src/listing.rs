//! The listing: each CL record, what its section did, the blocks it made, and
//! messages that stay off the tape.

use std::io::{self, Write};

use crate::event::Event;
use crate::statement::statement_text;

/// Writes a listing while a run goes; give [`Listing::observer`] to the run.
///
/// ```
/// use filpost::{Program, listing::Listing};
///
/// let program = Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let mut listing = Listing::new(Vec::new());
/// program.start().observe(listing.observer()).run(cl.as_bytes(), std::io::sink())?;
/// let text = String::from_utf8(listing.finish()?)?;
/// assert!(text.contains("GOTO") && text.contains("X1. Y2. Z3."), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Listing<W> {
    writer: W,
    /// The first error of the writer; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<W: Write + Send> Listing<W> {
    /// A listing to a writer.
    pub fn new(writer: W) -> Self {
        Listing { writer, failure: None }
    }

    /// The observer that writes it.
    pub fn observer(&mut self) -> impl FnMut(Event<'_>) + Send + '_ {
        |event| {
            if self.failure.is_none() {
                self.failure = self.line(&event).err();
            }
        }
    }

    /// Ends the listing and gives the writer back.
    ///
    /// # Errors
    /// The first error of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        match self.failure {
            Some(error) => Err(error),
            None => self.writer.flush().map(|()| self.writer),
        }
    }

    fn line(&mut self, event: &Event<'_>) -> io::Result<()> {
        let writer = &mut self.writer;
        match event {
            Event::Record { record, vocabulary } => {
                let statement = statement_text(record, vocabulary);
                writeln!(writer, "{:>7} {:>7}  {statement}", record.line, record.number)
            }
            Event::Section { key, swallowed, traced, .. } if *traced || *swallowed => {
                let end = if *swallowed { ": record swallowed" } else { "" };
                writeln!(writer, "{:>17}FIL section {key}{end}", "")
            }
            Event::Block { text, origin } => {
                let fil: Vec<String> =
                    origin.fil.iter().map(|at| format!(" <{}:{}>", at.file, at.line)).collect();
                writeln!(writer, "{:>20}{text}{}", "", fil.concat())
            }
            Event::Message(text) => writeln!(writer, "{:>17}{text}", ""),
            Event::Section { .. } | Event::Warning(_) => Ok(()),
        }
    }
}
