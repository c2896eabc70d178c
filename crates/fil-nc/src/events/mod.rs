//! The events of a program, one after the other.

mod ahead;

use std::collections::VecDeque;

use fil_diag::Diag;

use crate::motion::Event;

pub use ahead::ahead;

/// Events that a program of events in memory hands over at once.
const AT_ONCE: usize = 64;

/// Gives the events of a program in their order, a few at a time.
pub trait Events {
    /// Appends the next events, perhaps none of them yet; false behind the last.
    ///
    /// # Errors
    /// What the interpreter refuses; nothing is asked for after it.
    fn more(&mut self, into: &mut VecDeque<Event>) -> Result<bool, Box<Diag>>;
}

impl Events for &[Event] {
    fn more(&mut self, into: &mut VecDeque<Event>) -> Result<bool, Box<Diag>> {
        let (next, rest) = self.split_at(self.len().min(AT_ONCE));
        into.extend(next);
        *self = rest;
        Ok(!next.is_empty())
    }
}
