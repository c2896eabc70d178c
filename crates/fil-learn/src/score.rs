//! How far a program is from the proven one. Zero means the same bytes.

use crate::myers;
use crate::words::{self, Block, Word, hash};

/// A block's end among its words.
const END: u64 = 0;

/// Price of a word whose like is missing in the other program, wherever it is.
const BAG: f64 = 1.5;

/// Price of a block that the other program does not have.
const LINE: f64 = 0.1;

/// Price of a sequence number that differs.
const NUMBER: f64 = 0.05;

/// Price of a word whose form is missing in the other program: digits after the point, zeros, signs.
/// A form that is right shows before the numbers are.
const FORM: f64 = 0.05;

/// Price of programs that are not the same bytes.
const BYTES: f64 = 1.0;

/// Most insertions and deletions that are counted; beyond them the bag alone counts.
const MOST_EDITS: usize = 3000;

/// A program cut up once.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    /// Its bytes, without a last line end.
    pub bytes: Vec<u8>,
    /// Its blocks.
    pub blocks: Vec<Block>,
    words: Vec<u64>,
    sorted: Vec<u64>,
    forms: Vec<u64>,
    lines: Vec<u64>,
    numbers: Vec<u64>,
}

impl Cut {
    /// Cuts the text of a program.
    pub fn new(text: &[u8]) -> Cut {
        let blocks = words::blocks(text);
        let mut cut = Cut {
            bytes: without_last_end(text).to_vec(),
            words: Vec::new(),
            sorted: Vec::new(),
            forms: Vec::new(),
            lines: Vec::new(),
            numbers: Vec::new(),
            blocks: Vec::new(),
        };
        for block in &blocks {
            cut.words.extend(block.words.iter().map(|word| word.id));
            cut.forms.extend(block.words.iter().map(Word::form));
            cut.words.push(END);
            cut.lines.push(hash(block.text.as_bytes()));
            cut.numbers.push(hash(block.number.as_bytes()));
        }
        cut.sorted = cut.words.clone();
        cut.sorted.sort_unstable();
        cut.forms.sort_unstable();
        cut.lines.sort_unstable();
        cut.blocks = blocks;
        cut
    }

    /// Words of the program, block ends among them.
    pub fn len(&self) -> usize {
        self.words.len()
    }
}

/// A text without its last line end, which may be missing.
pub(crate) fn without_last_end(text: &[u8]) -> &[u8] {
    let text = text.strip_suffix(b"\n").unwrap_or(text);
    text.strip_suffix(b"\r").unwrap_or(text)
}

/// How far the text of a program is from `proven`; `None` where that is `limit` or more.
pub(crate) fn score_of_text(own: &[u8], proven: &Cut, limit: f64) -> Option<f64> {
    // Any other bytes cost that much: the words need not be looked at.
    if limit <= BYTES && without_last_end(own) != proven.bytes {
        return None;
    }
    score(&Cut::new(own), proven, limit)
}

/// How far `own` is from `proven`; `None` where that is `limit` or more.
pub(crate) fn score(own: &Cut, proven: &Cut, limit: f64) -> Option<f64> {
    if own.bytes == proven.bytes {
        return Some(0.0).filter(|score| *score < limit);
    }
    let bag = difference(&own.sorted, &proven.sorted);
    let numbers = own.numbers.iter().zip(&proven.numbers).filter(|(a, b)| a != b).count()
        + own.numbers.len().abs_diff(proven.numbers.len());
    let rest = BAG * bag as f64
        + LINE * difference(&own.lines, &proven.lines) as f64
        + FORM * difference(&own.forms, &proven.forms) as f64
        + NUMBER * numbers as f64
        + BYTES;
    // No fewer words are put in or taken out than the bags differ by.
    if rest + bag as f64 >= limit {
        return None;
    }
    let most = (limit - rest).ceil().min(MOST_EDITS as f64) as usize;
    let edits = match myers::distance(&own.words, &proven.words, most) {
        Some(edits) => edits,
        None if most == MOST_EDITS => MOST_EDITS.max(bag),
        None => return None,
    };
    Some(rest + edits as f64).filter(|score| *score < limit)
}

/// What of two sorted lists is not in the other one.
fn difference(a: &[u64], b: &[u64]) -> usize {
    let (mut i, mut j, mut differ) = (0, 0, 0);
    while i < a.len() && j < b.len() {
        match a[i].cmp(&b[j]) {
            std::cmp::Ordering::Equal => (i, j) = (i + 1, j + 1),
            std::cmp::Ordering::Less => (i, differ) = (i + 1, differ + 1),
            std::cmp::Ordering::Greater => (j, differ) = (j + 1, differ + 1),
        }
    }
    differ + (a.len() - i) + (b.len() - j)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(own: &str, proven: &str) -> f64 {
        let [own, proven] = [own, proven].map(|text| Cut::new(text.as_bytes()));
        score(&own, &proven, f64::INFINITY).expect("below the limit")
    }

    #[test]
    fn the_same_program_is_at_zero_with_or_without_its_last_line_end() {
        assert_eq!(of("G0 X1.\nM30\n", "G0 X1.\nM30"), 0.0);
    }

    #[test]
    fn a_wrong_word_costs_more_than_a_missing_one() {
        assert!(of("G54\nM30", "T15\nM30") > of("\nM30", "T15\nM30"));
    }

    #[test]
    fn a_word_in_another_block_costs_less_than_a_missing_one() {
        assert!(of("G0 M3\nX1.\n", "G0\nX1. M3\n") < of("G0\nX1.\n", "G0\nX1. M3\n"));
    }

    #[test]
    fn a_number_in_the_right_form_is_nearer() {
        assert!(of("X5.000", "X-95.000") < of("X5.", "X-95.000"));
    }

    #[test]
    fn sequence_numbers_alone_cost_little() {
        let differ = of("N1 G0\nN2 X1.\n", "N10 G0\nN20 X1.\n");
        assert!(differ > 1.0 && differ < 1.2, "{differ}");
    }
}
