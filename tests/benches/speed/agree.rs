//! Two programs cut the same: where their feed moves end, and how fast they are.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// Compares the feed moves of two programs; rapids may go by way of other points.
///
/// # Errors
/// The first feed move where they differ.
pub fn same_cuts(first: &Path, second: &Path) -> io::Result<()> {
    let (mut one, mut two) = (Cuts::open(first)?, Cuts::open(second)?);
    loop {
        match (one.next()?, two.next()?) {
            (None, None) => return Ok(()),
            (cut, other) if cut == other => {}
            (cut, other) => {
                let message = format!("{cut:?} in {}, {other:?} in {}", one.block, two.block);
                return Err(io::Error::other(message));
            }
        }
    }
}

/// The feed moves of a program.
struct Cuts {
    lines: BufReader<File>,
    block: String,
    rapid: bool,
    at: Cut,
}

/// Where a feed move ends, and its feed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Cut {
    point: [f64; 3],
    feed: f64,
}

impl Cuts {
    fn open(path: &Path) -> io::Result<Self> {
        let lines = BufReader::with_capacity(256 * 1024, File::open(path)?);
        Ok(Cuts { lines, block: String::new(), rapid: false, at: Cut::default() })
    }

    fn next(&mut self) -> io::Result<Option<Cut>> {
        loop {
            self.block.clear();
            if self.lines.read_line(&mut self.block)? == 0 {
                return Ok(None);
            }
            let mut moves = false;
            for word in self.block.split_ascii_whitespace() {
                let (letter, value) = word.split_at(1);
                let target = match letter {
                    "X" => &mut self.at.point[0],
                    "Y" => &mut self.at.point[1],
                    "Z" => &mut self.at.point[2],
                    "F" => &mut self.at.feed,
                    "G" if value == "0" || value == "1" => {
                        self.rapid = value == "0";
                        continue;
                    }
                    _ => continue,
                };
                *target = value.parse().map_err(io::Error::other)?;
                moves |= letter != "F";
            }
            if moves && !self.rapid {
                return Ok(Some(self.at));
            }
        }
    }
}
