//! UNITS: mm or inch, said once, before any length or feed.

use fil_cl::record::kind;
use fil_cl::{Record, WordId, words as w};
use fil_diag::{Diag, TextSpan};
use fil_machine::Unit;

use super::super::statements::statement;
use super::ClPath;
use crate::errors::NcCode;

/// Statements besides motion that hold lengths or feeds.
const MEASURES: [WordId; 7] =
    [w::FEDRAT, w::CYCLE, w::THREAD, w::PITCH, w::OP, w::LINTOL, w::GOHOME];

/// The unit of a UNITS statement.
pub(super) fn said(record: &Record) -> Unit {
    of_word(if record.has(w::INCHES) { w::INCHES } else { w::MM })
}

/// The unit of the word INCHES, and of MM.
pub(super) fn of_word(word: WordId) -> Unit {
    if word == w::INCHES { Unit::Inch } else { Unit::Mm }
}

impl ClPath<'_> {
    /// Refuses lengths and feeds before anything has said the unit.
    pub(super) fn require_unit(&self) -> Result<(), Box<Diag>> {
        let record = &self.record;
        let measures =
            matches!(record.kind, kind::MOTION | kind::SURFACE) || MEASURES.contains(&record.major);
        let measures = measures && !(record.major == w::THREAD && record.has(w::OFF));
        if self.state.unit.is_some() || !measures {
            return Ok(());
        }
        Err(self.no_unit("a length or feed comes before mm or inch is set"))
    }

    /// Refuses a UNITS statement that says another unit than the one that was given, or
    /// that an earlier one said.
    pub(super) fn refuse_other_unit(&self) -> Result<(), Box<Diag>> {
        let record = &self.record;
        let is_units = record.kind == kind::POST && matches!(record.major, w::UNITS | w::UNIT);
        match self.state.unit.filter(|known| is_units && *known != said(record)) {
            Some(known) => {
                let how = if self.given { "is given" } else { "came before" };
                Err(self.no_unit(&format!("{known} {how}, but UNITS is {}", said(record))))
            }
            None => Ok(()),
        }
    }

    #[cold]
    fn no_unit(&self, message: &str) -> Box<Diag> {
        let record = &self.record;
        let place = TextSpan::line(&self.name, record.line, statement(record, &self.vocabulary));
        Box::new(NcCode::NoUnit.diag(message).at(place))
    }
}
