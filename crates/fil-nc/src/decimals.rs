//! Numbers for people.

/// A number with at most so many digits after the point (one or more), without
/// zeros at its end and without a minus before zero.
pub fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_string() } else { text.to_string() }
}
