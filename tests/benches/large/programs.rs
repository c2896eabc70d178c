//! Programs that differ from another one in places.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

/// Blocks that are moved from one place of a program to another.
const MOVED: usize = 1000;

/// Places at which a block is changed.
const EDITS: usize = 10;

/// Changes a block in ten places; the others stay letter by letter.
pub fn edit(nc: &Path, edited: &Path, blocks: usize) -> io::Result<()> {
    let mut output = BufWriter::new(File::create(edited)?);
    for (number, line) in BufReader::new(File::open(nc)?).lines().enumerate() {
        let line = line?;
        match number % (blocks / EDITS) == blocks / EDITS / 2 {
            true => writeln!(output, "{line} M8")?,
            false => writeln!(output, "{line}")?,
        }
    }
    output.flush()
}

/// Moves blocks from the first fifth of a program to the last.
pub fn shift(nc: &Path, moved: &Path, blocks: usize) -> io::Result<()> {
    let mut output = BufWriter::new(File::create(moved)?);
    let (from, to) = (blocks / 5, blocks / 5 * 4);
    let mut held = Vec::with_capacity(MOVED);
    for (number, line) in BufReader::new(File::open(nc)?).lines().enumerate() {
        let line = line?;
        if (from..from + MOVED).contains(&number) {
            held.push(line);
            continue;
        }
        writeln!(output, "{line}")?;
        if number == to {
            held.iter().try_for_each(|line| writeln!(output, "{line}"))?;
        }
    }
    output.flush()
}
