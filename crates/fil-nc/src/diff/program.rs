//! A program read for a comparison: what its blocks say, each as one number, and
//! where its text lies.
//!
//! Nothing is kept of a block but its [`token`]. Where blocks themselves are asked
//! for, a [`Cursor`] reads the text again from the checkpoint before them.

use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::sync::{Arc, Mutex, PoisonError};

use fil_diag::{Diag, TextSpan};

use super::Options;
use super::language::read_into;
use super::modal::{Modal, group, tenths};
use crate::dialect::Family;
use crate::source::{Lines, Source, changed, unreadable};
use crate::text::{Block, Word};

/// Steps of a unit of length that the alignment tells apart.
const STEPS: f64 = 1e4;

/// Lines from one checkpoint to the next.
const STRETCH: u32 = 512;

/// A line and what is in force.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    pub block: Block,
    pub before: Modal,
    pub after: Modal,
    /// It only repeats what is in force.
    pub silent: bool,
}

/// A place from which a program can be read again.
#[derive(Clone, Debug, Default)]
pub(super) struct Checkpoint {
    /// Byte of the text where the line begins.
    pub offset: u64,
    /// The line before, 1-based: 0 at the start.
    pub line: u32,
    /// How many blocks stand before it.
    pub blocks: usize,
    modal: Modal,
}

/// What stands for the blocks of a program.
#[derive(Debug)]
struct Index {
    family: Family,
    /// The same for blocks that say the same; one for each line that is not empty.
    tokens: Vec<u64>,
    checkpoints: Vec<Checkpoint>,
}

/// A program read for a comparison.
#[derive(Clone, Debug)]
pub struct Program {
    name: String,
    pub(super) source: Arc<Source<'static>>,
    options: Arc<Options>,
    index: Arc<Index>,
    /// The lines that were asked for last.
    shown: Arc<Mutex<Shown>>,
}

/// Texts of the lines between two checkpoints.
#[derive(Debug, Default)]
struct Shown {
    first: u32,
    texts: Vec<String>,
}

impl Program {
    /// Takes up a text in memory.
    pub(super) fn read(text: &[u8], name: &str, options: &Options) -> Result<Self, Box<Diag>> {
        Program::index(Source::owned(text.to_vec()), name, options)
    }

    /// Takes up two files that stay where they are, side by side; one of them when
    /// both have the same bytes.
    pub(super) fn open(
        files: [(File, &str); 2],
        options: &Options,
    ) -> Result<[Self; 2], Box<Diag>> {
        let [(one, name), (two, other)] = files.map(|(file, name)| (Source::file(file), name));
        if matches!(one.common(&two), Ok((_, true))) {
            let first = Program::index(one, name, options)?;
            let shown = Arc::default();
            let second = Program { name: other.to_string(), shown, ..first.clone() };
            return Ok([first, second]);
        }
        let (first, second) = std::thread::scope(|scope| {
            let first = scope.spawn(|| Program::index(one, name, options));
            let second = Program::index(two, other, options);
            (first.join(), second)
        });
        let first = first.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok([first?, second?])
    }

    pub(super) fn index(
        source: Source<'static>,
        name: &str,
        options: &Options,
    ) -> Result<Self, Box<Diag>> {
        let cant = |error: io::Error| Box::new(unreadable(name, &error));
        let source = source.into_page(options.page);
        let family = Family::of(&source).map_err(cant)?;
        let mut index = Index { family, tokens: Vec::new(), checkpoints: Vec::new() };
        let mut walk = Walk::new(&source, (name, family), options, Checkpoint::default());
        let mut said = Vec::new();
        let mut due = 0;
        while walk.line_ahead() {
            if walk.line_number() >= due {
                due = walk.line_number() + STRETCH;
                index.checkpoints.push(walk.checkpoint(index.tokens.len()));
            }
            if walk.next_line()? {
                index.tokens.push(token(&walk.line, &mut said));
            }
        }
        index.tokens.shrink_to_fit();
        Ok(Program {
            name: name.to_string(),
            source: Arc::new(source),
            options: Arc::new(options.clone()),
            index: Arc::new(index),
            shown: Arc::default(),
        })
    }

    /// The name it was read by.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text of a line, 1-based; empty where there is none.
    pub fn text(&self, line: u32) -> String {
        let mut shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        if line < shown.first || line >= shown.first + shown.texts.len() as u32 {
            *shown = self.stretch(line).unwrap_or_default();
        }
        let at = line.checked_sub(shown.first).map(|at| at as usize);
        at.and_then(|at| shown.texts.get(at)).cloned().unwrap_or_default()
    }

    /// The lines from the checkpoint before a line to the next one.
    fn stretch(&self, line: u32) -> io::Result<Shown> {
        let checkpoints = &self.index.checkpoints;
        let next = checkpoints.partition_point(|at| at.line < line);
        let Some(from) = next.checked_sub(1).and_then(|at| checkpoints.get(at)) else {
            return Ok(Shown::default());
        };
        let mut lines = Lines::from(&self.source, from.offset);
        let mut texts = Vec::new();
        while texts.len() < STRETCH as usize
            && let Some(text) = lines.next_line()?
        {
            texts.push(String::from_utf8_lossy(text).trim_end().to_string());
        }
        Ok(Shown { first: from.line + 1, texts })
    }

    /// The sequence number of a line.
    pub fn sequence_number(&self, line: u32) -> Option<i64> {
        let mut block = Block::default();
        let text = self.text(line);
        read_into(self.index.family, &mut block, text.as_bytes(), &self.name, line).ok()?;
        leave_out(&mut block, &self.options);
        block.sequence_number()
    }

    /// What its blocks say, each as one number.
    pub(super) fn tokens(&self) -> &[u64] {
        &self.index.tokens
    }

    /// Both have been read from the same bytes by the same options.
    pub(super) fn same_as(&self, other: &Program) -> bool {
        Arc::ptr_eq(&self.index, &other.index)
    }

    /// The last checkpoint at or before a byte of the text.
    pub(super) fn checkpoint_before(&self, offset: u64) -> Checkpoint {
        let next = self.index.checkpoints.partition_point(|at| at.offset <= offset);
        next.checked_sub(1)
            .map_or_else(Checkpoint::default, |at| self.index.checkpoints[at].clone())
    }

    /// The last checkpoint at or before a block.
    fn checkpoint_of(&self, block: usize) -> Checkpoint {
        let next = self.index.checkpoints.partition_point(|at| at.blocks <= block);
        next.checked_sub(1)
            .map_or_else(Checkpoint::default, |at| self.index.checkpoints[at].clone())
    }

    /// Reads blocks again, from this one on.
    pub(super) fn cursor(&self, block: usize) -> Cursor<'_> {
        let from = self.checkpoint_of(block);
        let next = from.blocks;
        let named = (self.name.as_str(), self.index.family);
        Cursor { walk: Walk::new(&self.source, named, &self.options, from), next }
    }
}

/// Reads the blocks of a program one after the other.
pub(super) struct Cursor<'p> {
    walk: Walk<'p>,
    /// The block that is read next.
    next: usize,
}

impl Cursor<'_> {
    /// The block of an index; indices may only grow.
    ///
    /// # Errors
    /// E0915 when the text is no longer the one that was read.
    pub fn block(&mut self, index: usize) -> Result<&Line, Box<Diag>> {
        while self.next <= index {
            if !self.walk.line_ahead() {
                let line = TextSpan::line(self.walk.name, self.walk.line_number(), "");
                return Err(changed(self.walk.name, "it has fewer blocks than before")
                    .at(line)
                    .into());
            }
            if self.walk.next_line()? {
                self.next += 1;
            }
        }
        Ok(&self.walk.line)
    }
}

/// Goes through a text and keeps up what is in force.
struct Walk<'p> {
    lines: Lines<'p>,
    name: &'p str,
    family: Family,
    options: &'p Options,
    number: u32,
    line: Line,
    ended: bool,
}

impl<'p> Walk<'p> {
    fn new(
        source: &'p Source<'p>,
        (name, family): (&'p str, Family),
        options: &'p Options,
        from: Checkpoint,
    ) -> Self {
        let line = Line { after: from.modal, ..Line::default() };
        let lines = Lines::from(source, from.offset);
        Walk { lines, name, family, options, number: from.line, line, ended: false }
    }

    fn line_ahead(&self) -> bool {
        !self.ended
    }

    /// How many lines have been read.
    fn line_number(&self) -> u32 {
        self.number
    }

    fn checkpoint(&self, blocks: usize) -> Checkpoint {
        let modal = self.line.after.clone();
        Checkpoint { offset: self.lines.at(), line: self.number, blocks, modal }
    }

    /// Takes the next line up; false when it is empty, or there is none.
    fn next_line(&mut self) -> Result<bool, Box<Diag>> {
        let Walk { lines, name, family, options, number, line, ended } = self;
        let text = lines.next_line().map_err(|error| Box::new(unreadable(name, &error)))?;
        let Some(text) = text else {
            *ended = true;
            return Ok(false);
        };
        *number += 1;
        read_into(*family, &mut line.block, text, name, *number)?;
        leave_out(&mut line.block, options);
        line.before.clone_from(&line.after);
        line.after.take(&line.block);
        if is_empty(&line.block) {
            return Ok(false);
        }
        line.silent = !options.modal && only_repeats(&line.block, &line.before, &line.after);
        Ok(true)
    }
}

/// Drops what is not looked at.
fn leave_out(block: &mut Block, options: &Options) {
    let ignore = &options.ignore;
    if !ignore.letters.is_empty() {
        block.words.retain(|word| !ignore.letters.contains(&word.letter));
    }
    if ignore.numbers {
        block.words.retain(|word| word.letter != b'N');
    }
    if ignore.comments {
        block.comments.clear();
    }
    if ignore.dates {
        block.comments.iter_mut().for_each(|text| *text = without_dates(text));
    }
}

/// A text whose groups of digits joined by `-`, `/`, `.` or `:` are one `#`:
/// dates and times, as no tool's name is written.
fn without_dates(text: &str) -> String {
    let date = |word: &str| {
        let joints = word.bytes().filter(|byte| b"-/.:".contains(byte)).count();
        joints > 0
            && word.starts_with(|first: char| first.is_ascii_digit())
            && word.bytes().all(|byte| byte.is_ascii_digit() || b"-/.:T".contains(&byte))
            && (joints > 1 || word.contains(':'))
    };
    let words = text.split(' ').map(|word| if date(word.trim_matches(',')) { "#" } else { word });
    words.collect::<Vec<_>>().join(" ")
}

fn is_empty(block: &Block) -> bool {
    let marked = block.tape_mark || block.skip || block.statement.is_some();
    !marked && block.words.is_empty() && block.comments.is_empty()
}

/// A block that changes nothing: a cycle would drill again at the same place.
fn only_repeats(block: &Block, before: &Modal, after: &Modal) -> bool {
    let drills =
        after.in_cycle() && block.words.iter().any(|word| b"XYZABC".contains(&word.letter));
    let marked =
        block.tape_mark || block.skip || !block.comments.is_empty() || block.statement.is_some();
    let repeated = |word: &Word| word.letter == b'N' || repeats(word, before, after);
    !drills && !marked && block.words.iter().all(repeated)
}

/// The word says what is in force already.
fn repeats(word: &Word, before: &Modal, after: &Modal) -> bool {
    if word.index.is_some() {
        return false;
    }
    let value = word.number.value();
    match word.letter {
        b'G' | b'M' => {
            let code = tenths(value);
            group(word.letter, code)
                .is_some_and(|group| before.function(word.letter, group) == Some(code))
        }
        letter if after.drills_along(letter) && !before.in_cycle() => false,
        letter => after.keeps(letter) && before.in_force(letter) == Some(value),
    }
}

/// A hash of what a block says, without its number and what is left out; `said` is
/// memory to work in.
fn token(line: &Line, said: &mut Vec<(u8, Option<u32>, i64)>) -> u64 {
    let Line { block, before, after, silent } = line;
    let left_out = |word: &Word| !silent && repeats(word, before, after);
    said.clear();
    let words = block.words.iter().filter(|word| word.letter != b'N' && !left_out(word));
    let step = |word: &Word| (word.number.value() * STEPS).round() as i64;
    said.extend(words.map(|word| (word.letter, word.index, step(word))));
    said.sort_unstable();
    let mut hasher = DefaultHasher::new();
    (block.tape_mark, block.skip, &block.comments, &block.statement, &*said).hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_of_comments_are_told_from_numbers() {
        assert_eq!(without_dates("MADE 2026-11-21 10:30:05 R2.5 T1"), "MADE # # R2.5 T1");
        assert_eq!(without_dates("DIA 10.5, 21.11.2026, END"), "DIA 10.5, # END");
    }
}
