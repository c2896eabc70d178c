//! The blocks of a run, one by one.

use std::collections::VecDeque;
use std::iter::FusedIterator;
use std::ops::Range;

use fil_post::noted::{BlockInfo, Noted};
use fil_post::{Origin, tape::Tape};

use crate::engine::Engine;
use crate::error::Error;
use crate::report::Report;

/// A block of the NC program.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Block {
    /// Number of the block in the program, 1-based.
    pub number: u64,
    /// The block, without line end.
    pub text: String,
    /// The CL record and the FIL lines that made it.
    pub origin: Origin,
    /// Its words in order, each with what made it.
    pub words: Vec<WordOrigin>,
}

/// A word of a block and what made it.
///
/// ```
/// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let blocks: Vec<_> = program.blocks(cl.as_bytes()).collect::<Result<_, _>>()?;
/// let moved = blocks.iter().find(|block| block.text.contains("X1.")).expect("the motion");
/// let of = |letter| moved.words.iter().find(|word| word.letter == letter).expect("a word");
/// // X is due to the fourth line and F to the third one.
/// assert_eq!((of('X').text(&moved.text), of('X').origin.line), ("X1.", 4));
/// assert_eq!((of('F').text(&moved.text), of('F').origin.line), ("F200.", 3));
/// # Ok::<(), filpost::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WordOrigin {
    /// Its letter, `A` to `Z`; `_` for a text, `/` for the block-delete character, `#`
    /// for a sequence number.
    pub letter: char,
    /// Byte range in the text of the block, with the blank that follows.
    pub range: Range<usize>,
    /// The CL record and the FIL lines that ask for it; record 0 where the settings of the
    /// machine do.
    pub origin: Origin,
    /// The word of the record, as POSTF(7,n) counts; 0 for the record as a whole.
    pub record_word: u16,
    /// A FIL statement made the record whose words `record_word` counts.
    pub made_by_fil: bool,
}

impl WordOrigin {
    /// The word as it stands in the text of its block; empty for the text of another one.
    pub fn text<'a>(&self, block: &'a str) -> &'a str {
        block.get(self.range.clone()).unwrap_or("").trim_end()
    }
}

/// The words of a block on the tape.
pub(crate) fn words_of(tape: &Tape, noted: &Noted, block: &BlockInfo) -> Vec<WordOrigin> {
    let mut words: Vec<WordOrigin> = Vec::with_capacity(block.words.len());
    for (word, cause) in noted.words_of(block) {
        if let Some(before) = words.last_mut() {
            before.range.end = word.start();
        }
        words.push(WordOrigin {
            letter: word.letter().into(),
            range: word.start()..block.range.len(),
            origin: tape.stacks.origin(cause),
            record_word: cause.word,
            made_by_fil: cause.made_by_fil,
        });
    }
    words
}

/// Iterator over the blocks of a run; ends after the first error. Take it by
/// `&mut` to ask for the report at the end.
///
/// Files that scripts write appear when the last block is handed out.
pub struct Blocks<'o> {
    engine: Engine<'o, 'o>,
    ready: VecDeque<Block>,
    number: u64,
    over: bool,
}

impl<'o> Blocks<'o> {
    pub(crate) fn new(engine: Engine<'o, 'o>) -> Self {
        Blocks { engine, ready: VecDeque::new(), number: 0, over: false }
    }

    /// What the run has to tell so far, its warnings among it; all of it after the
    /// last block.
    pub fn report(&self) -> &Report {
        self.engine.report()
    }

    fn take_blocks(&mut self) -> Result<(), Error> {
        let mut number = self.number;
        let ready = &mut self.ready;
        let taken = self.engine.take_blocks(|block| {
            number += 1;
            ready.push_back(Block {
                number,
                text: block.text.to_string(),
                origin: block.origin.clone(),
                words: (block.words)(),
            });
        });
        self.number = number;
        taken.map_err(Error::Run)
    }

    /// Carries out records until there is a block, or the run is over.
    fn advance(&mut self) -> Result<(), Error> {
        while self.ready.is_empty() && !self.over {
            let more = self.engine.step();
            self.over = !matches!(more, Ok(true));
            more?;
            if self.over {
                self.engine.take_pending().commit()?;
            }
            self.take_blocks()?;
        }
        Ok(())
    }
}

impl Iterator for Blocks<'_> {
    type Item = Result<Block, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.advance() {
            Ok(()) => self.ready.pop_front().map(Ok),
            Err(error) => Some(Err(error)),
        }
    }
}

impl FusedIterator for Blocks<'_> {}
