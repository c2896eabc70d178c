//! CIRCLE whose word contradicts its axis: the motion after it proves the word, or refuses it.
//!
//! A word and an axis are two statements about the sense of one arc. Where they differ and the
//! path runs on only by the axis, the word is not what decides.

use fil_diag::Result;

use super::Reader;
use crate::dialect::ClDialect;
use crate::errors::ClCode;
use crate::forms::vector::{Vector, cross, dot, norm, sub};
use crate::record::Record;
use crate::words;

/// Cosine below which one direction runs back against another (about 155 degrees).
const BACK: f64 = -0.9;

/// A shorter motion has no direction.
const SHORTEST: f64 = 1e-6;

/// An arc by a word that contradicts its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WordArc {
    center: Vector,
    /// By the right-hand rule, as the word says.
    axis: Vector,
    /// Where it ends, when that is known.
    end: Option<Vector>,
    line: u32,
}

impl Reader<'_> {
    /// Notes a CIRCLE whose axis was turned by its word.
    pub(super) fn note_word_arc(&mut self, record: &Record) {
        let Some(circle) = record.circle() else { return };
        let arc =
            WordArc { center: circle.center, axis: circle.axis, end: None, line: record.line };
        self.modal.forms.word_arc = Some(arc);
    }

    /// Judges the arc before a motion.
    ///
    /// # Errors
    /// The arc runs back from this motion, and none before it has proved the word.
    pub(super) fn judge_word_arc(&mut self, record: &Record) -> Result<()> {
        let Some(arc) = self.modal.forms.word_arc.take() else { return Ok(()) };
        // Other motions count from elsewhere, or lead where the post says.
        let Some(point) = record.point().filter(|_| record.major == words::GOTO) else {
            return Ok(());
        };
        let Some(end) = arc.end else {
            self.modal.forms.word_arc = Some(WordArc { end: Some(point), ..arc });
            return Ok(());
        };
        let (way, tangent) = (sub(point, end), cross(arc.axis, sub(end, arc.center)));
        let (along, length) = (dot(way, tangent), norm(way) * norm(tangent));
        if length <= SHORTEST {
            return Ok(());
        }
        if along > -BACK * length {
            self.modal.forms.has_proved_words = true;
        }
        if along > BACK * length || self.modal.forms.has_proved_words {
            return Ok(());
        }
        let message = format!(
            "the CIRCLE of line {} runs back from this motion, as its word says, and would run on as \
             its axis says",
            arc.line
        );
        let whole = 0..self.statement.joined.len();
        let mut diag = self.diag(ClCode::ForeignArc, &message, whole);
        diag.hint = Some(format!(
            "check the arc; --dialect {} takes the sense of all arcs from their axes",
            ClDialect::CamWorksAxis
        ));
        Err(diag)
    }
}
