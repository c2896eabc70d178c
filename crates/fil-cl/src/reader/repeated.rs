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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Word;
    use crate::{Options, Reader, Vocabulary};

    fn read_all(text: &str) -> Vec<Record> {
        let mut reader = Reader::new(text.as_bytes(), "x.ncl", Options::default());
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        let mut records = Vec::new();
        while reader.read(&mut vocab, &mut record).unwrap() {
            records.push(record.clone());
        }
        records
    }

    #[test]
    fn a_line_makes_the_same_record_each_time() {
        let lines = [
            "RAPID",
            "FEDRAT / 10.5,  MMPM",
            "PPRINT / TOOL 1",
            "$$-> END /",
            "MACHIN / UNCX01, 1",
            "GOTO / 1, 2, 3",
            "GODLTA / 1, 2, 3",
            "SPINDL / RPM, 1E3, CLW $$ a comment",
        ];
        let text = lines.join("\n") + "\n";
        let records = read_all(&text.repeat(3));
        assert_eq!(records.len(), 3 * lines.len());
        for (first, later) in records.iter().zip(&records[lines.len()..]) {
            let passed = later.number - first.number;
            assert_eq!(passed as usize, lines.len());
            assert_eq!(Record { number: first.number, line: first.line, ..later.clone() }, *first);
            assert_eq!(later.line, first.line + passed);
        }
    }

    #[test]
    fn a_known_line_may_begin_a_longer_statement() {
        let records = read_all("COOLNT / ON\nCOOLNT / ON $\n, MIST\nCOOLNT / ON\n");
        let lengths: Vec<usize> = records.iter().map(|record| record.data.len()).collect();
        assert_eq!(lengths, [1, 2, 1]);
    }

    #[test]
    fn what_depends_on_other_statements_is_not_kept() {
        let mut repeated = Repeated::default();
        let motion = Record { kind: kind::MOTION, ..Record::default() };
        repeated.keep(b"GOTO / 1,2,3\n", &motion);
        let rapid = Record { kind: kind::POST, data: vec![Word::Empty], ..Record::default() };
        repeated.keep(b"RAPID\n", &rapid);
        let mut found = Record::default();
        assert_eq!(repeated.read(b"GOTO / 1,2,3\n", &mut found), None);
        assert_eq!(repeated.read(b"RAPID\nRAPID\n", &mut found), Some(6));
        assert_eq!(found, rapid);
        assert_eq!(repeated.read(b"RAPID", &mut found), None);
    }
}
