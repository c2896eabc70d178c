//! Which spindle of a lathe must be the one that the control counts, and what the other one does.

use super::lag::Lag;
use super::modes::Expected;
use super::modes_said::name_of_turn;
use super::settings::Settings;
use crate::motion::{Modes, Speed, Spindle};

/// The spindles of a lathe.
#[derive(Clone, Debug)]
pub(super) struct Counted {
    /// The second one; `None` before any record has spoken of one, or for a machine with one.
    side: Option<bool>,
    other: Other,
}

/// What must hold of the spindle that is not counted.
#[derive(Clone, Debug)]
struct Other {
    spindle: Option<Spindle>,
    last_turn: Option<Spindle>,
    speed: Option<Speed>,
    range: Option<u8>,
    orientation: Option<f64>,
    limit: Option<Option<f64>>,
}

impl Default for Counted {
    fn default() -> Self {
        let other = Other {
            spindle: Some(Spindle::Off),
            last_turn: None,
            speed: None,
            range: None,
            orientation: None,
            limit: Some(None),
        };
        Counted { side: None, other }
    }
}

impl Counted {
    /// Records speak of the second spindle.
    pub(super) fn is_side(&self) -> bool {
        self.side == Some(true)
    }

    /// What is wrong with the spindle that the program has chosen, and with the other one.
    pub(super) fn wrong(&self, modes: &Modes) -> Option<String> {
        let must = self.side?;
        let name = |side: bool| if side { "the second spindle" } else { "the main spindle" };
        if modes.master.is_side != Some(must) {
            let found = modes.master.is_side.map_or("no spindle that was chosen", name);
            return Some(format!("the control counts {found}, it should count {}", name(must)));
        }
        let turns = self.other.spindle.filter(|turns| *turns != modes.master.other)?;
        let [found, turns] = [modes.master.other, turns].map(name_of_turn);
        Some(format!("{} is {found}, it should be {turns}", name(!must)))
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
        self.speed.flush();
        let now = Other {
            spindle: self.spindle.now,
            last_turn: self.last_turn,
            // A surface speed ends before: S would be that of the other one.
            speed: self.speed.now.filter(|speed| matches!(speed, Speed::Turns(_))),
            range: self.range,
            orientation: self.orientation,
            limit: self.speed_limit,
        };
        let other = std::mem::replace(&mut self.counted.other, now);
        self.spindle = Lag::new(other.spindle);
        self.speed = Lag::new(other.speed);
        (self.last_turn, self.range) = (other.last_turn, other.range);
        self.orientation = other.orientation;
        if counted.has_own_limits {
            self.speed_limit = other.limit;
        }
    }

    /// The program ends with the main spindle counted, as the next one begins, and the second one
    /// standing: M30 stops the one that is counted, if it turns.
    pub(super) fn ends_counting_side(&mut self, settings: &Settings) {
        let other_turns = self.counted.other.spindle != Some(Spindle::Off);
        if !(self.counted.is_side() || other_turns) {
            return;
        }
        self.count(false, settings);
        self.spindle = Lag::new(None);
        self.counted.other.spindle = Some(Spindle::Off);
    }
}
