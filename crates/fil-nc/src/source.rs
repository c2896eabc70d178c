//! The text of a program, in memory or in a file that is read as often as it is needed.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use fil_diag::Diag;
use fil_text::CodePage;

use crate::errors::NcCode;

/// Bytes that are read at once.
const CHUNK: usize = 64 * 1024;

/// Longest line that is read, in bytes: no control takes a block of that length.
const LONGEST: usize = 1 << 20;

/// Bytes that are read first behind a jump: few lines may be wanted.
const FIRST_CHUNK: usize = 4 * 1024;

/// A text and its encoding.
#[derive(Debug)]
pub struct Source<'t> {
    place: Place<'t>,
    page: CodePage,
}

/// Where a text lies.
#[derive(Debug)]
enum Place<'t> {
    /// In memory.
    Memory(Cow<'t, [u8]>),
    /// In a file that can be read anywhere.
    File(Arc<Mutex<File>>),
}

impl<'t> Source<'t> {
    /// A text in memory, in UTF-8.
    pub fn memory(text: &'t [u8]) -> Self {
        Source { place: Place::Memory(Cow::Borrowed(text)), page: CodePage::UTF_8 }
    }
}

impl Source<'_> {
    /// A text that is handed over, in UTF-8.
    pub fn owned(text: Vec<u8>) -> Source<'static> {
        Source { place: Place::Memory(text.into()), page: CodePage::UTF_8 }
    }

    /// A file that can be read anywhere, in UTF-8; it is not kept in memory.
    pub fn file(file: File) -> Self {
        Source { place: Place::File(Arc::new(Mutex::new(file))), page: CodePage::UTF_8 }
    }

    /// The same text, read in a code page: an encoding whose line feeds are those of ASCII.
    pub fn in_page(&self, page: CodePage) -> Source<'_> {
        let place = match &self.place {
            Place::Memory(text) => Place::Memory(Cow::Borrowed(text)),
            Place::File(file) => Place::File(Arc::clone(file)),
        };
        Source { place, page }
    }

    /// This text, read in a code page.
    pub fn into_page(self, page: CodePage) -> Self {
        Source { page, ..self }
    }

    /// The same text to be kept: a file once more, what lies in memory copied.
    ///
    /// # Errors
    /// What the system says when a file can't be opened twice.
    pub fn again(&self) -> io::Result<Source<'static>> {
        let again = match &self.place {
            Place::Memory(text) => Source::owned(text.to_vec()),
            Place::File(file) => {
                Source::file(file.lock().unwrap_or_else(PoisonError::into_inner).try_clone()?)
            }
        };
        Ok(Source { page: self.page, ..again })
    }

    /// Texts of some lines, 1-based and ascending; a line that is not there has none.
    ///
    /// # Errors
    /// E0915 when the file can't be read any more; `name` is for the message.
    pub fn lines(&self, name: &str, wanted: &[u32]) -> Result<Vec<(u32, String)>, Box<Diag>> {
        let mut lines = Lines::from(self, 0);
        let mut found = Vec::new();
        let mut number = 0;
        for wanted in wanted {
            while number < *wanted {
                let text = lines.next_line().map_err(|error| unreadable(name, &error))?;
                let Some(text) = text else { return Ok(found) };
                number += 1;
                if number == *wanted {
                    found.push((number, String::from_utf8_lossy(text).trim_end().to_string()));
                }
            }
        }
        Ok(found)
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        match &self.place {
            Place::Memory(text) => {
                let from = text.len().min(usize::try_from(offset).unwrap_or(usize::MAX));
                (&text[from..]).read(buffer)
            }
            Place::File(file) => {
                let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
                file.seek(SeekFrom::Start(offset))?;
                file.read(buffer)
            }
        }
    }

    /// How many bytes at the start are the same in both, and whether that is all of both.
    pub(crate) fn common(&self, other: &Source<'_>) -> io::Result<(u64, bool)> {
        let (mut one, mut two) = (vec![0; CHUNK], vec![0; CHUNK]);
        let mut offset = 0;
        if self.page != other.page {
            return Ok((0, false));
        }
        loop {
            let read = fill(self, offset, &mut one)?;
            let count = fill(other, offset, &mut two)?;
            let same = one[..read].iter().zip(&two[..count]).take_while(|(a, b)| a == b).count();
            offset += same as u64;
            if same < read.max(count) || read == 0 {
                return Ok((offset, same == read && same == count));
            }
        }
    }
}

/// Reads as much as fits, less at the end of the text.
fn fill(source: &Source<'_>, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
    let mut read = 0;
    while read < buffer.len() {
        match source.read_at(offset + read as u64, &mut buffer[read..]) {
            Ok(0) => break,
            Ok(count) => read += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(read)
}

/// E0916 for a line that is too long, E0915 where the text can't be read a second time.
pub fn unreadable(name: &str, error: &io::Error) -> Diag {
    if error.kind() == io::ErrorKind::InvalidData {
        return Diag::new(NcCode::LineTooLong, format!("{name}: {error}"));
    }
    changed(name, &error.to_string())
}

/// E0915: the text can't be read a second time.
pub(crate) fn changed(name: &str, why: &str) -> Diag {
    Diag::new(NcCode::Changed, format!("{name}: {why}"))
}

/// The lines of a text, one after the other.
pub struct Lines<'s> {
    source: &'s Source<'s>,
    buffer: Vec<u8>,
    /// The part of the buffer that is not yet handed out.
    from: usize,
    to: usize,
    /// Of the first byte of the buffer.
    offset: u64,
    ended: bool,
    /// The last line that is not ASCII, in UTF-8.
    decoded: String,
}

impl<'s> Lines<'s> {
    /// The lines from a place of the text that begins one.
    pub fn from(source: &'s Source<'s>, offset: u64) -> Self {
        let first = if offset == 0 { CHUNK } else { FIRST_CHUNK };
        Lines {
            source,
            buffer: vec![0; first],
            from: 0,
            to: 0,
            offset,
            ended: false,
            decoded: String::new(),
        }
    }

    /// Goes on at another place of the text that begins a line.
    pub fn go_to(&mut self, offset: u64) {
        let within = offset.checked_sub(self.offset).and_then(|at| usize::try_from(at).ok());
        match within.filter(|at| *at <= self.to) {
            Some(at) => self.from = at,
            None => (self.from, self.to, self.offset) = (0, 0, offset),
        }
        self.ended = false;
    }

    /// Where the next line begins.
    pub fn at(&self) -> u64 {
        self.offset + self.from as u64
    }

    /// The next line without its line feed; what follows the last line feed is a
    /// line too.
    pub fn next_line(&mut self) -> io::Result<Option<&[u8]>> {
        let range = self.next_range()?;
        Ok(range.map(|line| self.in_utf8(line)))
    }

    /// The next line without its line feed; what follows the last line feed is a
    /// line only where something stands there.
    pub fn next_full_line(&mut self) -> io::Result<Option<&[u8]>> {
        let range = self.next_range()?.filter(|line| !(self.ended && line.is_empty()));
        Ok(range.map(|line| self.in_utf8(line)))
    }

    /// A line of the buffer, decoded where its bytes are not those of UTF-8.
    #[inline]
    fn in_utf8(&mut self, line: Range<usize>) -> &[u8] {
        if self.buffer[line.clone()].is_ascii() { &self.buffer[line] } else { self.decode(line) }
    }

    #[cold]
    fn decode(&mut self, line: Range<usize>) -> &[u8] {
        let bytes = &self.buffer[line];
        match self.source.page.decode_all(bytes) {
            Cow::Borrowed(_) => bytes,
            Cow::Owned(text) => {
                self.decoded = text;
                self.decoded.as_bytes()
            }
        }
    }

    fn next_range(&mut self) -> io::Result<Option<Range<usize>>> {
        let mut searched = self.from;
        loop {
            let found = memchr::memchr(b'\n', &self.buffer[searched..self.to]);
            if let Some(at) = found {
                let line = self.from..searched + at;
                self.from = line.end + 1;
                return Ok(Some(line));
            }
            if self.ended {
                return Ok(None);
            }
            searched = self.to - self.from;
            if searched > LONGEST {
                let what = format!("a line of more than {LONGEST} bytes");
                return Err(io::Error::new(io::ErrorKind::InvalidData, what));
            }
            if !self.read_more()? {
                self.ended = true;
                let line = self.from..self.to;
                self.from = self.to;
                return Ok(Some(line));
            }
        }
    }

    /// Moves what is left to the start of the buffer and reads behind it; false at
    /// the end of the text.
    fn read_more(&mut self) -> io::Result<bool> {
        self.buffer.copy_within(self.from..self.to, 0);
        self.offset += self.from as u64;
        (self.from, self.to) = (0, self.to - self.from);
        if self.to == self.buffer.len() || self.buffer.len() < CHUNK {
            self.buffer.resize(self.buffer.len() * 2, 0);
        }
        let next = self.offset + self.to as u64;
        let count = fill(self.source, next, &mut self.buffer[self.to..])?;
        self.to += count;
        Ok(count > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Vec<Vec<u8>> {
        let source = Source::memory(text);
        let mut lines = Lines::from(&source, 0);
        std::iter::from_fn(|| lines.next_line().unwrap().map(<[u8]>::to_vec)).collect()
    }

    #[test]
    fn lines_are_those_of_split_whatever_their_lengths() {
        let long = [vec![b'A'; CHUNK - 1], vec![b'\n'], vec![b'B'; 3 * CHUNK], b"\nC".to_vec()];
        for text in [&b""[..], b"\n", b"A", b"A\n", b"A\nB\r\n\nC", &long.concat()] {
            let split: Vec<_> = text.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
            assert_eq!(lines(text), split);
        }
    }

    #[test]
    fn reading_goes_on_anywhere() {
        let text: String = (0..40_000).map(|n| format!("N{n}\n")).collect();
        let source = Source::memory(text.as_bytes());
        let start = |n: u32| text.find(&format!("N{n}\n")).unwrap() as u64;
        let mut lines = Lines::from(&source, start(30_000));
        for n in [30_000, 5, 39_999, 6, 29_999] {
            lines.go_to(start(n));
            for next in n..(n + 9).min(40_000) {
                assert_eq!(lines.next_line().unwrap(), Some(format!("N{next}").as_bytes()));
            }
        }
        let found = source.lines("nc", &[1, 7, 40_001, 40_002]).unwrap();
        assert_eq!(found.iter().map(|(n, _)| *n).collect::<Vec<_>>(), [1, 7, 40_001]);
        assert_eq!(found[1].1, "N6");
    }

    #[test]
    fn common_bytes_end_at_the_first_difference_or_the_shorter_text() {
        let common =
            |one: &[u8], two: &[u8]| Source::memory(one).common(&Source::memory(two)).unwrap();
        assert_eq!(common(b"", b""), (0, true));
        assert_eq!(common(b"AB", b"AB"), (2, true));
        assert_eq!(common(b"AB", b"ABC"), (2, false));
        assert_eq!(common(b"ABD", b"ABC"), (2, false));
        let long = vec![b'A'; 2 * CHUNK];
        assert_eq!(common(&long, &long), (2 * CHUNK as u64, true));
        assert_eq!(common(&long, &long[1..]), (2 * CHUNK as u64 - 1, false));
    }
}
