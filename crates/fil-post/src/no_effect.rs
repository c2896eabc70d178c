//! Words and items that do not change the program: known, and with a reason.
//!
//! `data/no-effect.tsv` is the one source; the docs page is made from it, and tests
//! that change every item of every record look into it.

use std::collections::HashSet;
use std::sync::OnceLock;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoEffect {
    /// The major word.
    pub major: &'static str,
    /// `*` for the whole record; a minor word with its number; numbers by where they
    /// stand in the record, and their name: `numbers 8 to 11: tolerances`.
    pub item: &'static str,
    /// The item says what holds without it: it may be left out, but not be another.
    pub left_out_only: bool,
    /// Why it has no effect.
    pub reason: &'static str,
}

/// The change of an item that is only without effect when it is left out.
const LEFT_OUT: &str = "left out";

const SOURCE: &str = include_str!("../data/no-effect.tsv");

/// The rows, in the order of the file.
pub fn rows() -> impl Iterator<Item = NoEffect> {
    SOURCE.lines().filter(|line| !line.starts_with('#')).skip(1).filter_map(|line| {
        let mut fields = line.split('\t');
        let (major, item) = (fields.next()?, fields.next()?);
        let left_out_only = fields.next()? == LEFT_OUT;
        Some(NoEffect { major, item, left_out_only, reason: fields.next()? })
    })
}

/// True for a major word whose records have no effect.
pub fn is_whole_record(major: &str) -> bool {
    static WORDS: OnceLock<HashSet<&'static str>> = OnceLock::new();
    let words =
        WORDS.get_or_init(|| rows().filter(|row| row.item == "*").map(|row| row.major).collect());
    words.contains(major)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_row_has_a_reason_and_stands_once() {
        let all: Vec<NoEffect> = rows().collect();
        assert!(all.len() > 20);
        for (at, row) in all.iter().enumerate() {
            assert!(row.reason.len() > 10, "{row:?}");
            let again =
                all[..at].iter().any(|other| (other.major, other.item) == (row.major, row.item));
            assert!(!again, "{row:?}");
        }
        assert!(is_whole_record("PAINT") && !is_whole_record("GOTO"));
    }
}
