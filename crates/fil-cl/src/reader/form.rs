//! The forms of the dialect, applied to a statement.

use fil_diag::{Diag, Result};

use super::Reader;
use super::arc::has_radius;
use crate::errors::ClCode;
use crate::forms::arc::{self, Departure, Path};
use crate::forms::{FormError, Outcome, Written, common, geometry, table};
use crate::layout::UNCOMPUTED;
use crate::record::{Record, Word};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

/// The axes of the part.
const UNITS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Reader<'_> {
    /// Brings a statement to the form of Creo.
    pub(super) fn rewrite(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<Outcome> {
        let rules = self.rules();
        record.inert = rules.is_without_effect(vocab.name(record.major));
        if self.is_scout {
            return Ok(Outcome::Free);
        }
        match record.major {
            words::INDIRV => return self.take_direction(record),
            words::INTOL | words::OUTTOL if rules.splines => {
                self.keep_tolerance(record);
                return Ok(Outcome::Bound);
            }
            words::NURBS | words::KNOT | words::CNTRL if rules.splines => {
                return self.take_spline(record);
            }
            _ => {}
        }
        if vocab.name(record.major) == "HELICAL" && rules.geometry {
            return self.take_helix(vocab, record);
        }
        if !rules.is_creo() {
            let (state, made) = (&mut self.modal.forms, &mut self.made);
            common::to_creo(&mut Written { record, vocabulary: vocab, state, made });
        }
        // The radius of a circle comes from the point before it where it is left out.
        let outcome = match record.major {
            words::CIRCLE if !rules.is_creo() && !has_radius(record) => Outcome::Bound,
            _ => Outcome::Free,
        };
        let Some(rewrite) = rules.rewrite else { return Ok(outcome) };
        let (state, made) = (&mut self.modal.forms, &mut self.made);
        let mut written = Written { record, vocabulary: vocab, state, made };
        let rewritten = rewrite(&mut written).map_err(|error| self.form_error(error))?;
        Ok(if rewritten == Outcome::Free { outcome } else { rewritten })
    }

    /// The same for a text statement.
    pub(super) fn rewrite_text(&mut self, record: &mut Record) -> Result<()> {
        let rewrite = self.rules().rewrite_text.filter(|_| !self.is_scout);
        rewrite.map_or(Ok(()), |rewrite| rewrite(record)).map_err(|error| self.form_error(error))
    }

    /// Brings a motion or a CIRCLE to the part that the table has not turned.
    pub(super) fn bring_back(&mut self, record: &mut Record) -> Result<()> {
        let moved = self.modal.point.is_some() || self.modal.in_arc;
        let table = &mut self.modal.forms.table;
        if !table.is_in_play() || self.options.raw {
            return Ok(());
        }
        table::bring_back(table, record, moved).map_err(|error| self.form_error(error))
    }

    /// INDIRV/i,j,k: the direction in which the next motion departs.
    fn take_direction(&mut self, record: &Record) -> Result<Outcome> {
        let [Word::Number(i), Word::Number(j), Word::Number(k)] = record.data[..] else {
            let whole = 0..self.statement.joined.len();
            return Err(self.diag(ClCode::BadPoint, "INDIRV takes three numbers", whole));
        };
        self.modal.forms.direction = Some([i, j, k]);
        self.modal.forms.expects = Some("the motion that INDIRV begins");
        Ok(Outcome::Nothing)
    }

    /// HELICAL/CENTER,…,END,… makes a CIRCLE and the GOTO to its end.
    fn take_helix(&mut self, vocab: &Vocabulary, record: &mut Record) -> Result<Outcome> {
        self.leans = self.modal.point.is_none();
        let refuse = |message: &str| {
            self.diag(ClCode::UncomputedMotion, message, 0..self.statement.joined.len())
        };
        let unknown = || refuse("not the nine parts of a HELICAL");
        let (helix, direction) = arc::read_helix(vocab, &record.data).ok_or_else(unknown)?;
        let Some(start) = self.modal.point else {
            return Err(refuse("a point to start from must come before it"));
        };
        let from = Departure { start, direction };
        let path = arc::helix(from, &helix).map_err(|message| refuse(&message))?;
        self.refuse_expected()?;
        self.give_path(path, record);
        Ok(Outcome::Made)
    }

    /// True for a word of a motion by geometry that is computed in this dialect.
    pub(super) fn computes(&self, major: WordId) -> bool {
        let computes = match major {
            words::INDIRV => self.rules().geometry,
            words::NURBS | words::KNOT | words::CNTRL => self.rules().splines,
            _ => false,
        };
        computes && !self.is_scout
    }

    /// True for a statement that names shapes, where they are computed.
    pub(super) fn names_geometry(&self) -> bool {
        let text = &self.statement.joined;
        let is = |name: &[u8]| text.get(..name.len()).is_some_and(|t| t.eq_ignore_ascii_case(name));
        (is(b"TLON") || is(b"PSIS")) && self.rules().geometry && !self.is_scout
    }

    /// TLON,GOFWD/ makes a CIRCLE and the GOTO to its end; PSIS/ names the plane of arcs.
    pub(super) fn read_geometry(&mut self, record: &mut Record) -> Result<Outcome> {
        self.major = Some(words::TLON);
        self.leans = self.modal.point.is_none() || self.modal.forms.direction.is_none();
        let text = &self.statement.joined;
        let whole = 0..text.len();
        self.item_ranges.clear();
        let slash = memchr::memchr(b'/', text);
        let major: Vec<u8> = text[..slash.unwrap_or(text.len())]
            .iter()
            .filter(|byte| !byte.is_ascii_whitespace())
            .map(u8::to_ascii_uppercase)
            .collect();
        let Some(slash) = slash.filter(|_| matches!(&major[..], b"TLON,GOFWD" | b"PSIS")) else {
            return Err(self.diag(ClCode::UncomputedMotion, UNCOMPUTED, whole));
        };
        let parts = geometry::parse(&text[slash + 1..]).map_err(|(at, message)| {
            self.diag(ClCode::BadWord, &message, slash + 1 + at..slash + 2 + at)
        })?;
        let refuse = |message: &str| self.diag(ClCode::UncomputedMotion, message, whole.clone());
        if major == b"PSIS" {
            let [plane] = &parts[..] else { return Err(refuse("one plane is needed")) };
            let normal = geometry::plane_normal(plane);
            self.modal.forms.normal =
                Some(normal.ok_or_else(|| refuse("this surface is not computed"))?);
            return Ok(Outcome::Nothing);
        }
        let (round, stop) = geometry::round_and_stop(&parts)
            .ok_or_else(|| refuse("only arcs that end at a line or plane are computed"))?;
        let (Some(start), Some(direction)) = (self.modal.point, self.modal.forms.direction) else {
            return Err(refuse("a point to start from and INDIRV must come before it"));
        };
        let from = Departure { start, direction };
        let named = [self.modal.forms.normal, self.modal.forms.tool_axis, self.modal.axis];
        let axes: Vec<[f64; 3]> = named.into_iter().flatten().chain(UNITS).collect();
        let path = arc::arc(from, round, stop, &axes).map_err(|message| refuse(&message))?;
        (self.modal.forms.direction, self.modal.forms.expects) = (None, None);
        self.give_path(path, record);
        Ok(Outcome::Bound)
    }

    /// A path as CIRCLE and the GOTO to its end.
    fn give_path(&mut self, path: Path, record: &mut Record) {
        let line = record.line;
        *record = path.record();
        record.line = line;
        let axis = self.modal.axis.filter(|_| self.modal.multax);
        self.made.push(Record { line, ..Record::goto(path.end, axis) });
        self.modal.point = Some(path.end);
        self.modal.in_arc = false;
    }

    /// Refuses a motion before what was announced.
    pub(super) fn refuse_expected(&self) -> Result<()> {
        let Some(expected) = self.modal.forms.expects else { return Ok(()) };
        let message = format!("{expected} must come before this");
        Err(self.diag(ClCode::MissingItem, &message, 0..self.statement.joined.len()))
    }

    fn form_error(&mut self, error: FormError) -> Box<Diag> {
        self.leans = error.leans;
        let mut diag = self.diag(error.code, &error.message, self.item_range(error.item));
        diag.hint = error.hint.map(str::to_string);
        diag
    }
}
