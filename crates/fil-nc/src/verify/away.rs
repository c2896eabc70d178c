//! Turns of the machine for tilted frames: nothing may stand beside the tool while the tables or
//! heads turn. So a tool change or a position of the machine has come before, or a way up to the
//! level of the settings.

use fil_machine::locations::{self as loc, RotaryFrameOutput};

use super::ahead::Steps;
use super::lines::RAPID_PARTS;
use super::report::FindingKind;
use super::say::short;
use super::settings::Settings;
use super::verifier::{Fact, STILL, Verifier};
use crate::dialect::Habit;
use crate::motion::{Course, Event, Move, Position};

impl Settings<'_> {
    /// Motions under a tool axis that stands still are written in tilted frames.
    fn turns_for_frames(&self) -> bool {
        self.commons.read(loc::ROTARY_FRAME_OUTPUT) == RotaryFrameOutput::TiltedWorkPlane
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// The rotary axes turn in this motion, and X, Y and Z stay.
    fn only_turns(&self, found: &Move) -> bool {
        let at = self.at_as(found);
        let moves =
            (0..3).any(|n| found.known[n] && (found.to.linear[n] - at.linear[n]).abs() > STILL);
        let turns = (0..2).any(|n| (found.to.rotary[n] - at.rotary[n]).abs() > STILL);
        found.course == Course::Rapid && turns && !moves && found.arc.is_none()
    }

    /// The tool has come away from the part, or goes to it, by this motion.
    pub(super) fn leaves_or_comes(&mut self, found: &Move) {
        for n in 0..5 {
            let stays = !found.known[n] && found.to.axis(n) == self.at.axis(n);
            self.memory.machine_at[n] = match found.to_machine[n] {
                true => Some(found.to.axis(n)),
                false => self.memory.machine_at[n].filter(|_| stays),
            };
        }
        if found.to_machine[2] && self.settings.dialect.has(Habit::PositionsEndLengths) {
            self.expected.length_is_taken_off();
        }
        let is = match found.course {
            Course::Machine => true,
            _ => self.facts.has(Fact::Away) && self.only_turns(found),
        };
        self.facts.set(Fact::Away, is);
    }

    /// How high the tool stands in the machine behind a motion, and how it came there.
    pub(super) fn follow_height(&mut self, found: &Move, cuts: bool) {
        if self.only_turns(found) {
            return;
        }
        self.facts.set(Fact::InCut, cuts && !found.in_cycle);
        let counts_in_machine = !found.to.names_tip();
        let is_known = match counts_in_machine {
            true => found.known[2],
            false => self.is_known(&found.known),
        };
        let at = self.settings.forward.restated(&found.to, &Position::default());
        self.height = is_known.then_some(at.linear[2]);
    }

    /// A way up to the level of the settings in the frame of the machine, behind which the machine
    /// turns for another tilted frame.
    pub(super) fn goes_up_for_frame(&self, found: &Move) -> bool {
        let level = self.settings.retract_level(self.limits.metric);
        let is_at = |level: f64| (found.to.linear[2] - level).abs() <= self.slack.linear[2];
        let is_up = found.to_machine == [false, false, true, false, false]
            && self.settings.names_machine_positions()
            && level.is_some_and(is_at);
        let tilt = self.at.tilt;
        let mut behind = self.nc.from(self.next + 1).take(RAPID_PARTS);
        let is_other = |event| matches!(event, Event::Move(next) if next.to.tilt != tilt);
        is_up && self.settings.turns_for_frames() && behind.any(is_other)
    }

    /// Takes the way up and the turn before a hole in another frame than the last motion.
    pub(super) fn changes_frame(&mut self, cl_line: u32) {
        let other = |plunge: Move| {
            let tilts = plunge.to.tilt != self.at.tilt || plunge.to.rotary != self.at.rotary;
            tilts && !plunge.to.tip_control
        };
        if !self.settings.turns_for_frames() || !self.plunge(self.next).is_some_and(other) {
            return;
        }
        while let Some(found) = self.next_move() {
            let rapid = found.course == Course::Rapid && !found.in_cycle;
            let before = rapid && found.to.tilt.is_none();
            let turns = self.only_turns(&found);
            let at = self.at_as(&found).linear;
            let moves = |n: usize| found.known[n] && (found.to.linear[n] - at[n]).abs() > STILL;
            let rises = !(0..2).any(moves)
                && self.settings.retract_level(self.limits.metric).is_some_and(|level| {
                    (found.to.linear[2] - level).abs() <= self.slack.linear[2]
                });
            if !before || !(turns || rises) {
                break;
            }
            self.check_before_frame(cl_line, &found);
            self.check_turn_is_away(cl_line, &found);
            self.take(cl_line, &found);
            self.next += 1;
        }
        // The level before the cycle is that of another frame.
        self.memory.initial = None;
    }

    /// A turn of the machine for a tilted frame, or out of one, where the tool is not away from
    /// the part.
    pub(super) fn check_turn_is_away(&mut self, cl_line: u32, found: &Move) {
        let frames = self.settings.turns_for_frames() && !found.to.names_tip();
        let changed = found.modes.tool != self.moved.modes.tool;
        if !frames || self.facts.has(Fact::Away) || changed || !self.only_turns(found) {
            return;
        }
        let Some(level) = self.settings.retract_level(self.limits.metric) else { return };
        let slack = self.slack.linear[2];
        // How high a Z of the part lies in the machine nobody knows.
        let of_machine = self.settings.names_machine_positions();
        let is_above = self.height.is_some_and(|stands| stands >= level - slack);
        if !self.facts.has(Fact::InCut) && is_above && !of_machine {
            return;
        }
        let place = match self.height {
            Some(stands) if of_machine => format!("at Z{} of the part", short(stands)),
            Some(stands) => format!("at Z{}", short(stands)),
            None => "where Z has not been programmed since the last tilted work plane".to_string(),
        };
        let message = format!(
            "the machine turns {place}, the tool must have gone up to Z{} before",
            short(level)
        );
        self.find(FindingKind::Order, Some(cl_line), Some(found.line), message);
    }
}
