//! What stands between tokens: comments, line ends and semicolons.

use std::ops::Range;

/// A part of a gap that layout has to keep or to think about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part<'s> {
    /// `$$…`, without blanks at its end.
    Comment {
        text: &'s str,
        /// Nothing stands before it on its line, not even a blank.
        first_column: bool,
    },
    /// The end of a line that is not continued.
    LineEnd,
    Semicolon,
}

/// The parts of a gap and where they end: at the end of the range, or before
/// something that belongs into no gap.
pub(super) fn parts(source: &str, range: Range<usize>) -> (Vec<Part<'_>>, usize) {
    let mut parts = Vec::new();
    let mut at = range.start;
    while at < range.end {
        let rest = &source[at..range.end];
        match rest.as_bytes()[0] {
            b' ' | b'\t' | b'\x0c' | b'\x1a' => at += 1,
            b';' => {
                parts.push(Part::Semicolon);
                at += 1;
            }
            b'\r' | b'\n' => {
                parts.push(Part::LineEnd);
                at += line_end_length(rest);
            }
            b'$' => match dollar(source, at, rest) {
                Some((comment, length)) => {
                    parts.extend(comment);
                    at += length;
                }
                None => return (parts, at),
            },
            _ => return (parts, at),
        }
    }
    (parts, range.end)
}

fn line_end_length(rest: &str) -> usize {
    if rest.starts_with("\r\n") { 2 } else { 1 }
}

/// A comment, or a `$` that continues its line, perhaps with a comment after
/// it: the comment and the length of all. `None` for a `$` without meaning.
fn dollar<'s>(source: &str, at: usize, rest: &'s str) -> Option<(Option<Part<'s>>, usize)> {
    let end = rest.find(['\r', '\n']).unwrap_or(rest.len());
    let line = &rest[..end];
    if line.starts_with("$$") {
        let first_column = at == 0 || source[..at].ends_with(['\r', '\n']);
        return Some((Some(comment(line, first_column)), end));
    }
    if end == rest.len() {
        return None;
    }
    let length = end + line_end_length(&rest[end..]);
    let after = line[1..].trim_start_matches([' ', '\t']);
    if after.is_empty() {
        return Some((None, length));
    }
    let parted = line[1..].starts_with([' ', '\t']) && after.starts_with("$$");
    parted.then(|| (Some(comment(after, false)), length))
}

fn comment(text: &str, first_column: bool) -> Part<'_> {
    Part::Comment { text: text.trim_end_matches([' ', '\t', '\x0c', '\x1a']), first_column }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_gap_are_told_apart() {
        let text = " $ \r\n;$$ a \n\n$$b$\n $ $$ c\r X";
        let comment = |text, first_column| Part::Comment { text, first_column };
        let expected = [
            Part::Semicolon,
            comment("$$ a", false),
            Part::LineEnd,
            Part::LineEnd,
            comment("$$b$", true),
            Part::LineEnd,
            comment("$$ c", false),
        ];
        assert_eq!(parts(text, 0..text.len()), (expected.to_vec(), text.len() - 1));
    }

    #[test]
    fn a_lone_dollar_ends_the_gap() {
        assert_eq!(parts(" $ x\n", 0..5), (vec![], 1));
        assert_eq!(parts("  $", 0..3), (vec![], 2));
    }
}
