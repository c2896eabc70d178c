//! Writing a map while a run goes.

use std::io::{self, Write};

use fil_post::tape::Tape;
use fil_post::{BlockInfo, Cause, Noted, Stack};
use fil_vm::Module;
use serde::Serialize;

use super::digest::{Digest, Digesting};
use super::forms::Forms;
use super::line::{End, FilFile, Header, StackLine, TakenLine};
use super::names::Names;
use super::{VERSION, words};

/// Bytes of lines that are kept before they go to the writer.
const FLUSH: usize = 64 * 1024;

/// Writes the map of one run.
pub(crate) struct Writer<'w> {
    output: &'w mut dyn Write,
    /// Lines not yet handed to the output.
    lines: Vec<u8>,
    forms: Forms,
    /// What the last block is due to.
    last: Cause,
    /// The first error of the output; after it nothing more is written.
    failure: Option<io::Error>,
    /// Lines of the NC program so far.
    nc_lines: u64,
    stacks: usize,
    nc: Digesting,
}

impl<'w> Writer<'w> {
    /// Starts a map.
    pub fn new(output: &'w mut dyn Write, names: &Names, module: &Module) -> Self {
        let name = |index: usize, own: &str| names.fil.get(index).cloned().unwrap_or(own.into());
        let fil = module.files.iter().enumerate().map(|(index, file)| FilFile {
            name: name(index, &file.name),
            digest: Digest::of(file.text.as_bytes()),
        });
        let header = Header {
            version: VERSION,
            cl: names.cl.clone(),
            nc: names.nc.clone(),
            fil: fil.collect(),
            sections: module.section_keys().map(str::to_string).collect(),
        };
        let mut writer = Writer {
            output,
            lines: Vec::with_capacity(FLUSH + FLUSH / 4),
            forms: Forms::default(),
            last: Cause::default(),
            failure: None,
            nc_lines: 0,
            stacks: 0,
            nc: Digesting::default(),
        };
        writer.object(&header);
        writer
    }

    /// Writes the finished blocks of a tape.
    pub fn blocks(&mut self, tape: &Tape) {
        for stack in &tape.stacks.all()[self.stacks..] {
            self.stack(stack);
        }
        if let Some(noted) = &tape.noted {
            noted.blocks.iter().for_each(|block| self.block(block, noted));
        }
        self.nc.add(&tape.text);
        self.hand_out();
    }

    /// Notes a record that a section took without effect.
    pub fn taken(&mut self, line: u32, record: u32, section: u16) {
        self.object(&TakenLine { taken: (line, record), section });
        if self.lines.len() >= FLUSH {
            self.hand_out();
        }
    }

    /// Ends the map.
    ///
    /// # Errors
    /// The first error of the output.
    pub fn finish(mut self, cl: Digest) -> io::Result<()> {
        self.object(&End { lines: self.nc_lines, cl, nc: self.nc.digest() });
        self.hand_out();
        self.failure.map_or_else(|| self.output.flush(), Err)
    }

    fn block(&mut self, block: &BlockInfo, noted: &Noted) {
        match self.forms.number(block, noted, self.last) {
            Some(number) => words::number(number.into(), &mut self.lines),
            None => self.write_out(block, noted),
        }
        self.lines.push(b'\n');
        self.last = block.cause;
        self.nc_lines += 1;
    }

    fn write_out(&mut self, block: &BlockInfo, noted: &Noted) {
        let cause = block.cause;
        let lines = &mut self.lines;
        lines.push(b'[');
        words::number(words::distance(self.last.line, cause.line), lines);
        lines.push(b',');
        words::number(words::distance(self.last.record, cause.record), lines);
        lines.extend_from_slice(b",\"");
        words::write(noted.words_of(block), block.range.len(), cause, lines);
        lines.push(b'"');
        if cause.stack != 0 {
            lines.push(b',');
            words::number(cause.stack.into(), lines);
        }
        lines.push(b']');
    }

    fn stack(&mut self, stack: &Stack) {
        self.stacks += 1;
        let fil = stack.lines.iter().map(|at| (at.file, at.line)).collect();
        self.object(&StackLine { stack: self.stacks as u32, section: stack.section, fil });
    }

    fn object(&mut self, line: &impl Serialize) {
        if let Err(error) = serde_json::to_writer(&mut self.lines, line) {
            self.failure.get_or_insert(error.into());
        }
        self.lines.push(b'\n');
    }

    fn hand_out(&mut self) {
        if self.failure.is_none() {
            self.failure = self.output.write_all(&self.lines).err();
        }
        self.lines.clear();
    }
}
