//! The blocks of a run, one by one.

use std::collections::VecDeque;
use std::io::Read;

use fil_post::Origin;

use crate::engine::Engine;
use crate::error::Error;

/// A block of the NC program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Number of the block in the program, 1-based.
    pub number: u64,
    /// The block, without line end.
    pub text: String,
    /// The CL record and the FIL lines that made it.
    pub origin: Origin,
}

/// Iterator over the blocks of a run; ends after the first error.
pub struct Blocks<'p, R: Read> {
    engine: Engine<'p, R>,
    ready: VecDeque<Block>,
    number: u64,
    over: bool,
}

impl<'p, R: Read> Blocks<'p, R> {
    pub(crate) fn new(engine: Engine<'p, R>) -> Self {
        Blocks { engine, ready: VecDeque::new(), number: 0, over: false }
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
}

impl<R: Read> Iterator for Blocks<'_, R> {
    type Item = Result<Block, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.ready.is_empty() && !self.over {
            match self.engine.step() {
                Ok(true) => {}
                Ok(false) => {
                    self.over = true;
                    if let Err(error) = self.engine.take_held().keep() {
                        self.ready.clear();
                        return Some(Err(error));
                    }
                }
                Err(error) => {
                    self.over = true;
                    self.ready.clear();
                    return Some(Err(error));
                }
            }
            self.take_blocks();
        }
        self.ready.pop_front().map(Ok)
    }
}

impl<R: Read> Drop for Blocks<'_, R> {
    fn drop(&mut self) {
        self.engine.finish();
    }
}
