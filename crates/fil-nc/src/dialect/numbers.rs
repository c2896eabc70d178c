//! Addresses: which letter is printed how, and what its numbers stand for.

use fil_machine::commons::Commons;
use fil_machine::locations::{self as loc, HomeFrame};

use super::int;
use crate::text::Number;

/// Tape positions are 1 to 52; 53 stands for "not written".
const SLOTS: i32 = 52;

const LETTER_P: u8 = 16;
const LETTER_Q: u8 = 17;
const LETTER_U: u8 = 21;

/// How many digits a number has before and after its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Digits {
    whole: u32,
    decimals: u32,
}

/// What a letter of the program is and how its numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Address {
    /// Its letter in the settings, 1 to 26.
    pub letter: u8,
    /// U, V, W of a lathe: an increment of X, Y, Z.
    pub increment: bool,
    inch: Digits,
    metric: Digits,
    /// Numbers carry a point.
    point: bool,
    /// A whole number may stand without its point.
    bare: bool,
    /// Zeros in front fill the number up.
    leading: bool,
    /// Zeros at the end are dropped, those of whole numbers too.
    dropped: bool,
}

/// Why a number can't be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// No point on an address that carries one: controls read it as millimetres or
    /// as the smallest step.
    NoPoint,
    /// Zeros are dropped on both sides.
    NoZeros,
    /// A point on an address of whole numbers: some controls read seconds in place of
    /// milliseconds, or millimetres in place of the smallest step, and others refuse it.
    Point,
}

impl Address {
    /// An address of whole numbers, for words that a setting need not name.
    pub(crate) fn plain(printed: u8) -> Self {
        address(printed.to_ascii_uppercase() - b'A' + 1, 9090, 0)
    }

    /// What a number of this address stands for.
    ///
    /// # Errors
    /// The number can be read in two ways.
    pub fn value(&self, number: Number, metric: bool) -> Result<f64, Unreadable> {
        if number.digits != 0 && number.point && self.counts_steps() {
            return Err(Unreadable::Point);
        }
        if number.point || number.digits == 0 {
            return Ok(number.value());
        }
        if self.point {
            return if self.bare { Ok(number.value()) } else { Err(Unreadable::NoPoint) };
        }
        let digits = if metric { self.metric } else { self.inch };
        let width = digits.whole + digits.decimals;
        let missing = width.saturating_sub(number.whole.into());
        let filled = match (self.dropped, self.leading) {
            (true, false) if missing > 0 => return Err(Unreadable::NoZeros),
            (true, true) => missing,
            _ => 0,
        };
        Ok(number.digits as f64 * libm::exp10(f64::from(filled) - f64::from(digits.decimals)))
    }

    /// P and Q in whole numbers: milliseconds, or smallest steps.
    fn counts_steps(&self) -> bool {
        let is_whole = !self.point && self.inch.decimals == 0 && self.metric.decimals == 0;
        is_whole && matches!(self.letter, LETTER_P | LETTER_Q)
    }
}

/// The machine's addresses by printed letter.
pub(super) fn addresses(commons: &Commons, lathe: bool) -> [Option<Address>; 26] {
    let mut table = [None; 26];
    let bare = int(commons, 4593) == Some(1);
    for letter in 1..=26u8 {
        let Some(slot) = int(commons, letter.into()).filter(|slot| (1..=SLOTS).contains(slot))
        else {
            continue;
        };
        let slot = slot as u32;
        let printed = int(commons, 52 + slot)
            .and_then(|code| u8::try_from(code).ok())
            .filter(u8::is_ascii_alphabetic)
            .unwrap_or(b'A' + letter - 1)
            .to_ascii_uppercase();
        let format = int(commons, 105 + slot).unwrap_or(0).clamp(0, 9999);
        let spec = int(commons, 158 + slot).unwrap_or(0).clamp(0, 9999);
        let place = usize::from(printed - b'A');
        if table[place].is_none() {
            table[place] = Some(Address { bare, ..address(letter, format, spec) });
        }
    }
    if lathe {
        let home = commons.read(loc::HOME_FRAME);
        let by_increments =
            matches!(home, HomeFrame::ReferencePoint | HomeFrame::SecondReferencePoint);
        add_increments(&mut table, by_increments);
    }
    table
}

/// Reads the format (`abcd`: inch a.b, metric c.d digits) and the specification (plus
/// sign, leading zeros, trailing zeros, point).
fn address(letter: u8, format: i32, spec: i32) -> Address {
    let digit = |value: i32, place: i32| (value / place % 10) as u32;
    Address {
        letter,
        increment: false,
        inch: Digits { whole: digit(format, 1000), decimals: digit(format, 100) },
        metric: Digits { whole: digit(format, 10), decimals: digit(format, 1) },
        point: digit(spec, 1) == 1,
        bare: false,
        leading: digit(spec, 100) == 1,
        dropped: digit(spec, 10) == 2,
    }
}

/// On a lathe U, V, W are the increments of X, Y, Z unless they are something else. Where the way
/// home is one of increments, they are that whatever their format.
fn add_increments(table: &mut [Option<Address>; 26], goes_home_by_them: bool) {
    for letter in LETTER_U..LETTER_U + 3 {
        let axis = table.iter().flatten().find(|address| address.letter == letter + 3).copied();
        let place = &mut table[usize::from(letter - 1)];
        if place.is_none() || goes_home_by_them {
            *place = axis.map(|axis| Address { increment: true, ..axis });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::read_block;

    fn number(text: &str) -> Number {
        read_block(text.as_bytes(), "test", 1).unwrap().words[0].number
    }

    fn read(format: i32, spec: i32, text: &str) -> Result<f64, Unreadable> {
        address(24, format, spec).value(number(text), true)
    }

    #[test]
    fn a_point_is_always_believed() {
        assert_eq!(read(3443, 1, "X-.5"), Ok(-0.5));
        assert_eq!(read(4343, 0, "P5.5"), Ok(5.5));
    }

    #[test]
    fn a_lost_point_is_not_guessed() {
        assert_eq!(read(3443, 1, "X83"), Err(Unreadable::NoPoint));
        assert_eq!(read(3443, 1, "X0"), Ok(0.0));
        let bare = Address { bare: true, ..address(24, 3443, 1) };
        assert_eq!(bare.value(number("X83"), true), Ok(83.0));
    }

    #[test]
    fn implied_decimals_count_from_the_right() {
        assert_eq!(read(3443, 0, "X83000"), Ok(83.0));
        assert_eq!(read(3443, 100, "X0083000"), Ok(83.0));
        assert_eq!(address(24, 3443, 0).value(number("X10000"), false), Ok(1.0));
        assert_eq!(read(2020, 0, "G81"), Ok(81.0));
    }

    #[test]
    fn dropped_zeros_are_filled_up_where_the_front_is_known() {
        assert_eq!(read(3443, 120, "X0083"), Ok(83.0));
        assert_eq!(read(3443, 20, "X83"), Err(Unreadable::NoZeros));
        assert_eq!(read(3443, 20, "X1234567"), Ok(1234.567));
    }
}
