//! The most frequent statements, read in one go: `GOTO` and `INDIRV` that fill one line, with
//! numbers in fixed point. Anything else is left to the long way, which gives the same record.

use super::known::{KnownAxis, KnownNumbers};
use super::number::fixed_point;

/// Reads the values of a `GOTO` that fills one line; gives how many they are and
/// the length of the line including its line end; `None` when anything about it is
/// unusual.
#[inline]
pub(super) fn plain_goto(
    text: &[u8],
    values: &mut [f64; 6],
    numbers: &mut KnownNumbers,
    known: &mut KnownAxis,
) -> Option<(usize, usize)> {
    let found = plain_values(text, b"GOTO", values, numbers, |rest| known.read(rest))?;
    if found.count == 6 && !found.is_known {
        let [_, _, _, i, j, k] = *values;
        known.keep(&text[found.axis..found.length], [i, j, k]);
    }
    matches!(found.count, 3 | 6).then_some((found.count, found.length))
}

/// The same for `INDIRV` with three values; gives the length of the line.
pub(super) fn plain_direction(
    text: &[u8],
    values: &mut [f64; 6],
    numbers: &mut KnownNumbers,
) -> Option<usize> {
    let found = plain_values(text, b"INDIRV", values, numbers, |_| None)?;
    (found.count == 3).then_some(found.length)
}

/// The values of a statement that fills one line.
struct Plain {
    count: usize,
    /// Bytes of the line, its end included.
    length: usize,
    /// Where the fourth value begins.
    axis: usize,
    /// The last three were known by their text.
    is_known: bool,
}

/// Reads the values of a statement that fills one line; `known` is asked for the last three.
#[inline(always)]
fn plain_values(
    text: &[u8],
    major: &[u8],
    values: &mut [f64; 6],
    numbers: &mut KnownNumbers,
    known: impl Fn(&[u8]) -> Option<([f64; 3], usize)>,
) -> Option<Plain> {
    let mut rest = skip_blanks(text.strip_prefix(major)?).strip_prefix(b"/")?;
    let (mut count, mut axis) = (0, 0);
    loop {
        let number = skip_blanks(rest);
        let (value, behind) = match numbers.read(count, number) {
            Some(known) => known,
            None => {
                let (value, behind) = fixed_point(number)?;
                numbers.keep(count, number, number.len() - behind.len(), value);
                (value, behind)
            }
        };
        *values.get_mut(count)? = value;
        count += 1;
        rest = match skip_blanks(behind) {
            [b',', rest @ ..] => rest,
            [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => {
                return Some(Plain {
                    count,
                    length: text.len() - rest.len(),
                    axis,
                    is_known: false,
                });
            }
            _ => return None,
        };
        if count == 3 {
            axis = text.len() - rest.len();
            if let Some((found, length)) = known(rest) {
                values[3..].copy_from_slice(&found);
                return Some(Plain { count: 6, length: axis + length, axis, is_known: true });
            }
        }
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
