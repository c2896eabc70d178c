//! Who made this block, and what did this record or this line of FIL make:
//! answers from the line map of a run.
//!
//! The files of the run are compared with the map first; an answer is never
//! about files that have changed since.

mod answer;
mod digests;
mod line_search;
mod position;
mod records;
mod run_files;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::path::{Path, PathBuf};

use fil_cl::reader;
use fil_diag::Diag;
use fil_post::{Cause, Stack};

pub use answer::{Answer, Asked, Line, LineWord, Made, Record, Step, Taken};
pub use position::{FilePosition, map_of};

use crate::error::{Error, RunCode};
use crate::map::{self, Entry, MapReader, NcLine};
use records::Records;
use run_files::{Role, RunFiles};

/// How a question is answered.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Most lines of the NC program that are shown; all are counted.
    pub most: usize,
    /// How the CL file is read.
    pub cl: reader::Options,
    /// Encoding of the FIL files; guessed when `None`.
    pub encoding: Option<String>,
    /// Where the CL file is now; where it lay as seen from the map when `None`.
    pub cl_file: Option<PathBuf>,
    /// Where FIL files are now; the others where they lay as seen from the map.
    pub fil_files: Vec<PathBuf>,
}

/// Answers a question about a line.
///
/// # Errors
/// E0707 for a map that can't be used, E0708 for files of another run, E0709
/// for a line that is not there, E0701 for files that can't be read.
pub fn trace(place: &FilePosition, map: &Path, options: &Options) -> Result<Answer, Error> {
    let mut map = Map { reader: MapReader::open(map)?, path: map, near: None };
    let files = RunFiles::find(&map.reader, map.path, place, options)?;
    let mut answer = Answer {
        asked: Asked::from(files.role),
        file: place.file.display().to_string(),
        line: place.line,
        excerpt: None,
        record: None,
        taken: Vec::new(),
        lines: Vec::new(),
        in_all: 0,
        missing: files.missing.clone(),
    };
    let found = match files.role {
        Role::Nc => map.nc_line(place, &files)?,
        Role::Cl => map.of_record(place, options, &mut answer)?,
        Role::Fil(file) => map.of_fil_line(place, file, &files, options, &mut answer)?,
    };
    answer.in_all = found.in_all;
    answer.lines = map.shown(found.lines, &files, options)?;
    Ok(answer)
}

/// A map that is asked.
struct Map<'p> {
    reader: MapReader<File>,
    path: &'p Path,
    /// A block not far before the one asked for.
    near: Option<Cause>,
}

/// How many blocks [`Map::near`] lies before the one asked for.
const NEAR: u64 = 64;

/// Lines of the program that belong to an answer; of each only the words that do.
#[derive(Default)]
struct Found {
    lines: Vec<NcLine>,
    in_all: u64,
    /// Records without effect.
    taken: Vec<map::Taken>,
}

impl Found {
    /// What the lines, their words and the records without effect come from.
    fn causes(&self) -> impl Iterator<Item = Cause> {
        let of_lines = self
            .lines
            .iter()
            .flat_map(|line| line.words.iter().map(|word| word.cause).chain([line.cause]));
        let of_taken = self.taken.iter().map(|taken| Cause {
            record: taken.record,
            line: taken.line,
            ..Cause::default()
        });
        of_lines.chain(of_taken)
    }
}

impl Map<'_> {
    /// The line asked for, or the word at its column.
    fn nc_line(&mut self, place: &FilePosition, files: &RunFiles) -> Result<Found, Error> {
        if place.line == 0 || place.line > self.reader.nc_lines() {
            return Err(no_line(place, self.reader.nc_lines()));
        }
        self.reader.pass_to(place.line.saturating_sub(NEAR))?;
        self.near = Some(self.reader.last_cause()).filter(|cause| cause.line > 0);
        let wanted = |_: &[Stack], number: u64, _: Cause| number == place.line;
        while let Some(entry) = self.reader.next_where(&wanted) {
            if let Entry::Line(line) = entry? {
                return asked(line, place, files);
            }
        }
        Err(no_line(place, self.reader.nc_lines()))
    }

    /// What the record at a line of the CL file has made.
    fn of_record(
        &mut self,
        place: &FilePosition,
        options: &Options,
        answer: &mut Answer,
    ) -> Result<Found, Error> {
        refuse_column(place)?;
        if let Some(found) = self.of_line(place, options, answer)? {
            return Ok(found);
        }
        self.reader = MapReader::open(self.path)?;
        let record = records::at_line(&place.file, place, &options.cl)?;
        let Some(record) = record else { return Ok(Found::default()) };
        let number = record.number;
        self.near = Some(Cause { record: number, line: record.line, ..Cause::default() });
        answer.record = Some(record);
        let wanted = |_: &[Stack], cause: Cause| cause.record == number;
        let mut found = Found::default();
        while let Some(entry) = self.reader.next_where(&|stacks, _, cause| wanted(stacks, cause)) {
            self.take(entry?, options, &wanted, &mut found);
        }
        self.name_taken(&found, answer);
        Ok(found)
    }

    /// The same where that line is a statement like most, which can be read without what
    /// stands before it, and the map has blocks of it; `None` otherwise.
    fn of_line(
        &mut self,
        place: &FilePosition,
        options: &Options,
        answer: &mut Answer,
    ) -> Result<Option<Found>, Error> {
        let Ok(line) = u32::try_from(place.line) else { return Ok(None) };
        let wanted = |_: &[Stack], cause: Cause| cause.line == line;
        let mut found = Found::default();
        while let Some(entry) = self.reader.next_of_line(line) {
            self.take(entry?, options, &wanted, &mut found);
        }
        let Some(cause) = found.causes().find(|cause| cause.line == line) else { return Ok(None) };
        let record = records::plain(&place.file, cause, &options.cl)?;
        if record.is_none()
            || found.causes().any(|other| other.line == line && other.record != cause.record)
        {
            return Ok(None);
        }
        self.near = Some(cause);
        answer.record = record;
        self.name_taken(&found, answer);
        Ok(Some(found))
    }

    /// What a line of FIL has made or had a part in.
    fn of_fil_line(
        &mut self,
        place: &FilePosition,
        file: u16,
        files: &RunFiles,
        options: &Options,
        answer: &mut Answer,
    ) -> Result<Found, Error> {
        refuse_column(place)?;
        let lines = files.fil_line_count(file);
        answer.excerpt = files.fil_line(file, place.line);
        if answer.excerpt.is_none() {
            return Err(no_line(place, lines));
        }
        let wanted = |stacks: &[Stack], cause: Cause| {
            let stack = (cause.stack as usize).checked_sub(1).and_then(|at| stacks.get(at));
            let lines = stack.map_or(&[][..], |stack| &stack.lines);
            lines.iter().any(|at| at.file == file && u64::from(at.line) == place.line)
        };
        let mut found = Found::default();
        while let Some(entry) = self.reader.next_where(&|stacks, _, cause| wanted(stacks, cause)) {
            self.take(entry?, options, &wanted, &mut found);
        }
        Ok(found)
    }

    /// Adds a line of which the cause, or that of a word, is wanted, or a record without
    /// effect.
    fn take(
        &self,
        entry: Entry,
        options: &Options,
        wanted: &dyn Fn(&[Stack], Cause) -> bool,
        found: &mut Found,
    ) {
        match entry {
            Entry::Line(mut line) => {
                if !wanted(self.reader.stacks(), line.cause) {
                    line.words.retain(|word| wanted(self.reader.stacks(), word.cause));
                }
                found.in_all += 1;
                if found.lines.len() < options.most {
                    found.lines.push(line);
                }
            }
            Entry::Taken(taken) => {
                let (record, line) = (taken.record, taken.line);
                if wanted(&[], Cause { record, line, ..Cause::default() }) {
                    found.taken.push(taken);
                }
            }
        }
    }

    /// The records without effect, with the sections that took them.
    fn name_taken(&self, found: &Found, answer: &mut Answer) {
        let named = found.taken.iter().map(|taken| Taken {
            record: taken.record,
            section: self.reader.sections()[usize::from(taken.section)].clone(),
        });
        answer.taken = named.collect();
    }

    /// The lines with the texts of all that they name.
    fn shown(
        &self,
        lines: Vec<NcLine>,
        files: &RunFiles,
        options: &Options,
    ) -> Result<Vec<Line>, Error> {
        let numbers: BTreeSet<u64> = lines.iter().map(|line| line.number).collect();
        let texts = files.nc_lines(&numbers)?;
        let causes = lines
            .iter()
            .flat_map(|line| line.words.iter().map(|word| word.cause).chain([line.cause]));
        let causes = causes.filter(|cause| cause.record > 0);
        let wanted: BTreeMap<u32, u32> = causes.map(|cause| (cause.record, cause.line)).collect();
        let records = match files.cl() {
            Some(path) => records::read(path, &wanted, self.near, &options.cl)?,
            None => Records::default(),
        };
        let made = |cause: Cause| self.made(cause, &records, files);
        Ok(lines
            .into_iter()
            .map(|line| {
                let text = texts.get(&line.number).cloned();
                let words = line.words.iter().map(|word| LineWord {
                    letter: word.letter,
                    column: text.as_deref().map(|text| column_of(text, word.range.start)),
                    text: text.as_deref().map(|text| word.text(text).to_string()),
                    word: word.cause.word,
                    value: (!word.cause.made_by_fil)
                        .then(|| records.get(&word.cause.record)?.word(word.cause.word))
                        .flatten(),
                    made_by_fil: word.cause.made_by_fil,
                    made: made(word.cause),
                });
                Line { number: line.number, words: words.collect(), made: made(line.cause), text }
            })
            .collect())
    }

    fn made(&self, cause: Cause, records: &Records, files: &RunFiles) -> Made {
        let stack = self.reader.stack(cause);
        let steps = stack.map_or(&[][..], |stack| &stack.lines).iter().map(|at| Step {
            file: files.fil_name(at.file),
            line: at.line,
            text: files.fil_line(at.file, u64::from(at.line)),
        });
        Made {
            record: cause.record,
            cl: files.cl_name(),
            line: cause.line,
            statement: records.get(&cause.record).map(|record| record.statement.clone()),
            section: stack.and_then(|stack| self.reader.section(stack)).map(str::to_string),
            fil: steps.collect(),
        }
    }
}

/// The line asked for, or its word at the column asked for.
fn asked(mut line: NcLine, place: &FilePosition, files: &RunFiles) -> Result<Found, Error> {
    if let Some(column) = place.column {
        let byte = files.nc_byte(place.line, column)?;
        let word = byte.and_then(|byte| line.word_at(byte)).cloned();
        line.words = vec![word.ok_or_else(|| no_column(place, column))?];
    }
    Ok(Found { lines: vec![line], in_all: 1, taken: Vec::new() })
}

/// Column, from 1 and in characters, of a byte of a line.
fn column_of(text: &str, byte: usize) -> usize {
    text.get(..byte).map_or(byte, |head| head.chars().count()) + 1
}

fn no_line(place: &FilePosition, lines: u64) -> Error {
    let message = match lines {
        0 => format!("{} has no line", place.file.display()),
        _ => format!("{} has the lines 1 to {lines}, and no {}", place.file.display(), place.line),
    };
    Error::setup(Diag::new(RunCode::NoSuchLine, message))
}

fn no_column(place: &FilePosition, column: u64) -> Error {
    let file = place.file.display();
    let message = format!("line {} of {file} has no word at column {column}", place.line);
    Error::setup(Diag::new(RunCode::NoSuchLine, message))
}

fn refuse_column(place: &FilePosition) -> Result<(), Error> {
    match place.column {
        Some(_) => {
            let message = "a column is understood of a line of the NC program only";
            Err(Error::setup(Diag::new(RunCode::NoSuchLine, message)))
        }
        None => Ok(()),
    }
}
