//! Passing over blocks that nobody asks for: those that repeat a form cost little.

use std::io::{BufRead, Read, Seek};
use std::path::Path;

use fil_post::Cause;

use super::{Entry, Form, MapReader, Step};
use crate::error::Error;
use crate::files;

impl Form {
    /// True when neither a block of this form nor a word of it comes from a CL line.
    fn is_not_of(&self, cause: Cause, line: u32) -> bool {
        let [least, most] = self.reach.map(|lines| i64::from(cause.line).saturating_add(lines));
        i64::from(line) < least || i64::from(line) > most
    }
}

impl<R: Read + Seek> MapReader<R> {
    /// Passes over the blocks before a line of the program: what their words are caused by
    /// is not looked at. What cannot be passed over so is left to [`MapReader::next_where`].
    pub(crate) fn pass_to(&mut self, number: u64) -> Result<(), Error> {
        while !self.over && self.read + 1 < number {
            self.pass_repeated(|_, next, _| next < number)?;
            if self.read + 1 < number {
                self.over = matches!(self.step(&|_, _, _| false)?, Step::End);
            }
        }
        Ok(())
    }

    /// The next block that comes from a line of the CL file, or a word of which does, or
    /// record of that line without effect. Ends after the first error.
    pub(crate) fn next_of_line(&mut self, line: u32) -> Option<Result<Entry, Error>> {
        if self.over {
            return None;
        }
        let entry = self.entry_of_line(line).transpose();
        self.over = !matches!(entry, Some(Ok(_)));
        entry
    }

    fn entry_of_line(&mut self, line: u32) -> Result<Option<Entry>, Error> {
        loop {
            self.pass_repeated(|form, _, cause| form.is_not_of(cause, line))?;
            match self.step(&|_, _, cause| cause.line == line)? {
                Step::Entry(Entry::Taken(taken)) if taken.line != line => {}
                Step::Entry(entry) => return Ok(Some(entry)),
                Step::Passed => {}
                Step::End => return Ok(None),
            }
        }
    }

    /// Passes over blocks that repeat a form, as far as they are in memory and `passes`
    /// says so of form, number and cause; the first of them that is not as it should be
    /// stays.
    fn pass_repeated(&mut self, passes: impl Fn(&Form, u64, Cause) -> bool) -> Result<(), Error> {
        let cant = |error| files::cant_read(Path::new(&self.name), &error);
        let buffer = self.input.fill_buf().map_err(cant)?;
        let (mut used, mut lines) = (0, 0);
        while let Some((form, length)) = repeated(&buffer[used..]) {
            let Some(form) = form.checked_sub(1).and_then(|at| self.forms.get(at)) else { break };
            let Some(cause) = form.after(self.last) else { break };
            let known = form.highest_stack as usize <= self.stacks.len();
            if !known || !passes(form, self.read + 1, cause) {
                break;
            }
            self.last = cause;
            self.read += 1;
            used += length;
            lines += 1;
        }
        self.input.consume(used);
        self.number = self.number.saturating_add(lines);
        Ok(())
    }
}

/// The number of a form at the start of some bytes, and the length of its line; `None` where
/// there is no such line, or not all of it.
fn repeated(bytes: &[u8]) -> Option<(usize, usize)> {
    const MOST: usize = 10;
    let (mut number, mut length) = (0, 0);
    for byte in &bytes[..bytes.len().min(MOST)] {
        length += 1;
        match byte {
            b'0'..=b'9' => number = number * 10 + usize::from(byte - b'0'),
            b'\n' if length > 1 => return Some((number, length)),
            _ => return None,
        }
    }
    None
}
