//! The text of a program beside its path: the numbers that say where a motion ends stand in the
//! path already, so a sign stands for each of them in the text.
//!
//! A sign stands only where the script of the page makes the same number of the path again, from
//! whole numbers; all other text stays as it is.

use std::io;

use super::Trace;
use super::pack::Grid;

/// The letters of the axes.
const AXES: &[u8; 3] = b"XYZ";

/// Most digits of a number on either side of its point.
const MOST_DIGITS: usize = 9;

/// Signs for a number without a zero before its point, and with one.
const SIGNS: [u8; 2] = [1, 2];

/// Hands the text of a program over with signs for the ends of its motions, in parts; as it is, and
/// false, where it has such signs of its own.
pub(super) fn spell(
    text: &str,
    trace: &Trace,
    grid: &Grid,
    out: &mut dyn FnMut(&[u8]) -> io::Result<()>,
) -> io::Result<bool> {
    let text = text.as_bytes();
    let [sign, other] = SIGNS;
    if memchr::memchr2(sign, other, text).is_some() {
        out(text)?;
        return Ok(false);
    }
    let ends = ends(trace);
    let mut begin = 0;
    // What is handed over is a run of the text up to a number, then a sign.
    let mut from = 0;
    for line in 1.. {
        if begin == text.len() {
            break;
        }
        let rest = &text[begin..];
        let end = begin + memchr::memchr(b'\n', rest).map_or(rest.len(), |at| at + 1);
        let point = ends.get(line).and_then(|end| trace.points.get(*end as usize));
        if let Some(point) = point.map(|point| grid.counts(point)) {
            let mut at = begin;
            while at < end {
                let axis = AXES.iter().position(|axis| *axis == text[at]);
                at += 1;
                let Some(axis) = axis else { continue };
                let number = &text[at..end];
                let length = number.iter().take_while(|byte| is_of_number(**byte)).count();
                let told = counted(&number[..length], grid.decimals);
                if let Some((_, sign)) = told.filter(|(count, _)| *count == point[axis]) {
                    out(&text[from..at])?;
                    out(&[sign])?;
                    at += length;
                    from = at;
                }
            }
        }
        begin = end;
    }
    out(&text[from..])?;
    Ok(true)
}

fn is_of_number(byte: u8) -> bool {
    byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+')
}

/// By line, the index of the last point of its last piece; beyond all points for a line without
/// one.
fn ends(trace: &Trace) -> Vec<u32> {
    let lines = trace.pieces.iter().map(|piece| piece.line as usize + 1).max().unwrap_or(0);
    let mut ends = vec![u32::MAX; lines];
    for piece in &trace.pieces {
        ends[piece.line as usize] = piece.end - 1;
    }
    ends
}

/// A number as a count of the last of so many decimals, and its sign; `None` for one that the script
/// would spell otherwise: with zeros at its end, before its first digit, or without a point.
fn counted(number: &[u8], decimals: usize) -> Option<(i64, u8)> {
    let size = number.strip_prefix(b"-").unwrap_or(number);
    let point = size.iter().position(|byte| *byte == b'.')?;
    let (whole, fraction) = (&size[..point], &size[point + 1..]);
    let digits = |text: &[u8]| {
        let next = |value: i64, byte: &u8| {
            byte.is_ascii_digit().then(|| 10 * value + i64::from(byte - b'0'))
        };
        text.iter().try_fold(0, next).filter(|_| text.len() <= MOST_DIGITS)
    };
    let is_short = fraction.last() != Some(&b'0');
    let sign = match (whole, fraction) {
        ([], []) => None,
        ([b'0'], [_, ..]) => Some(SIGNS[1]),
        ([b'0', _, ..], _) => None,
        _ => Some(SIGNS[0]),
    };
    let scale = |digits: usize| 10i64.pow(digits as u32);
    let count = digits(whole)? * scale(decimals)
        + digits(fraction)? * scale(decimals.checked_sub(fraction.len())?);
    let is_negative = size.len() < number.len();
    let sign = sign.filter(|_| is_short && !(is_negative && count == 0))?;
    Some((if is_negative { -count } else { count }, sign))
}

#[cfg(test)]
mod tests {
    use super::super::{Extent, Piece, Stroke};
    use super::*;
    use fil_machine::Unit;

    fn of(text: &str, points: &[[f64; 3]]) -> String {
        let piece = |index: usize| Piece {
            stroke: Stroke::Feed,
            line: index as u32 + 1,
            start: index.saturating_sub(1) as u32,
            end: index as u32 + 1,
        };
        let pieces = (0..points.len()).map(piece).collect();
        let trace = Trace { points: points.to_vec(), pieces, ..Trace::default() };
        let grid = Grid::new(&Extent::of(points).expect("points"), Unit::Mm);
        let mut spelled = Vec::new();
        let mut take = |part: &[u8]| {
            spelled.extend_from_slice(part);
            Ok(())
        };
        super::spell(text, &trace, &grid, &mut take).expect("a vector takes all");
        String::from_utf8(spelled).expect("a text")
    }

    #[test]
    fn ends_of_motions_are_left_to_the_path() {
        let points = [[1.5, -0.25, 10.0], [-3.0, 0.0, 10.0]];
        let text = "N10 G1 X1.5 Y-.25 Z10. F5\nN20 X-3. Y0. (X-3.)\nM30\n";
        assert_eq!(
            of(text, &points),
            "N10 G1 X\u{1} Y\u{1} Z\u{1} F5\nN20 X\u{1} Y\u{1} (X\u{1})\nM30\n"
        );
        assert_eq!(of("X1.5 Y-0.25\n", &points), "X\u{1} Y\u{2}\n");
    }

    /// As the script of the page spells a count.
    fn spell(count: i64, decimals: usize, sign: u8) -> String {
        let digits = format!("{:0width$}", count.unsigned_abs(), width = decimals + 1);
        let (whole, fraction) = digits.split_at(digits.len() - decimals);
        let fraction = fraction.trim_end_matches('0');
        let whole = if sign == 1 && whole == "0" && !fraction.is_empty() { "" } else { whole };
        format!("{}{whole}.{fraction}", if count < 0 { "-" } else { "" })
    }

    #[test]
    fn a_number_that_is_counted_is_spelled_as_it_was() {
        let numbers =
            ["0.", "1.", "-.5", "-0.5", "0.0001", ".0001", "123.456", "-10.", "100.", "7.0009"];
        for number in numbers {
            let (count, sign) = counted(number.as_bytes(), 4).expect(number);
            assert_eq!(spell(count, 4, sign), number);
        }
        let others =
            ["", "-", ".", "0", "1", "-0.", "00.5", "01.", "1.0", "0.00001", "1.2.3", "1-.2"];
        for number in others {
            assert_eq!(counted(number.as_bytes(), 4), None, "{number}");
        }
    }

    #[test]
    fn what_the_path_does_not_say_stays() {
        let points = [[1.5, -0.25, 10.0]];
        for text in ["X1.50 Y-.26 Z10\n", "X1.5.\n", "X+1.5 I1.5\n", "X\u{1}1.5\n", "X\n", ""] {
            assert_eq!(of(text, &points), text);
        }
        assert_eq!(of("M3\nX1.5\n", &points), "M3\nX1.5\n", "a line without a motion");
    }
}
