//! One change tried: a CL text around the statement, posted as it is and with the
//! change.

use crate::posting::{Posted, Prepared, Refused};

use super::statement::{AT_THE_END, Change, OF_AN_ITEM, Statement};

/// A text of at most so many statements is posted as a whole.
const WHOLE: usize = 40;

/// A longer text is never posted as a whole.
const LONGEST: usize = 1000;

/// Motions before the statement that stay in the text.
const MOTIONS_BEFORE: usize = 4;

/// Statements after it; fewer where the post refuses these.
const AFTER: [usize; 3] = [14, 5, 1];

/// A text around a statement: the whole one, or of a long one what stands before the
/// statement but most motions, the statement, some of what follows.
pub struct Window<'a> {
    before: String,
    statement: &'a Statement,
    after: String,
    outcome: Posted,
}

impl<'a> Window<'a> {
    /// The text around statement `at`: the whole text also where all shorter ones are
    /// refused and it is not too long; `None` when the post refuses it as it is.
    pub fn new(machine: &Prepared, all: &'a [Statement], at: usize) -> Option<Self> {
        let whole = || Self::of(machine, lines(&all[..at]), all, at, usize::MAX);
        if all.len() <= WHOLE {
            return whole();
        }
        let before = before(&all[..at]);
        AFTER
            .iter()
            .find_map(|count| Self::of(machine, before.clone(), all, at, *count))
            .or_else(|| if all.len() <= LONGEST { whole() } else { None })
    }

    fn of(
        machine: &Prepared,
        before: String,
        all: &'a [Statement],
        at: usize,
        count: usize,
    ) -> Option<Self> {
        let after = after(&all[at + 1..], count);
        let text = format!("{before}{}\n{after}", all[at].text);
        let outcome = machine.post(&text).ok()?;
        Some(Window { before, statement: &all[at], after, outcome })
    }

    /// True when a FIL section was run for the record of the statement.
    pub fn is_of_a_section(&self) -> bool {
        let line = 1 + self.before.matches('\n').count();
        self.outcome.sections.contains(&line)
    }

    /// True when the post says that it ignores the statement.
    pub fn is_ignored(&self) -> bool {
        let major = format!("W0552: {}: ", self.statement.major);
        self.outcome.warnings.iter().any(|warning| warning.starts_with(&major))
    }

    /// True when the post does or says something else for the changed statement.
    pub fn notices(&self, machine: &Prepared, changed: &str) -> bool {
        let text = format!("{}{changed}\n{}", self.before, self.after);
        match machine.post(&text) {
            Ok(posted) => posted != self.outcome,
            Err(Refused { .. }) => true,
        }
    }

    /// The changes of the statement that were tried, as index of the item and change,
    /// with whether they are noticed.
    pub fn tried(&self, machine: &Prepared) -> Vec<(usize, Change, bool)> {
        let count = self.statement.items.len();
        let items = (0..count).flat_map(|index| OF_AN_ITEM.map(|change| (index, change)));
        let end = AT_THE_END.map(|change| (count, change));
        let trial = |(index, change)| {
            let changed = self.statement.changed(index, change)?;
            Some((index, change, self.notices(machine, &changed)))
        };
        items.chain(end).filter_map(trial).collect()
    }
}

fn is_motion(statement: &Statement) -> bool {
    matches!(&statement.major[..], "GOTO" | "GODLTA" | "CIRCLE" | "RAPID")
}

fn lines(all: &[Statement]) -> String {
    all.iter().map(|one| format!("{}\n", one.text)).collect()
}

fn before(all: &[Statement]) -> String {
    let motions: Vec<usize> = (0..all.len()).filter(|at| is_motion(&all[*at])).collect();
    // A CIRCLE without its end, or a RAPID without its GOTO, would mean another motion.
    let first = motions.len().checked_sub(MOTIONS_BEFORE).map_or(0, |index| motions[index]);
    let kept: Vec<Statement> = (0..all.len())
        .filter(|at| !is_motion(&all[*at]) || *at >= first)
        .map(|at| all[at].clone())
        .collect();
    lines(&kept)
}

fn after(all: &[Statement], count: usize) -> String {
    let mut text = lines(&all[..count.min(all.len())]);
    if all.len() > count {
        text.push_str("FINI\n");
    }
    text
}
