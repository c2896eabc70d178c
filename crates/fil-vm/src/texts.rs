//! Work on texts. Positions count characters from 1.

use crate::library::NumberRules;

/// Most digits after the point that TEXT/CONVF writes.
pub(crate) const MOST_DECIMALS: usize = 9;

/// Whole numbers below this are exact, so that their digits mean something.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// Byte position of a character, or the end for the position behind the last one.
fn byte_of(text: &str, character: usize) -> Option<usize> {
    let ends = text.char_indices().map(|(at, _)| at).chain(std::iter::once(text.len()));
    ends.into_iter().nth(character.checked_sub(1)?)
}

/// Number of characters.
pub(crate) fn length(text: &str) -> usize {
    text.chars().count()
}

/// Position of the first `wanted` at or after a character.
pub(crate) fn position(text: &str, wanted: &str, from: usize) -> Option<usize> {
    let start = byte_of(text, from)?;
    let found = start + text[start..].find(wanted)?;
    Some(length(&text[..found]) + 1)
}

/// Characters `from` to `to`; `None` where the text does not have them.
pub(crate) fn part(text: &str, from: usize, to: usize) -> Option<&str> {
    let start = byte_of(text, from)?;
    let end = byte_of(text, to.checked_add(1)?)?;
    text.get(start..end)
}

/// The last `count` characters; `None` where there are fewer.
pub(crate) fn last(text: &str, count: usize) -> Option<&str> {
    part(text, length(text).checked_sub(count)? + 1, length(text))
}

/// The number a text holds: sign, digits, point and exponent (E or D).
pub(crate) fn number(text: &str) -> Option<f64> {
    let text = text.trim_matches([' ', '\t']);
    let begins =
        text.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let value: f64 = text.replace(['D', 'd'], "E").parse().ok()?;
    (begins && value.is_finite()).then_some(value)
}

/// A number as text, without width; `None` where its digits would not be exact.
///
/// Without `decimals` it is the shortest text that is read as the same number.
/// With them it is rounded half away from zero, as numbers of the tape are.
pub(crate) fn digits(number: f64, decimals: Option<usize>, rules: NumberRules) -> Option<String> {
    let mut text = match decimals {
        None => format!("{}", number.abs()),
        Some(decimals) => {
            let scaled = (number.abs() * 10u64.pow(decimals as u32) as f64).round();
            if scaled >= EXACT {
                return None;
            }
            let mut text = format!("{:0>least$}", scaled as u64, least = decimals + 1);
            if decimals > 0 {
                text.insert(text.len() - decimals, '.');
            }
            text
        }
    };
    if rules.trim && text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    let is_zero = text.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    if rules.point && !text.contains('.') {
        text.push('.');
    }
    if rules.no_lead && !is_zero && text.starts_with("0.") {
        text.remove(0);
    }
    if is_zero {
        return Some(text);
    }
    let sign = match () {
        () if number < 0.0 => "-",
        () if rules.plus => "+",
        () => "",
    };
    Some(format!("{sign}{text}"))
}

/// A written number right in its width; `None` where it is wider. Width 0 takes
/// any.
pub(crate) fn in_width(text: String, width: usize, rules: NumberRules) -> Option<String> {
    if width == 0 {
        return Some(text);
    }
    let blank = width.checked_sub(text.len())?;
    if rules.zeros {
        let sign = text.len() - text.trim_start_matches(['+', '-']).len();
        return Some(format!("{}{}{}", &text[..sign], "0".repeat(blank), &text[sign..]));
    }
    Some(format!("{}{text}", " ".repeat(blank)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(words: &str) -> NumberRules {
        let mut rules = NumberRules::default();
        assert!(words.split_whitespace().all(|word| rules.take(word)));
        rules
    }

    fn written(x: f64, width: usize, decimals: Option<usize>, words: &str) -> Option<String> {
        digits(x, decimals, rules(words)).and_then(|text| in_width(text, width, rules(words)))
    }

    #[test]
    fn positions_count_characters() {
        let text = "Ø10 Fräser";
        assert_eq!(length(text), 10);
        assert_eq!(part(text, 1, 3), Some("Ø10"));
        assert_eq!(part(text, 4, 3), Some(""));
        assert_eq!(part(text, 11, 10), Some(""));
        assert_eq!(part(text, 5, 11), None);
        assert_eq!(part(text, 0, 3), None);
        assert_eq!(part(text, 5, 2), None);
        assert_eq!(last(text, 6), Some("Fräser"));
        assert_eq!(last(text, 0), Some(""));
        assert_eq!(last(text, 11), None);
        assert_eq!(position(text, "r", 1), Some(6));
        assert_eq!(position(text, "r", 7), Some(10));
        assert_eq!(position(text, "r", 11), None);
        assert_eq!(position(text, "r", 99), None);
    }

    #[test]
    fn only_whole_numbers_are_numbers() {
        for (text, value) in
            [(" 12.5 ", 12.5), ("-.5", -0.5), ("1D3", 1000.0), ("+7", 7.0), ("5.", 5.0)]
        {
            assert_eq!(number(text), Some(value), "{text}");
        }
        for text in ["", " ", "inf", "nan", "-infinity", "1 2", "0x10", "1E999", "12mm", "--1", "."]
        {
            assert_eq!(number(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_are_written_by_their_rules() {
        for (x, width, decimals, words, wanted) in [
            (5.0, 0, None, "", "5"),
            (-0.0, 0, None, "", "0"),
            (0.1 + 0.2, 0, None, "", "0.30000000000000004"),
            (5.25, 0, Some(3), "", "5.250"),
            (5.25, 0, Some(3), "TRIM", "5.25"),
            (5.0, 0, Some(3), "TRIM", "5"),
            (5.0, 0, Some(3), "TRIM POINT", "5."),
            (50.0, 0, Some(0), "TRIM", "50"),
            (0.786, 0, Some(3), "NOLEAD", ".786"),
            (-0.786, 0, Some(3), "NOLEAD", "-.786"),
            (0.0, 0, Some(2), "NOLEAD PLUS", "0.00"),
            (2.5, 0, Some(0), "", "3"),
            (-2.5, 0, Some(0), "", "-3"),
            (-0.0004, 0, Some(3), "", "0.000"),
            (12.0, 4, Some(0), "ZEROS", "0012"),
            (-12.0, 6, Some(1), "ZEROS", "-012.0"),
            (12.0, 6, Some(1), "PLUS", " +12.0"),
        ] {
            assert_eq!(written(x, width, decimals, words).as_deref(), Some(wanted), "{x} {words}");
        }
        assert_eq!(written(12345.0, 4, Some(0), ""), None);
        assert_eq!(written(1e16, 0, Some(2), ""), None);
    }
}
