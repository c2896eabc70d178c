//! Decimal numbers.

/// Powers of ten that a double holds exactly.
static POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Powers of ten up to eight digits.
static TENS: [u64; 9] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// The highest bit of each of eight bytes.
const HIGH_BITS: u64 = u64::from_le_bytes([0x80; 8]);

/// A 64-bit integer cannot overflow below this many digits.
const SAFE_DIGITS: usize = 19;

/// The fixed-point number at the start of `text`, and the text behind it.
///
/// `None` when there is none, or when it has too many digits for the exact way:
/// an integer up to 2^53 divided by an exact power of ten is correctly rounded.
#[inline]
pub(crate) fn fixed_point(text: &[u8]) -> Option<(f64, &[u8])> {
    let (negative, text) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (mantissa, behind) = digits(text, 0);
    let whole = text.len() - behind.len();
    let (mantissa, behind, decimals) = match behind {
        [b'.', fraction @ ..] => {
            let (mantissa, behind) = long_digits(fraction, mantissa);
            (mantissa, behind, fraction.len() - behind.len())
        }
        _ => (mantissa, behind, 0),
    };
    if !(1..=SAFE_DIGITS).contains(&(whole + decimals)) || mantissa > 1 << 53 {
        return None;
    }
    let size = mantissa as f64 / POWERS.get(decimals)?;
    // A zero has no sign: -0.0 would turn arc tangents half a turn.
    Some((if negative && mantissa != 0 { -size } else { size }, behind))
}

/// Appends the digits at the start of a text to an integer; gives it and the text behind.
#[inline]
fn digits(mut text: &[u8], mut value: u64) -> (u64, &[u8]) {
    while let [byte, rest @ ..] = text {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        text = rest;
    }
    (value, text)
}

/// As [`digits`], the first eight at once: they take as long as four one by one.
#[inline]
fn long_digits(text: &[u8], value: u64) -> (u64, &[u8]) {
    let Some((bytes, rest)) = text.split_first_chunk() else { return digits(text, value) };
    let (number, count) = leading_digits(*bytes);
    let value = value.wrapping_mul(TENS[count]).wrapping_add(number);
    if count < 8 { (value, &text[count..]) } else { digits(rest, value) }
}

/// The number that the digits at the start of eight bytes write, and how many they are.
///
/// The bytes are lanes of one integer, the first in the lowest lane. What is no digit is
/// shifted out, so that zeros stand in front; then the lanes are added up: to four numbers
/// below 100, to two below 10^4, to one.
#[inline]
fn leading_digits(bytes: [u8; 8]) -> (u64, usize) {
    let lanes = u64::from_le_bytes(bytes) ^ u64::from_le_bytes([b'0'; 8]);
    // Adding 118 sets the high bit of a lane above 9; a carry into the next
    // lane comes only from one that has the bit itself.
    let above = (lanes.wrapping_add(u64::from_le_bytes([118; 8])) | lanes) & HIGH_BITS;
    let count = (above.trailing_zeros() / 8) as usize;
    if count == 0 {
        return (0, 0);
    }
    let lanes = if count == 8 { lanes } else { lanes << (64 - 8 * count) };
    let pairs = (lanes * 10 + (lanes >> 8)) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_FFFF_0000_FFFF;
    ((fours * 10_000 + (fours >> 32)) & 0xFFFF_FFFF, count)
}

/// A whole item as a number: sign, digits, point, exponent with E or D.
/// `None` when it is none or not finite.
pub(crate) fn number(item: &[u8]) -> Option<f64> {
    if let Some((value, [])) = fixed_point(item) {
        return Some(value);
    }
    if !is_decimal(item) {
        return None;
    }
    let text = std::str::from_utf8(item).ok()?.replace(['d', 'D'], "E");
    let value: f64 = text.parse().ok()?;
    value.is_finite().then_some(value + 0.0)
}

/// Checks the form; the standard parser would take `inf` and `nan` too.
fn is_decimal(item: &[u8]) -> bool {
    let item = without_sign(item);
    let (_, behind) = digits(item, 0);
    let fraction = behind.strip_prefix(b".").unwrap_or(behind);
    let (_, end) = digits(fraction, 0);
    let has_digits = behind.len() < item.len() || end.len() < fraction.len();
    match end {
        [] => has_digits,
        [b'e' | b'E' | b'd' | b'D', exponent @ ..] => {
            let exponent = without_sign(exponent);
            has_digits && !exponent.is_empty() && digits(exponent, 0).1.is_empty()
        }
        _ => false,
    }
}

fn without_sign(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"+").or(text.strip_prefix(b"-")).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn forms() {
        assert_eq!(number(b"-7.2290790757"), Some(-7.2290790757));
        assert_eq!(number(b"25."), Some(25.0));
        assert_eq!(number(b".005061"), Some(0.005061));
        assert_eq!(number(b"+4"), Some(4.0));
        assert_eq!(number(b"1.5E-3"), Some(0.0015));
        assert_eq!(number(b"1.5d2"), Some(150.0));
        assert_eq!(number(b"123456789.12345678901234"), "123456789.12345678901234".parse().ok());
        for bad in ["", ".", "-", "+.", "12.3.4", "1.0X", "1E", "1E+", "inf", "NaN", "1e999"] {
            assert_eq!(number(bad.as_bytes()), None, "{bad}");
        }
    }

    #[test]
    fn a_zero_has_no_sign() {
        for zero in ["-0.0000000000", "-0", "-0e0", "-0.00000000000000000000000000"] {
            assert!(number(zero.as_bytes()).unwrap().is_sign_positive(), "{zero}");
        }
    }

    #[test]
    fn eight_digits_at_once() {
        assert_eq!(leading_digits(*b"00000000"), (0, 8));
        assert_eq!(leading_digits(*b"12345678"), (12_345_678, 8));
        assert_eq!(leading_digits(*b"99999999"), (99_999_999, 8));
        for at in 0..8 {
            for byte in (0..=255u8).filter(|byte| !byte.is_ascii_digit()) {
                let mut bytes = *b"98765432";
                bytes[at] = byte;
                let before = "98765432"[..at].parse().unwrap_or(0);
                assert_eq!(leading_digits(bytes), (before, at), "{bytes:?}");
            }
        }
    }

    proptest! {
        #[test]
        fn fixed_point_agrees_with_the_standard_library(
            text in "[+-]?[0-9]{1,12}(\\.[0-9]{0,12})?|[+-]?[0-9]{0,2}\\.[0-9]{1,17}"
        ) {
            let (expected, got) = (text.parse::<f64>().unwrap(), number(text.as_bytes()).unwrap());
            prop_assert_eq!(expected, got);
        }
    }
}
