//! Statements of the dialects, brought to the form that Creo writes.
//!
//! The reader hands each statement to the function of its dialect after the items are read
//! and before they become words. The function changes the items, or takes the statement in
//! when it says nothing by itself. What it cannot bring to that form for certain it refuses,
//! or leaves as it is for a section to take or the post to refuse.

pub(crate) mod arc;
pub(crate) mod common;
pub(crate) mod cycle;
pub(crate) mod free_text;
pub(crate) mod geometry;
pub(crate) mod spline;
pub(crate) mod table;
pub(crate) mod vector;

use crate::errors::ClCode;
use crate::forms::cycle::Cycle;
use crate::forms::table::Table;
use crate::layout::ShapeError;
use crate::reader::{ArcPoints, ToldSweep};
use crate::record::{Record, Word};
use crate::vocabulary::{Vocabulary, WordId};

/// What became of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// A record that depends on no other statement and leaves nothing for later ones.
    Free,
    /// A record that does.
    Bound,
    /// A record that is made already, of several statements.
    Made,
    /// No record: the statement is part of a later one, or repeats what was said.
    Nothing,
}

/// Why a statement is refused.
#[derive(Debug)]
pub(crate) struct FormError {
    pub(crate) code: ClCode,
    pub(crate) message: String,
    /// Index of the item at fault.
    pub(crate) item: usize,
    pub(crate) hint: Option<&'static str>,
    /// What is missing should have come before the statement.
    pub(crate) leans: bool,
}

impl FormError {
    pub(crate) fn new(code: ClCode, item: usize, message: impl Into<String>) -> Self {
        FormError { code, message: message.into(), item, hint: None, leans: false }
    }

    pub(crate) fn hint(mut self, hint: &'static str) -> Self {
        self.hint = Some(hint);
        self
    }

    /// Says that something did not come before the statement.
    pub(crate) fn leaning(mut self) -> Self {
        self.leans = true;
        self
    }
}

impl From<ShapeError> for FormError {
    fn from(error: ShapeError) -> Self {
        FormError::new(error.code, error.item, error.message)
    }
}

/// What statements of a dialect leave for later ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FormState {
    /// What was announced and must come before the next motion.
    pub(crate) expects: Option<&'static str>,
    /// INDIRV: how the next motion departs.
    pub(crate) direction: Option<[f64; 3]>,
    /// PSIS: the normal of the plane of arcs.
    pub(crate) normal: Option<[f64; 3]>,
    /// TLAXIS.
    pub(crate) tool_axis: Option<[f64; 3]>,
    /// A unit of millimetres was named.
    pub(crate) is_metric: bool,
    /// A unit of inches was named.
    pub(crate) is_inch: bool,
    /// Number and offset of the tool.
    pub(crate) tool: Option<[f64; 2]>,
    /// The point of the tool that the path is for.
    pub(crate) output_point: Option<f64>,
    /// The next tool has been described.
    pub(crate) is_described: bool,
    /// The cycle in force.
    pub(crate) cycle: Option<Cycle>,
    /// The highest speed of the spindle.
    pub(crate) highest_speed: Option<f64>,
    /// CHANNEL: the spindle or turret that the file is for.
    pub(crate) channel: Option<Word>,
    /// SPINDL/PARLEL: the axis along which the tool of the next point lies, 0 for X.
    pub(crate) spindle_along: Option<usize>,
    /// MOVNRB: the last control point of the curve under way.
    pub(crate) curve_end: Option<[f64; 3]>,
    /// INTOL, where it is above 0.
    pub(crate) inner_tolerance: Option<f64>,
    /// OUTTOL, where it is above 0.
    pub(crate) outer_tolerance: Option<f64>,
    /// The program has ended.
    pub(crate) has_ended: bool,
    /// ROTABL and TLAXIS, where points turn with the table.
    pub(crate) table: Table,
    /// Degrees that the CIRCLE under way turns by, where it tells.
    pub(crate) sweep: Option<f64>,
    /// A CIRCLE that tells how far it turns, until its end.
    pub(crate) told_sweep: Option<ToldSweep>,
    /// A CIRCLE of Creo's and the points behind it, as long as they lie on it.
    pub(crate) arc_points: Option<ArcPoints>,
}

impl FormState {
    /// True while each motion must be looked at.
    #[inline]
    pub(crate) fn watches_motions(&self) -> bool {
        self.expects.is_some()
            || self.table.is_in_play()
            || self.told_sweep.is_some()
            || self.spindle_along.is_some()
    }
}

/// A statement under way to its record: the items stand in `record.data`.
pub(crate) struct Written<'a> {
    pub(crate) record: &'a mut Record,
    pub(crate) vocabulary: &'a mut Vocabulary,
    pub(crate) state: &'a mut FormState,
    /// Where the tool stands; `None` where that is not known.
    pub(crate) point: Option<[f64; 3]>,
    /// Records that the statement makes besides its own, the last one first.
    pub(crate) made: &'a mut Vec<Record>,
}

/// Brings a statement of a dialect to the form of Creo.
pub(crate) type Rewrite = fn(&mut Written<'_>) -> Result<Outcome, FormError>;

/// Brings a text statement of a dialect to the form of Creo.
pub(crate) type RewriteText = fn(&mut Record) -> Result<(), FormError>;

impl Written<'_> {
    /// The name of a minor word; empty for another item and past the end.
    pub(crate) fn name(&self, item: usize) -> &str {
        match self.record.data.get(item) {
            Some(Word::Minor(word)) => self.vocabulary.name(*word),
            _ => "",
        }
    }

    /// Makes the items a minor word and couplets.
    pub(crate) fn set_couplets(&mut self, first: WordId, couplets: &[(WordId, f64)]) {
        let data = &mut self.record.data;
        data.clear();
        data.push(Word::Minor(first));
        for (word, value) in couplets {
            data.extend([Word::Minor(*word), Word::Number(*value)]);
        }
    }

    /// The number that an item is.
    pub(crate) fn number(&self, item: usize) -> Option<f64> {
        match self.record.data.get(item) {
            Some(Word::Number(value)) => Some(*value),
            _ => None,
        }
    }
}
