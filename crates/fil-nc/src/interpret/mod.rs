//! NC program to events: a streaming interpreter of blocks.
//!
//! Modal functions, planes, units, increments, arcs, cycles and subprograms are
//! followed as the [`Dialect`] says they mean on the machine. What it does not
//! say is refused.

mod arc;
mod block;
mod counted;
mod cycle;
mod direction;
mod klartext;
mod left_to_control;
mod live;
mod live_cycle;
mod modes;
mod order;
mod osp_thread;
mod passed_over;
mod program;
mod sinumerik;
mod state;
mod thread;
mod tilt;
mod tip_control;
mod turns;
mod words;

#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::io;
use std::ops::Range;

use fil_diag::{Diag, TextSpan};

use crate::dialect::{Dialect, Family, is_cl_file};
use crate::errors::NcCode;
use crate::events::Events;
use crate::motion::Event;
use crate::source::{Lines, Source, unreadable};

pub use passed_over::{PassedOver, PassingOver};
pub(crate) use sinumerik::line as sinumerik_words;
pub(crate) use sinumerik::number_of_tool;

/// The note on a text that is no program.
const OF_CL: &str =
    "the text is that of a CL file: `filpost verify` takes the CL file first, then the program";

/// A refusal, before it has its place.
#[derive(Debug)]
pub(crate) struct Fault {
    code: NcCode,
    message: String,
    /// Bytes of the line; the whole line when `None`.
    range: Option<Range<usize>>,
}

impl Fault {
    fn new(code: NcCode, message: impl Into<String>) -> Self {
        Fault { code, message: message.into(), range: None }
    }

    fn at(mut self, range: &Range<usize>) -> Self {
        self.range = Some(range.clone());
        self
    }

    pub(crate) fn place(self, name: &str, line: u32, text: &[u8]) -> Box<Diag> {
        let mut place = TextSpan::line(name, line, String::from_utf8_lossy(text).trim_end());
        if let Some(range) = self.range {
            let before = |end: usize| String::from_utf8_lossy(&text[..end.min(text.len())]).len();
            let end = place.excerpt.len();
            place.span = before(range.start).min(end)..before(range.end).min(end);
        }
        Box::new(Diag::new(self.code, self.message).at(place))
    }
}

/// Refuses a word that means nothing where it stands, or a function that is not followed there.
fn refuse<T>(why: &str) -> Result<T, Fault> {
    Err(Fault::new(NcCode::NoMeaning, why))
}

/// A program that is run line by line.
pub struct Running<'a> {
    control: Control<'a>,
    source: &'a Source<'a>,
    name: &'a str,
    dialect: &'a Dialect,
}

/// The control that runs it.
enum Control<'a> {
    WordAddress(Box<program::Program<'a>>),
    Klartext(Box<klartext::Program<'a>>),
    Sinumerik(Box<sinumerik::Program<'a>>),
}

impl<'a> Running<'a> {
    /// Begins a program; `name` is for messages.
    pub fn new(source: &'a Source<'a>, name: &'a str, dialect: &'a Dialect) -> Self {
        let control = match dialect.family {
            Family::WordAddress => {
                Control::WordAddress(Box::new(program::Program::new(source, dialect)))
            }
            Family::Klartext => {
                Control::Klartext(Box::new(klartext::Program::new(source, dialect)))
            }
            Family::Sinumerik => {
                Control::Sinumerik(Box::new(sinumerik::Program::new(source, dialect)))
            }
        };
        Running { control, source, name, dialect }
    }
}

impl Events for Running<'_> {
    fn more(&mut self, into: &mut VecDeque<Event>) -> Result<bool, Box<Diag>> {
        let more = match &mut self.control {
            Control::WordAddress(program) => program.run_line(self.name, into),
            Control::Klartext(program) => program.run_line(self.name, into),
            Control::Sinumerik(program) => program.run_line(self.name, into),
        };
        more.map_err(|mut refused| {
            if self.dialect.leaves_blocks_out() {
                refused.message.push_str(", with block delete on");
            }
            match self.of_another_family() {
                Some(note) => Box::new(refused.note(note)),
                None => refused,
            }
        })
    }
}

impl Running<'_> {
    /// Goes on after a refusal, for a picture of what is left: the refused line has no effect, and
    /// positions and motion functions are unknown until the program gives them again.
    pub(crate) fn go_on(&mut self) {
        match &mut self.control {
            Control::WordAddress(program) => program.forget(),
            Control::Klartext(program) => program.forget(),
            Control::Sinumerik(program) => program.forget(),
        }
    }

    /// Goes on after a refusal as if the refused line were not there; false where it is one before
    /// the last that was read.
    fn pass_over(&mut self) -> bool {
        match &mut self.control {
            Control::WordAddress(program) => program.pass_over(),
            Control::Klartext(program) => program.pass_over(),
            Control::Sinumerik(program) => program.pass_over(),
        }
    }

    /// The note on a program that is not for the family of the machine. A text without
    /// signs says nothing: any family may have such a program.
    #[cold]
    fn of_another_family(&self) -> Option<String> {
        if is_cl_file(self.source).ok()? {
            return Some(OF_CL.to_string());
        }
        let told = Family::of(self.source).ok()?;
        let machine = self.dialect.family;
        (told != machine && told != Family::WordAddress).then(|| {
            let (told, machine) = (told.title(), machine.title());
            format!("the text of the program is {told}, the machine is read as {machine}")
        })
    }
}

/// Runs a whole program and hands its events over in order; `name` is for messages.
///
/// # Errors
/// The first thing in the program that has no sure meaning on the machine; what
/// came before it has been handed over.
pub fn interpret(
    text: &[u8],
    name: &str,
    dialect: &Dialect,
    take: &mut dyn FnMut(Event),
) -> Result<(), Box<Diag>> {
    let source = Source::memory(text).into_page(dialect.text.page);
    let mut running = Running::new(&source, name, dialect);
    let mut events = VecDeque::new();
    while running.more(&mut events)? {
        events.drain(..).for_each(&mut *take);
    }
    Ok(())
}

/// True when the program has blocks that the control leaves out when its switch for
/// blocks with a skip mark is on; `name` is for messages.
///
/// # Errors
/// E0915 when its file can't be read.
pub fn has_skipped_blocks(
    source: &Source<'_>,
    name: &str,
    dialect: &Dialect,
) -> Result<bool, Box<Diag>> {
    let mut lines = Lines::from(source, 0);
    while let Some(line) = lines.next_line().map_err(|error| cant_read(name, &error))? {
        if program::may_be_skipped(&dialect.text.marks.read(line)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// E0915
fn cant_read(name: &str, error: &io::Error) -> Box<Diag> {
    Box::new(unreadable(name, error))
}

/// The events of a whole program.
///
/// # Errors
/// As [`interpret`].
pub fn events(text: &[u8], name: &str, dialect: &Dialect) -> Result<Vec<Event>, Box<Diag>> {
    let mut events = Vec::new();
    interpret(text, name, dialect, &mut |event| events.push(event))?;
    Ok(events)
}
