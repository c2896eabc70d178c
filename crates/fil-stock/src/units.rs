//! Numbers with units in descriptions of stock and tools.

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// A description without the unit at its end, and the mm of its unit: `in` or `mm`, mm when left
/// out.
pub(crate) fn split_unit(text: &str) -> (&str, f64) {
    let text = text.trim();
    let unit = |suffix: &str| text.strip_suffix(suffix).filter(|rest| ends_in_number(rest));
    match (unit("in"), unit("mm")) {
        (Some(rest), _) => (rest.trim_end(), INCH),
        (None, Some(rest)) => (rest.trim_end(), 1.0),
        (None, None) => (text, 1.0),
    }
}

/// A length above 0 with its unit, such as `0.5`, `0.5mm` or `0.02in`, in mm.
pub fn length(text: &str) -> Option<f64> {
    let (number, unit) = split_unit(text);
    numbers(number, ',', unit)
        .filter(|values| values.len() == 1 && values[0] > 0.0)
        .map(|values| values[0])
}

/// Three coordinates with commas between and perhaps a unit, in mm.
pub fn place(text: &str) -> Option<[f64; 3]> {
    let (values, unit) = split_unit(text);
    <[f64; 3]>::try_from(numbers(values, ',', unit)?).ok()
}

fn ends_in_number(text: &str) -> bool {
    text.trim_end().ends_with(|last: char| last.is_ascii_digit() || last == '.')
}

/// Finite numbers with a separator between, in mm.
pub(crate) fn numbers(text: &str, separator: char, unit: f64) -> Option<Vec<f64>> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    text.split(separator).map(|text| Some(number(text)? * unit)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_at_the_end() {
        assert_eq!(split_unit("4x3x1in"), ("4x3x1", 25.4));
        assert_eq!(split_unit("4x3x1 mm"), ("4x3x1", 1.0));
        assert_eq!(split_unit("4x3x1"), ("4x3x1", 1.0));
        assert_eq!(split_unit("bin"), ("bin", 1.0));
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!(numbers("1,-2.5", ',', 2.0), Some(vec![2.0, -5.0]));
        assert_eq!(numbers("1,nan", ',', 1.0), None);
        assert_eq!(numbers("1,,2", ',', 1.0), None);
    }
}
