//! The most frequent statements, read in one go: `GOTO` and `INDIRV` that fill one line, with
//! numbers in fixed point. Anything else is left to the long way, which gives the same record.

use super::known::{KnownAxis, KnownNumbers};
use super::number::fixed_point;

/// Reads the point of a `GOTO`; gives the text behind it. `None` when anything about it is
/// unusual.
#[inline(always)]
pub(super) fn plain_point<'t>(
    text: &'t [u8],
    numbers: &mut KnownNumbers,
) -> Option<([f64; 3], &'t [u8])> {
    values(text, b"GOTO", numbers)
}

/// The same for `INDIRV` with three values; gives the values and the length of the line.
pub(super) fn plain_direction(
    text: &[u8],
    numbers: &mut KnownNumbers,
) -> Option<([f64; 3], usize)> {
    let (direction, behind) = values(text, b"INDIRV", numbers)?;
    Some((direction, text.len() - line_end(behind)?.len()))
}

/// The first three values of a statement, and the text behind them. Each has a name of its
/// own: numbers that were written to memory one by one can't be read back as one at once.
#[inline(always)]
fn values<'t>(
    text: &'t [u8],
    major: &[u8],
    numbers: &mut KnownNumbers,
) -> Option<([f64; 3], &'t [u8])> {
    let rest = skip_blanks(text.strip_prefix(major)?).strip_prefix(b"/")?;
    let (x, rest) = value(0, rest, numbers)?;
    let (y, rest) = value(1, rest.strip_prefix(b",")?, numbers)?;
    let (z, rest) = value(2, rest.strip_prefix(b",")?, numbers)?;
    Some(([x, y, z], rest))
}

/// The tool axis behind a point, and the text behind the line; the last axis is known by its
/// text.
pub(super) fn plain_axis<'t>(
    text: &'t [u8],
    numbers: &mut KnownNumbers,
    known: &mut KnownAxis,
) -> Option<([f64; 3], &'t [u8])> {
    let text = text.strip_prefix(b",")?;
    if let Some((axis, length)) = known.read(text) {
        return Some((axis, &text[length..]));
    }
    let (i, rest) = value(3, text, numbers)?;
    let (j, rest) = value(4, rest.strip_prefix(b",")?, numbers)?;
    let (k, rest) = value(5, rest.strip_prefix(b",")?, numbers)?;
    let rest = line_end(rest)?;
    known.keep(text, text.len() - rest.len(), [i, j, k]);
    Some(([i, j, k], rest))
}

/// The value at a place of a statement, from 0, and the text behind it and its blanks.
#[inline(always)]
fn value<'t>(place: usize, text: &'t [u8], numbers: &mut KnownNumbers) -> Option<(f64, &'t [u8])> {
    let text = skip_blanks(text);
    let (value, behind) = match numbers.read(place, text) {
        Some(known) => known,
        None => {
            let (value, behind) = fixed_point(text)?;
            numbers.keep(place, text, text.len() - behind.len(), value);
            (value, behind)
        }
    };
    Some((value, skip_blanks(behind)))
}

/// The text behind a line end.
#[inline]
pub(super) fn line_end(text: &[u8]) -> Option<&[u8]> {
    match text {
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some(rest),
        _ => None,
    }
}

#[inline]
fn skip_blanks(mut text: &[u8]) -> &[u8] {
    while let [first, rest @ ..] = text
        && *first <= b' '
        && matches!(*first, b' ' | b'\t')
    {
        text = rest;
    }
    text
}
