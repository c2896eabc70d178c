//! A CL record as the text of its statement, for messages and the listing.

use std::io;

use fil_cl::{Record, Vocabulary, writer::Writer};

/// The statement in Creo's layout, on one line.
pub fn statement_text(record: &Record, vocabulary: &Vocabulary) -> String {
    Statements::default().text(record, vocabulary).to_string()
}

/// Makes the texts of many statements.
pub(crate) struct Statements(Writer<io::Sink>);

impl Default for Statements {
    fn default() -> Self {
        Statements(Writer::new(io::sink()))
    }
}

impl Statements {
    /// The statement in Creo's layout, on one line.
    pub fn text<'t>(&'t mut self, record: &Record, vocabulary: &'t Vocabulary) -> &'t str {
        match self.0.one_line(record, vocabulary) {
            Ok(line) => line.trim().trim_end_matches('$').trim_end(),
            Err(_) => vocabulary.name(record.major),
        }
    }
}
