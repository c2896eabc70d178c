//! Two programs say the same: the moves of both, block by block.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// Compares the axis and feed words of two programs, by value; gives the
/// number of blocks with a move.
///
/// # Errors
/// The first block where they differ.
pub fn same_moves(first: &Path, second: &Path) -> io::Result<u64> {
    let mut first = Moves::open(first)?;
    let mut second = Moves::open(second)?;
    let mut count = 0;
    loop {
        match (first.next()?, second.next()?) {
            (None, None) => return Ok(count),
            (one, two) if one == two => count += 1,
            (one, two) => {
                let message = format!("move {}: {one:?} and {two:?}", count + 1);
                return Err(io::Error::other(message));
            }
        }
    }
}

/// The moves of a program.
struct Moves {
    lines: BufReader<File>,
    line: String,
}

impl Moves {
    fn open(path: &Path) -> io::Result<Self> {
        let lines = BufReader::with_capacity(256 * 1024, File::open(path)?);
        Ok(Moves { lines, line: String::new() })
    }

    /// X, Y, Z and F of the next block that has one of X, Y and Z.
    fn next(&mut self) -> io::Result<Option<[Option<f64>; 4]>> {
        loop {
            self.line.clear();
            if self.lines.read_line(&mut self.line)? == 0 {
                return Ok(None);
            }
            let values = ['X', 'Y', 'Z', 'F'].map(|letter| value_of(&self.line, letter));
            if values[..3].iter().any(Option::is_some) {
                return Ok(Some(values));
            }
        }
    }
}

/// The value of a word of a block.
fn value_of(block: &str, letter: char) -> Option<f64> {
    block.split_ascii_whitespace().find_map(|word| word.strip_prefix(letter)?.parse().ok())
}
