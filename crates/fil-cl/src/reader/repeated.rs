//! Statements that come again and again with the same text: `RAPID`, a FEDRAT
//! between two rapids, `COOLNT / ON`. They are read once and then known by their
//! line.

use crate::record::{Record, kind};
use crate::words;

/// Lines kept at a time.
const LINES: usize = 16;

/// Longest line that is kept.
const LONGEST: usize = 64;

/// A line, line end included, and the record it makes.
#[derive(Default)]
struct Known {
    line: Vec<u8>,
    record: Record,
}

/// The lines known by now, each in the place its bytes name.
#[derive(Default)]
pub(super) struct Repeated {
    known: [Known; LINES],
}

impl Repeated {
    /// Makes `record` what the first line of `text` makes, when that is known;
    /// gives the length of the line.
    #[inline]
    pub(super) fn read(&self, text: &[u8], record: &mut Record) -> Option<usize> {
        let head = &text[..text.len().min(LONGEST)];
        let length = memchr::memchr(b'\n', head)? + 1;
        let known = &self.known[place(&head[..length])];
        if known.line != head[..length] {
            return None;
        }
        copy(&known.record, record);
        Some(length)
    }

    /// Keeps a line that is a whole statement, unless its record depends on the
    /// statements before it or leaves something for those after it.
    pub(super) fn keep(&mut self, line: &[u8], record: &Record) {
        let is_modal = record.kind == kind::MOTION || record.major == words::MULTAX;
        if is_modal || line.len() > LONGEST || !line.ends_with(b"\n") {
            return;
        }
        let known = &mut self.known[place(line)];
        known.line.clear();
        known.line.extend_from_slice(line);
        copy(record, &mut known.record);
    }
}

/// Makes `to` what `from` is; its buffers are used again.
fn copy(from: &Record, to: &mut Record) {
    (to.kind, to.sub, to.major) = (from.kind, from.sub, from.major);
    to.data.clear();
    to.data.extend_from_slice(&from.data);
    to.text.clear();
    to.text.push_str(&from.text);
}

/// Where a line is kept: by its length and the bytes in which such lines differ.
#[inline]
fn place(line: &[u8]) -> usize {
    let byte = |at: usize| usize::from(line[at]);
    let middle = line.len() / 2;
    (line.len() + byte(0) * 7 + byte(middle) * 5 + byte(middle / 2) * 3) % LINES
}
