//! The blocks of a run, one by one.

use std::collections::VecDeque;
use std::iter::FusedIterator;

use fil_cl::reader::Reader;
use fil_post::Origin;

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
}

/// Iterator over the blocks of a run; ends after the first error. Take it by
/// `&mut` to ask for the report at the end.
///
/// Files that scripts write appear when the last block is handed out.
pub struct Blocks<'o> {
    engine: Engine<'o, Reader<'o>>,
    ready: VecDeque<Block>,
    number: u64,
    over: bool,
}

impl<'o> Blocks<'o> {
    pub(crate) fn new(engine: Engine<'o, Reader<'o>>) -> Self {
        Blocks { engine, ready: VecDeque::new(), number: 0, over: false }
    }

    /// What the run has to tell so far, its warnings among it; all of it after the
    /// last block.
    pub fn report(&self) -> &Report {
        self.engine.report()
    }

    fn take_blocks(&mut self) {
        let mut number = self.number;
        let ready = &mut self.ready;
        self.engine.take_blocks(|text, origin| {
            number += 1;
            ready.push_back(Block { number, text: text.to_string(), origin: origin.clone() });
        });
        self.number = number;
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
            self.take_blocks();
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
