//! The text of a program beside its path: the numbers that say where a motion ends stand in the
//! path already, so a sign stands for each of them in the text.
//!
//! A sign stands only where the script of the page makes the same number of the path again, from
//! whole numbers; all other text stays as it is.

use super::Trace;
use super::pack::Grid;

/// The letters of the axes.
const AXES: &[u8; 3] = b"XYZ";

/// Most digits of a number on either side of its point.
const MOST_DIGITS: usize = 9;

/// Signs for a number without a zero before its point, and with one.
const SIGNS: [u8; 2] = [1, 2];

/// The text of a program with signs for the ends of its motions; `None` for one that has such signs
/// of its own.
pub(super) fn spelled(text: &str, trace: &Trace, grid: &Grid) -> Option<Vec<u8>> {
    if text.bytes().any(|byte| SIGNS.contains(&byte)) {
        return None;
    }
    let mut out = Vec::with_capacity(text.len());
    let ends = ends(trace);
    for (index, line) in text.as_bytes().split_inclusive(|byte| *byte == b'\n').enumerate() {
        let end = ends.get(index + 1).and_then(|end| trace.points.get(*end as usize));
        let Some(end) = end.map(|point| grid.counts(point)) else {
            out.extend_from_slice(line);
            continue;
        };
        let mut rest = line;
        while let Some((letter, behind)) = rest.split_first() {
            out.push(*letter);
            rest = behind;
            let Some(axis) = AXES.iter().position(|axis| axis == letter) else { continue };
            let length = rest.iter().take_while(|byte| is_of_number(**byte)).count();
            let told = counted(&rest[..length], grid.decimals);
            if let Some((_, sign)) = told.filter(|(count, _)| *count == end[axis]) {
                out.push(sign);
                rest = &rest[length..];
            }
        }
    }
    Some(out)
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
        ends[piece.line as usize] = piece.end as u32 - 1;
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
            start: index.saturating_sub(1),
            end: index + 1,
        };
        let pieces = (0..points.len()).map(piece).collect();
        let trace = Trace { points: points.to_vec(), pieces, ..Trace::default() };
        let grid = Grid::new(&Extent::of(points).expect("points"), Unit::Mm);
        let spelled = spelled(text, &trace, &grid).unwrap_or_else(|| text.into());
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
