//! Which spindle of a lathe the control counts: threads, feeds a turn, S and the codes of a spindle
//! without its own are those of one of the two, which SETMS of a SINUMERIK or M codes of the
//! machine's builder choose. What the other one does goes on meanwhile.

use super::state::State;
use super::words::Words;
use super::{Fault, refuse};
use crate::dialect::Auxiliary;
use crate::motion::Spindle;

impl State<'_> {
    /// The control counts the second spindle, or the main one.
    pub(super) fn count(&mut self, side: bool) -> Result<(), Fault> {
        if self.surface {
            return refuse("another spindle is counted while S is a surface speed");
        }
        let before = self.modes.master.is_side.replace(side) == Some(true);
        if before == side {
            return Ok(());
        }
        let (master, other) = (&mut self.modes.spindle, &mut self.other_spindle);
        other.turn = self.modes.master.other;
        std::mem::swap(master, other);
        if !self.dialect.turning.counted.has_own_limits {
            std::mem::swap(&mut master.speed_limit, &mut other.speed_limit);
        }
        self.modes.master.other = other.turn;
        Ok(())
    }

    /// The codes of one spindle turn that one, counted or not.
    pub(super) fn turn_one(&mut self, side: bool, turn: Spindle) {
        let is_counted = (self.modes.master.is_side == Some(true)) == side;
        match is_counted || !self.dialect.turning.counted.has_own_codes {
            true => self.turn_spindle(turn),
            false => self.modes.master.other = turn,
        }
    }

    /// A code that chooses the spindle stands alone: of which one S in its block would be is not
    /// plain.
    pub(super) fn check_choice(&self, words: &Words) -> Result<(), Fault> {
        let chooses = words.auxiliaries.iter().any(|(one, _)| matches!(one, Auxiliary::Counts(_)));
        if chooses && (words.auxiliaries.len() > 1 || words.has(b'S' - b'A' + 1)) {
            return refuse("the spindle that is counted is chosen beside other words of a spindle");
        }
        Ok(())
    }
}
