//! The tape: finished blocks as text, with sequence numbers and provenance.

use std::ops::Range;

use crate::address::{Addresses, letter};
use crate::block::{Block, no_address};
use crate::commons::Commons;
use crate::locations as loc;
use fil_diag::Diag;

/// A line of FIL that had a part in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilLine {
    /// Number of the FIL file, in the order they were loaded.
    pub file: u16,
    /// Line, 1-based.
    pub line: u32,
}

/// What made a block: a CL record and, where FIL wrote it, the FIL lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Number of the CL record, 1-based; 0 before the first record.
    pub record: u32,
    /// Line of the CL file, 1-based.
    pub line: u32,
    /// FIL call stack, innermost first; empty when no section was running.
    pub fil: Vec<FilLine>,
}

/// A finished block on the tape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockInfo {
    /// Byte range in [`Tape::text`], without line end.
    pub range: Range<usize>,
    /// What made it.
    pub origin: Origin,
}

/// Sequence numbers: what is due for the next block.
#[derive(Clone, Debug, Default)]
struct Sequence {
    next: Option<f64>,
    increment: Option<f64>,
    switched: Option<bool>,
    since_last: i32,
}

/// The output side of the post.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    /// Text of the blocks not yet taken away.
    pub text: Vec<u8>,
    /// The finished blocks within `text`, when observed.
    pub blocks: Vec<BlockInfo>,
    /// Keep [`Tape::blocks`]; off by default because it costs time.
    pub observe: bool,
    /// What the blocks written next are due to.
    pub origin: Origin,
    /// Number of blocks written so far.
    pub count: u64,
    /// The next blocks carry the block-delete character.
    pub skip: bool,
    sequence: Sequence,
}

impl Tape {
    /// Writes a block with its sequence number; a block of which the machine
    /// writes no word is left out.
    ///
    /// # Errors
    /// A sequence number that does not fit its address.
    pub fn block(
        &mut self,
        block: &Block,
        addresses: &Addresses,
        commons: &mut Commons,
    ) -> Result<(), Box<Diag>> {
        if !block.prints(addresses) {
            return Ok(());
        }
        let start = self.begin(true, addresses, commons)?;
        block.write(addresses, commons, &mut self.text);
        self.end(start);
        Ok(())
    }

    /// Writes words in the order given, whatever the tape order; all of them,
    /// whether or not their values have changed.
    ///
    /// # Errors
    /// The machine has no such address, or a value does not fit it.
    pub fn words(
        &mut self,
        words: &[(u8, f64)],
        addresses: &Addresses,
        commons: &mut Commons,
    ) -> Result<(), Box<Diag>> {
        let mut line = Vec::new();
        for &(letter, value) in words {
            let position = addresses.position(letter).ok_or_else(|| no_address(letter))?;
            let slot = addresses.slot(position);
            let scaled = slot.format.scale(value)?;
            if addresses.blank && !line.is_empty() {
                line.push(b' ');
            }
            line.push(slot.character);
            slot.format.write(scaled, &mut line);
            commons.set_last_output(letter, slot.format.unscale(scaled));
        }
        let start = self.begin(true, addresses, commons)?;
        self.text.extend_from_slice(&line);
        self.end(start);
        Ok(())
    }

    /// Writes a text as a block, with or without a sequence number.
    ///
    /// # Errors
    /// As [`Tape::block`].
    pub fn line(
        &mut self,
        text: &str,
        numbered: bool,
        addresses: &Addresses,
        commons: &mut Commons,
    ) -> Result<(), Box<Diag>> {
        let start = self.begin(numbered, addresses, commons)?;
        self.text.extend_from_slice(text.as_bytes());
        self.end(start);
        Ok(())
    }

    /// Sets the number of the next block and, where given, the increment.
    pub fn renumber(&mut self, next: f64, increment: Option<f64>) {
        self.sequence.next = Some(next);
        self.sequence.increment = increment.or(self.sequence.increment);
        self.sequence.since_last = 0;
    }

    /// Switches sequence numbers on or off.
    pub fn switch_numbers(&mut self, on: bool) {
        self.sequence.switched = Some(on);
    }

    fn begin(
        &mut self,
        numbered: bool,
        addresses: &Addresses,
        commons: &mut Commons,
    ) -> Result<usize, Box<Diag>> {
        let start = self.text.len();
        if self.skip {
            self.text.push(b'/');
        }
        if numbered {
            self.number(addresses, commons)?;
        }
        Ok(start)
    }

    fn number(&mut self, addresses: &Addresses, commons: &mut Commons) -> Result<(), Box<Diag>> {
        const N: u8 = letter(b'N');
        let on = self.sequence.switched.unwrap_or(commons.int(loc::SEQNO_OFF_AT_START) != 72);
        let Some(position) = addresses.position(N).filter(|_| on) else { return Ok(()) };
        let every = commons.int(loc::SEQNO_EVERY).max(1);
        self.sequence.since_last += 1;
        if self.sequence.since_last < every && self.sequence.next.is_some() {
            return Ok(());
        }
        self.sequence.since_last = 0;
        let increment =
            self.sequence.increment.or(commons.dbl_opt(loc::SEQNO_INCREMENT)).unwrap_or(1.0);
        let first = increment + commons.dbl_opt(loc::SEQNO_START_OFFSET).unwrap_or(0.0);
        let mut number = self.sequence.next.unwrap_or(first);
        if commons.dbl_opt(loc::SEQNO_MAX).is_some_and(|max| number > max) {
            number = first;
        }
        self.sequence.next = Some(number + increment);
        let slot = addresses.slot(position);
        let scaled = slot.format.scale(number)?;
        self.text.push(slot.character);
        slot.format.write(scaled, &mut self.text);
        if addresses.blank {
            self.text.push(b' ');
        }
        commons.set_last_output(N, number);
        Ok(())
    }

    fn end(&mut self, start: usize) {
        self.count += 1;
        if self.observe {
            let range = start..self.text.len();
            self.blocks.push(BlockInfo { range, origin: self.origin.clone() });
        }
        self.text.push(b'\n');
    }
}
