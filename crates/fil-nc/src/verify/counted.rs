//! Which spindle of a lathe must be the one that the control counts, and what the other one does.

use super::delayed::DelayedMode;
use super::modes::{Expected, ExpectedSpindle};
use super::settings::Settings;
use crate::motion::{Speed, Spindle};

/// Which spindle of a lathe the control counts, and the other one.
#[derive(Clone, Debug)]
pub(super) struct Counted {
    /// The second one; `None` before any record has spoken of one, or for a machine with one.
    pub(super) side: Option<bool>,
    pub(super) other: ExpectedSpindle,
}

impl Counted {
    /// Records speak of the second spindle.
    pub(super) fn is_side(&self) -> bool {
        self.side == Some(true)
    }
}

impl Expected {
    /// A record speaks of one of the spindles, which must be counted from there on.
    pub(super) fn count(&mut self, side: bool, settings: &Settings) {
        let counted = &settings.dialect.turning.counted;
        if !counted.is_chosen() {
            return;
        }
        let before = self.counted.side.replace(side) == Some(true);
        if before == side {
            return;
        }
        self.spindle.flush();
        // A surface speed ends before: S would be that of the other one.
        let speed = self.spindle.speed.now().filter(|speed| matches!(speed, Speed::Turns(_)));
        self.spindle.speed = DelayedMode::new(speed);
        let (master, other) = (&mut self.spindle, &mut self.counted.other);
        std::mem::swap(master, other);
        if !counted.has_own_limits {
            std::mem::swap(&mut master.speed_limit, &mut other.speed_limit);
        }
    }

    /// The program ends with the main spindle counted, as the next one begins, and the second one
    /// standing: M30 stops the one that is counted, if it turns.
    pub(super) fn ends_counting_side(&mut self, settings: &Settings) {
        let other_turns = self.counted.other.turn.now() != Some(Spindle::Off);
        if !(self.counted.is_side() || other_turns) {
            return;
        }
        self.count(false, settings);
        self.spindle.turn = DelayedMode::new(None);
        self.counted.other.turn = DelayedMode::new(Some(Spindle::Off));
    }
}
