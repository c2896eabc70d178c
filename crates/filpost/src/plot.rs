//! Drawings of NC programs and CL files, with what the line map tells of them.

use std::io::{Read, Seek};

use fil_cl::reader::{Options, Reader};
use fil_machine::Unit;
use fil_machine::commons::{Commons, Kind};
use fil_nc::dialect::Dialect;
use fil_nc::forward::Forward;
use fil_nc::interpret::events;
use fil_nc::plot::{Drawing, Note, Trace, cl_trace, nc_trace};

use crate::error::Error;
use crate::map::{Digest, Entry, MapReader};
use crate::units;

/// Lines looked at to tell a CL file from an NC program.
const FIRST_LINES: usize = 50;

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
    fn trace(&self, shift: [f64; 3]) -> Result<Trace, Error> {
        let Text { name, bytes } = self.text;
        let reader = Reader::new(bytes, name, self.options);
        cl_trace(reader, name, self.unit, shift).map_err(Error::Run)
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
pub fn program(nc: Text<'_>, commons: &Commons) -> Result<Drawing, Error> {
    let dialect = Dialect::new(commons).map_err(Error::Run)?;
    let forward = Forward::from_commons(commons).map_err(Error::Run)?;
    let events = events(nc.bytes, nc.name, &dialect).map_err(Error::Run)?;
    Ok(Drawing {
        title: nc.name.to_string(),
        path: nc_trace(&events, &forward),
        lathe: dialect.lathe,
        notes: notes(nc.bytes),
        ..Drawing::default()
    })
}

/// The path of a CL file.
///
/// # Errors
/// What the CL reader refuses; a file whose unit nobody says.
pub fn cl_file(cl: ClText<'_>) -> Result<Drawing, Error> {
    let path = cl.trace([0.0; 3])?;
    let cl = cl.text;
    let notes = notes(cl.bytes);
    Ok(Drawing { title: cl.name.to_string(), path, notes, ..Drawing::default() })
}

/// Lays the path of a CL file under that of a program for the machine of these
/// settings.
///
/// # Errors
/// What the CL reader refuses; a file whose unit nobody says, or says twice.
pub fn lay_under(
    drawing: &mut Drawing,
    mut cl: ClText<'_>,
    commons: &Commons,
) -> Result<(), Error> {
    let known = units::known_before(cl.unit, commons).map_err(Error::Run)?;
    cl.unit = known.map(|(unit, _)| unit);
    let shift = ["input.translate_x", "input.translate_y", "input.translate_z"].map(|key| {
        let row = fil_machine::locations::Location::named(key);
        let value = row.and_then(|row| commons.get(Kind::Dbl, row.number.into()).ok());
        value.filter(|value| *value != fil_machine::commons::EMPTY).unwrap_or(0.0)
    });
    drawing.under = Some(cl.trace(shift)?);
    drawing.under_name = "CL file";
    drawing.under_notes = notes(cl.text.bytes);
    Ok(())
}

/// Adds to the notes of a program what made each of its lines: the CL record and
/// the FIL lines. `read` gives the text of a file that the map names, if there is
/// one; one that is not that of the run is not shown.
///
/// # Errors
/// A map that is broken, or not of this program.
pub fn add_origins<R: Read + Seek>(
    drawing: &mut Drawing,
    nc: Text<'_>,
    mut map: MapReader<R>,
    read: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(), Error> {
    map.nc().check(nc.name, &Digest::of(nc.bytes))?;
    let mut lines_of = |file: &crate::map::MapFile| {
        let text = read(&file.name).filter(|bytes| Digest::of(bytes) == file.digest);
        (file.name.clone(), text.map(|bytes| lines(&bytes)).unwrap_or_default())
    };
    let cl = lines_of(map.cl());
    let fil: Vec<_> = map.fil().iter().map(&mut lines_of).collect();
    let shown = |(name, lines): &(String, Vec<String>), line: u32| {
        let text = lines.get((line as usize).wrapping_sub(1)).map_or("", |text| text.trim());
        format!("{name}:{line}  {text}").trim_end().to_string()
    };
    while let Some(entry) = map.next() {
        let Entry::Line(line) = entry? else { continue };
        let Some(note) = drawing.notes.get_mut((line.number as usize).wrapping_sub(1)) else {
            continue;
        };
        let mut origin = Vec::new();
        if line.cause.line > 0 {
            origin.push(shown(&cl, line.cause.line));
        }
        if let Some(stack) = map.stack(line.cause) {
            for place in &stack.lines {
                if let Some(file) = fil.get(usize::from(place.file)) {
                    origin.push(shown(file, place.line));
                }
            }
        }
        note.origin = origin.join("\n");
    }
    Ok(())
}

fn notes(bytes: &[u8]) -> Vec<Note> {
    lines(bytes).into_iter().map(|text| Note { text, ..Note::default() }).collect()
}

/// The lines of a text, for people.
fn lines(bytes: &[u8]) -> Vec<String> {
    let text = fil_syntax::decode(bytes, None)
        .map_or_else(|_| String::from_utf8_lossy(bytes), |(text, _)| text);
    text.lines().map(|line| line.trim_end().to_string()).collect()
}
