//! Modes that a program depends on without saying them.

use super::state::State;
use super::words::Words;
use crate::dialect::Dialect;
use crate::motion::{Compensation, Course, Event, Move, StartMode};

/// What the words of a block may depend on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Uses {
    /// An axis word that is a position or an increment.
    pub(super) positions: bool,
    /// S.
    pub(super) speed: bool,
}

impl Uses {
    pub(super) fn of(words: &Words, dialect: &Dialect) -> Self {
        Uses { positions: words.has_plain_axes(dialect), speed: words.has(b'S' - b'A' + 1) }
    }
}

impl State<'_> {
    /// Tells the modes that the block depends on and that are not certain. Each is told
    /// once, before what the block does.
    #[cold]
    pub(super) fn tell_left_to_control(&mut self, uses: Uses) {
        for mode in StartMode::ALL.into_iter().rev() {
            if !self.certain.has(mode) && self.depends_on(mode, uses) {
                self.certain.say(mode);
                self.events.insert(0, Event::LeftToControl { line: self.line, mode });
            }
        }
    }

    fn depends_on(&self, mode: StartMode, uses: Uses) -> bool {
        let any = |is: &dyn Fn(&Move) -> bool| {
            self.events.iter().any(|event| matches!(event, Event::Move(found) if is(found)))
        };
        let of_cycle = |found: &Move| found.in_cycle && found.course != Course::Machine;
        match mode {
            StartMode::Unit | StartMode::Diameter => any(&|_| true),
            StartMode::Positions => uses.positions && any(&|found| found.course != Course::Machine),
            StartMode::Feed => any(&|found| found.course == Course::Feed),
            StartMode::Plane => any(&|found| {
                let counts_lengths =
                    self.dialect.counts_lengths_in_plane() && found.course != Course::Machine;
                counts_lengths
                    || found.arc.is_some()
                    || of_cycle(found)
                    || found.modes.compensation.side != Compensation::Off
            }),
            StartMode::ReturnLevel => {
                self.cycle.active.is_some_and(|cycle| !cycle.keeps_its_level()) && any(&of_cycle)
            }
            StartMode::Surface => uses.speed && self.modes.spindle.speed.is_some(),
        }
    }
}
