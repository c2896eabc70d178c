//! Motions of the CL file that a section takes: neither it nor POSTF(13) gives them to the post.

use fil_cl::vocabulary::words;
use fil_cl::{Record, Word, record::kind};
use fil_diag::Diag;
use fil_post::path::taken_change::{self, BeforeSection};
use fil_post::{Post, WaitsForMotion};

use super::Outside;

/// The motions that were current while a section ran and that the post has not carried out: the
/// numbers of their records, ascending, and what waited for each.
#[derive(Debug, Default)]
pub(crate) struct Taken {
    motions: Vec<(u32, WaitsForMotion)>,
    /// The point that the post had when the section began.
    from: Option<[f64; 3]>,
    /// LOADTL at which it began.
    change: Option<Change>,
}

/// A tool change of the CL file, before its section ran.
#[derive(Clone, Copy, Debug)]
struct Change {
    tool: i64,
    offset: i64,
    before: BeforeSection,
}

impl Taken {
    /// A record has become current; those behind it come again, if the section went back.
    pub fn is_current(&mut self, record: &Record, post: &Post) {
        while self.motions.last().is_some_and(|(number, _)| *number >= record.number) {
            self.motions.pop();
        }
        if moves(record) {
            self.motions.push((record.number, post.waits_for_motion()));
        }
    }

    /// The post has carried out a record of the CL file.
    pub fn is_posted(&mut self, record: &Record) {
        let found = self.motions.binary_search_by_key(&record.number, |(number, _)| *number);
        if let Ok(at) = found {
            self.motions.remove(at);
        }
    }
}

impl Outside<'_, '_> {
    /// A section begins with a record.
    pub fn watch_taken(&mut self, record: &Record) {
        self.taken.motions.clear();
        self.taken.change = match tool_of(record) {
            Some((tool, offset)) if record.major == words::LOADTL => {
                Some(Change { tool, offset, before: BeforeSection::new(&self.post) })
            }
            _ => None,
        };
        self.taken.from = self.post.point();
        self.taken.is_current(record, &self.post);
    }

    /// A section has ended: what waits for a motion that it has taken waits no longer.
    ///
    /// # Errors
    /// As [`Post::motion_is_taken`].
    pub fn settle_taken(&mut self) -> Result<(), Box<Diag>> {
        if self.taken.motions.is_empty() {
            return Ok(());
        }
        let is_replaced = self.post.point() != self.taken.from;
        let mut motions = self.taken.motions.iter();
        motions.try_for_each(|(_, waits)| self.post.motion_is_taken(*waits, is_replaced))
    }
}

impl Outside<'_, '_> {
    /// The record with which a section began has not gone to the post.
    ///
    /// # Errors
    /// As [`taken_change::is_taken`].
    pub fn settle_change(&mut self) -> Result<(), Box<Diag>> {
        let Some(Change { tool, offset, before }) = self.taken.change.take() else {
            return Ok(());
        };
        taken_change::is_taken(&mut self.post, before, tool, offset)
    }
}

/// The tool that LOADTL names, and its length offset: that of OSETNO, else the same number.
fn tool_of(record: &Record) -> Option<(i64, i64)> {
    let number = |word: Option<&Word>| match word {
        Some(Word::Number(value)) if value.fract() == 0.0 => Some(*value as i64),
        _ => None,
    };
    let tool = number(record.data.first())?;
    let mut items = record.data.iter();
    let has_offset = items.any(|item| *item == Word::Minor(words::OSETNO));
    let offset = number(items.next()).filter(|_| has_offset);
    Some((tool, offset.unwrap_or(tool)))
}

/// True for a record that RAPID makes rapid, or that ends what RAPID has begun.
fn moves(record: &Record) -> bool {
    match record.kind {
        kind::MOTION => record.major != words::FROM,
        _ => matches!(record.major, words::GOHOME | words::RETRCT),
    }
}
