//! The lines of a map between its first and its last.

use fil_post::{BlockInfo, Cause, Noted, Stack};
use serde::Serialize;

use super::digest::{Digest, Digesting};
use super::forms::Forms;
use super::line::{End, StackLine, TakenLine};
use super::reader::Taken;
use super::words;

/// What a run has made and the map does not tell yet.
#[derive(Default)]
pub(super) struct Batch {
    /// The text of the blocks.
    pub text: Vec<u8>,
    /// The blocks.
    pub noted: Noted,
    /// The FIL call stacks that came up.
    pub stacks: Vec<Stack>,
    /// The records that sections took without effect.
    pub taken: Vec<Taken>,
    /// The lines of the map that tell all this.
    pub lines: Vec<u8>,
}

impl Batch {
    /// Makes it empty; its buffers are used again.
    pub fn clear(&mut self) {
        self.text.clear();
        self.noted.clear();
        self.stacks.clear();
        self.taken.clear();
        self.lines.clear();
    }
}

/// Makes the lines of one map.
#[derive(Default)]
pub(super) struct Lines {
    forms: Forms,
    /// The cause of the last block.
    last: Cause,
    /// Number of the last stack.
    stack: u32,
    /// Lines of the NC program so far.
    nc_lines: u64,
    nc: Digesting,
    /// The map itself, up to here.
    map: Digesting,
}

impl Lines {
    /// Begins after the first line of a map.
    pub fn after(header: &[u8]) -> Self {
        let mut lines = Lines::default();
        lines.map.add(header);
        lines
    }

    /// Makes the lines of a batch.
    pub fn write(&mut self, batch: &mut Batch) {
        let Batch { text, noted, stacks, taken, lines } = batch;
        for stack in stacks {
            self.stack += 1;
            let fil = stack.lines.iter().map(|at| (at.file, at.line)).collect();
            object(&StackLine { stack: self.stack, section: stack.section, fil }, lines);
        }
        for Taken { line, record, section } in taken {
            object(&TakenLine { taken: (*line, *record), section: *section }, lines);
        }
        for block in &noted.blocks {
            self.block(block, noted, lines);
        }
        self.nc.add(text);
        self.map.add(lines);
    }

    /// The last line of the map.
    pub fn end(&self, cl: Digest) -> End {
        End { lines: self.nc_lines, cl, nc: self.nc.digest(), map: self.map.digest() }
    }

    fn block(&mut self, block: &BlockInfo, noted: &Noted, lines: &mut Vec<u8>) {
        match self.forms.number(block, noted, self.last) {
            Some(number) => words::number(number.into(), lines),
            None => write_out(block, noted, self.last, lines),
        }
        lines.push(b'\n');
        self.last = block.cause;
        self.nc_lines += 1;
    }
}

/// Appends the line of a block that comes after one with the cause `last`.
fn write_out(block: &BlockInfo, noted: &Noted, last: Cause, lines: &mut Vec<u8>) {
    let cause = block.cause;
    lines.push(b'[');
    words::number(words::distance(last.line, cause.line), lines);
    lines.push(b',');
    words::number(words::distance(last.record, cause.record), lines);
    lines.extend_from_slice(b",\"");
    words::write(noted.words_of(block), block.range.len(), cause, lines);
    lines.push(b'"');
    if cause.stack != 0 {
        lines.push(b',');
        words::number(cause.stack.into(), lines);
    }
    lines.push(b']');
}

/// Appends a line that is a JSON object.
pub(super) fn object(line: &impl Serialize, lines: &mut Vec<u8>) {
    serde_json::to_writer(&mut *lines, line).expect("numbers and names, into memory");
    lines.push(b'\n');
}
