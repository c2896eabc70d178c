//! Drawings of NC programs and CL files, with what the line map tells of them.

use std::borrow::Cow;
use std::io::{Read, Seek};

use fil_cl::reader::{Options, Reader};
use fil_machine::Unit;
use fil_machine::commons::Commons;
use fil_nc::dialect::Dialect;
use fil_nc::forward::Forward;
use fil_nc::plot::{Drawing, LineCause, Notes, ToolShape, Trace, cl_tools, cl_trace, nc_trace};
use fil_post::FilLine;
use fil_text::CodePage;

use crate::error::Error;
use crate::map::{Digest, Entry, MapReader};
use crate::units;

/// Lines looked at to tell a CL file from an NC program.
const FIRST_LINES: usize = 50;

/// Longest CL or FIL file whose lines are shown, bytes: of a longer one a picture tells the
/// numbers of its lines alone, so that it does not grow with a file that it is not of.
const LONGEST_SOURCE: usize = 8 << 20;

/// A text and its name in messages and notes.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// The name.
    pub name: &'a str,
    /// The text, in whatever encoding.
    pub bytes: &'a [u8],
}

/// A CL file to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct ClText<'a> {
    /// The file.
    pub text: Text<'a>,
    /// How it is read.
    pub options: Options,
    /// Its unit, where it does not say it itself.
    pub unit: Option<Unit>,
}

impl ClText<'_> {
    fn trace(&self, commons: Option<&Commons>) -> Result<Trace, Error> {
        let Text { name, bytes } = self.text;
        let reader = Reader::new(bytes, name, self.options);
        cl_trace(reader, name, self.unit, commons).map_err(Error::Run)
    }

    /// The tools whose shape the file gives.
    fn tools(&self) -> Result<Vec<ToolShape>, Error> {
        let Text { name, bytes } = self.text;
        cl_tools(Reader::new(bytes, name, self.options), self.unit).map_err(Error::Run)
    }
}

/// True when a text is a CL file: it has comments with `$$`, or statements with a
/// word and a slash.
pub fn is_cl(bytes: &[u8]) -> bool {
    let statement = |line: &[u8]| {
        let line = line.trim_ascii();
        let word = line.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        line.starts_with(b"$$") || word >= 3 && line[word..].trim_ascii_start().starts_with(b"/")
    };
    bytes.split(|byte| *byte == b'\n').take(FIRST_LINES).any(statement)
}

/// The path of an NC program on the machine of these settings.
///
/// # Errors
/// What has no sure meaning on the machine.
pub fn program<'t>(nc: Text<'t>, commons: &Commons) -> Result<Drawing<'t>, Error> {
    let dialect = Dialect::new(commons).map_err(Error::Run)?;
    let forward = Forward::from_commons(commons).map_err(Error::Run)?;
    Ok(Drawing {
        title: nc.name.to_string(),
        path: nc_trace(nc.bytes, nc.name, &dialect, &forward).map_err(Error::Run)?,
        lathe: dialect.is_lathe(),
        diameter: dialect.counts_diameters(),
        forward: forward.has_rotary().then_some(forward),
        notes: Notes { text: nc_text(nc.bytes, dialect.page()), ..Notes::default() },
        ..Drawing::default()
    })
}

/// The path of a CL file.
///
/// # Errors
/// What the CL reader refuses; a file whose unit nobody says.
pub fn cl_file(cl: ClText<'_>) -> Result<Drawing<'_>, Error> {
    let (path, tools) = (cl.trace(None)?, cl.tools()?);
    let cl = cl.text;
    let notes = notes(cl.bytes);
    Ok(Drawing { title: cl.name.to_string(), path, tools, notes, ..Drawing::default() })
}

/// Lays the path of a CL file under that of a program for the machine of these
/// settings.
///
/// # Errors
/// What the CL reader refuses; a file whose unit nobody says, or says twice.
pub fn lay_under<'t>(
    drawing: &mut Drawing<'t>,
    mut cl: ClText<'t>,
    commons: &Commons,
) -> Result<(), Error> {
    let known = units::known_before(cl.unit, None, commons).map_err(Error::Run)?;
    cl.unit = known.map(|(unit, _)| unit);
    drawing.under = Some(cl.trace(Some(commons))?);
    drawing.under_name = "CL file";
    drawing.tools = cl.tools()?;
    drawing.take_tool_axes();
    if cl.text.bytes.len() <= LONGEST_SOURCE {
        drawing.under_notes = notes(cl.text.bytes);
    }
    Ok(())
}

/// Lays the path of a second program for the same machine under that of the first.
///
/// # Errors
/// As [`program`].
pub fn lay_program_under<'t>(
    drawing: &mut Drawing<'t>,
    second: Text<'t>,
    commons: &Commons,
) -> Result<(), Error> {
    let under = program(second, commons)?;
    drawing.under = Some(under.path);
    drawing.under_name = "second program";
    drawing.under_notes = under.notes;
    Ok(())
}

/// Takes from a CL file what a program does not give: the shape of its tools and, on a lathe,
/// how its live tools lie.
///
/// # Errors
/// As [`lay_under`].
pub fn take_tools<'t>(
    drawing: &mut Drawing<'t>,
    cl: ClText<'t>,
    commons: &Commons,
) -> Result<(), Error> {
    if drawing.lathe {
        lay_under(drawing, cl, commons)?;
        drawing.under = None;
    } else {
        drawing.tools = cl.tools()?;
    }
    Ok(())
}

/// Adds to the notes of a program what made each of its lines: the CL record and
/// the FIL lines. `read` gives the text of a file that the map names, if there is
/// one; one that is not that of the run is not shown.
///
/// # Errors
/// A map that is broken, or not of this program.
pub fn add_origins<R: Read + Seek>(
    drawing: &mut Drawing<'_>,
    nc: Text<'_>,
    map: MapReader<R>,
    read: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(), Error> {
    note_origins(&mut drawing.notes, nc, map, read)
}

/// The same for notes by themselves.
///
/// # Errors
/// As [`add_origins`].
pub fn note_origins<R: Read + Seek>(
    notes: &mut Notes<'_>,
    nc: Text<'_>,
    mut map: MapReader<R>,
    read: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(), Error> {
    map.nc().check(nc.name, &Digest::of(nc.bytes))?;
    let mut text_of = |file: &crate::map::MapFile| {
        let bytes = read(&file.name).filter(|bytes| Digest::of(bytes) == file.digest);
        bytes.filter(|bytes| bytes.len() <= LONGEST_SOURCE).map(|bytes| text(&bytes).into_owned())
    };
    notes.source_name = map.cl().name.clone();
    notes.source = text_of(map.cl());
    let fil: Vec<(String, Option<String>)> =
        map.fil().iter().map(|file| (file.name.clone(), text_of(file))).collect();
    let shown = |line: &FilLine| {
        let (name, text) = fil.get(usize::from(line.file))?;
        let at = (line.line as usize).checked_sub(1)?;
        let text = text.as_deref().and_then(|text| text.lines().nth(at));
        let text = text.unwrap_or_default().trim();
        Some(format!("{name}:{}  {text}", line.line).trim_end().to_string())
    };
    while let Some(entry) = map.next_where(&|_, _, _| true) {
        let Entry::Line(line) = entry? else { continue };
        let cause = LineCause { line: line.cause.line, stack: line.cause.stack };
        notes.causes.resize((line.number as usize).saturating_sub(1), LineCause::default());
        notes.causes.push(cause);
    }
    let stacks = map.stacks().iter();
    notes.stacks = stacks
        .map(|stack| stack.lines.iter().filter_map(shown).collect::<Vec<_>>().join("\n"))
        .collect();
    Ok(())
}

/// The lines of a text, for people.
fn notes(bytes: &[u8]) -> Notes<'_> {
    Notes { text: text(bytes), ..Notes::default() }
}

/// The text of a program in the encoding of its machine.
fn nc_text(bytes: &[u8], page: CodePage) -> Cow<'_, str> {
    if page.is_utf8() { text(bytes) } else { plain(page.decode_all(bytes)) }
}

/// A text in any encoding, its lines without what stands behind them.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = fil_syntax::decode(bytes, None);
    plain(text.map_or_else(|_| String::from_utf8_lossy(bytes), |(text, _)| text))
}

/// A text whose lines end as those of pages do.
fn plain(text: Cow<'_, str>) -> Cow<'_, str> {
    if text.contains('\r') { text.replace("\r\n", "\n").into() } else { text }
}
