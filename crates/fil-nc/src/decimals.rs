//! Numbers for people.

use fil_machine::digits::{push_fraction, push_number};

/// Digits of a double in twos, without the first.
const BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// Parts of one by the number of decimals.
static SCALES: [u32; 10] =
    [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000, 1_000_000_000];

/// A number with at most so many digits after the point (one or more), without
/// zeros at its end and without a minus before zero.
pub fn short(value: f64, decimals: u8) -> String {
    let mut out = Vec::new();
    push_short(&mut out, value, decimals);
    String::from_utf8(out).unwrap_or_default()
}

/// Appends a number as [`short`] tells it.
pub fn push_short(out: &mut Vec<u8>, value: f64, decimals: u8) {
    let Some((whole, fraction)) = rounded(value, decimals) else {
        let text = format!("{value:.*}", usize::from(decimals));
        let text = text.trim_end_matches('0').trim_end_matches('.');
        return out.extend_from_slice(if text == "-0" { b"0" } else { text.as_bytes() });
    };
    if value < 0.0 && (whole, fraction) != (0, 0) {
        out.push(b'-');
    }
    push_number(out, whole);
    if fraction != 0 {
        out.push(b'.');
        push_fraction(out, fraction, decimals, false);
    }
}

/// The size of a number in whole parts and in parts of the last digit, half to even, from all that
/// it has; `None` for one that is too large or too small for it.
fn rounded(value: f64, decimals: u8) -> Option<(u64, u32)> {
    if value == 0.0 {
        return Some((0, 0));
    }
    let scale = *SCALES.get(usize::from(decimals))?;
    let bits = value.abs().to_bits();
    let mantissa = bits & ((1 << BITS) - 1) | 1 << BITS;
    // The number is the mantissa divided by two so often.
    let halved = (1023 + u64::from(BITS)).checked_sub(bits >> BITS)?;
    if !(1..127).contains(&halved) {
        return None;
    }
    let scaled = u128::from(mantissa) * u128::from(scale);
    let floor = u64::try_from(scaled >> halved).ok()?;
    let (rest, half) = (scaled & ((1 << halved) - 1), 1 << (halved - 1));
    let up = rest > half || rest == half && floor % 2 == 1;
    let scaled = floor.checked_add(u64::from(up))?;
    Some((scaled / u64::from(scale), (scaled % u64::from(scale)) as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// As the standard library writes it.
    fn written(value: f64, decimals: u8) -> String {
        let text = format!("{value:.*}", usize::from(decimals));
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" { "0" } else { text }.to_string()
    }

    #[test]
    fn halves_go_to_the_even_digit() {
        let numbers =
            [0.0, -0.0, 0.125, 0.375, -0.0625, 0.0005, 1e-9, -1e-30, 1e15, 1e19, 0.999_95];
        for value in numbers {
            for decimals in 1..=9 {
                assert_eq!(short(value, decimals), written(value, decimals), "{value}");
            }
        }
        assert_eq!(short(f64::NAN, 3), "NaN");
        assert_eq!(short(-0.0001, 3), "0");
        assert_eq!(short(0.125, 2), "0.12");
    }

    proptest! {
        #[test]
        fn a_number_is_rounded_from_all_of_its_digits(bits: u64, parts: i32, decimals in 1u8..=9) {
            for value in [f64::from_bits(bits), f64::from(parts) / 1e4, f64::from(parts) / 1024.0] {
                prop_assert_eq!(short(value, decimals), written(value, decimals));
            }
        }
    }
}
