//! The end of tool-tip control: a control may take the length of the tool off by moving, so
//! the tool must have gone up along its axis before.

use fil_machine::locations::{self as loc, ControlFamily};

use super::ahead::Steps;
use super::expected_step::{ExpectedStep, Step};
use super::report::FindingKind;
use super::say::short;
use super::settings::Settings;
use super::verifier::{Fact, STILL, Verifier};
use crate::motion::{Course, Event, Modes, Move, Position};

impl Settings<'_> {
    /// How far the tool must go up before tool-tip control ends, mm; `None` for a control
    /// that does not move then.
    pub(super) fn way_up_at_tip_end(&self) -> Option<f64> {
        let moves = self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
        let way = self.commons.dbl_opt(loc::ROTARY_TIP_END_RETRACT);
        way.filter(|way| moves && *way > 0.0)
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// A rapid straight along the tool, away from the part and as far as the settings ask
    /// for, behind which tool-tip control ends, or nothing moves any more.
    pub(super) fn goes_up_at_tip_end(&self, found: &Move) -> bool {
        let Some(way_up) = self.settings.way_up_at_tip_end() else { return false };
        let along_tool = found.course == Course::Rapid
            && found.to.tip_control
            && self.at.tip_control
            && found.to.rotary == self.at.rotary
            && !found.in_cycle;
        let ends = self.ends_tip_control(self.next + 1, &found.modes);
        if !along_tool || ends == Some(false) {
            return false;
        }
        let forward = &self.settings.forward;
        let stands = forward.pose(&self.at);
        let way = forward.pose(&found.to).tip - stands.tip;
        let along = way.dot(&stands.axis);
        let slack = 2.0 * self.tip_slack(&found.to) + self.axis_slack() * way_up;
        (way - stands.axis * along).norm() <= slack && along >= way_up - slack
    }

    /// A rapid straight up in Z, along which the tool lies, with its length on, as far as the
    /// settings ask for, behind which the length is taken off and tool-tip control begins. A frame
    /// may have ended before it.
    pub(super) fn goes_up_at_tip_begin(&self, found: &Move) -> bool {
        let Some(way_up) = self.settings.way_up_at_tip_end() else { return false };
        let (from, to) = (self.at_as(found), &found.to);
        let ends_frame = self.at.tilt != to.tilt;
        let is_known = match ends_frame {
            true => self.known[..3] == [true; 3] && found.known[2],
            false => self.known[2] && found.known == self.known,
        };
        // Away from the part a head that leans may go straight up in Z, too.
        let level = from.linear[2];
        let is_away = self.facts.has(Fact::Away)
            || (!ends_frame && !self.facts.has(Fact::InCut) && self.is_retract_level(level));
        let straight_up = found.course == Course::Rapid
            && !(to.tip_control || self.at.tip_control || found.in_cycle)
            && found.modes.length.offset.is_some()
            && is_known
            && (is_away || self.lies_along_z(to))
            && to.rotary == from.rotary
            && (0..2).all(|n| (to.linear[n] - from.linear[n]).abs() <= STILL)
            && to.linear[2] - level >= way_up - 2.0 * self.tip_slack(to);
        straight_up && self.begins_tip_control(self.next + 1, to)
    }

    /// Says it where a head that leans goes up in its frame less far than the settings ask for, and
    /// the length of the tool is taken off behind the frame, before tool-tip control begins.
    pub(super) fn check_way_up_in_frame(&mut self, cl_line: u32, part: &Move) {
        let Some(way_up) = self.settings.way_up_at_tip_end() else { return };
        let leaves_frame = part.to.tilt.is_some() && part.to.tilt == self.at.tilt;
        if !(leaves_frame && part.known[2] && self.known[2]) {
            return;
        }
        let rise = part.to.linear[2] - self.at.linear[2];
        let is_enough = rise >= way_up - 2.0 * self.slack.linear[2] - STILL;
        if self.is_upright(part.to.rotary) || is_enough || part.modes.length.offset.is_none() {
            return;
        }
        let message = format!(
            "retracts by {} before the tool length offset is cancelled, it should be {}",
            short(rise),
            short(way_up)
        );
        self.find(FindingKind::Order, Some(cl_line), Some(part.line), message);
    }

    /// Says it where tool-tip control begins with the length of the tool on, which is taken off
    /// before, and the tool had not gone up.
    pub(super) fn check_tip_begin(&mut self, cl_line: u32) {
        let may_come_down = !self.at.tip_control
            && !self.facts.has(Fact::Above)
            && !self.facts.has(Fact::FreshTool)
            && self.known[2]
            && self.expected.offset_on().is_some();
        if !may_come_down || self.settings.way_up_at_tip_end().is_none() {
            return;
        }
        let Some(Event::Move(found)) = self.nc.get(self.next) else { return };
        if !found.to.tip_control || self.own.has(found.line) {
            return;
        }
        self.facts.set(Fact::Above, true);
        let message =
            "TCPC starts with an active tool length offset, and the control may have moved down by it"
                .to_string();
        self.find(FindingKind::Order, Some(cl_line), Some(found.line), message);
    }

    /// The next motion that moves X, Y or Z is under tool-tip control.
    fn begins_tip_control(&self, index: usize, from: &Position) -> bool {
        let next = self.nc.from(index).find_map(|event| match event {
            Event::Move(next) if next.modes.frame.tip_control => Some(true),
            Event::Move(next) => (next.to.linear != from.linear).then_some(false),
            Event::ToolChange { .. } | Event::End { .. } => Some(false),
            _ => None,
        });
        next == Some(true)
    }

    /// Takes the way up, on which a work offset may wait for the next motion of the CL file.
    pub(super) fn goes_up(&mut self, cl_line: u32, found: &Move) {
        let mut seen = *found;
        if found.modes.frame.fixture == self.moved.modes.frame.fixture {
            seen.modes.frame.fixture =
                self.expected.fixture.must.unwrap_or(found.modes.frame.fixture);
        }
        self.take(cl_line, &seen);
        self.moved.modes.frame.fixture = found.modes.frame.fixture;
        self.next += 1;
        self.facts.set(Fact::Up, true);
    }

    /// The CL file stays where the tool is, and the program ends tool-tip control, or goes up for
    /// that, which no step asks for: it comes behind all steps that stay.
    #[cold]
    pub(super) fn rests_before_tip_end(&mut self, step: &Step) -> bool {
        let (ExpectedStep::Rapid(pose) | ExpectedStep::Feed(pose, _)) = &step.what else {
            return false;
        };
        // A new tool is brought there anew.
        if self.facts.has(Fact::FreshTool) || self.goes_on_under_tip_control() {
            return false;
        }
        while self.stands_at(pose) {
            // A direction that is written as a vector is said where nothing moves, too.
            while let Some(still) = self.next_move().filter(|found| self.is_still(found)) {
                self.take(step.line, &still);
                self.next += 1;
            }
            let found = match self.nc.get(self.next) {
                Some(Event::Move(found)) => found,
                Some(Event::Dwell { line, .. }) if self.own.has(line) => {
                    self.next += 1;
                    continue;
                }
                _ => return false,
            };
            if self.goes_up_at_tip_end(&found) || !found.to.tip_control {
                return true;
            }
            // A text may turn an axis that the tool lies along.
            if !self.own.has(found.line) {
                return false;
            }
            self.stand(&found);
        }
        false
    }

    /// The next motion is one under tool center point control.
    fn goes_on_under_tip_control(&self) -> bool {
        let next = self.next_move().filter(|found| found.to.tip_control);
        next.is_some_and(|found| {
            !self.is_still(&found) && !self.own.has(found.line) && !self.goes_up_at_tip_end(&found)
        })
    }

    /// Tool-tip control ends before an event, though it may begin again, for another work offset
    /// or the same; `None` where no event says it.
    fn ends_tip_control(&self, index: usize, modes: &Modes) -> Option<bool> {
        self.nc.from(index).find_map(|event| match event {
            Event::Move(next) => Some(
                !next.modes.frame.tip_control
                    || next.modes.frame.fixture != modes.frame.fixture
                    || next.modes.frame.tip_control_line != modes.frame.tip_control_line,
            ),
            Event::ToolChange { modes, .. } | Event::End { modes, .. } => {
                Some(!modes.frame.tip_control)
            }
            _ => None,
        })
    }

    /// Where tool-tip control has ended with the machine turned, a control may have moved for it.
    pub(super) fn forget_tip(&mut self, next: &Move) {
        let turned = self.at.rotary.iter().any(|angle| angle % 360.0 != 0.0);
        if self.at.tip_control && !next.to.tip_control && turned {
            self.known[..3].fill(false);
        }
    }

    /// Says it where tool-tip control has ended and the tool had not gone up.
    pub(super) fn check_tip_end(&mut self, cl_line: u32) {
        let here = self.at.tip_control && !self.facts.has(Fact::Up) && self.known[..3] == [true; 3];
        if !here || self.settings.way_up_at_tip_end().is_none() {
            return;
        }
        let is_own = self.nc.get(self.next).is_some_and(|event| self.own.has(event.line()));
        if is_own || self.ends_tip_control(self.next, &self.moved.modes) != Some(true) {
            return;
        }
        self.facts.set(Fact::Up, true);
        let line = self.nc.get(self.next).map(|event| event.line());
        let message =
            "TCPC ended at the tool position, and the control may move down by the tool length"
                .to_string();
        self.find(FindingKind::Order, Some(cl_line), line, message);
    }
}
