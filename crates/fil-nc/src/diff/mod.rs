//! Two NC programs compared word by word, as a control would read them.
//!
//! [`compare`] aligns the blocks of both programs and tells what the second one
//! says otherwise. A modal word that one program repeats and the other leaves
//! out is no difference, arcs are compared as geometry, and what a user chose
//! to ignore is not looked at. No machine is needed: the modal groups are those
//! that ISO 6983 and the controls built on it share, and a word of no known
//! group must be the same in both. Klartext and programs of a SINUMERIK are told by
//! their text: what is no word there is compared as a statement.

mod align;
mod arc;
mod language;
mod modal;
mod pair;
mod program;
mod say;
mod walk;

use std::fs::File;
use std::ops::Range;

use fil_diag::Diag;
use fil_text::CodePage;

use crate::source::Source;

pub use program::Program;
pub use say::sentence;

/// What is compared, and how exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Largest deviation of a length (in the unit of the programs) or an angle
    /// (degrees) treated as equal.
    pub tolerance: f64,
    /// What is not looked at.
    pub ignore: Ignore,
    /// Repeated modal words count: a word that only one program writes is a
    /// difference, whatever is in force.
    pub modal: bool,
    /// X is written as a diameter, so that its arcs start at half of it.
    pub diameter: bool,
    /// The encoding of both programs, for their comments.
    pub page: CodePage,
}

impl Default for Options {
    /// A thousandth, nothing ignored, modality understood.
    fn default() -> Self {
        Options {
            tolerance: 0.001,
            ignore: Ignore::default(),
            modal: false,
            diameter: false,
            page: CodePage::UTF_8,
        }
    }
}

/// What a comparison leaves out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ignore {
    /// Sequence numbers.
    pub numbers: bool,
    /// Comments.
    pub comments: bool,
    /// Dates and times inside comments.
    pub dates: bool,
    /// Whether a number is written with a point.
    pub points: bool,
    /// Words of these letters.
    pub letters: Vec<u8>,
}

impl Ignore {
    /// Adds an entry of an ignore list: `n`, `comments`, `dates`, `points`,
    /// `spaces` (which are never looked at) or a letter.
    ///
    /// # Errors
    /// The entry when it is none of these.
    pub fn add(&mut self, entry: &str) -> Result<(), String> {
        match entry.trim().to_ascii_lowercase().as_str() {
            "n" => self.numbers = true,
            "comments" => self.comments = true,
            "dates" => self.dates = true,
            "points" => self.points = true,
            "spaces" => {}
            letter if letter.len() == 1 && letter.as_bytes()[0].is_ascii_alphabetic() => {
                self.letters.push(letter.as_bytes()[0].to_ascii_uppercase());
            }
            other => return Err(other.to_string()),
        }
        Ok(())
    }
}

/// What differs at one place.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// A block that the other program lacks.
    Only,
    /// A letter other than G and M; `None` where a program lacks it and nothing
    /// is in force.
    Word(u8, [Option<f64>; 2]),
    /// A preparatory (G) or auxiliary (M) function of the same modal group.
    Function(u8, [Option<f64>; 2]),
    /// An arc that leaves the other by this much between the same ends.
    Arc(f64),
    /// Comments.
    Comment([String; 2]),
    /// What is no word of a letter: `TOOL CALL 5 Z`, `MCALL CYCLE81(…)`; empty where a
    /// block has none.
    Statement([String; 2]),
    /// Block skip or tape mark.
    Mark([bool; 2]),
    /// The sequence numbers differ in this many blocks, here for the first time.
    Numbering(usize, [Option<i64>; 2]),
    /// Words of this letter have a point in one program alone in this many
    /// blocks, here for the first time.
    Points(u8, usize),
}

/// A difference between two programs.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Lines, 1-based; `None` where that program has no such block.
    pub lines: [Option<u32>; 2],
    /// What differs.
    pub what: What,
    /// Bytes of the words in their lines.
    pub words: [Option<Range<usize>>; 2],
}

/// Lines that stand for each other, or lines of one program alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// The first line of each program, 1-based; `None` where that program has none.
    pub lines: [Option<u32>; 2],
    /// How many lines follow each other so.
    pub count: u32,
}

/// What a comparison found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// The differences in the order of the programs.
    pub differences: Vec<Difference>,
    /// What was compared with what, in order; none for programs of the same bytes.
    pub stretches: Vec<Stretch>,
}

impl Comparison {
    /// Pairs of lines that were compared, and lines alone, in order; empty lines are
    /// left out.
    pub fn pairs(&self) -> impl Iterator<Item = [Option<u32>; 2]> {
        self.stretches.iter().flat_map(|stretch| {
            (0..stretch.count).map(|at| stretch.lines.map(|line| line.map(|line| line + at)))
        })
    }

    /// Adds a pair, or a line alone.
    fn note(&mut self, lines: [Option<u32>; 2]) {
        if let Some(last) = self.stretches.last_mut()
            && last.lines.map(|line| line.map(|line| line + last.count)) == lines
        {
            last.count += 1;
        } else {
            self.stretches.push(Stretch { lines, count: 1 });
        }
    }
}

/// Compares two programs that were read by the same options.
///
/// # Errors
/// E0915 when the file of a program is no longer what it was.
pub fn compare(
    first: &Program,
    second: &Program,
    options: &Options,
) -> Result<Comparison, Box<Diag>> {
    if first.same_as(second) {
        return Ok(Comparison::default());
    }
    let runs = align::align(first, second, options)?;
    walk::compare(first, second, options, runs)
}

/// Reads a program for a comparison; `name` is for messages.
///
/// # Errors
/// The first line that can't be read.
pub fn read(text: &[u8], name: &str, options: &Options) -> Result<Program, Box<Diag>> {
    Program::read(text, name, options)
}

/// The same from where a text lies.
///
/// # Errors
/// As [`read`].
pub fn read_source(
    source: Source<'static>,
    name: &str,
    options: &Options,
) -> Result<Program, Box<Diag>> {
    Program::index(source, name, options)
}

/// Reads two programs from files that can be read again; their text is not kept in
/// memory. The names are for messages.
///
/// # Errors
/// As [`read`].
pub fn open(
    [first, second]: [(File, &str); 2],
    options: &Options,
) -> Result<[Program; 2], Box<Diag>> {
    Program::open([first, second], options)
}
