//! Decimal numbers.

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// A 64-bit integer cannot overflow below this many digits.
const SAFE_DIGITS: usize = 19;

/// The fixed-point number at the start of `text` and its length in bytes.
///
/// `None` when there is none, or when it has too many digits for the exact way:
/// an integer up to 2^53 divided by an exact power of ten is correctly rounded.
#[inline]
pub(super) fn fixed_point(text: &[u8]) -> Option<(f64, usize)> {
    let negative = *text.first()? == b'-';
    let start = usize::from(negative || text[0] == b'+');
    let (mantissa, point) = digits(text, start, 0);
    let (mantissa, end, decimals) = match text.get(point) {
        Some(b'.') => {
            let (mantissa, rest) = eights(text, point + 1, mantissa);
            let (mantissa, end) = digits(text, rest, mantissa);
            (mantissa, end, end - point - 1)
        }
        _ => (mantissa, point, 0),
    };
    let count = point - start + decimals;
    if count == 0 || count > SAFE_DIGITS || mantissa > 1 << 53 || decimals >= POWERS.len() {
        return None;
    }
    let size = mantissa as f64 / POWERS[decimals];
    // A zero has no sign: -0.0 would turn arc tangents half a turn.
    Some((if negative && mantissa != 0 { -size } else { size }, end))
}

/// Appends the digits from `at` on to an integer; gives it and where they end.
#[inline]
fn digits(text: &[u8], mut at: usize, mut value: u64) -> (u64, usize) {
    while let Some(digit) = text.get(at).map(|byte| byte.wrapping_sub(b'0')) {
        if digit > 9 {
            break;
        }
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    (value, at)
}

/// As [`digits`], for as long as eight digits stand together: CL files write
/// ten decimals, and eight digits at once take as long as two one by one.
#[inline]
fn eights(text: &[u8], mut at: usize, mut value: u64) -> (u64, usize) {
    while let Some(bytes) = text[at..].first_chunk() {
        let Some(eight) = eight_digits(*bytes) else { break };
        value = value.wrapping_mul(100_000_000).wrapping_add(eight);
        at += 8;
    }
    (value, at)
}

/// The number eight digits write; `None` when one of the bytes is no digit.
///
/// The bytes are added up as lanes of one integer, the first digit in the
/// lowest lane: to four numbers below 100, to two below 10^4, to one.
#[inline]
fn eight_digits(bytes: [u8; 8]) -> Option<u64> {
    let lanes = u64::from_le_bytes(bytes) ^ u64::from_le_bytes([b'0'; 8]);
    // Adding 118 sets the high bit of a lane above 9; a carry into the next
    // lane comes only from one that has the bit itself.
    let above = lanes.wrapping_add(u64::from_le_bytes([118; 8])) | lanes;
    if above & u64::from_le_bytes([0x80; 8]) != 0 {
        return None;
    }
    let pairs = (lanes * 10 + (lanes >> 8)) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_FFFF_0000_FFFF;
    Some((fours * 10_000 + (fours >> 32)) & 0xFFFF_FFFF)
}

/// A whole item as a number: sign, digits, point, exponent with E or D.
/// `None` when it is none or not finite.
pub(crate) fn number(item: &[u8]) -> Option<f64> {
    if let Some((value, end)) = fixed_point(item)
        && end == item.len()
    {
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
    let skip_sign = |at: usize| at + usize::from(matches!(item.get(at), Some(b'+' | b'-')));
    let start = skip_sign(0);
    let (_, point) = digits(item, start, 0);
    let mut end = point;
    let mut count = point - start;
    if item.get(point) == Some(&b'.') {
        (_, end) = digits(item, point + 1, 0);
        count += end - point - 1;
    }
    if count > 0 && matches!(item.get(end), Some(b'e' | b'E' | b'd' | b'D')) {
        let exponent = skip_sign(end + 1);
        (_, end) = digits(item, exponent, 0);
        count = end - exponent;
    }
    count > 0 && end == item.len()
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
        assert_eq!(eight_digits(*b"00000000"), Some(0));
        assert_eq!(eight_digits(*b"12345678"), Some(12_345_678));
        assert_eq!(eight_digits(*b"99999999"), Some(99_999_999));
        for at in 0..8 {
            for byte in (0..=255u8).filter(|byte| !byte.is_ascii_digit()) {
                let mut bytes = *b"98765432";
                bytes[at] = byte;
                assert_eq!(eight_digits(bytes), None, "{bytes:?}");
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
