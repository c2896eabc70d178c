//! Records that a program hands over from memory.

use fil_cl::{ClCode, Record, Vocabulary};
use fil_diag::{Diag, Result, TextSpan};

use crate::error::{Error, RunCode};
use crate::program::Program;
use crate::source::Unread;

/// Hands out records that are already there, after a look at each.
pub(crate) struct Memory<'r> {
    records: Box<dyn Iterator<Item = Record> + Send + 'r>,
    /// The words of the records, until the run takes them.
    vocabulary: Option<Vocabulary>,
    /// How messages call the records.
    name: String,
    number: u32,
    /// The last record was refused.
    failed: bool,
}

impl<'r> Memory<'r> {
    /// # Errors
    /// E0712 for a vocabulary that does not begin with that of the program: its
    /// numbers would mean other words.
    pub fn new(
        records: impl Iterator<Item = Record> + Send + 'r,
        vocabulary: Vocabulary,
        program: &Program,
        name: &str,
    ) -> Result<Self, Error> {
        if !vocabulary.extends(&program.shared.vocabulary) {
            let message = "the vocabulary of the records is not that of the program";
            let hint = "Start from Program::vocabulary of the program that runs them.";
            return Err(Error::Run(Box::new(Diag::new(RunCode::BadRecord, message).hint(hint))));
        }
        Ok(Memory {
            records: Box::new(records),
            vocabulary: Some(vocabulary),
            name: name.to_string(),
            number: 0,
            failed: false,
        })
    }
}

impl Memory<'_> {
    /// As [`Stream::read`](crate::source::Stream).
    pub fn read(&mut self, vocabulary: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        if let Some(words) = self.vocabulary.take() {
            *vocabulary = words;
        }
        let Some(next) = self.records.next() else { return Ok(false) };
        *record = next;
        self.number = self.number.saturating_add(1);
        record.number = self.number;
        if record.line == 0 {
            record.line = self.number;
        }
        match record.fault(vocabulary) {
            None => Ok(true),
            Some(fault) => {
                self.failed = true;
                let diag = RunCode::BadRecord.diag(format!("record {}: {fault}", record.number));
                // What it names may be no word, so it is not shown.
                Err(Box::new(diag.at(TextSpan::line(&self.name, record.line, ""))))
            }
        }
    }

    /// Why record `number` can't be gone to.
    pub fn cant_seek(&self, number: u32) -> Box<Diag> {
        let message = format!("record {number} is asked for after record {}", self.number);
        let place = TextSpan::line(&self.name, self.number, "");
        Box::new(ClCode::NotSeekable.diag(message).at(place))
    }

    /// True when the last record was refused.
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    /// Goes on behind a record that was refused.
    pub fn resume(&mut self) -> Option<Unread> {
        let unread = Unread { word: None, leans_on_earlier: false, goes_on: true };
        std::mem::take(&mut self.failed).then_some(unread)
    }
}
