//! The listing: each CL record, what its section did, the blocks it made, and
//! messages that stay off the tape.

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

use crate::observe::WhatHappened;
use crate::statement::statement_text;

/// Writes a listing while a run goes; give [`Listing::observer`] to the builder.
pub struct Listing<W> {
    output: Arc<Mutex<Output<W>>>,
}

struct Output<W> {
    writer: W,
    failure: Option<io::Error>,
}

impl<W: Write + Send + 'static> Listing<W> {
    /// A listing to a writer.
    pub fn new(writer: W) -> Self {
        Listing { output: Arc::new(Mutex::new(Output { writer, failure: None })) }
    }

    /// The observer that writes it.
    pub fn observer(&self) -> impl FnMut(WhatHappened<'_>) + Send + 'static {
        let output = Arc::clone(&self.output);
        move |event| {
            if let Ok(mut output) = output.lock() {
                output.line(&event);
            }
        }
    }

    /// Ends the listing.
    ///
    /// # Errors
    /// The first error of the writer.
    pub fn finish(self) -> io::Result<()> {
        let Ok(mut output) = self.output.lock() else { return Ok(()) };
        match output.failure.take() {
            Some(error) => Err(error),
            None => output.writer.flush(),
        }
    }
}

impl<W: Write> Output<W> {
    fn line(&mut self, event: &WhatHappened<'_>) {
        let written = match event {
            WhatHappened::Record(record, vocabulary) => {
                let statement = statement_text(record, vocabulary);
                writeln!(self.writer, "{:>7} {:>7}  {statement}", record.line, record.number)
            }
            WhatHappened::Section(event) => {
                let end = if event.swallowed { ": record swallowed" } else { "" };
                if event.traced || event.swallowed {
                    writeln!(self.writer, "{:>17}FIL section {}{end}", "", event.key)
                } else {
                    Ok(())
                }
            }
            WhatHappened::Block { text, origin } => {
                let fil: Vec<String> =
                    origin.fil.iter().map(|at| format!(" <{}:{}>", at.file, at.line)).collect();
                writeln!(self.writer, "{:>20}{text}{}", "", fil.concat())
            }
            WhatHappened::Message(text) => writeln!(self.writer, "{:>17}{text}", ""),
        };
        if let Err(error) = written {
            self.failure.get_or_insert(error);
        }
    }
}
