//! Where an axis may stand: behind blocks that may be skipped with them and without them,
//! behind a text where the text has brought it.

use fil_machine::Letter;
use fil_machine::commons::EMPTY;

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
}

impl Levels {
    /// One position; [`EMPTY`] for one that is not known.
    pub(super) fn of(letter: Letter, value: f64) -> Self {
        if value == EMPTY { Self::unknown(letter) } else { Self::at(letter, value) }
    }

    fn at(letter: Letter, value: f64) -> Self {
        Levels { letter, low: value, high: value, unknown: false }
    }

    /// A position that is not known.
    pub(super) fn unknown(letter: Letter) -> Self {
        Levels { letter, low: f64::INFINITY, high: f64::NEG_INFINITY, unknown: true }
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

    /// The position, where there is one only.
    pub fn exact(self) -> Option<f64> {
        (!self.unknown && self.low == self.high).then_some(self.low)
    }

    /// They, if they are more than one and some position is known.
    pub(super) fn in_doubt(self) -> Option<Self> {
        (self.low < self.high || self.unknown && self.low == self.high).then_some(self)
    }
}
