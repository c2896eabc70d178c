//! Digits of whole numbers, eight at once: a step for each digit would cost a guess of the
//! processor at each end of a number.

/// Digits that are made at once.
const LANES: usize = 8;

/// A number of more digits is at least this.
const LIMIT: u64 = 100_000_000;

/// Powers of ten up to eight digits.
static TENS: [u32; LANES + 1] =
    [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// The eight digits of a number below 10^8, with zeros before it.
#[derive(Clone, Copy)]
pub struct Digits(u64);

impl Digits {
    /// How many there are.
    pub const COUNT: usize = LANES;

    /// Those of a number; `None` for one that has more.
    #[inline]
    pub fn of(number: u64) -> Option<Digits> {
        (number < LIMIT).then(|| Digits(lanes(number as u32)))
    }

    /// How many zeros come before the first other digit; all eight in zero.
    #[inline]
    pub fn zeros_before(self) -> usize {
        self.0.trailing_zeros() as usize / 8
    }

    /// How many digits there are up to the last that is no zero; none in zero.
    #[inline]
    pub fn up_to_last(self) -> usize {
        LANES - self.0.leading_zeros() as usize / 8
    }

    /// Appends those from one on, at most seven, up to before another.
    #[inline]
    fn push(self, out: &mut Vec<u8>, from: usize, to: usize) {
        push_lanes(out, self.0 >> (8 * from), to - from);
    }
}

/// A word that is put together in one place: a vector is asked for room once.
#[derive(Default)]
pub struct Text {
    bytes: [u8; 32],
    length: usize,
}

impl Text {
    /// Appends a character.
    #[inline]
    pub fn push(&mut self, character: u8) {
        self.bytes[self.length] = character;
        self.length += 1;
    }

    /// Appends digits from one on, at most seven, up to before another.
    #[inline]
    pub fn digits(&mut self, digits: Digits, from: usize, to: usize) {
        let text = (digits.0 >> (8 * from)) | u64::from_le_bytes([b'0'; LANES]);
        self.bytes[self.length..self.length + LANES].copy_from_slice(&text.to_le_bytes());
        self.length += to - from;
    }

    /// Appends all of it to a vector.
    #[inline]
    pub fn append_to(&self, out: &mut Vec<u8>) {
        let end = out.len() + self.length;
        out.extend_from_slice(&self.bytes);
        out.truncate(end);
    }
}

/// Appends a number without zeros before it.
#[inline]
pub fn push_number(out: &mut Vec<u8>, number: u64) {
    match Digits::of(number) {
        // Of a zero the last digit is written.
        Some(digits) => digits.push(out, digits.zeros_before().min(LANES - 1), LANES),
        None => push_long(out, number),
    }
}

#[cold]
fn push_long(out: &mut Vec<u8>, number: u64) {
    push_number(out, number / LIMIT);
    push_lanes(out, lanes((number % LIMIT) as u32), LANES);
}

/// Appends a number with zeros before it up to a width.
pub fn push_padded(out: &mut Vec<u8>, number: u64, width: usize) {
    let digits = number.checked_ilog10().map_or(1, |power| power as usize + 1);
    out.resize(out.len() + width.saturating_sub(digits), b'0');
    push_number(out, number);
}

/// Appends the digits behind a decimal point: of a fraction with at most nine of them, all
/// or those up to the last that is not zero.
#[inline]
pub fn push_fraction(out: &mut Vec<u8>, fraction: u32, decimals: u8, all: bool) {
    let decimals = usize::from(decimals);
    let Some(left_out) = LANES.checked_sub(decimals) else {
        return push_long_fraction(out, fraction, all);
    };
    let lanes = lanes(fraction * TENS[left_out]);
    let written = if all { decimals } else { LANES - lanes.leading_zeros() as usize / 8 };
    push_lanes(out, lanes, written);
}

/// The same for one of nine digits.
#[cold]
fn push_long_fraction(out: &mut Vec<u8>, fraction: u32, all: bool) {
    let last = fraction % 10;
    let has_last = all || last != 0;
    push_fraction(out, fraction / 10, LANES as u8, has_last);
    if has_last {
        out.push(b'0' + last as u8);
    }
}

/// The digits of a number below 10^8, one a byte, the first in the lowest.
///
/// The number is parted into two of four digits, these into four of two, these into eight.
/// Each step divides all its parts by one multiplication: 5243 / 2^19 is a hundredth for
/// parts below 43,699, and 103 / 2^10 a tenth for parts below 179.
#[inline]
fn lanes(number: u32) -> u64 {
    let number = u64::from(number);
    let fours = (number / 10_000) | ((number % 10_000) << 32);
    let hundreds = ((fours * 5243) >> 19) & 0x0000_007F_0000_007F;
    let pairs = hundreds | ((fours - 100 * hundreds) << 16);
    let tens = ((pairs * 103) >> 10) & 0x000F_000F_000F_000F;
    tens | ((pairs - 10 * tens) << 8)
}

/// Appends the first digits of eight. All eight are copied, since a copy of fixed length
/// takes a moment, and one of any length a call.
#[inline]
fn push_lanes(out: &mut Vec<u8>, lanes: u64, count: usize) {
    let end = out.len() + count;
    out.extend_from_slice(&(lanes | u64::from_le_bytes([b'0'; LANES])).to_le_bytes());
    out.truncate(end);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn text(write: impl FnOnce(&mut Vec<u8>)) -> String {
        let mut out = b"N".to_vec();
        write(&mut out);
        String::from_utf8(out).unwrap()[1..].to_string()
    }

    #[test]
    fn numbers_at_the_ends_of_the_lanes() {
        for number in [0, 9, 10, 99, 100, 9_999, 10_000, LIMIT - 1, LIMIT, LIMIT + 1, u64::MAX] {
            assert_eq!(text(|out| push_number(out, number)), number.to_string());
        }
        assert_eq!(text(|out| push_padded(out, 10, 4)), "0010");
        assert_eq!(text(|out| push_padded(out, 0, 2)), "00");
        assert_eq!(text(|out| push_padded(out, 12345, 4)), "12345");
    }

    proptest! {
        #[test]
        fn a_number_has_its_digits(number: u64, places in 0u32..20) {
            let number = number / 10u64.pow(places);
            prop_assert_eq!(text(|out| push_number(out, number)), number.to_string());
            let padded = text(|out| push_padded(out, number, 12));
            prop_assert_eq!(padded, format!("{number:012}"));
        }

        #[test]
        fn a_fraction_has_its_digits(fraction: u32, decimals in 1u8..=9) {
            let fraction = (u64::from(fraction) % 10u64.pow(u32::from(decimals))) as u32;
            let all = format!("{fraction:0width$}", width = usize::from(decimals));
            let written = |all| text(|out| push_fraction(out, fraction, decimals, all));
            prop_assert_eq!(written(true), all.clone());
            prop_assert_eq!(written(false), all.trim_end_matches('0'));
        }
    }
}
