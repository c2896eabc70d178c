//! Lines of two programs that are the same block of the post.

use fil_nc::verify::{Finding, FindingKind, Report};

use super::align::Pair;

/// Which line of the reference is which line of the program, in stretches.
#[derive(Debug, Default)]
pub(super) struct SameLines {
    /// First line of the reference, first line of the program, and how many.
    stretches: Vec<[u32; 3]>,
    /// The program is the reference.
    is_all: bool,
    /// The first line of the program that differs, or follows what was left out.
    first: Option<u32>,
    last: u32,
    /// CL lines whose blocks differ.
    touched: Vec<u32>,
}

impl SameLines {
    /// Of a program that is its own reference.
    pub fn all() -> Self {
        SameLines { is_all: true, ..SameLines::default() }
    }

    /// Takes up the blocks of a record.
    pub fn record(&mut self, pairs: &[Pair<'_>]) {
        for pair in pairs {
            match pair {
                Pair::Same(one, two) => self.same(one.nc_line, two.nc_line),
                Pair::Changed(_, made) | Pair::Added(made) => {
                    self.differs(made.nc_line, made.cause.line);
                }
                Pair::LeftOut(made) => self.differs(self.last + 1, made.cause.line),
            }
        }
    }

    fn same(&mut self, one: u32, two: u32) {
        self.last = two;
        match self.stretches.last_mut() {
            Some([first, second, count]) if (*first + *count, *second + *count) == (one, two) => {
                *count += 1;
            }
            _ => self.stretches.push([one, two, 1]),
        }
    }

    fn differs(&mut self, nc_line: u32, cl_line: u32) {
        self.last = self.last.max(nc_line);
        self.first = self.first.or(Some(nc_line));
        if self.touched.last() != Some(&cl_line) {
            self.touched.push(cl_line);
        }
    }

    /// The line of the program that is a line of the reference.
    fn of_reference(&self, line: u32) -> Option<u32> {
        if self.is_all {
            return Some(line);
        }
        let at = self.stretches.partition_point(|[first, ..]| *first <= line).checked_sub(1)?;
        let [first, second, count] = self.stretches[at];
        (line < first + count).then(|| second + (line - first))
    }

    /// The line of the reference that is a line of the program.
    pub fn of_program(&self, line: u32) -> Option<u32> {
        let at = self.stretches.partition_point(|[_, second, _]| *second <= line).checked_sub(1)?;
        let [first, second, count] = self.stretches[at];
        (line < second + count).then(|| first + (line - second))
    }

    /// The findings of the reference that hold for the program: those of records and blocks that no
    /// author has changed, and of modes up to the first change.
    pub fn of_the_post(&self, mut report: Report) -> Report {
        let findings = std::mem::take(&mut report.findings);
        report.findings = findings.into_iter().filter_map(|found| self.holds(found)).collect();
        report
    }

    fn holds(&self, found: Finding) -> Option<Finding> {
        if found.cl_line.is_some_and(|line| self.touched.contains(&line)) {
            return None;
        }
        let Some(line) = found.nc_line else {
            let keeps = is_of_the_block(found.kind) || self.first.is_none();
            return keeps.then_some(found);
        };
        let line = self.of_reference(line)?;
        let is_before = self.first.is_none_or(|first| line < first);
        (is_before || is_of_the_block(found.kind))
            .then_some(Finding { nc_line: Some(line), ..found })
    }
}

/// True for a finding that what came before the block has no part in.
fn is_of_the_block(kind: FindingKind) -> bool {
    matches!(
        kind,
        FindingKind::Position
            | FindingKind::Arc
            | FindingKind::RapidForFeed
            | FindingKind::FeedForRapid
            | FindingKind::Thread
            | FindingKind::Missing
            | FindingKind::Cycle
            | FindingKind::Dwell
    )
}
