//! What one record writes beyond what is kept in memory: a loop in a section writes
//! millions of blocks before the next record is read.

use std::borrow::Cow;
use std::io::{self, Seek, Write};

use fil_diag::Result;
use fil_post::Origin;
use fil_post::errors::PostCode;

use crate::blocks::{Block, WordOrigin, words_of};
use crate::error::RunCode;
use crate::event::Event;
use crate::outside::Outside;
use crate::spool::{Spool, spool};

/// Bytes on the tape from which on they leave memory.
const SPILL: usize = 1 << 20;

/// The blocks of a record that do not lie on the tape any more.
#[derive(Default)]
pub(crate) struct Spilled {
    taken: Option<Spool>,
}

impl Spilled {
    fn take(&mut self, bytes: &[u8]) -> io::Result<()> {
        // What comes here has left memory: none of it is kept there where files are.
        self.taken.get_or_insert_with(|| spool(0)).write_all(bytes)
    }

    /// Writes what was taken, and forgets it.
    pub fn hand_out(&mut self, output: &mut dyn Write) -> io::Result<()> {
        let Some(mut taken) = self.taken.take() else { return Ok(()) };
        taken.rewind()?;
        io::copy(&mut taken, output).map(|_| ())
    }
}

/// A block that is handed out.
pub(crate) struct Shown<'a> {
    /// Without line end.
    pub text: &'a str,
    pub origin: &'a Origin,
    /// Its words, made when they are asked for.
    pub words: &'a dyn Fn() -> Vec<WordOrigin>,
}

impl Outside<'_, '_> {
    /// Takes blocks off a full tape, where somebody will ask for them by the record.
    ///
    /// # Errors
    /// E0702; E0717
    pub fn spill(&mut self) -> Result<()> {
        if self.post.control.tape.text.len() < SPILL {
            return Ok(());
        }
        self.spill_all()
    }

    #[cold]
    fn spill_all(&mut self) -> Result<()> {
        self.show_blocks(|_| {});
        self.encode_tape()?;
        self.check_length()?;
        if self.pass.is_first() {
            self.forget_blocks();
            return Ok(());
        }
        let Some(spilled) = &mut self.spilled else { return Ok(()) };
        let taken = spilled.take(&self.post.control.tape.text);
        taken.map_err(|error| RunCode::CantWrite.diag(error.to_string()))?;
        self.give_away_blocks()
    }

    /// Brings blocks that everyone has seen into the encoding of the program.
    ///
    /// # Errors
    /// E0543 for a letter that it lacks; each block was asked for that before.
    pub fn encode_tape(&mut self) -> Result<()> {
        let page = self.post.control.tables.style.page;
        let text = &mut self.post.control.tape.text;
        if page.is_utf8() || text.is_ascii() {
            return Ok(());
        }
        let encoded = page.encode(&String::from_utf8_lossy(text)).map(Cow::into_owned);
        match encoded {
            Ok(bytes) => *text = bytes,
            Err(letter) => {
                return PostCode::TapeLetter.err(format!("`{letter}` is no letter of {page}"));
            }
        }
        Ok(())
    }

    /// Hands out the blocks that nobody has seen yet.
    pub fn show_blocks(&mut self, mut take: impl FnMut(Shown<'_>)) {
        let tape = &self.post.control.tape;
        let Some(noted) = &tape.noted else { return };
        for block in &noted.blocks[self.shown..] {
            let text = &tape.text[block.range.clone()];
            let text = std::str::from_utf8(text)
                .map_or_else(|_| String::from_utf8_lossy(text), Cow::Borrowed);
            let origin = tape.stacks.origin(block.cause);
            take(Shown { text: &text, origin: &origin, words: &|| words_of(tape, noted, block) });
            if let Some(kept) = &mut self.kept {
                kept.push(Block {
                    number: kept.len() as u64 + 1,
                    text: text.to_string(),
                    origin: origin.clone(),
                    words: words_of(tape, noted, block),
                });
            }
            for observer in self.observers.iter_mut() {
                observer(Event::Block { text: &text, origin: &origin });
            }
        }
        self.shown = noted.blocks.len();
    }

    /// Gives blocks that were written to the map, and forgets them.
    ///
    /// # Errors
    /// E0717
    pub fn give_away_blocks(&mut self) -> Result<()> {
        self.check_length()?;
        let tape = &mut self.post.control.tape;
        if let Some(map) = &mut self.map {
            // The map takes the text along.
            self.report.bytes += tape.text.len() as u64;
            map.blocks(tape);
        }
        self.forget_blocks();
        Ok(())
    }

    /// Forgets blocks that were written.
    pub fn forget_blocks(&mut self) {
        let tape = &mut self.post.control.tape;
        if let Some(noted) = &mut tape.noted {
            noted.clear();
        }
        self.report.bytes += tape.text.len() as u64;
        tape.text.clear();
        self.shown = 0;
    }

    /// Refuses a program that is longer than the host allows.
    fn check_length(&self) -> Result<()> {
        let most = self.program.shared.limits.output_bytes;
        let written = self.report.bytes + self.post.control.tape.text.len() as u64;
        if written <= most {
            return Ok(());
        }
        Err(RunCode::TooLong.diag(format!("it has more than {most} bytes")))
    }
}
