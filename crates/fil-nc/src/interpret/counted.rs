//! Which spindle of a lathe the control counts: threads, feeds a turn, S and the codes of a spindle
//! without its own are those of one of the two, which SETMS of a SINUMERIK or M codes of the
//! machine's builder choose. What the other one does goes on meanwhile.

use super::Fault;
use super::state::State;
use super::words::Words;
use crate::dialect::Auxiliary;
use crate::errors::NcCode;
use crate::motion::{Speed, Spindle};

/// What holds of a spindle while the other one is counted, besides how it turns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OtherSpindle {
    speed: Option<Speed>,
    limit: Option<f64>,
    range: Option<u8>,
    orientation: Option<f64>,
}

fn refuse<T>(why: &str) -> Result<T, Fault> {
    Err(Fault::new(NcCode::NoMeaning, why))
}

impl State<'_> {
    /// The control counts the second spindle, or the main one.
    pub(super) fn count(&mut self, side: bool) -> Result<(), Fault> {
        if self.surface {
            return refuse("another spindle is counted while S is a surface speed");
        }
        let before = self.modes.counts_side.replace(side) == Some(true);
        if before == side {
            return Ok(());
        }
        let (modes, other) = (&mut self.modes, &mut self.other_spindle);
        std::mem::swap(&mut modes.spindle, &mut modes.other_spindle);
        std::mem::swap(&mut modes.speed, &mut other.speed);
        std::mem::swap(&mut modes.spindle_range, &mut other.range);
        std::mem::swap(&mut modes.orientation, &mut other.orientation);
        if self.dialect.turning.counted.has_own_limits {
            std::mem::swap(&mut modes.speed_limit, &mut other.limit);
        }
        Ok(())
    }

    /// The codes of one spindle turn that one, counted or not.
    pub(super) fn turn_one(&mut self, side: bool, turn: Spindle) {
        let is_counted = (self.modes.counts_side == Some(true)) == side;
        match is_counted || !self.dialect.turning.counted.has_own_codes {
            true => self.turn_spindle(turn),
            false => self.modes.other_spindle = turn,
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
