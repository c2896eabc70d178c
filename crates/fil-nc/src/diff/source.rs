//! The text of a program, in memory or in a file that is read as often as it is needed.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::sync::{Mutex, PoisonError};

/// Bytes that are read at once.
const CHUNK: usize = 64 * 1024;

/// Where the text lies.
#[derive(Debug)]
pub(super) enum Source {
    Memory(Vec<u8>),
    File(Mutex<File>),
}

impl Source {
    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Source::Memory(text) => {
                let from = text.len().min(usize::try_from(offset).unwrap_or(usize::MAX));
                (&text[from..]).read(buffer)
            }
            Source::File(file) => {
                let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
                file.seek(SeekFrom::Start(offset))?;
                file.read(buffer)
            }
        }
    }

    /// How many bytes at the start are the same in both, and whether that is all of both.
    pub fn common(&self, other: &Source) -> io::Result<(u64, bool)> {
        let (mut one, mut two) = (vec![0; CHUNK], vec![0; CHUNK]);
        let mut offset = 0;
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
fn fill(source: &Source, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
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

/// The lines of a text, one after the other.
pub(super) struct Lines<'s> {
    source: &'s Source,
    buffer: Vec<u8>,
    /// The part of the buffer that is not yet handed out.
    from: usize,
    to: usize,
    /// Of the first byte of the buffer.
    offset: u64,
    ended: bool,
}

impl<'s> Lines<'s> {
    /// The lines from a place of the text that begins one.
    pub fn from(source: &'s Source, offset: u64) -> Self {
        Lines { source, buffer: vec![0; CHUNK], from: 0, to: 0, offset, ended: false }
    }

    /// Where the next line begins.
    pub fn at(&self) -> u64 {
        self.offset + self.from as u64
    }

    /// The next line without its line feed; what follows the last line feed is a
    /// line too.
    pub fn next_line(&mut self) -> io::Result<Option<&[u8]>> {
        let mut searched = self.from;
        loop {
            let found = self.buffer[searched..self.to].iter().position(|byte| *byte == b'\n');
            if let Some(at) = found {
                let line = self.from..searched + at;
                self.from = line.end + 1;
                return Ok(Some(&self.buffer[line]));
            }
            if self.ended {
                return Ok(None);
            }
            searched = self.to - self.from;
            if !self.read_more()? {
                self.ended = true;
                let line = self.from..self.to;
                self.from = self.to;
                return Ok(Some(&self.buffer[line]));
            }
        }
    }

    /// Moves what is left to the start of the buffer and reads behind it; false at
    /// the end of the text.
    fn read_more(&mut self) -> io::Result<bool> {
        self.buffer.copy_within(self.from..self.to, 0);
        self.offset += self.from as u64;
        (self.from, self.to) = (0, self.to - self.from);
        if self.to == self.buffer.len() {
            self.buffer.resize(self.to * 2, 0);
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
        let source = Source::Memory(text.to_vec());
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
    fn common_bytes_end_at_the_first_difference_or_the_shorter_text() {
        let common = |one: &[u8], two: &[u8]| {
            Source::Memory(one.to_vec()).common(&Source::Memory(two.to_vec())).unwrap()
        };
        assert_eq!(common(b"", b""), (0, true));
        assert_eq!(common(b"AB", b"AB"), (2, true));
        assert_eq!(common(b"AB", b"ABC"), (2, false));
        assert_eq!(common(b"ABD", b"ABC"), (2, false));
        let long = vec![b'A'; 2 * CHUNK];
        assert_eq!(common(&long, &long), (2 * CHUNK as u64, true));
        assert_eq!(common(&long, &long[1..]), (2 * CHUNK as u64 - 1, false));
    }
}
