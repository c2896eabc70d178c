//! Why a change of an item need not be noticed.

use std::ops::RangeInclusive;

use filpost::no_effect::{self, NoEffect};
use filpost::{Commons, locations as loc};

use super::statement::{Change, Statement};

/// The row of the table for what Creo says in comments.
const ARROW: &str = "$$->";

/// An arc of a smaller radius than this, mm, is a point in the last digit.
const LAST_DIGIT: f64 = 0.001;

/// Why a change may pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excuse {
    /// A row of the table of things without effect.
    Row(NoEffect),
    /// Another reason.
    Other(&'static str),
}

impl Excuse {
    /// The row, if it is one.
    pub fn row(self) -> Option<NoEffect> {
        match self {
            Excuse::Row(row) => Some(row),
            Excuse::Other(_) => None,
        }
    }
}

/// A statement among those of its file, on its machine.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// The statements of the file.
    pub all: &'a [Statement],
    /// Which one is meant.
    pub at: usize,
    /// The machine.
    pub commons: &'a Commons,
    /// The dialect of the file reads it as a statement without effect.
    pub inert: bool,
}

impl Setting<'_> {
    fn statement(&self) -> &Statement {
        &self.all[self.at]
    }

    /// The row of the table of things without effect; that the machine lists the word; or
    /// why the statement as a whole can't act where it is.
    pub fn excuse(&self, index: usize, change: Change) -> Option<Excuse> {
        let statement = self.statement();
        let listed = self.commons.words_without_effect();
        if listed.contains(&statement.major) {
            return Some(Excuse::Other("the machine lists the word as without effect"));
        }
        if self.inert {
            return Some(Excuse::Other("the dialect reads it as without effect"));
        }
        let no_time = change == Change::DropCouplet
            && statement.items.len() > index + 1
            && statement.item(index) == "DWELL"
            && statement.item(index + 1).parse() == Ok(0.0);
        if no_time {
            return Some(Excuse::Other("a dwell of no time"));
        }
        // NX names a deep hole by both words.
        let is_said_twice = change == Change::Drop
            && statement.major == "CYCLE"
            && index == 0
            && statement.item(0) == "DRILL"
            && statement.items.len() > 1
            && ["DEEP", "BRKCHP"].contains(&&statement.item(1)[..]);
        if is_said_twice {
            return Some(Excuse::Other("DRILL,DEEP of NX is DEEP"));
        }
        let row = no_effect::rows().find(|row| self.covers(row, index, change));
        row.map(Excuse::Row).or_else(|| self.dead().map(Excuse::Other))
    }

    /// True when a row of the table says that the change has no effect.
    fn covers(&self, row: &NoEffect, index: usize, change: Change) -> bool {
        let statement = self.statement();
        let in_comment = row.major == ARROW && statement.in_comment && statement.major != "CUTTER";
        // MOVARC is a CIRCLE that tells its angle.
        let major = if statement.major == "MOVARC" { "CIRCLE" } else { &statement.major[..] };
        if row.major != major && !in_comment {
            return false;
        }
        if row.item == "*" {
            return true;
        }
        let left_out = matches!(change, Change::Drop | Change::DropCouplet);
        if row.left_out_only && !left_out {
            return false;
        }
        if let Some(numbers) = numbers(row.item) {
            let is_number = change == Change::AddNumber || statement.is_number(index);
            return is_number && numbers.contains(&(index + 1));
        }
        if index >= statement.items.len() {
            return false;
        }
        let item = statement.item(index);
        match change {
            Change::Drop if item == row.item => row.left_out_only,
            Change::DropCouplet if item == row.item => true,
            Change::Other if statement.word_before(index).as_deref() == Some(row.item) => true,
            _ => self.is_named(row.item, index),
        }
    }

    /// True for an item that a row describes in words.
    fn is_named(&self, name: &str, index: usize) -> bool {
        let statement = self.statement();
        match name {
            "the text" => {
                let fixed = self.commons.read(loc::PROGRAM_NUMBER).is_some();
                let named = self.commons.read(loc::PROGRAM_NAME_COMMENT);
                self.commons.read(loc::PROGRAM_NUMBER_ADDRESS).is_none() || (fixed && !named)
            }
            "the tool" => !self.commons.read(loc::TOOL_PRESELECT),
            "the center's coordinate along the axis" => {
                let axis = |item: usize| statement.item(item).parse::<f64>().map(f64::abs);
                index < 3 && statement.items.len() >= 6 && axis(index + 3) == Ok(1.0)
            }
            _ => false,
        }
    }

    /// Why the statement can't act where it is: the file is at its end, or what the
    /// statement says is said again before anything uses it.
    fn dead(&self) -> Option<&'static str> {
        if self.all[..self.at].iter().any(|one| one.major == "FINI") {
            return Some("after FINI");
        }
        let statement = self.statement();
        let motions: &[&str] = &["GOTO", "GODLTA", "CYCLE", "CIRCLE"];
        match &statement.major[..] {
            "FEDRAT" => self.unused(motions, "FEDRAT"),
            "FROM" => self.unused(&["GODLTA", "CIRCLE"], "GOTO"),
            "UNITS" => self.unused(&["GOTO", "GODLTA", "CYCLE", "FROM", "FEDRAT"], "FINI"),
            "LOADTL" => self.unused(motions, "LOADTL"),
            "CUTCOM" => self.unused(motions, "CUTCOM"),
            "MULTAX" => (!self.later().any(has_sloping_axis)).then_some("no tool axis follows"),
            "CIRCLE" => {
                let radius = statement.items.len().checked_sub(1).map(|last| statement.item(last));
                let radius = radius.and_then(|radius| radius.parse::<f64>().ok());
                radius.is_some_and(|radius| radius < LAST_DIGIT).then_some("a point on the tape")
            }
            _ => None,
        }
    }

    /// The statements after this one that are carried out.
    fn later(&self) -> impl Iterator<Item = &Statement> {
        self.all[self.at + 1..].iter().take_while(|one| one.major != "FINI")
    }

    fn unused(&self, uses: &[&str], again: &str) -> Option<&'static str> {
        let mut words = self.later().map(|one| &one.major[..]);
        let next = words.find(|word| *word == again || uses.contains(word));
        next.is_none_or(|word| word == again).then_some("said again before anything uses it")
    }
}

fn has_sloping_axis(statement: &Statement) -> bool {
    let upright = |index: &usize| statement.item(*index).parse() == Ok([0.0, 0.0, 1.0][index - 3]);
    statement.major == "GOTO" && statement.items.len() == 6 && !(3..6).all(|index| upright(&index))
}

/// The items that `number 7: …` or `numbers 8 to 11: …` means.
fn numbers(item: &str) -> Option<RangeInclusive<usize>> {
    let (numbers, _) = item.strip_prefix("number")?.split_once(':')?;
    match numbers.strip_prefix('s').unwrap_or(numbers).split_once(" to ") {
        Some((first, last)) => Some(first.trim().parse().ok()?..=last.trim().parse().ok()?),
        None => numbers.trim().parse().ok().map(|number| number..=number),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::statement::statements;

    fn setting<'a>(all: &'a [Statement], at: usize, commons: &'a Commons) -> Setting<'a> {
        Setting { all, at, commons, inert: false }
    }

    #[test]
    fn only_what_a_row_says_is_excused() {
        let commons = loc::default_commons();
        let all = statements(
            "LOADTL / 1, LENGTH, 5.\nSPINDL / RPM, 100., CCLW\nCIRCLE / 0, 0, 0, 0, 0, 1, 5\n\
             GOTO / 1, 2, 3\nFINI\n",
        );
        let excused =
            |at, index, change| setting(&all, at, &commons).excuse(index, change).is_some();
        assert!(excused(0, 2, Change::Other) && excused(0, 1, Change::DropCouplet));
        assert!(!excused(0, 1, Change::Banana) && !excused(0, 0, Change::Other));
        assert!(excused(1, 0, Change::Drop) && !excused(1, 0, Change::Banana));
        assert!(!excused(1, 2, Change::Drop) && !excused(1, 1, Change::Other));
        assert!(excused(2, 2, Change::Other) && !excused(2, 1, Change::Other));
        assert!(excused(2, 6, Change::Drop) && !excused(2, 6, Change::Other));
        assert!(!excused(3, 0, Change::Other) && !excused(3, 3, Change::AddNumber));
    }

    #[test]
    fn a_feed_that_nothing_uses_is_dead() {
        let commons = loc::default_commons();
        let all = statements("FEDRAT / 5.\nRAPID\nFEDRAT / 6.\nGOTO / 1, 2, 3\nFINI\nGOTO / 4\n");
        let dead = |at| setting(&all, at, &commons).dead().is_some();
        assert!(dead(0) && !dead(2) && !dead(3) && dead(5));
    }
}
