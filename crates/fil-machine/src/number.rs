//! Number output: one function writes every number of the tape.
//!
//! A value becomes a scaled integer (rounded half away from zero) and is
//! written by the rules of its address: format (digits before and after the
//! point), specification (sign, leading and trailing zeros, point) and the
//! decimal rule of the tape.

use fil_diag::{Diag, Result};

use crate::digits::{Digits, Text, push_fraction, push_number, push_padded};
use crate::errors::MachineCode;
use crate::locations::TapeDecimalRule;

static POWERS: [f64; 10] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// Most digits of a format, before and after the point.
const MAX_DIGITS: usize = 18;

/// By number of digits: the least whole number that does not fit. A static: a constant is
/// copied where it is looked into.
static LIMITS: [i64; MAX_DIGITS + 1] = {
    let mut limits = [1; MAX_DIGITS + 1];
    let mut digits = 1;
    while digits <= MAX_DIGITS {
        limits[digits] = 10 * limits[digits - 1];
        digits += 1;
    }
    limits
};

/// Relative difference below which a value counts as held exactly: what a few
/// operations on doubles leave.
const EXACT: f64 = 1e-9;

/// How an address writes its numbers.
///
/// The specification is read as four decimal digits `p l t d`: `p` plus sign
/// printed, `l` leading zeros (padded to the format when there is no point,
/// one zero before the point otherwise), `t` trailing zeros (0 dropped after
/// the point, 1 kept, 2 dropped in whole numbers too), `d` decimal point.
/// The digits are our reading of the values 0, 1 and 100 seen in real files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NumberFormat {
    /// Digits before the point.
    pub whole: u8,
    /// Digits after the point.
    pub decimals: u8,
    /// Print `+`.
    pub plus: bool,
    /// Leading zeros.
    pub leading: bool,
    /// Keep trailing zeros after the point.
    pub trailing: bool,
    /// Drop trailing zeros of whole numbers as well (N10 is N1).
    pub drop_whole_zeros: bool,
    /// Print the decimal point.
    pub point: bool,
    /// The tape's decimal rule.
    pub rule: TapeDecimalRule,
}

impl NumberFormat {
    /// Reads a format number (`abcd`: inch a.b, metric c.d) and a specification.
    pub fn from_commons(format: i32, spec: i32, metric: bool, rule: TapeDecimalRule) -> Self {
        let format = format.clamp(0, 9999);
        let spec = spec.clamp(0, 9999);
        let digit = |value: i32, place: i32| ((value / place) % 10) as u8;
        let (whole, decimals) = if metric {
            (digit(format, 10), digit(format, 1))
        } else {
            (digit(format, 1000), digit(format, 100))
        };
        NumberFormat {
            whole,
            decimals,
            plus: digit(spec, 1000) == 1,
            leading: digit(spec, 100) == 1,
            trailing: digit(spec, 10) == 1,
            drop_whole_zeros: digit(spec, 10) == 2,
            point: digit(spec, 1) == 1,
            rule,
        }
    }

    /// The same with the digits of another format.
    pub fn with_digits(self, format: i32, metric: bool) -> Self {
        let digits = NumberFormat::from_commons(format, 0, metric, self.rule);
        NumberFormat { whole: digits.whole, decimals: digits.decimals, ..self }
    }

    /// The value as a scaled integer: rounded half away from zero to the
    /// last digit of the format.
    ///
    /// # Errors
    /// A value that is not finite or has more digits than the format.
    #[inline]
    pub fn scale(&self, value: f64) -> Result<i64> {
        let scaled = value * POWERS[self.decimals as usize];
        let limit = LIMITS[usize::from(self.whole + self.decimals)];
        if scaled.abs() < limit as f64 {
            let rounded = round(scaled);
            if rounded.abs() < limit {
                return Ok(rounded);
            }
        }
        Err(self.overflow(value))
    }

    /// The value as a scaled integer, for a number whose every digit counts (a
    /// tool, an offset).
    ///
    /// # Errors
    /// As [`NumberFormat::scale`]; a value that the format would round; one below zero.
    #[inline]
    pub fn exact(&self, value: f64) -> Result<i64> {
        let whole = value as i64;
        // A whole number of a format of whole numbers is its own scaled value.
        if self.decimals == 0
            && whole as f64 == value
            && (0..LIMITS[self.whole as usize]).contains(&whole)
        {
            return Ok(whole);
        }
        self.exact_decimal(value)
    }

    fn exact_decimal(&self, value: f64) -> Result<i64> {
        if value < 0.0 {
            return Err(self.negative(value));
        }
        self.exact_length(value)
    }

    /// The value as a scaled integer, for a length of either sign that each point takes: a
    /// rest that the format drops would be an error of all of them.
    ///
    /// # Errors
    /// As [`NumberFormat::scale`]; a value that the format would round.
    pub fn exact_length(&self, value: f64) -> Result<i64> {
        let scaled = self.scale(value)?;
        if (self.unscale(scaled) - value).abs() > EXACT * value.abs().max(1.0) {
            return Err(self.inexact(value, scaled));
        }
        Ok(scaled)
    }

    /// The value as a scaled integer that differs from it by at most `share` of it:
    /// a feed, a lead, a peck or a dwell. Zero never comes from rounding.
    ///
    /// # Errors
    /// As [`NumberFormat::scale`]; a value that rounding would change by more.
    #[inline]
    pub fn within(&self, value: f64, share: f64) -> Result<i64> {
        let scaled = self.scale(value)?;
        // Counted in last digits: to divide takes longer than all the rest.
        let exact = value * POWERS[self.decimals as usize];
        if (scaled as f64 - exact).abs() > share * exact.abs() {
            return Err(self.changed(value, scaled, share));
        }
        Ok(scaled)
    }

    #[cold]
    fn negative(&self, value: f64) -> Box<Diag> {
        MachineCode::Overflow
            .diag(format!("{value}: a number that names something is not negative"))
    }

    #[cold]
    fn inexact(&self, value: f64, scaled: i64) -> Box<Diag> {
        MachineCode::Inexact.diag(format!(
            "{value} would be written as {}, with {} digits after the point",
            self.unscale(scaled),
            self.decimals
        ))
    }

    #[cold]
    fn changed(&self, value: f64, scaled: i64, share: f64) -> Box<Diag> {
        MachineCode::Inexact.diag(format!(
            "{value} would be written as {}, off by more than {} %",
            self.unscale(scaled),
            share * 100.0
        ))
    }

    #[cold]
    fn overflow(&self, value: f64) -> Box<Diag> {
        let message = format!("{value} does not fit {}.{} digits", self.whole, self.decimals);
        MachineCode::Overflow.diag(message)
    }

    /// True for a whole number of no more digits than there are before the point.
    #[inline]
    pub fn holds_whole(&self, number: u32) -> bool {
        i64::from(number) < LIMITS[usize::from(self.whole)]
    }

    /// The value a scaled integer stands for.
    #[inline]
    pub fn unscale(&self, scaled: i64) -> f64 {
        scaled as f64 / POWERS[self.decimals as usize]
    }

    /// Appends a scaled integer by the rules of the address.
    pub fn write(&self, scaled: i64, out: &mut Vec<u8>) {
        self.write_after(Text::default(), scaled, out);
    }

    /// Appends a letter and a scaled integer by the rules of the address.
    #[inline]
    pub fn write_word(&self, letter: u8, scaled: i64, out: &mut Vec<u8>) {
        let mut text = Text::default();
        text.push(letter);
        self.write_after(text, scaled, out);
    }

    /// Appends what is there of a word, and a scaled integer.
    #[inline]
    fn write_after(&self, mut text: Text, scaled: i64, out: &mut Vec<u8>) {
        if scaled < 0 {
            text.push(b'-');
        } else if self.plus {
            text.push(b'+');
        }
        let size = scaled.unsigned_abs();
        let places = Digits::COUNT.checked_sub(usize::from(self.decimals));
        match (Digits::of(size), places) {
            (Some(digits), Some(places @ 1..)) if self.point => {
                self.put_with_point(digits, places, &mut text);
                text.append_to(out);
            }
            (Some(digits), _) if !self.point && !self.leading && !self.drop_whole_zeros => {
                // Of a zero the last digit is written.
                let first = digits.zeros_before().min(Digits::COUNT - 1);
                text.digits(digits, first, Digits::COUNT);
                text.append_to(out);
            }
            _ => {
                text.append_to(out);
                self.write_long(size, out);
            }
        }
    }

    /// Puts a number of eight digits, of which so many come before the point: it is parted where
    /// its digits are, as a division takes longer than all the rest.
    #[inline]
    fn put_with_point(&self, digits: Digits, places: usize, text: &mut Text) {
        let (first, last) = (digits.zeros_before(), digits.up_to_last());
        let has_fraction = last > places;
        if first < places || self.leading || !has_fraction {
            text.digits(digits, first.min(places - 1), places);
        }
        let has_digits = has_fraction || self.trailing && self.decimals != 0;
        if has_digits || self.rule != TapeDecimalRule::PointOnlyIfNeeded {
            text.push(b'.');
        }
        if has_digits {
            text.digits(digits, places, if self.trailing { Digits::COUNT } else { last });
        } else if self.rule == TapeDecimalRule::AtLeastOneDigitAfterThePoint {
            text.push(b'0');
        }
    }

    /// Writes a number of more digits, or one by rarer rules.
    #[cold]
    fn write_long(&self, size: u64, out: &mut Vec<u8>) {
        if !self.point {
            return self.write_plain(size, out);
        }
        // The fraction has at most nine digits, as many as a format can name.
        let power = LIMITS[usize::from(self.decimals)] as u64;
        let (whole, fraction) = (size / power, (size % power) as u32);
        if whole != 0 || self.leading || fraction == 0 {
            push_number(out, whole);
        }
        let has_digits = fraction != 0 || self.trailing && self.decimals != 0;
        if has_digits || self.rule != TapeDecimalRule::PointOnlyIfNeeded {
            out.push(b'.');
        }
        if has_digits {
            push_fraction(out, fraction, self.decimals, self.trailing);
        } else if self.rule == TapeDecimalRule::AtLeastOneDigitAfterThePoint {
            out.push(b'0');
        }
    }

    fn write_plain(&self, size: u64, out: &mut Vec<u8>) {
        let mut width = usize::from(self.whole + self.decimals);
        let mut rest = size;
        while self.drop_whole_zeros && rest != 0 && rest.is_multiple_of(10) {
            rest /= 10;
            width = width.saturating_sub(1);
        }
        if self.leading { push_padded(out, rest, width) } else { push_number(out, rest) }
    }
}

/// Least rest that is rounded up. A value computed as just below the half (a turn of a
/// rotary axis leaves 1e-13) is the half itself; else the same point would be written with
/// another last digit each time it is reached another way.
const HALF: f64 = 0.5 - 1e-7;

/// The nearest whole number, half away from zero, of a value below 10^18. The
/// rest after the cut is exact; `f64::round` would be a call on most builds.
#[inline]
fn round(value: f64) -> i64 {
    let whole = value as i64;
    let rest = value - whole as f64;
    whole + i64::from(rest >= HALF) - i64::from(rest <= -HALF)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(format: i32, spec: i32, rule: TapeDecimalRule, value: f64) -> String {
        let format = NumberFormat::from_commons(format, spec, true, rule);
        let mut out = Vec::new();
        format.write(format.scale(value).unwrap(), &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn decimal_numbers_by_rule() {
        let always = |spec, value| text(3443, spec, TapeDecimalRule::AsTheAddress, value);
        assert_eq!(always(1, 83.0), "83.");
        assert_eq!(always(1, -0.7857), "-.786");
        assert_eq!(always(1, 0.0), "0.");
        assert_eq!(always(1, -0.0001), "0.");
        assert_eq!(always(101, 0.05), "0.05");
        assert_eq!(always(11, 1.5), "1.500");
        assert_eq!(always(1001, 1.5), "+1.5");
        assert_eq!(text(3443, 1, TapeDecimalRule::AtLeastOneDigitAfterThePoint, 83.0), "83.0");
        assert_eq!(text(3443, 1, TapeDecimalRule::AtLeastOneDigitAfterThePoint, 0.0), "0.0");
        assert_eq!(text(3443, 101, TapeDecimalRule::PointOnlyIfNeeded, 83.0), "83");
        assert_eq!(text(3443, 101, TapeDecimalRule::PointOnlyIfNeeded, 0.25), "0.25");
    }

    #[test]
    fn whole_numbers_by_rule() {
        let whole = |format, spec, value| text(format, spec, TapeDecimalRule::AsTheAddress, value);
        assert_eq!(whole(2020, 100, 0.0), "00");
        assert_eq!(whole(2020, 100, 43.0), "43");
        assert_eq!(whole(4040, 0, 250.0), "250");
        assert_eq!(whole(4040, 20, 10.0), "1");
        assert_eq!(whole(4040, 20, 0.0), "0");
        assert_eq!(whole(4040, 100, 10.0), "0010");
    }

    #[test]
    fn inch_uses_the_first_half_of_the_format() {
        let format = NumberFormat::from_commons(3443, 1, false, TapeDecimalRule::AsTheAddress);
        assert_eq!((format.whole, format.decimals), (3, 4));
        assert_eq!(format.scale(0.12345).unwrap(), 1235);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let format = NumberFormat::from_commons(3443, 1, true, TapeDecimalRule::AsTheAddress);
        assert_eq!(format.scale(9999.9994).unwrap(), 9_999_999);
        for value in [9999.9996, -10_000.0, f64::NAN, f64::INFINITY] {
            assert_eq!(format.scale(value).unwrap_err().code.name(), "E0501", "{value}");
        }
    }

    #[test]
    fn a_half_is_rounded_away_from_zero() {
        for value in [0.4999998, 0.5, 1.5, 2.5, 4503599627370495.5, 9.9e17] {
            for value in [value, -value] {
                assert_eq!(round(value), value.round() as i64, "{value}");
            }
        }
    }

    proptest::proptest! {
        #[test]
        fn short_and_long_numbers_are_written_alike(
            size in 0u64..100_000_000, shift in 0u32..9, decimals in 0u8..8,
            leading: bool, trailing: bool, point: bool, rule in 0..3
        ) {
            let rule = [TapeDecimalRule::AsTheAddress, TapeDecimalRule::PointOnlyIfNeeded, TapeDecimalRule::AtLeastOneDigitAfterThePoint][rule as usize];
            let size = size / 10u64.pow(shift);
            let format = NumberFormat { decimals, leading, trailing, point, rule, ..NumberFormat::default() };
            let (mut short, mut long) = (Vec::new(), Vec::new());
            format.write(size as i64, &mut short);
            format.write_long(size, &mut long);
            proptest::prop_assert_eq!(short, long);
        }

        #[test]
        fn rounding_agrees_with_the_standard_library(value in -1e18f64..1e18, scale in 0..20) {
            let value = value / libm::exp10(f64::from(scale));
            proptest::prop_assume!((value.fract().abs() - HALF).abs() > 1e-6);
            proptest::prop_assert_eq!(round(value), value.round() as i64);
        }

        #[test]
        fn what_computing_leaves_of_a_half_is_a_half(
            whole in 0u32..10_000_000, noise in -1e-8f64..1e-8
        ) {
            let value = f64::from(whole) + 0.5 + noise;
            proptest::prop_assert_eq!(round(value), i64::from(whole) + 1);
            proptest::prop_assert_eq!(round(-value), -i64::from(whole) - 1);
        }

        #[test]
        fn output_reads_back_to_the_rounded_value(
            value in -9999.0f64..9999.0, leading: bool, trailing: bool, plus: bool, rule in 0..3
        ) {
            let rule = [TapeDecimalRule::AsTheAddress, TapeDecimalRule::PointOnlyIfNeeded, TapeDecimalRule::AtLeastOneDigitAfterThePoint][rule as usize];
            let spec = 1 + 10 * i32::from(trailing) + 100 * i32::from(leading) + 1000 * i32::from(plus);
            let format = NumberFormat::from_commons(3443, spec, true, rule);
            let scaled = format.scale(value).unwrap();
            let mut out = Vec::new();
            format.write(scaled, &mut out);
            let read: f64 = std::str::from_utf8(&out).unwrap().parse().unwrap();
            proptest::prop_assert_eq!(read, format.unscale(scaled));
            proptest::prop_assert!((read - value).abs() <= 0.000_500_001);
        }
    }
}
