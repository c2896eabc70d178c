//! How the spindle turns in the passes of one thread: the tool lags behind it by the speed, so
//! that passes at two speeds, or two directions, do not meet.

use super::ahead::Steps;
use super::report::FindingKind;
use super::walk::Walk;
use crate::motion::{Move, Speed, Spindle};

/// Speed and direction of the spindle in a pass, and whether it is the second one.
pub(super) type Turns = (Option<Speed>, Spindle, Option<bool>);

impl<C: Steps> Walk<'_, C> {
    /// The next pass must turn the spindle as the first one of its thread did.
    pub(super) fn check_turns_of_pass(&mut self, cl_line: u32, pass: &Move) {
        let now = (pass.modes.speed, pass.modes.spindle, pass.modes.counts_side);
        let first = *self.thread_turns.get_or_insert(now);
        if first != now {
            self.thread_turns = Some(now);
            let message = "the spindle turns otherwise than in the passes of the thread before, \
                           which do not meet"
                .to_string();
            self.find(FindingKind::Speed, Some(cl_line), Some(pass.line), message);
        }
    }
}
