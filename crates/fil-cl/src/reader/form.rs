//! The forms of the dialect, applied to a statement.

use fil_diag::{Diag, Result};

use super::arc::has_radius;
use super::spline::Gathered;
use super::{Meaning, Reader, plain};
use crate::errors::ClCode;
use crate::forms::arc::{self, Departure, Path};
use crate::forms::geometry::Part;
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
            words::DEFSUB | words::ENDSUB | words::CALSUB
                if rules.is_creo() && self.options.expand_subroutines && !self.options.raw =>
            {
                return self.take_subroutine(record);
            }
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
            let (state, made, point) = (&mut self.modal.forms, &mut self.made, self.modal.point);
            common::to_creo(&mut Written { record, vocabulary: vocab, state, point, made });
        }
        // The radius of a circle comes from the point before it where it is left out.
        let outcome = match record.major {
            words::CIRCLE if !rules.is_creo() && !has_radius(record) => Outcome::Bound,
            _ => Outcome::Free,
        };
        let Some(rewrite) = rules.rewrite else { return Ok(outcome) };
        let (state, made, point) = (&mut self.modal.forms, &mut self.made, self.modal.point);
        let mut written = Written { record, vocabulary: vocab, state, point, made };
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
        self.depart([i, j, k]);
        Ok(Outcome::Nothing)
    }

    /// The short way for an INDIRV in one line; each arc of some systems has one.
    pub(super) fn take_plain_direction(&mut self) -> bool {
        if !self.rules().geometry || self.is_scout || self.options.raw {
            return false;
        }
        let found = plain::plain_direction(self.lines.unread(), &mut self.known_numbers);
        let Some((direction, length)) = found else { return false };
        self.take_lines(length, 1);
        self.depart(direction);
        true
    }

    fn depart(&mut self, direction: [f64; 3]) {
        self.modal.forms.direction = Some(direction);
        self.modal.forms.expects = Some("the motion that INDIRV begins");
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

    /// Takes a statement that names shapes. Where statements are given as they are written, its
    /// words and numbers stand in their order, without the parentheses.
    pub(super) fn take_geometry(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
    ) -> Result<Outcome> {
        if !self.keeps_meaning() {
            return self.read_geometry(record);
        }
        let (major, slash) = self.geometry_major()?;
        let mut written = Record { line: record.line, ..Record::command(major) };
        if major == words::TLON {
            written.data.push(Word::Minor(words::GOFWD));
        }
        geometry::flatten(&self.parse_geometry(slash)?, vocab, &mut written.data);
        match self.read_geometry(record) {
            Ok(outcome) => {
                let made = (outcome != Outcome::Nothing).then(|| std::mem::take(record));
                let records = made.into_iter().chain(self.take_pending()).collect();
                self.keep_meaning(Meaning::Records(records));
            }
            Err(diag) => {
                self.forget_motion();
                self.keep_meaning(Meaning::Refused(diag));
            }
        }
        *record = written;
        Ok(Outcome::Bound)
    }

    /// Forgets what led to a motion that is refused: nobody knows where it ends.
    pub(super) fn forget_motion(&mut self) {
        self.spline = Gathered::default();
        self.modal.point = None;
        let forms = &mut self.modal.forms;
        (forms.direction, forms.expects) = (None, None);
    }

    /// TLON of `TLON,GOFWD/`, or PSIS, and where its slash stands.
    fn geometry_major(&self) -> Result<(WordId, usize)> {
        let text = &self.statement.joined;
        let slash = memchr::memchr(b'/', text).unwrap_or(text.len());
        let is = |name: &[u8]| {
            let letters = text[..slash].iter().filter(|byte| !byte.is_ascii_whitespace());
            letters.map(u8::to_ascii_uppercase).eq(name.iter().copied())
        };
        match () {
            () if slash == text.len() => {}
            () if is(b"TLON,GOFWD") => return Ok((words::TLON, slash)),
            () if is(b"PSIS") => return Ok((words::PSIS, slash)),
            () => {}
        }
        Err(self.diag(ClCode::UncomputedMotion, UNCOMPUTED, 0..text.len()))
    }

    fn parse_geometry(&self, slash: usize) -> Result<Vec<Part<'_>>> {
        geometry::parse(&self.statement.joined[slash + 1..]).map_err(|(at, message)| {
            self.diag(ClCode::BadWord, &message, slash + 1 + at..slash + 2 + at)
        })
    }

    /// TLON,GOFWD/ makes a CIRCLE and the GOTO to its end; PSIS/ names the plane of arcs.
    fn read_geometry(&mut self, record: &mut Record) -> Result<Outcome> {
        self.major = Some(words::TLON);
        self.leans = self.modal.point.is_none() || self.modal.forms.direction.is_none();
        self.item_ranges.clear();
        let (major, slash) = self.geometry_major()?;
        let parts = self.parse_geometry(slash)?;
        let whole = 0..self.statement.joined.len();
        let refuse = |message: &str| self.diag(ClCode::UncomputedMotion, message, whole.clone());
        if major == words::PSIS {
            let [plane] = &parts[..] else { return Err(refuse("one plane is needed")) };
            let normal = geometry::plane_normal(plane);
            let normal = normal.ok_or_else(|| refuse("this surface is not computed"))?;
            self.modal.forms.normal = Some(normal);
            return Ok(Outcome::Nothing);
        }
        let (round, stop) = geometry::round_and_stop(&parts)
            .ok_or_else(|| refuse("only arcs that end at a line or plane are computed"))?;
        let (Some(start), Some(direction)) = (self.modal.point, self.modal.forms.direction) else {
            return Err(refuse("a point to start from and INDIRV must come before it"));
        };
        let from = Departure { start, direction };
        let named = [self.modal.forms.normal, self.modal.forms.tool_axis, self.modal.axis];
        let axes = named.into_iter().flatten().chain(UNITS);
        let path = arc::arc(from, round, stop, axes).map_err(|message| refuse(&message))?;
        (self.modal.forms.direction, self.modal.forms.expects) = (None, None);
        self.give_path(path, record);
        Ok(Outcome::Bound)
    }

    /// A path as CIRCLE and the GOTO to its end.
    fn give_path(&mut self, path: Path, record: &mut Record) {
        path.fill(record);
        let axis = self.modal.axis.filter(|_| self.modal.multax);
        let own = axis.filter(|_| axis != self.axis_left_out());
        self.pending.give(&[path.end], own, record.line);
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
