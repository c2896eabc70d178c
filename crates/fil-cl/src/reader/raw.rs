//! Statements as they are written, each with what it means.
//!
//! A section may want the words of the CAM system. The post knows those of Creo only, so a
//! record that is given as it is written comes with its meaning: the records that the reader
//! would have given otherwise.

use fil_diag::{Diag, Result};

use super::Reader;
use crate::forms::Outcome;
use crate::record::{Record, Word, kind};
use crate::vocabulary::Vocabulary;

/// What a statement means, where that is something else than it says.
#[derive(Clone, Debug)]
pub enum Meaning {
    /// The records of Creo's form; none for a statement that belongs to another one.
    Records(Vec<Record>),
    /// It can't be brought to that form for certain.
    Refused(Box<Diag>),
}

impl Reader<'_> {
    /// What the last record means, where statements are read as they are written (see
    /// [`Options::raw`](super::Options::raw)); `None` where it means what it says.
    pub fn meaning(&self) -> Option<&Meaning> {
        let (number, meaning) = self.meaning.as_ref()?;
        (*number == self.number).then_some(meaning)
    }

    /// True where records are given as they are written, with their meaning.
    pub(super) fn keeps_meaning(&self) -> bool {
        self.options.raw && !self.is_scout
    }

    /// Keeps what the record that is given next means.
    #[cold]
    pub(super) fn keep_meaning(&mut self, meaning: Meaning) {
        self.meaning = Some((self.number.saturating_add(1), meaning));
    }

    /// Gives a statement as it is written and keeps what it means: the motions of a spline
    /// with its last control point. What is no record as it is written, such as several
    /// points in one GOTO, is given in Creo's form.
    pub(super) fn give_as_written(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<Outcome> {
        let mut written = record.clone();
        let is_geometry = self.computes(record.major);
        let has_shape = is_geometry || written.arrange().is_ok();
        if is_geometry {
            (written.kind, written.sub) = (kind::POST, 0);
        }
        let outcome = match self.bring_to_form(vocab, record) {
            Err(diag) if has_shape => {
                if is_geometry {
                    self.forget_motion();
                }
                self.keep_meaning(Meaning::Refused(diag));
                *record = written;
                return Ok(Outcome::Bound);
            }
            result => result?,
        };
        if !has_shape {
            return Ok(outcome);
        }
        written.inert = record.inert;
        if self.rules().trailing_comma {
            drop_empty_end(record);
        }
        let more = self.take_pending();
        let is_alone = self.made.is_empty() && more.is_empty();
        if outcome != Outcome::Nothing && is_alone && *record == written {
            return Ok(outcome);
        }
        let meant =
            (outcome != Outcome::Nothing).then(|| std::mem::replace(record, written.clone()));
        let rest = std::mem::take(&mut self.made).into_iter().rev().chain(more);
        self.keep_meaning(Meaning::Records(meant.into_iter().chain(rest).collect()));
        *record = written;
        Ok(Outcome::Bound)
    }

    /// The same for a text statement.
    pub(super) fn give_text_as_written(&mut self, record: &mut Record) {
        let written = record.clone();
        match self.rewrite_text(record) {
            Err(diag) => self.keep_meaning(Meaning::Refused(diag)),
            Ok(()) if *record == written => return,
            Ok(()) => self.keep_meaning(Meaning::Records(vec![record.clone()])),
        }
        *record = written;
    }
}

/// Leaves out the empty items behind the last comma: Creo writes no list that ends so.
pub(super) fn drop_empty_end(record: &mut Record) {
    // The radius of a circle has its place, known or not.
    if record.kind != kind::SURFACE {
        let last = record.data.iter().rposition(|word| *word != Word::Empty);
        record.data.truncate(last.map_or(0, |at| at + 1));
    }
}
