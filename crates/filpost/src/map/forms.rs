//! The forms of blocks: most blocks of a program are like one before them.

use std::collections::HashMap;
use std::hash::{Hash, Hasher};

use fil_post::{BlockInfo, Cause, Noted, WordInfo};
use rustc_hash::{FxBuildHasher, FxHasher};

use super::words::distance;

/// Most forms that are kept to be repeated by their number; what is written out
/// later is not, so that memory stays bounded.
pub(super) const MOST: usize = 1 << 14;

/// The forms that were written out. The number of a form counts from 1.
#[derive(Default)]
pub(super) struct Forms {
    forms: Vec<Form>,
    /// The numbers of the forms by their hashes.
    numbers: HashMap<u64, u32, FxBuildHasher>,
}

/// What blocks of one form have in common: their lines in the map would be the same.
struct Form {
    head: Head,
    words: Box<[WordInfo]>,
    others: Box<[Other]>,
}

/// All of a form but its words.
#[derive(PartialEq, Eq, Hash)]
struct Head {
    /// Distance from the record of the block before.
    from_last: Distance,
    stack: u32,
    /// Length of the text in bytes.
    length: usize,
}

/// The cause of a word, as seen from the record of its block.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Other {
    from_block: Distance,
    stack: u32,
    made_by_fil: bool,
}

/// How far a record lies from another.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Distance {
    lines: i64,
    records: i64,
}

impl Forms {
    /// The number of the form of a block that comes after one with the cause
    /// `last`; `None` for a new one, which has the next number from now on.
    pub fn number(&mut self, block: &BlockInfo, noted: &Noted, last: Cause) -> Option<u32> {
        let made = block.cause;
        let head = Head {
            from_last: Distance::new(last, made),
            stack: made.stack,
            length: block.range.len(),
        };
        let words = &noted.words[block.words.clone()];
        let others = noted.others[block.others.clone()].iter();
        let others = others.map(|cause| Other::new(made, *cause));

        let mut hasher = FxHasher::default();
        head.hash(&mut hasher);
        words.hash(&mut hasher);
        others.clone().for_each(|other| other.hash(&mut hasher));
        let hash = hasher.finish();

        if let Some(&number) = self.numbers.get(&hash) {
            let form = &self.forms[number as usize - 1];
            let same = form.head == head && *form.words == *words;
            if same && form.others.iter().copied().eq(others.clone()) {
                return Some(number);
            }
        }
        if self.forms.len() < MOST {
            self.forms.push(Form { head, words: words.into(), others: others.collect() });
            self.numbers.insert(hash, self.forms.len() as u32);
        }
        None
    }
}

impl Other {
    fn new(block: Cause, cause: Cause) -> Other {
        let from_block = Distance::new(block, cause);
        Other { from_block, stack: cause.stack, made_by_fil: cause.made_by_fil }
    }
}

impl Distance {
    fn new(from: Cause, to: Cause) -> Self {
        let lines = distance(from.line, to.line);
        Distance { lines, records: distance(from.record, to.record) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks of records that follow each other, each with a word caused by itself and,
    /// where given, one caused by a record so far before it.
    fn numbers(blocks: &[(u16, Option<u32>)]) -> Vec<Option<u32>> {
        let (mut forms, mut last) = (Forms::default(), Cause::default());
        let mut found = Vec::new();
        for (at, (word, before)) in (10u32..).zip(blocks) {
            let cause = Cause { record: at, line: at, ..Cause::default() };
            let mut noted = Noted::default();
            noted.word(b'X', 0, Cause { word: *word, ..cause }, cause);
            if let Some(before) = before {
                let other = Cause { record: at - before, line: at - before, ..cause };
                noted.word(b'F', 5, other, cause);
            }
            noted.block(0..9, cause);
            found.push(forms.number(&noted.blocks[0], &noted, last));
            last = cause;
        }
        found
    }

    #[test]
    fn a_form_is_known_by_words_and_distances() {
        let blocks = [(6, None), (6, None), (6, Some(1)), (6, Some(2)), (7, None), (6, Some(1))];
        // The first comes from no record, and is another form than the second.
        assert_eq!(numbers(&blocks), [None, None, None, None, None, Some(3)]);
        assert_eq!(numbers(&[(6, None), (6, None), (6, None)])[2], Some(2));
    }

    #[test]
    fn no_more_forms_are_kept_than_may_be() {
        let blocks: Vec<(u16, Option<u32>)> =
            (0..MOST as u16 + 10).map(|word| (word, None)).collect();
        let twice = numbers(&[&blocks[..], &blocks[..]].concat());
        let (first, again) = twice.split_at(blocks.len());
        assert!(first.iter().all(Option::is_none));
        assert_eq!(again[5], Some(6));
        assert_eq!(again[MOST + 5], None);
    }
}
