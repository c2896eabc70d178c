//! Events that no step asks for, which the walk passes over.

use super::ahead::Steps;
use super::expected_step::{ExpectedStep, Step};
use super::report::FindingKind;
use super::verifier::{Fact, STILL, Verifier};
use crate::motion::{Course, Event, Move};

impl<C: Steps> Verifier<'_, C> {
    /// Passes over events that no step asks for: motions to points of the machine,
    /// blocks of the settings, ways of no length. Gives the motion that comes next, when
    /// it is one.
    pub(super) fn pass(&mut self, cl_line: u32) -> Option<Move> {
        loop {
            self.pass_still(cl_line);
            match self.nc.get(self.next)? {
                Event::Move(found) if found.course == Course::Machine => {
                    let is_for_frame = self.goes_up_for_frame(&found);
                    self.stand(&found);
                    if is_for_frame {
                        continue;
                    }
                    let message = "goes to a point of the machine that neither the CL file nor the settings ask for";
                    self.find(
                        FindingKind::Extra,
                        Some(cl_line),
                        Some(found.line),
                        message.to_string(),
                    );
                }
                Event::Move(found) => return Some(found),
                _ => return None,
            }
        }
    }

    /// The next event is a motion at feed that goes on from where the axes stand: nothing is
    /// passed over. Most motions are.
    pub(super) fn goes_on(&self) -> bool {
        let goes_on = |event: &Event| match event {
            Event::Move(found) => {
                found.course == Course::Feed
                    && found.known == self.known
                    && !self.at.names_tip()
                    && !found.to.names_tip()
                    && (0..3).any(|n| (found.to.linear[n] - self.at.linear[n]).abs() > STILL)
                    && !self.own.has(found.line)
            }
            _ => false,
        };
        self.nc.look(self.next, goes_on) == Some(true)
    }

    /// As [`Verifier::pass`], up to a motion to a point of the machine, which may be asked for.
    pub(super) fn pass_still(&mut self, cl_line: u32) {
        loop {
            self.pass_own();
            self.check_tip_end(cl_line);
            self.check_tip_begin(cl_line);
            match self.nc.get(self.next) {
                Some(Event::Move(found)) if self.goes_up_at_tip_end(&found) => {
                    self.goes_up(cl_line, &found);
                }
                Some(Event::Move(found)) if self.goes_up_at_tip_begin(&found) => {
                    let is_away =
                        self.facts.has(Fact::Away) || self.is_retract_level(self.at.linear[2]);
                    self.goes_up(cl_line, &found);
                    self.facts.set(Fact::Away, is_away);
                    self.facts.set(Fact::Above, true);
                }
                Some(Event::Move(found)) if self.turns_away(&found) => {
                    self.take_turn_away(cl_line, &found);
                }
                Some(Event::Move(found))
                    if found.course != Course::Machine
                        && !self.is_of_a_later_offset(&found)
                        && (self.is_still(&found) || self.goes_there_again(&found)) =>
                {
                    self.take(cl_line, &found);
                    self.next += 1;
                }
                _ => return,
            }
        }
    }

    /// A motion in a work offset that no record before has asked for: it belongs to a step
    /// behind the record that does.
    fn is_of_a_later_offset(&self, found: &Move) -> bool {
        found.modes.frame.fixture != self.moved.modes.frame.fixture
            && self.expected.fixture.must.is_some_and(|asked| asked != found.modes.frame.fixture)
    }

    /// A record has asked for a work offset in which nothing has moved: where the axes stand in
    /// it nobody knows.
    pub(super) fn awaits_offset(&self) -> bool {
        self.expected
            .fixture
            .must
            .flatten()
            .is_some_and(|asked| self.moved.modes.frame.fixture != Some(asked))
    }

    /// The CL file stays where the tool is, and the program goes to a point of the machine, for
    /// which a later record may ask.
    pub(super) fn rests_before_machine(&mut self, step: &Step) -> bool {
        let (ExpectedStep::Rapid(pose) | ExpectedStep::Feed(pose, _)) = &step.what else {
            return false;
        };
        let goes_away =
            |walk: &Self| walk.next_move().is_some_and(|found| found.course == Course::Machine);
        if goes_away(self) {
            self.pass_still(step.line);
        }
        goes_away(self) && self.stands_at(pose)
    }

    /// Passes over events of blocks of the settings and of INSERT.
    pub(super) fn pass_own(&mut self) {
        while self.nc.line(self.next).is_some_and(|line| self.own.has(line)) {
            let Some(event) = self.nc.get(self.next) else { return };
            match event {
                Event::Move(found) => {
                    if found.to.linear[2] != self.at.linear[2] {
                        // Holes behind it return to where it has brought the tool.
                        self.memory.initial = None;
                    }
                    self.stand(&found);
                }
                Event::ToolChange { tool, .. } => {
                    self.expected.insert_tool(tool);
                    self.memory.machine_at = [None; 5];
                    self.next += 1;
                }
                Event::Dwell { .. } => self.next += 1,
                _ => return,
            }
        }
    }

    /// Goes where a motion goes without a look at it.
    pub(super) fn stand(&mut self, found: &Move) {
        self.leaves_or_comes(found);
        let stays = self.known[2] && found.to.linear[2] == self.at.linear[2];
        self.facts.end_unless(Fact::FreshHeight, stays || !found.known[2]);
        self.at = found.to;
        self.known = found.known;
        self.moved.modes.tool = found.modes.tool;
        self.moved.modes.frame.fixture = found.modes.frame.fixture;
        self.moved.modes.frame.tip_control_line = found.modes.frame.tip_control_line;
        self.memory.rapid_end = None;
        self.next += 1;
    }

    /// Goes nowhere. X, Y or Z that was not known before may have come from anywhere.
    pub(super) fn is_still(&self, found: &Move) -> bool {
        let at = self.at_as(found);
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= STILL);
        let found_out = (0..3).any(|n| self.limits.written[n] && found.known[n] && !self.known[n]);
        found.arc.is_none()
            && !found_out
            && same(&found.to.linear, &at.linear)
            && same(&found.to.rotary, &at.rotary)
    }
}
