//! How a value may be rounded to its address: a position to the nearest digit, a
//! number that names something not at all, a rate only a little.

use fil_diag::Result;

use crate::letter::Letter;
use crate::number::NumberFormat;

/// Share of a feed, speed, peck or dwell that rounding may change: 1 %. Our own
/// reading of what a format promises.
const RATE: f64 = 0.01;

/// Share of a lead that rounding may change: 0.05 %, 10 micrometres on 20 mm of
/// thread. Our own reading.
const LEAD: f64 = 0.0005;

/// What rounding may do to a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest last digit: positions, angles, arc centers.
    Nearest,
    /// Not at all, and never below zero: tools, offsets, sequence and program numbers.
    Exact,
    /// Not at all, and of either sign: a shift of the zero, an angle to stop at.
    ExactLength,
    /// A little, and never to zero: feeds, speeds, pecks, dwells.
    Rate,
    /// Next to nothing: the lead of a thread or a tap.
    Lead,
}

impl Rounding {
    /// What the words of a letter stand for on a word-address control (ISO 6983).
    #[inline]
    pub fn of(letter: Letter) -> Self {
        match letter.byte() {
            b'D' | b'G' | b'H' | b'L' | b'M' | b'N' | b'O' | b'T' => Rounding::Exact,
            b'E' | b'F' | b'P' | b'Q' | b'S' => Rounding::Rate,
            _ => Rounding::Nearest,
        }
    }

    /// The value as a scaled integer of the format.
    ///
    /// # Errors
    /// A value that does not fit the format, or that it would change too much.
    #[inline]
    pub fn scale(self, value: f64, format: &NumberFormat) -> Result<i64> {
        match self {
            Rounding::Nearest => format.scale(value),
            Rounding::Exact => format.exact(value),
            Rounding::ExactLength => format.exact_length(value),
            Rounding::Rate => format.within(value, RATE),
            Rounding::Lead => format.within(value, LEAD),
        }
    }
}
