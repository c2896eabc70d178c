//! Lines of long files by their numbers: line feeds are counted, nothing is read twice.

use std::io::{self, Read};

/// Bytes read at once.
const CHUNK: usize = 256 * 1024;

/// Where a line, counted from 1, begins; `None` when there are not so many.
pub(super) fn offset(input: &mut impl Read, line: u64) -> io::Result<Option<u64>> {
    let Some(mut ahead) = line.checked_sub(1) else { return Ok(None) };
    let mut buffer = vec![0; CHUNK];
    let mut before = 0;
    while ahead > 0 {
        let chunk = match input.read(&mut buffer) {
            Ok(0) => return Ok(None),
            Ok(read) => &buffer[..read],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        let feeds = feeds(chunk);
        if feeds >= ahead {
            let mut ends = chunk.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
            let end = ends.nth(ahead as usize - 1).map_or(0, |(at, _)| at as u64 + 1);
            return Ok(Some(before + end));
        }
        ahead -= feeds;
        before += chunk.len() as u64;
    }
    Ok(Some(before))
}

/// How many lines there are; what follows the last line feed is one if it is not empty.
pub(super) fn count(input: &mut impl Read) -> io::Result<u64> {
    let mut buffer = vec![0; CHUNK];
    let (mut lines, mut open) = (0, false);
    loop {
        match input.read(&mut buffer) {
            Ok(0) => return Ok(lines + u64::from(open)),
            Ok(read) => {
                lines += feeds(&buffer[..read]);
                open = buffer[read - 1] != b'\n';
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// Line feeds of a chunk. Sums of bytes, so that the compiler adds many at once.
fn feeds(chunk: &[u8]) -> u64 {
    const LONGEST: usize = 255;
    let sum = |part: &[u8]| part.iter().fold(0u8, |sum, byte| sum + u8::from(*byte == b'\n'));
    chunk.chunks(LONGEST).map(|part| u64::from(sum(part))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_where_they_begin() {
        let long = [vec![b'\n'; 1000], vec![b'A'; 2 * CHUNK], b"\nB\n".to_vec()].concat();
        for text in [&b""[..], b"A", b"A\n", b"A\nB\n\nC", &long] {
            let mut at = 0;
            let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
            for (number, line) in (1u64..).zip(&lines) {
                assert_eq!(offset(&mut &text[..], number).unwrap(), Some(at));
                at += line.len() as u64;
            }
            assert_eq!(count(&mut &text[..]).unwrap(), lines.len() as u64);
            assert_eq!(offset(&mut &text[..], lines.len() as u64 + 2).unwrap(), None);
        }
        assert_eq!(offset(&mut &b"A"[..], 0).unwrap(), None);
    }
}
