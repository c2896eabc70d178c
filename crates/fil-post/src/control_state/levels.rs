//! Where an axis may stand behind blocks that may be skipped: with them and without them.

use fil_machine::commons::EMPTY;
use fil_machine::{Commons, Letter};

/// The positions at which an axis may stand, values of the tape in mm or inch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// Its letter.
    pub letter: Letter,
    /// The lowest position that is known; above [`Self::high`] where none is.
    pub low: f64,
    /// The highest position that is known.
    pub high: f64,
    /// It may stand at a position that is not known, too.
    pub unknown: bool,
    /// The last output value that they were found with: any other is from a later motion.
    pub(crate) last: f64,
}

impl Levels {
    /// One position; [`EMPTY`] for one that is not known.
    pub(super) fn of(letter: Letter, value: f64) -> Self {
        let unknown = value == EMPTY;
        let (low, high) = if unknown { (f64::INFINITY, f64::NEG_INFINITY) } else { (value, value) };
        Levels { letter, low, high, unknown, last: value }
    }

    /// All positions of both.
    pub(super) fn or(self, other: Self) -> Self {
        Levels {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            unknown: self.unknown || other.unknown,
            ..self
        }
    }

    /// The position that is lowest on the machine, if any is known.
    pub(super) fn lowest(self, counts_down: bool) -> Option<f64> {
        (self.low <= self.high).then_some(if counts_down { self.high } else { self.low })
    }

    /// They, if they are more than one, for the last output value in force.
    pub(super) fn behind(self, commons: &Commons) -> Option<Self> {
        let differ = self.low < self.high || self.unknown && self.low == self.high;
        differ.then(|| Levels { last: commons.last_output(self.letter), ..self })
    }

    /// True when nothing has moved the axis since.
    pub(super) fn counts_from(self, last: f64) -> bool {
        self.last == last
    }
}
