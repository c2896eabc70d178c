//! NC program to events: a streaming interpreter of blocks.
//!
//! Modal functions, planes, units, increments, arcs, cycles and subprograms are
//! followed as the [`Dialect`] says they mean on the machine. What it does not
//! say is refused.

mod arc;
mod block;
mod cycle;
mod klartext;
mod left_to_control;
mod modes;
mod program;
mod sinumerik;
mod state;
mod thread;
mod tip_control;
mod words;

#[cfg(test)]
mod tests;

use std::ops::Range;

use fil_diag::{Diag, TextSpan};

use crate::dialect::{Dialect, Family};
use crate::errors::NcCode;
use crate::motion::Event;

pub(crate) use sinumerik::line as sinumerik_words;

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
    match dialect.family {
        Family::WordAddress => program::Program::new(text, name, dialect).run(take),
        Family::Klartext => klartext::run(text, name, dialect, take),
        Family::Sinumerik => sinumerik::run(text, name, dialect, take),
    }
}

/// True when the program has blocks that the control leaves out when its switch for
/// blocks with a skip mark is on.
pub fn has_skipped_blocks(text: &[u8], dialect: &Dialect) -> bool {
    dialect.family != Family::Klartext && program::has_skipped_blocks(text, dialect)
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
