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
            let (mantissa, end) = digits(text, point + 1, mantissa);
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

/// A whole item as a number: sign, digits, point, exponent with E or D.
/// `None` when it is none or not finite.
pub(super) fn number(item: &[u8]) -> Option<f64> {
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

    proptest! {
        #[test]
        fn fixed_point_agrees_with_the_standard_library(
            text in "[+-]?[0-9]{1,12}(\\.[0-9]{0,12})?"
        ) {
            let (expected, got) = (text.parse::<f64>().unwrap(), number(text.as_bytes()).unwrap());
            prop_assert_eq!(expected, got);
        }
    }
}
