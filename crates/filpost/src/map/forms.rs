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

#[derive(PartialEq, Eq, Hash)]
struct Head {
    /// Distance from the record of the block before.
    lines: i64,
    records: i64,
    stack: u32,
    /// Length of the text in bytes.
    length: usize,
}

/// What a word is due to, as seen from the record of its block.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Other {
    lines: i64,
    records: i64,
    stack: u32,
    made_by_fil: bool,
}

impl Forms {
    /// The number of the form of a block that comes after one with the cause
    /// `last`; `None` for a new one, which has the next number from now on.
    pub fn number(&mut self, block: &BlockInfo, noted: &Noted, last: Cause) -> Option<u32> {
        let made = block.cause;
        let head = Head {
            lines: distance(last.line, made.line),
            records: distance(last.record, made.record),
            stack: made.stack,
            length: block.range.len(),
        };
        let words = &noted.words[block.words.clone()];
        let others = noted.others[block.others.clone()].iter();
        let others = others.map(|cause| Other::from_block(made, *cause));

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
    fn from_block(block: Cause, cause: Cause) -> Other {
        Other {
            lines: distance(block.line, cause.line),
            records: distance(block.record, cause.record),
            stack: cause.stack,
            made_by_fil: cause.made_by_fil,
        }
    }
}
