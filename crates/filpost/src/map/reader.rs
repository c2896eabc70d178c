//! Reading a map, block by block.

mod passing;

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use fil_diag::{Diag, TextSpan};
use fil_post::{Cause, FilLine, Stack};
use fil_text::CodePage;
use serde::Deserialize;

use super::digest::Digest;
use super::line::{End, Header, ObjectLine, StackLine};
use super::words::FormWord;
use super::{VERSION, Word, forms, words};
use crate::error::{Error, RunCode};
use crate::files;

/// Longest line that is read, in bytes. The longest that is written are those
/// of many FIL files or of a deep call stack.
const LONGEST: u64 = 16 << 20;

/// Bytes at the end in which the last line is looked for.
const TAIL: u64 = 64 << 10;

/// A file of the run that a map is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapFile {
    /// Its name, as seen from the folder of the map.
    pub name: String,
    /// Its length and hash when the map was written; of a FIL file those of its
    /// text in UTF-8.
    pub digest: Digest,
}

impl MapFile {
    /// Refuses another file than that of the run.
    ///
    /// # Errors
    /// E0708; `shown` is what the message calls the file.
    pub fn check(&self, shown: &str, digest: &Digest) -> Result<(), Error> {
        if *digest == self.digest {
            return Ok(());
        }
        let message = format!(
            "{shown} has {} bytes and the hash {}; the map is of one with {} bytes and the hash {}",
            digest.bytes, digest.hash, self.digest.bytes, self.digest.hash
        );
        Err(Error::setup(Diag::new(RunCode::OtherRun, message)))
    }
}

/// A line of the NC program: a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NcLine {
    /// Its number, 1-based.
    pub number: u64,
    /// What made it; [`MapReader::stack`] has its FIL lines.
    pub cause: Cause,
    /// Its words, in order.
    pub words: Vec<Word>,
}

impl NcLine {
    /// The word at a byte of the line, from 0.
    pub fn word_at(&self, byte: usize) -> Option<&Word> {
        self.words.iter().find(|word| word.range.contains(&byte))
    }
}

/// A record that a section took without any effect on the post.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Taken {
    /// Line of the CL file.
    pub line: u32,
    /// Number of the record.
    pub record: u32,
    /// Index of the section in [`MapReader::sections`].
    pub section: u16,
}

/// What a map tells, one after the other. Where a [`Taken`] stands among the
/// lines means nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A line of the NC program; they come in order.
    Line(NcLine),
    /// A record without effect.
    Taken(Taken),
}

/// Reads a map. The files of its run are known at once; whoever shows blocks of
/// a program at hand compares it first, with [`MapFile::check`].
#[derive(Debug)]
pub struct MapReader<R> {
    input: BufReader<R>,
    name: String,
    line: Vec<u8>,
    /// Number of that line.
    number: u32,
    cl: MapFile,
    nc: MapFile,
    page: CodePage,
    fil: Vec<MapFile>,
    sections: Vec<String>,
    stacks: Vec<Stack>,
    /// The lines of blocks that were written out, to be repeated.
    forms: Vec<Form>,
    /// The cause of the last block.
    last: Cause,
    /// Lines of the program that the last line promises, and those read.
    nc_lines: u64,
    read: u64,
    over: bool,
}

/// A line of the program that is written out: by how much its CL line and record
/// come after those of the line before, its words, and the stack if there is one.
#[derive(Deserialize)]
struct FormLine<'t>(i64, i64, &'t str, #[serde(default)] u32);

/// What blocks of one form have in common.
#[derive(Clone, Debug)]
struct Form {
    lines: i64,
    records: i64,
    words: Vec<FormWord>,
    stack: u32,
    /// The highest number of a stack that it names.
    highest_stack: u32,
    /// CL lines from that of the block to those of its words, least and most.
    reach: [i64; 2],
}

impl Form {
    /// Reads a line that is written out; `None` for another.
    fn read(line: &[u8]) -> Option<Form> {
        let FormLine(lines, records, words, stack) = parse(line)?;
        let words = words::read(words)?;
        let stacks = words.iter().map(FormWord::stack);
        let highest_stack = stacks.max().unwrap_or(0).max(stack);
        let reach = words
            .iter()
            .map(FormWord::lines)
            .fold([0, 0], |[least, most], lines| [least.min(lines), most.max(lines)]);
        Some(Form { lines, records, words, stack, highest_stack, reach })
    }

    /// What a block of this form is caused by when it comes after a block with the
    /// cause `last`; `None` for what no map says.
    fn after(&self, last: Cause) -> Option<Cause> {
        let line = words::moved(last.line, self.lines)?;
        let record = words::moved(last.record, self.records)?;
        Some(Cause { record, line, stack: self.stack, ..Cause::default() })
    }
}

/// What a line of a map was.
enum Step {
    /// An entry that is wanted, or a record without effect.
    Entry(Entry),
    /// Another one.
    Passed,
    /// The last line.
    End,
}

/// Which blocks are asked for: by their stacks known so far, the number of the line,
/// and a cause, which is that of the block or of one of its words.
pub(crate) type Wanted<'w> = dyn Fn(&[Stack], u64, Cause) -> bool + 'w;

impl MapReader<File> {
    /// Opens a map.
    ///
    /// # Errors
    /// E0701 for a file that can't be read, E0707 for one that is no whole map.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let file = File::open(path).map_err(|error| files::cant_read(path, &error))?;
        if file.metadata().is_ok_and(|found| found.is_dir()) {
            return Err(files::cant_read(path, &io::Error::from(io::ErrorKind::IsADirectory)));
        }
        MapReader::new(&path.display().to_string(), file)
    }
}

impl<R: Read + Seek> MapReader<R> {
    /// Reads the first and the last line of a map, and all of it once for its hash;
    /// `name` is what messages show.
    ///
    /// # Errors
    /// E0707: it was cut off or edited, is of another version, or is no map.
    pub fn new(name: &str, mut input: R) -> Result<Self, Error> {
        let cant = |error: io::Error| files::cant_read(Path::new(name), &error);
        let (last, start) = last_line(&mut input).map_err(cant)?;
        input.rewind().map_err(cant)?;
        let lines = Digest::of_reader((&mut input).take(start)).map_err(cant)?;
        input.rewind().map_err(cant)?;
        let none = || MapFile { name: String::new(), digest: Digest::of(b"") };
        let mut reader = MapReader {
            input: BufReader::with_capacity(256 << 10, input),
            name: name.to_string(),
            line: Vec::new(),
            number: 0,
            cl: none(),
            nc: none(),
            page: CodePage::UTF_8,
            fil: Vec::new(),
            sections: Vec::new(),
            stacks: Vec::new(),
            forms: Vec::new(),
            last: Cause::default(),
            nc_lines: 0,
            read: 0,
            over: false,
        };
        let header: Header = match reader.next_line()? {
            true => parse(&reader.line).ok_or_else(|| reader.broken("this is no line map"))?,
            false => return Err(reader.broken("the file is empty")),
        };
        if header.version != VERSION {
            let version = header.version;
            return Err(reader.broken(&format!("version {version}, but only {VERSION} is known")));
        }
        let end: End = parse(&last)
            .ok_or_else(|| reader.broken("the map was cut off: its last line is missing"))?;
        if end.map != lines {
            let message = "the map was edited: its last line has another length or hash of the \
                           lines before it";
            return Err(reader.broken(message));
        }
        let label = header.encoding.as_deref();
        reader.page = label
            .map_or(Some(CodePage::UTF_8), CodePage::named)
            .ok_or_else(|| reader.broken("the encoding of its program is not known"))?;
        reader.cl = MapFile { name: header.cl, digest: end.cl };
        reader.nc = MapFile { name: header.nc, digest: end.nc };
        let fil = header.fil.into_iter();
        reader.fil = fil.map(|fil| MapFile { name: fil.name, digest: fil.digest }).collect();
        reader.sections = header.sections;
        reader.nc_lines = end.lines;
        Ok(reader)
    }

    /// The CL file.
    pub fn cl(&self) -> &MapFile {
        &self.cl
    }

    /// The NC program.
    pub fn nc(&self) -> &MapFile {
        &self.nc
    }

    /// The encoding of the NC program.
    pub fn nc_page(&self) -> CodePage {
        self.page
    }

    /// The FIL files, by the numbers in [`FilLine::file`].
    pub fn fil(&self) -> &[MapFile] {
        &self.fil
    }

    /// Keys of the sections (`CYCLE,DEEP`), by the numbers in [`Stack::section`].
    pub fn sections(&self) -> &[String] {
        &self.sections
    }

    /// Number of lines of the NC program.
    pub fn nc_lines(&self) -> u64 {
        self.nc_lines
    }

    /// The FIL call stack of a cause; `None` where no FIL was running. The
    /// stacks of all entries read so far are known.
    pub fn stack(&self, cause: Cause) -> Option<&Stack> {
        self.stacks.get((cause.stack as usize).checked_sub(1)?)
    }

    /// The FIL call stacks of all entries read so far, by their numbers from 1.
    pub(crate) fn stacks(&self) -> &[Stack] {
        &self.stacks
    }

    /// The key of the section a stack began in.
    pub fn section(&self, stack: &Stack) -> Option<&str> {
        self.sections.get(usize::from(stack.section?)).map(String::as_str)
    }

    /// The next block that is wanted, or record without effect; the blocks between
    /// cost little. Ends after the first error.
    pub(crate) fn next_where(&mut self, wanted: &Wanted<'_>) -> Option<Result<Entry, Error>> {
        if self.over {
            return None;
        }
        let entry = self.entry(wanted).transpose();
        self.over = !matches!(entry, Some(Ok(_)));
        entry
    }

    /// The cause of the block that was read or passed over last.
    pub(crate) fn last_cause(&self) -> Cause {
        self.last
    }

    fn entry(&mut self, wanted: &Wanted<'_>) -> Result<Option<Entry>, Error> {
        loop {
            match self.step(wanted)? {
                Step::Entry(entry) => return Ok(Some(entry)),
                Step::Passed => {}
                Step::End => return Ok(None),
            }
        }
    }

    /// Reads the next line of the map.
    fn step(&mut self, wanted: &Wanted<'_>) -> Result<Step, Error> {
        if !self.next_line()? {
            return Err(self.broken("the map was cut off: its last line is missing"));
        }
        if let Some(b'[' | b'0'..=b'9') = self.line.first() {
            let line = self.nc_line(wanted)?;
            return Ok(line.map_or(Step::Passed, |line| Step::Entry(Entry::Line(line))));
        }
        match parse::<ObjectLine>(&self.line) {
            Some(ObjectLine::Stack(stack)) => self.add_stack(stack).map(|()| Step::Passed),
            Some(ObjectLine::Taken(taken)) => {
                self.known(usize::from(taken.section) < self.sections.len())?;
                let (line, record) = taken.taken;
                Ok(Step::Entry(Entry::Taken(Taken { line, record, section: taken.section })))
            }
            None => self.end().map(|()| Step::End),
        }
    }

    fn nc_line(&mut self, wanted: &Wanted<'_>) -> Result<Option<NcLine>, Error> {
        let written_out = match self.line.first() {
            Some(b'[') => Some(Form::read(&self.line).ok_or_else(|| self.no_line())?),
            _ => None,
        };
        let form = match &written_out {
            Some(form) => form,
            None => {
                let number = form_number(&self.line).ok_or_else(|| self.no_line())?;
                let known = number.checked_sub(1).and_then(|index| self.forms.get(index));
                known.ok_or_else(|| self.unfit())?
            }
        };
        let cause = form.after(self.last).ok_or_else(|| self.no_line())?;
        self.known(form.highest_stack as usize <= self.stacks.len())?;
        let number = self.read + 1;
        let asked = |cause| wanted(&self.stacks, number, cause);
        let mut found = asked(cause);
        for word in &form.words {
            found |= asked(word.cause(cause).ok_or_else(|| self.no_line())?);
        }
        let words = match found {
            true => form.words.iter().map_while(|word| word.in_block(cause)).collect(),
            false => Vec::new(),
        };
        self.forms.extend(written_out.filter(|_| self.forms.len() < forms::MOST));
        self.read = number;
        self.last = cause;
        Ok(found.then_some(NcLine { number, cause, words }))
    }

    fn add_stack(&mut self, line: StackLine) -> Result<(), Error> {
        let next = line.stack as usize == self.stacks.len() + 1;
        let section = line.section.is_none_or(|at| usize::from(at) < self.sections.len());
        let files = line.fil.iter().all(|(file, _)| usize::from(*file) < self.fil.len());
        self.known(next && section && files)?;
        let lines = line.fil.into_iter().map(|(file, line)| FilLine { file, line }).collect();
        self.stacks.push(Stack { section: line.section, lines });
        Ok(())
    }

    /// Refuses a line that names what the map does not have.
    fn known(&self, known: bool) -> Result<(), Error> {
        if known { Ok(()) } else { Err(self.unfit()) }
    }

    fn unfit(&self) -> Error {
        self.broken("this line does not fit the lines before it")
    }

    fn no_line(&self) -> Error {
        self.broken("this is no line of a line map")
    }

    fn end(&mut self) -> Result<(), Error> {
        if parse::<End>(&self.line).is_none() {
            return Err(self.no_line());
        }
        if self.read != self.nc_lines {
            let message = format!("{} lines of {} are there", self.read, self.nc_lines);
            return Err(self.broken(&message));
        }
        if self.next_line()? {
            return Err(self.broken("the map goes on after its last line"));
        }
        Ok(())
    }

    /// Reads a line; false at the end of the file.
    fn next_line(&mut self) -> Result<bool, Error> {
        self.line.clear();
        self.number = self.number.saturating_add(1);
        let mut input = (&mut self.input).take(LONGEST);
        let read = input.read_until(b'\n', &mut self.line);
        let count = read.map_err(|error| files::cant_read(Path::new(&self.name), &error))?;
        if count as u64 == LONGEST {
            return Err(self.broken("this line is too long"));
        }
        Ok(count > 0)
    }

    fn broken(&self, message: &str) -> Error {
        const SHOWN: usize = 200;
        let line = String::from_utf8_lossy(&self.line[..self.line.len().min(SHOWN)]);
        let place = TextSpan::line(&self.name, self.number.max(1), line.trim_end());
        Error::setup(Diag::new(RunCode::MapFile, message).at(place))
    }
}

impl<R: Read + Seek> Iterator for MapReader<R> {
    type Item = Result<Entry, Error>;

    /// The next entry; ends after the first error.
    fn next(&mut self) -> Option<Self::Item> {
        self.next_where(&|_, _, _| true)
    }
}

/// The number of a form that a line names.
fn form_number(line: &[u8]) -> Option<usize> {
    const MOST_DIGITS: usize = 9;
    let digits = line.strip_suffix(b"\n").unwrap_or(line).trim_ascii();
    let plain = digits.len() <= MOST_DIGITS && digits.iter().all(u8::is_ascii_digit);
    plain.then(|| digits.iter().fold(0, |number, digit| number * 10 + usize::from(digit - b'0')))
}

fn parse<'a, T: Deserialize<'a>>(line: &'a [u8]) -> Option<T> {
    serde_json::from_slice(line).ok()
}

/// The last line of an input, if it is a short one, and where it begins.
fn last_line(input: &mut (impl Read + Seek)) -> io::Result<(Vec<u8>, u64)> {
    let length = input.seek(SeekFrom::End(0))?;
    let from = input.seek(SeekFrom::Start(length.saturating_sub(TAIL)))?;
    let mut tail = Vec::new();
    input.take(TAIL).read_to_end(&mut tail)?;
    let text = tail.strip_suffix(b"\n").unwrap_or(&tail);
    let start = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    Ok((text[start..].to_vec(), from + start as u64))
}
