//! What finished blocks and their words are caused by, noted while they are written.

use std::ops::Range;

use crate::cause::Cause;

/// Stands for a text in place of a letter.
pub const TEXT: u8 = b'_';

/// Stands for the block-delete character in place of a letter.
pub const SKIP: u8 = b'/';

/// Stands for a sequence number in place of its letter.
pub const SEQUENCE: u8 = b'#';

/// A finished block on the tape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockInfo {
    /// Byte range in [`Tape::text`](crate::tape::Tape::text), without line end.
    pub range: Range<usize>,
    /// What made it.
    pub cause: Cause,
    /// Range of its words in [`Noted::words`].
    pub words: Range<usize>,
    /// Range in [`Noted::others`] of their causes.
    pub others: Range<usize>,
}

/// A word of a finished block, in one number: there are millions to be kept and
/// compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WordInfo(u64);

impl WordInfo {
    fn new(letter: u8, due_to: DueTo, word: u16, start: usize) -> Self {
        let small = u64::from(letter) | (due_to as u64) << 8 | u64::from(word) << 16;
        WordInfo(small | (start as u64) << 32)
    }

    /// Its letter, `A` to `Z`; [`TEXT`] for a text, [`SKIP`] for the block-delete
    /// character, [`SEQUENCE`] for a sequence number.
    pub fn letter(self) -> u8 {
        self.0 as u8
    }

    /// Which record it is caused by.
    pub fn due_to(self) -> DueTo {
        match (self.0 >> 8) as u8 {
            0 => DueTo::Block,
            1 => DueTo::Fil,
            2 => DueTo::Machine,
            _ => DueTo::Other,
        }
    }

    /// The word of that record, as [`Cause::word`].
    pub fn word(self) -> u16 {
        (self.0 >> 16) as u16
    }

    /// Byte in the block where it starts; it ends where the next one starts.
    pub fn start(self) -> usize {
        (self.0 >> 32) as usize
    }
}

/// The record that a word of a block is caused by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DueTo {
    /// The one that made the block.
    Block,
    /// One that a FIL statement made, for the record that made the block.
    Fil,
    /// None: the settings of the machine ask for it.
    Machine,
    /// The next one in [`Noted::others`].
    Other,
}

/// The blocks on a tape, what they and their words are caused by.
#[derive(Clone, Debug, Default)]
pub struct Noted {
    /// The blocks, in order.
    pub blocks: Vec<BlockInfo>,
    /// The words of all blocks.
    pub words: Vec<WordInfo>,
    /// The causes of words that are due neither to the record of their block nor
    /// to the machine.
    pub others: Vec<Cause>,
}

impl Noted {
    /// Notes the next word of a block that is caused by `block`.
    pub fn word(&mut self, letter: u8, start: usize, cause: Cause, block: Cause) {
        let due_to = if cause.is_of_the_record(block) {
            if cause.made_by_fil { DueTo::Fil } else { DueTo::Block }
        } else if cause == Cause::default() {
            DueTo::Machine
        } else {
            self.others.push(cause);
            DueTo::Other
        };
        self.words.push(WordInfo::new(letter, due_to, cause.word, start));
    }

    /// Notes that a block with the words since the last one is finished.
    pub fn block(&mut self, range: Range<usize>, cause: Cause) {
        let last = self.blocks.last();
        let (words, others) = last.map_or((0, 0), |last| (last.words.end, last.others.end));
        let (words, others) = (words..self.words.len(), others..self.others.len());
        self.blocks.push(BlockInfo { range, cause, words, others });
    }

    /// The words of a block, each with its cause.
    pub fn words_of(&self, block: &BlockInfo) -> impl Iterator<Item = (WordInfo, Cause)> {
        let made = block.cause;
        let mut others = self.others[block.others.clone()].iter();
        self.words[block.words.clone()].iter().map(move |word| {
            let of_record = Cause { word: word.word(), made_by_fil: false, ..made };
            let cause = match word.due_to() {
                DueTo::Block => of_record,
                DueTo::Fil => Cause { made_by_fil: true, ..of_record },
                DueTo::Machine => Cause::default(),
                DueTo::Other => others.next().copied().unwrap_or_default(),
            };
            (*word, cause)
        })
    }

    /// Forgets the last block.
    pub fn drop_last(&mut self) {
        if let Some(last) = self.blocks.pop() {
            self.words.truncate(last.words.start);
            self.others.truncate(last.others.start);
        }
    }

    /// Forgets all blocks.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.words.clear();
        self.others.clear();
    }
}
