//! From the items of a statement to the words of its record, with what the dialect means.

use fil_diag::{Diag, Result};

use super::Reader;
use crate::forms::Outcome;
use crate::layout::ShapeError;
use crate::record::{Record, kind};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

/// Statements before which all must have come that was announced.
const ENDS_AN_ANNOUNCEMENT: [WordId; 8] = [
    words::GOTO,
    words::FROM,
    words::GODLTA,
    words::GOHOME,
    words::CIRCLE,
    words::FINI,
    words::END,
    words::REWIND,
];

impl Reader<'_> {
    /// Brings a statement to the form of Creo and its items to words.
    pub(super) fn bring_to_form(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<Outcome> {
        let outcome = self.rewrite(vocab, record)?;
        if matches!(outcome, Outcome::Free | Outcome::Bound) {
            self.finish(record)?;
        }
        Ok(outcome)
    }

    /// From items to words, with what the dialect means by them.
    fn finish(&mut self, record: &mut Record) -> Result<()> {
        if ENDS_AN_ANNOUNCEMENT.contains(&record.major) {
            self.refuse_expected()?;
        }
        match record.major {
            words::CIRCLE => {
                self.turn_circle(record)?;
                self.bring_back(record)?;
                if let Some(degrees) = self.modal.forms.sweep.take() {
                    record.arrange().map_err(|error| self.shape_error(&error))?;
                    self.note_sweep(record, degrees);
                    return Ok(());
                }
            }
            words::GOTO => {
                self.bring_back(record)?;
                self.keep_end_of_arc(record)?;
                self.split_points(record)?;
            }
            words::FROM => {
                self.bring_back(record)?;
                self.check_axis(record)?;
            }
            words::GODLTA | words::GOHOME => self.bring_back(record)?,
            _ => {}
        }
        record.arrange().map_err(|error| self.shape_error(&error))?;
        if record.kind == kind::MOTION {
            self.check_sweep(record)?;
        }
        self.watch_arc_points(record)?;
        match record.major {
            words::CIRCLE => self.note_circle(record),
            words::MULTAX | words::TLAXIS => self.set_mode(record),
            words::GOTO | words::FROM => self.keep_axis(record),
            // Where these lead is a matter of the post.
            words::GODLTA => self.modal.point = None,
            words::GOHOME => self.keep_home(record),
            _ => {}
        }
        Ok(())
    }

    fn shape_error(&self, error: &ShapeError) -> Box<Diag> {
        self.diag(error.code, &error.message, self.item_range(error.item))
    }
}
