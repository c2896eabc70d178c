//! A CL text of any dialect as one of Creo.
//!
//! The records are those that FIL and the post see, written statement by statement. Then the
//! new text is read back and compared with them, so that it says the same or is refused.

use std::io::{self, Read, Seek, Write};

use fil_diag::{Diag, Result, TextSpan};

use crate::dialect::Recognized;
use crate::errors::ClCode;
use crate::forms::vector;
use crate::layout::takes_text;
use crate::reader::{Options, Reader};
use crate::record::{FIRST_DATA, Record, Word, WordView, kind};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;
use crate::writer::Writer;

/// The first line of Creo's files, by which they are recognized.
const HEADER: &[u8] = b"$$*          Pro/CLfile\n";

/// What was written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Converted {
    /// Statements, FINI and UNITS that were added among them.
    pub statements: u64,
    /// The dialect of the text that was read.
    pub dialect: Recognized,
}

/// Writes `cl` as a CL text of Creo to `output`, from where that stands on, and reads it back.
///
/// Words that the dialect gives no effect become records `$$-> WORD / …`, and texts without
/// effect become comments; FINI comes at the end where the dialect writes none. Comments of
/// the text are left out. `unit` is MM or INCHES, to be written where the text says no unit; what the
/// feeds tell ([`Reader::told_unit`]) takes its place where it is not given.
///
/// ```
/// use std::io::Cursor;
/// use fil_cl::{Options, to_ncl};
///
/// let nx = "TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,250.\nGOTO/1.,2.,3.\nEND-OF-PATH\n";
/// let mut ncl = Cursor::new(Vec::new());
/// to_ncl(&mut Cursor::new(nx), "a.cls", Options::default(), None, &mut ncl)?;
/// let text = String::from_utf8_lossy(ncl.get_ref()).into_owned();
/// assert!(text.contains("FEDRAT / 250.0, MMPM\nGOTO / 1.0, 2.0, 3.0\n"));
/// # Ok::<(), Box<fil_diag::Diag>>(())
/// ```
///
/// # Errors
/// What the reader refuses; a statement that Creo's text can't say; an input or output that
/// fails.
pub fn to_ncl(
    mut cl: impl Read + Seek + Send,
    name: &str,
    options: Options,
    unit: Option<WordId>,
    mut output: impl Read + Write + Seek + Send,
) -> Result<Converted> {
    // Subroutines are Creo's own, and who reads the file may take them as they are.
    let options = Options { raw: false, expand_subroutines: false, ..options };
    let mut vocabulary = Vocabulary::new();
    let from = output.stream_position().map_err(|error| write_failed(&error))?;
    let start = cl.stream_position().map_err(|error| read_failed(&error, name))?;

    let mut reader = Reader::new(&mut cl, name, options);
    output.write_all(HEADER).map_err(|error| write_failed(&error))?;
    let mut writer = Writer::new(io::BufWriter::new(&mut output));
    let mut statements = 0;
    let unit = unit.or_else(|| reader.told_unit());
    Statements::new(unit).all(&mut reader, &mut vocabulary, |record, vocabulary| {
        statements += 1;
        write(&mut writer, record, vocabulary).map_err(|diag| at(*diag, name, record, vocabulary))
    })?;
    let dialect = reader.recognized();
    drop(reader);
    writer.into_inner().flush().map_err(|error| write_failed(&error))?;

    cl.seek(io::SeekFrom::Start(start)).map_err(|error| read_failed(&error, name))?;
    output.seek(io::SeekFrom::Start(from)).map_err(|error| write_failed(&error))?;
    let mut reader = Reader::new(&mut cl, name, options);
    let again = Options { dialect: None, ..options };
    let mut back = Reader::new(&mut output, "the text for Creo", again);
    let mut found = Record::default();
    Statements::new(unit).all(&mut reader, &mut vocabulary, |record, vocabulary| {
        if is_comment(record) {
            return Ok(());
        }
        let problem = match back.read(vocabulary, &mut found) {
            Ok(true) if says_the_same(&found, record, vocabulary) => return Ok(()),
            Ok(true) => "it would read back as another statement".to_string(),
            Ok(false) => "it would not read back".to_string(),
            Err(diag) => format!("it would not read back: {}", diag.message),
        };
        Err(at(Diag::new(ClCode::Unwritable, problem), name, record, vocabulary))
    })?;
    match back.read(&mut vocabulary, &mut found) {
        Ok(false) => Ok(Converted { statements, dialect }),
        _ => {
            let message = "it would read back with a statement more";
            Err(at(Diag::new(ClCode::Unwritable, message), name, &found, &vocabulary))
        }
    }
}

/// Tiny arcs of a system whose full turns are exact. Creo's text does not tell them from full turns:
/// they are lines there, of less than any control can go.
#[derive(Default)]
struct TinyArcs {
    /// Where the tool stands.
    start: Option<[f64; 3]>,
    /// A CIRCLE until its end comes.
    held: Option<Record>,
}

impl TinyArcs {
    /// Ends nearer than this to the start are those of tiny arcs, mm or inch.
    const NEAR: f64 = 1e-3;

    fn holds(&self) -> bool {
        self.held.is_some()
    }

    /// Looks at a statement; gives back the CIRCLE before it, unless it was a tiny arc.
    fn look(&mut self, record: &Record) -> Option<Record> {
        let before = self.held.take();
        if record.major == words::CIRCLE {
            self.held = Some(record.clone());
            return before;
        }
        let start = self.start;
        self.start = record.point().or(start);
        before.filter(|circle| !is_tiny(circle, start, record.point()))
    }
}

/// An arc whose end lies a little beyond its start, in its running direction.
fn is_tiny(circle: &Record, start: Option<[f64; 3]>, end: Option<[f64; 3]>) -> bool {
    let (Some(circle), Some(start), Some(end)) = (circle.circle(), start, end) else {
        return false;
    };
    let [from, to] = [start, end].map(|point| vector::sub(point, circle.center));
    let apart = vector::norm(vector::sub(to, from));
    let runs_on = vector::dot(circle.axis, vector::cross(from, to)) > 0.0;
    apart > 0.0 && apart < TinyArcs::NEAR && runs_on
}

/// The statements of the new text, one after the other.
struct Statements {
    /// The unit to be written before the first statement that needs one.
    unit: Option<WordId>,
    has_fini: bool,
}

impl Statements {
    fn new(unit: Option<WordId>) -> Self {
        Statements { unit, has_fini: false }
    }

    /// Hands out all of them.
    fn all(
        mut self,
        reader: &mut Reader<'_>,
        vocabulary: &mut Vocabulary,
        mut take: impl FnMut(&Record, &mut Vocabulary) -> Result<()>,
    ) -> Result<()> {
        let mut record = Record::default();
        let mut tiny = TinyArcs::default();
        while reader.read(vocabulary, &mut record)? {
            if reader.recognized().dialect.has_exact_turns()
                && let Some(circle) = tiny.look(&record)
            {
                take(&circle, vocabulary)?;
            }
            if tiny.holds() {
                continue;
            }
            if let Some(units) = self.units_before(&record) {
                take(&units, vocabulary)?;
            }
            self.has_fini |= record.kind == kind::FINI;
            if let Some(name) = tool_name(&record) {
                take(&name, vocabulary)?;
            }
            // A word without effect in its dialect would be one with an effect, or an unknown
            // one, in a text of Creo.
            if record.inert && !is_comment(&record) {
                (record.kind, record.sub) = (kind::PSEUDO, 0);
            }
            take(&record, vocabulary)?;
        }
        if !self.has_fini && !reader.recognized().dialect.rules().writes_fini {
            let fini = Record { line: record.line, ..fini() };
            take(&fini, vocabulary)?;
        }
        Ok(())
    }

    /// UNITS, where this is the first statement that may depend on it and is another one.
    fn units_before(&mut self, record: &Record) -> Option<Record> {
        let is_free = record.inert
            || record.kind == kind::PSEUDO
            || matches!(record.major, words::PARTNO | words::PPRINT | words::MACHIN)
            || matches!(record.major, words::REMARK | words::TITLES);
        if is_free {
            return None;
        }
        let unit = self.unit.take()?;
        if record.major == words::UNITS {
            return None;
        }
        let data = vec![Word::Minor(unit)];
        Some(Record { data, line: record.line, ..Record::command(words::UNITS) })
    }
}

/// What Creo's text has for the name of the tool in TOOL PATH of NX, which a control may call
/// it by.
fn tool_name(record: &Record) -> Option<Record> {
    if record.major != words::TOOL_PATH {
        return None;
    }
    let name = record.text.splitn(3, ',').nth(2)?.trim();
    let fits = !name.is_empty() && !name.contains(',');
    fits.then(|| {
        let mut said = Record { line: record.line, ..Record::command(words::TPRINT) };
        let text = said.store_text(name);
        said.data.push(text);
        said
    })
}

fn fini() -> Record {
    Record { kind: kind::FINI, major: words::FINI, ..Record::default() }
}

/// True for a text without effect, which becomes a comment.
fn is_comment(record: &Record) -> bool {
    record.inert && record.kind == kind::POST && takes_text(record.major)
}

fn write<W: Write>(writer: &mut Writer<W>, record: &Record, vocabulary: &Vocabulary) -> Result<()> {
    let is_open =
        record.kind == kind::SURFACE && record.circle().is_some_and(|c| c.radius.is_none());
    if is_open {
        let message = "Creo's CIRCLE has a radius, and the start that would tell it is not known";
        return Err(Box::new(Diag::new(ClCode::Unwritable, message)));
    }
    if is_comment(record) {
        writer.comment(record, vocabulary)
    } else {
        writer.write(record, vocabulary)
    }
}

/// True when a record that was read back says what the one does that was written.
fn says_the_same(found: &Record, meant: &Record, vocabulary: &Vocabulary) -> bool {
    let is_alike = (found.kind, found.sub, found.major) == (meant.kind, meant.sub, meant.major)
        && found.len() == meant.len()
        && !found.inert;
    is_alike
        && (FIRST_DATA..=meant.len())
            .all(|n| same_word(found.word(n, vocabulary), meant.word(n, vocabulary)))
}

fn same_word(found: Option<WordView<'_>>, meant: Option<WordView<'_>>) -> bool {
    match (found, meant) {
        (Some(WordView::Number(a)), Some(WordView::Number(b))) => a.to_bits() == b.to_bits(),
        (found, meant) => found == meant,
    }
}

/// Adds the line of the statement.
fn at(diag: Diag, name: &str, record: &Record, vocabulary: &Vocabulary) -> Box<Diag> {
    let line = TextSpan::line(name, record.line, vocabulary.name(record.major));
    let hint = "post the file as it is, without converting it";
    Box::new(diag.at(line).hint(hint))
}

fn write_failed(error: &io::Error) -> Box<Diag> {
    Box::new(Diag::new(ClCode::WriteFailed, error.to_string()))
}

fn read_failed(error: &io::Error, name: &str) -> Box<Diag> {
    let message = error.to_string();
    Box::new(Diag::new(ClCode::ReadFailed, message).at(TextSpan::line(name, 0, "")))
}
