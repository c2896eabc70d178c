//! Lines that are passed over: what an author wrote goes to the tape as it is, whether or not the
//! interpreter knows what it does.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

use fil_diag::Diag;

use super::Running;
use crate::events::Events;
use crate::motion::Event;

/// Refused lines that are passed over, at most; a program with more is another control's.
const MOST: usize = 100;

/// The refused lines of a program, which may be an author's.
#[derive(Debug, Default)]
pub struct PassedOver(Mutex<Vec<Diag>>);

impl From<Vec<Diag>> for PassedOver {
    fn from(refused: Vec<Diag>) -> Self {
        PassedOver(Mutex::new(refused))
    }
}

impl PassedOver {
    /// Why each line was refused, in the order of the program.
    pub fn take(&self) -> Vec<Diag> {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Keeps a refusal; gives it back when there are too many.
    fn keep(&self, refused: Box<Diag>) -> Result<(), Box<Diag>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() == MOST {
            return Err(refused);
        }
        kept.push(*refused);
        Ok(())
    }
}

/// A program whose refused lines count as if they were not there.
pub struct PassingOver<'a> {
    running: Running<'a>,
    passed: &'a PassedOver,
    /// The last line that was passed over.
    last: u32,
}

impl<'a> Running<'a> {
    /// The program with its refused lines passed over, which `passed` takes up.
    pub fn passing_over(self, passed: &'a PassedOver) -> PassingOver<'a> {
        PassingOver { running: self, passed, last: 0 }
    }
}

impl Events for PassingOver<'_> {
    fn more(&mut self, into: &mut VecDeque<Event>) -> Result<bool, Box<Diag>> {
        let refused = match self.running.more(into) {
            Err(refused) => refused,
            more => return more,
        };
        let line = refused.spans.first().map_or(0, |span| span.line);
        // The end of the text is refused again and again.
        if line <= self.last || !self.running.pass_over() {
            return Err(refused);
        }
        self.last = line;
        self.passed.keep(refused).map(|()| true)
    }
}
