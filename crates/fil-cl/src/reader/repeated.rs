//! Statements that come again and again with the same text: `RAPID`, a FEDRAT
//! between two rapids, the coordinate system of each operation. They are read once
//! and then known by their lines.

use std::hash::Hasher;

use rustc_hash::FxHasher;

use super::Reader;
use crate::record::{Record, kind};
use crate::words;

/// Places of statements.
const PLACES: usize = 64;

/// Statements kept in each place: two that alternate, as RAPID and FEDRAT do, may share one.
const KEPT: usize = 2;

/// Longest first line of a statement that is kept.
const LONGEST: usize = 80;

/// Longest statement that is kept.
const LONGEST_STATEMENT: usize = 4 * LONGEST;

/// A statement, line ends included, and the record it makes.
#[derive(Default)]
struct Known {
    /// Empty as long as none is kept.
    text: Vec<u8>,
    lines: u32,
    record: Record,
}

impl Known {
    /// The statement is what a text begins with. It ends with its last line, so that no longer one
    /// begins alike.
    #[inline]
    fn begins(&self, text: &[u8]) -> bool {
        !self.text.is_empty() && text.starts_with(&self.text)
    }
}

/// The statements known by now.
pub(super) struct Repeated {
    /// The first is none.
    known: Vec<Known>,
    /// Which of them stand in the place that their first line names.
    places: [[u8; KEPT]; PLACES],
    /// The two that came last: one of them comes next in most files.
    last: [u8; 2],
    /// Place of the statement that was looked for and not found: it is kept there once it is read.
    missed: Option<usize>,
}

impl Default for Repeated {
    fn default() -> Self {
        let known = vec![Known::default()];
        Repeated { known, places: [[0; KEPT]; PLACES], last: [0; 2], missed: None }
    }
}

impl Repeated {
    /// Makes `record` what the statement at the start of `text` makes, when that is
    /// known; gives its length and the number of its lines.
    #[inline]
    pub(super) fn read(&mut self, text: &[u8], record: &mut Record) -> Option<(usize, u32)> {
        let [last, before] = self.last;
        if !self.known[usize::from(last)].begins(text) {
            let is_before = self.known[usize::from(before)].begins(text);
            self.last = [if is_before { before } else { self.find(text)? }, last];
        }
        let known = &self.known[usize::from(self.last[0])];
        copy(&known.record, record);
        Some((known.text.len(), known.lines))
    }

    /// The statement at the start of `text`.
    fn find(&mut self, text: &[u8]) -> Option<u8> {
        self.missed = None;
        let head = &text[..text.len().min(LONGEST)];
        let length = memchr::memchr(b'\n', head)? + 1;
        let place = place(&head[..length]);
        let is_it = |known: &u8| self.known[usize::from(*known)].begins(text);
        let found = self.places[place].into_iter().find(is_it);
        if found.is_none() {
            self.missed = Some(place);
        }
        found
    }

    /// Keeps the statement of so many lines that was looked for last, unless its record depends on the
    /// statements before it or leaves something for those after it. It takes the room of
    /// the one that was kept longest in its place.
    pub(super) fn keep(&mut self, text: &[u8], lines: u32, record: &Record) {
        let is_modal = record.kind == kind::MOTION
            || matches!(record.major, words::MULTAX | words::TLAXIS | words::GOHOME);
        let is_whole = text.len() <= LONGEST_STATEMENT && text.ends_with(b"\n");
        let Some(place) = self.missed.take().filter(|_| is_whole && !is_modal) else { return };
        let place = &mut self.places[place];
        place.rotate_right(1);
        if place[0] == 0 {
            place[0] = self.known.len() as u8;
            self.known.push(Known::default());
        }
        let known = &mut self.known[usize::from(place[0])];
        known.text.clear();
        known.text.extend_from_slice(text);
        known.lines = lines;
        copy(record, &mut known.record);
    }
}

impl Reader<'_> {
    /// The short way for a statement that was read before.
    #[inline]
    pub(super) fn read_repeated(&mut self, record: &mut Record) -> bool {
        let Some((length, lines)) = self.repeated.read(self.lines.unread(), record) else {
            return false;
        };
        record.line = self.take_lines(length, lines);
        if record.kind == kind::SURFACE {
            self.modal.in_arc = true;
            self.note_circle(record);
        } else {
            self.modal.forms.arc_points = None;
        }
        self.count(record);
        true
    }
}

/// Makes `to` what `from` is; its buffers are used again.
fn copy(from: &Record, to: &mut Record) {
    (to.kind, to.sub, to.major, to.inert) = (from.kind, from.sub, from.major, from.inert);
    to.data.clear();
    to.data.extend_from_slice(&from.data);
    to.text.clear();
    to.text.push_str(&from.text);
}

/// Where a statement is kept, by its first line.
#[inline]
fn place(line: &[u8]) -> usize {
    let mut hasher = FxHasher::default();
    hasher.write(line);
    hasher.finish() as usize % PLACES
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
    fn statements_of_several_lines_keep_their_places() {
        let text = "$$-> CSYS / 1, 0, $\n 0, 4, $\n 5\n\n$$ a comment\nCOOLNT / $\n ON\n";
        let once = read_all(text);
        let places: Vec<u32> = once.iter().map(|record| record.line).collect();
        assert_eq!(places, [1, 6]);
        let again = read_all(&text.repeat(3));
        for (at, record) in again.iter().enumerate() {
            let first = &once[at % 2];
            assert_eq!(record.line, first.line + 7 * (at as u32 / 2));
            assert_eq!(record.number, at as u32 + 1);
            assert_eq!((&record.data, &record.text), (&first.data, &first.text));
        }
    }

    #[test]
    fn a_statement_that_goes_on_otherwise_is_read_anew() {
        let text = "CUTTER / 1, $\n 2\nCUTTER / 1, $\n 3\nCUTTER / 1, $\n 2, $\n 4\nRAPID\n";
        let lengths: Vec<usize> = read_all(text).iter().map(|record| record.data.len()).collect();
        assert_eq!(lengths, [2, 2, 3, 0]);
    }

    /// Keeps a statement of one line, which nobody has kept before.
    fn look_and_keep(repeated: &mut Repeated, text: &[u8], record: &Record) {
        assert!(repeated.read(text, &mut Record::default()).is_none());
        repeated.keep(text, 1, record);
    }

    #[test]
    fn statements_that_share_a_place_are_kept_both() {
        let mut repeated = Repeated::default();
        let rapid = b"RAPID\n";
        let texts = (0..).map(|number| format!("FEDRAT / {number}, MMPM\n"));
        let shares = |text: &String| place(text.as_bytes()) == place(rapid);
        let feeds: Vec<String> = texts.filter(shares).take(KEPT).collect();
        let record = Record { kind: kind::POST, ..Record::default() };
        let mut found = Record::default();
        look_and_keep(&mut repeated, rapid, &record);
        look_and_keep(&mut repeated, feeds[0].as_bytes(), &record);
        assert!(repeated.read(rapid, &mut found).is_some());
        assert!(repeated.read(feeds[0].as_bytes(), &mut found).is_some());
        look_and_keep(&mut repeated, feeds[1].as_bytes(), &record);
        assert!(repeated.read(rapid, &mut found).is_none());
    }

    #[test]
    fn what_depends_on_other_statements_is_not_kept() {
        let mut repeated = Repeated::default();
        let motion = Record { kind: kind::MOTION, ..Record::default() };
        look_and_keep(&mut repeated, b"GOTO / 1,2,3\n", &motion);
        let rapid = Record { kind: kind::POST, data: vec![Word::Empty], ..Record::default() };
        look_and_keep(&mut repeated, b"RAPID\n", &rapid);
        let mut found = Record::default();
        assert_eq!(repeated.read(b"GOTO / 1,2,3\n", &mut found), None);
        assert_eq!(repeated.read(b"RAPID\nRAPID\n", &mut found), Some((6, 1)));
        assert_eq!(found, rapid);
        assert_eq!(repeated.read(b"RAPID", &mut found), None);
    }
}
