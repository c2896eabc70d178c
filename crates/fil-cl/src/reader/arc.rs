//! CIRCLE as the dialect means it.

use fil_diag::Result;

use super::Reader;
use crate::dialect::{ArcSense, ClDialect};
use crate::errors::ClCode;
use crate::forms::vector;
use crate::record::{Record, Word};
use crate::words;

impl Reader<'_> {
    /// Turns the axis of a circle so that the right-hand rule holds. A circle that is not
    /// in a form of the dialect is refused: it is perhaps one of another dialect, whose
    /// axis has the opposite sense.
    pub(super) fn turn_circle(&mut self, record: &mut Record) -> Result<()> {
        let count = record.data.iter().take_while(|word| matches!(word, Word::Number(_))).count();
        let Some(form) = self.rules().circle else {
            let message = format!("arcs of {} are not written as CIRCLE", self.dialect());
            return self.foreign_circle(&message, count);
        };
        if !form.counts.contains(&count) {
            let message =
                format!("{count} numbers, where {} has {}", self.dialect(), form.spell_counts());
            return self.foreign_circle(&message, count);
        }
        self.check_axis(record)?;
        if self.is_turned(record, form.sense, count)? {
            for word in record.data.iter_mut().skip(3).take(3) {
                if let Word::Number(part) = word {
                    *part = 0.0 - *part;
                }
            }
        }
        if !self.is_scout && self.dialect() != ClDialect::Creo {
            if self.dialect() != ClDialect::Generic {
                bring_to_seven(record, count);
            }
            self.add_radius(record);
        }
        if self.recognition.used.circle == 0 {
            self.recognition.used.circle = record.line;
        }
        self.modal.in_arc = true;
        Ok(())
    }

    /// Adds the radius that a circle of six numbers leaves out: the distance of its axis from
    /// the start, where that is known.
    fn add_radius(&self, record: &mut Record) {
        let Some(start) = self.modal.point else { return };
        let [x, y, z, i, j, k, ..] = &record.data[..] else { return };
        let [
            Word::Number(x),
            Word::Number(y),
            Word::Number(z),
            Word::Number(i),
            Word::Number(j),
            Word::Number(k),
        ] = [*x, *y, *z, *i, *j, *k]
        else {
            return;
        };
        if !has_radius(record) {
            let Some(axis) = vector::unit([i, j, k]) else { return };
            let radius = vector::norm(vector::across(vector::sub(start, [x, y, z]), axis));
            record.data.insert(SIX, Word::Number(radius));
        }
    }

    /// True when the axis must be turned for the right-hand rule. A word that contradicts
    /// the axis is refused.
    fn is_turned(&self, record: &Record, sense: ArcSense, count: usize) -> Result<bool> {
        let turned = sense == ArcSense::LeftHand;
        match (record.has(words::CLOCKWISE), record.has(words::COUNTERCLOCKWISE)) {
            (false, false) if matches!(sense, ArcSense::ByWord | ArcSense::ByAxis) => {
                self.foreign_circle("CLOCKWISE or COUNTERCLOCKWISE is needed", count)?;
            }
            (false, false) => {}
            (true, true) => self.foreign_circle("CLOCKWISE and COUNTERCLOCKWISE", count)?,
            (clockwise, _) if sense == ArcSense::ByWord => return Ok(clockwise),
            _ if sense == ArcSense::ByAxis => {}
            (clockwise, _) if clockwise != (points_down(record) != turned) => {
                let word = if clockwise { "CLOCKWISE" } else { "COUNTERCLOCKWISE" };
                let message =
                    format!("{word}, but the axis says the opposite in {}", self.dialect());
                self.foreign_circle(&message, count)?;
            }
            _ => {}
        }
        Ok(turned)
    }

    /// Refuses a form that the dialect does not have: it is one of others, or of none.
    fn foreign_circle(&self, message: &str, count: usize) -> Result<()> {
        let range = self.item_range(count.saturating_sub(1));
        let is_told = self.dialect().is_told();
        let others: Vec<String> = ClDialect::with_circles_of(count)
            .filter(|other| {
                *other != self.dialect() && !(is_told && other.turns_against(self.dialect()))
            })
            .map(|other| format!("--dialect {other}"))
            .collect();
        if others.is_empty() {
            return Err(self.diag(ClCode::BadPoint, message, range));
        }
        let mut diag = self.diag(ClCode::ForeignArc, message, range);
        diag.hint = Some(format!("such a CIRCLE is one of {}", others.join(", ")));
        Err(diag)
    }

    fn dialect(&self) -> ClDialect {
        self.recognition.found().dialect
    }
}

/// Numbers of a CIRCLE in Creo's form: center, axis, radius.
const NUMBERS: usize = 7;

/// Numbers of center and axis.
const SIX: usize = 6;

/// True for a CIRCLE that names its radius behind center and axis.
pub(super) fn has_radius(record: &Record) -> bool {
    matches!(record.data.get(SIX), Some(Word::Number(_)))
}

/// Leaves what Creo's form has, and TIMES: tolerances and sizes of the tool tell nothing of
/// the arc, and a direction that was checked says what the axis says now.
fn bring_to_seven(record: &mut Record, count: usize) {
    if count > NUMBERS {
        record.data.drain(NUMBERS..count);
    }
    let directions = [words::CLOCKWISE, words::COUNTERCLOCKWISE].map(Word::Minor);
    record.data.retain(|word| !directions.contains(word));
}

/// True when the largest part of a circle's axis is negative: seen from the positive side
/// of the principal axis, the right-hand rule then means clockwise.
fn points_down(record: &Record) -> bool {
    let part = |word: &Word| match word {
        Word::Number(part) => *part,
        _ => 0.0,
    };
    let parts = record.data.iter().skip(3).take(3).map(part);
    parts.max_by(|a, b| a.abs().total_cmp(&b.abs())).is_some_and(|largest| largest < 0.0)
}
