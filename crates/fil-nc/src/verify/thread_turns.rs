//! How the spindle turns in the passes of one thread: the tool lags behind it by the speed, so
//! that passes at two speeds, or two directions, do not meet. And what comes between two motions of
//! one pass: while the tool waits in its groove the part turns on.

use super::ahead::Steps;
use super::report::FindingKind;
use super::verifier::{Fact, Verifier};
use crate::motion::{Course, Move, Speed, Spindle};

/// Speed and direction of the spindle in a pass, and whether it is the second one.
pub(super) type Turns = (Option<Speed>, Spindle, Option<bool>);

impl<C: Steps> Verifier<'_, C> {
    /// The next pass must turn the spindle as the first one of its thread did.
    pub(super) fn check_turns_of_pass(&mut self, cl_line: u32, pass: &Move) {
        let now = (pass.modes.spindle.speed, pass.modes.spindle.turn, pass.modes.master.is_side);
        let first = *self.memory.thread_turns.get_or_insert(now);
        if first != now {
            self.memory.thread_turns = Some(now);
            let message = "the spindle speed differs from the earlier passes of the thread, so they do not match"
                .to_string();
            self.find(FindingKind::Speed, Some(cl_line), Some(pass.line), message);
        }
    }

    /// A motion of a pass that goes on from another one must be of the next block. A pass of a
    /// cycle begins behind a rapid of its own.
    pub(super) fn check_joins(&mut self, cl_line: u32, pass: &Move) {
        if self.facts.has(Fact::InGroove) && !pass.in_cycle && pass.line > self.moved.line + 1 {
            let message = "blocks between two moves of one pass stop the tool in the thread while the part turns"
                .to_string();
            self.find(FindingKind::Thread, Some(cl_line), Some(pass.line), message);
        }
    }

    /// Follows whether the tool stands in a groove that it has cut.
    pub(super) fn follow_groove(&mut self, found: &Move) {
        self.facts.set(Fact::InGroove, found.course == Course::Thread && !found.in_cycle);
    }
}
