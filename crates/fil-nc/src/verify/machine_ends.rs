//! Motions whose end the settings of the machine give or correct.

use super::ahead::Steps;
use super::expected_step::{ExpectedStep, Step, TableWay};
use super::lines::{AROUND, RAPID_PARTS};
use super::rapid_lean::Leg;
use super::report::FindingKind;
use super::say::short;
use super::verifier::{Fact, STILL, Verifier};
use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Position};

/// Directions of the tool that differ by less are one: what the rounding of angles makes.
const SAME_AXIS: f64 = 1e-4;

impl<C: Steps> Verifier<'_, C> {
    /// A rapid that the CL file asks for to a position of the linear axes, mm; the others stay, and
    /// the rotary axes.
    pub(super) fn go_to_machine(&mut self, cl_line: u32, to: [Option<f64>; 3]) {
        self.report.compared += 1;
        self.report.matched += u64::from(self.is_at_machine(cl_line, to));
    }

    /// The same where the settings may ask for it, which is no motion of the CL file. Says whether
    /// the program makes it.
    pub(super) fn is_at_machine(&mut self, cl_line: u32, to: [Option<f64>; 3]) -> bool {
        self.memory.initial = None;
        if self.settings.names_machine_positions() {
            let [x, y, z] = to;
            return self.go_in_machine_frame(cl_line, [x, y, z, None, None]);
        }
        self.pass(cl_line);
        let raised = self.raised_from_here(to[2]);
        let count = self.parts_to_machine(to);
        let Some(count) = count else {
            let axes = ["X", "Y", "Z"].iter().zip(to);
            let axes = axes.filter_map(|(axis, value)| Some(format!(" {axis}{}", short(value?))));
            let message = format!("no rapid to{}", axes.collect::<String>());
            self.find(FindingKind::Missing, Some(cl_line), None, message);
            return false;
        };
        let last = self.next + count;
        if let Some(raised) = raised.filter(|_| !self.facts.has(Fact::Up)) {
            self.check_way_up_along_head(cl_line, count, &raised);
        }
        let end = last.checked_sub(1).and_then(|at| self.nc.get(at));
        let ends_tip_control = self.at.tip_control;
        while self.next < last {
            if let (Some(part), Some(Event::Move(end))) = (self.next_move(), &end) {
                match self.settings.is_mill_turn() && self.goes_around(&part, &end.to) {
                    true => {}
                    false => self.check_part(cl_line, &part, &end.to, Leg::ToMachine),
                }
                if ends_tip_control && part.to.linear[2] == self.at.linear[2] {
                    self.take_without_length(cl_line, &part);
                } else {
                    self.take(cl_line, &part);
                }
            }
            self.next += 1;
        }
        self.facts.set(Fact::Away, true);
        self.settle(cl_line);
        self.watch.stand(None);
        true
    }

    /// Motions to a point in the frame of the machine, mm and degrees, Z before all others; an
    /// axis without a value stays. An axis that stands there may stay. True when they are as they
    /// must be.
    pub(super) fn go_in_machine_frame(&mut self, cl_line: u32, to: [Option<f64>; 5]) -> bool {
        self.pass_still(cl_line);
        let mut open = to;
        while open.iter().any(Option::is_some) {
            let found = self.next_move().filter(|found| found.course == Course::Machine);
            if found.is_none() && (0..5).all(|n| open[n].is_none_or(|to| self.is_there(n, to))) {
                break;
            }
            let Some(found) = found else {
                let message = "no motion to the position of the machine".to_string();
                self.find(FindingKind::Missing, Some(cl_line), None, message);
                return false;
            };
            // While a mill-turn machine turns, the axis C is its spindle.
            let is_spindle = self.settings.is_mill_turn() && !self.expected.mills();
            let is_axis = |n: usize| if n > 2 { !is_spindle } else { self.limits.written[n] };
            // Behind the end of a frame the axes stand where the tool stood in it. An axis that is
            // named goes to a place of the machine, which says nothing of where it stood.
            let stands = self.out_of_polar(&found).unwrap_or_else(|| self.at_as(&found));
            let moved = |n: &usize| {
                let differs = (found.to.axis(*n) - stands.axis(*n)).abs() > STILL;
                is_axis(*n) && (found.to_machine[*n] || differs)
            };
            let arrives = |n: usize| {
                to[n].is_some_and(|to| {
                    found.to_machine[n] && (found.to.axis(n) - to).abs() <= self.slack_of(n)
                })
            };
            let astray = (0..5).filter(moved).any(|n| !arrives(n));
            for n in (0..5).filter(|n| arrives(*n)) {
                open[n] = None;
            }
            // Of a lathe both go at once: alone one of them may go through the wall of a groove.
            // The settings may say that one axis goes first.
            let reached = |n: usize| open[n].is_none_or(|to| self.is_there(n, to));
            let rises = match (self.settings.is_lathe(), self.settings.first_of_lathe_home()) {
                (true, Some(first)) => reached(first),
                (true, None) => (0..3).all(reached),
                (false, _) => reached(2),
            };
            self.check_edge_is_off(cl_line, &found);
            self.stand(&found);
            if astray || !rises {
                let message = "goes to another position of the machine".to_string();
                self.find(FindingKind::Extra, Some(cl_line), Some(found.line), message);
                return false;
            }
        }
        self.facts.set(Fact::Away, true);
        self.watch.stand(None);
        true
    }

    /// An axis stands at this position in the frame of the machine, mm or degrees.
    fn is_there(&self, n: usize, to: f64) -> bool {
        self.memory.machine_at[n].is_some_and(|at| (at - to).abs() <= self.slack_of(n))
    }

    /// What the rounding of an axis may make, mm or degrees.
    fn slack_of(&self, n: usize) -> f64 {
        match n {
            0..3 => self.slack.linear[n],
            _ => self.slack.rotary[n - 3],
        }
    }

    /// Where X and C of a mill-turn machine without Y stand behind polar interpolation, as a motion
    /// has C: at the point that was reached in the plane.
    fn out_of_polar(&self, found: &Move) -> Option<Position> {
        let [x, y, z] = self.at.linear;
        if !self.expected.mills_without_y(self.settings) || y == 0.0 {
            return None;
        }
        let rotary = [found.to.rotary[0], self.at.rotary[1]];
        let stands = Position { linear: [libm::hypot(x, y), 0.0, z], rotary, ..found.to };
        let forward = &self.settings.forward;
        let off = forward.pose(&stands).tip - forward.pose(&self.at).tip;
        (off.norm() <= AROUND).then_some(stands)
    }

    /// The length of an edge in force shifts where the spindle goes in the frame of the machine.
    fn check_edge_is_off(&mut self, cl_line: u32, found: &Move) {
        let edge = found.modes.length.offset.filter(|_| self.settings.has_edges());
        if let Some(edge) = edge {
            let message = format!(
                "D{edge} is active in a move to machine coordinates, and its length shifts the move"
            );
            self.find(FindingKind::Tool, Some(cl_line), Some(found.line), message);
        }
    }

    /// Where a way up to a level of Z must bring a head that leans; `None` for a tool along Z, where
    /// it stands nobody knows, and behind a tool change, which has brought it away.
    pub(super) fn raised_from_here(&self, level: Option<f64>) -> Option<Position> {
        if self.facts.has(Fact::FreshTool) {
            return None;
        }
        let stands = self.settings.forward.restated(&self.at, &Position::default());
        Some(self.raised(&stands, level)).filter(|raised| *raised != stands)
    }

    /// One of the rapids to a position of the machine ends above where the tool stands, along it.
    pub(super) fn check_way_up_along_head(
        &mut self,
        cl_line: u32,
        count: usize,
        raised: &Position,
    ) {
        let stands = self.settings.forward.restated(&self.at, &Position::default());
        let slack = self.slack_raised(&stands, raised);
        let is_above = |at: &Position| {
            let at = self.settings.forward.restated(at, &Position::default());
            (0..3).all(|n| (at.linear[n] - raised.linear[n]).abs() <= slack)
        };
        let goes_up = self.nc.from(self.next).take(count).any(|event| match event {
            Event::Move(part) => is_above(&part.to) && part.known[..3] == [true; 3],
            _ => false,
        });
        if !goes_up {
            let line = self.nc.get(self.next).map(|event| event.line());
            let message = "the tool is tilted, and does not retract along its axis".to_string();
            self.find(FindingKind::Order, Some(cl_line), line, message);
        }
    }

    /// How many rapids reach a position of the linear axes; none where the axes stand there.
    fn parts_to_machine(&self, to: [Option<f64>; 3]) -> Option<usize> {
        let stands = self.settings.forward.restated(&self.at, &Position::default());
        let raised = self.raised(&stands, to[2]);
        let leans = raised != stands;
        // Positions of the axes are on the tape; those of a tip are not.
        let of_tip = self.at.names_tip().then(|| self.slack_raised(&stands, &raised));
        let reached = |found: &Position, known: &[bool; 5]| {
            let at = self.settings.forward.restated(found, &Position::default());
            let near = |a: f64, b: f64, n: usize| (a - b).abs() <= self.slack.linear[n];
            let arrives = |n: usize| match to[n] {
                // In polar interpolation it is the way of C.
                None if n == 1 && self.expected.mills_without_y(self.settings) => true,
                Some(value) => known[n] && near(at.linear[n], value, n),
                None if leans => {
                    let slack = of_tip.unwrap_or(self.slack.linear[n]);
                    !known[n] || (at.linear[n] - raised.linear[n]).abs() <= slack
                }
                None => !(known[n] && self.known[n]) || near(at.linear[n], stands.linear[n], n),
            };
            let turns = at.rotary != stands.rotary && !self.settings.is_mill_turn();
            (0..3).all(arrives) && !turns
        };
        if reached(&self.at, &self.known) {
            return Some(0);
        }
        let mut rapids = self.nc.from(self.next).take(RAPID_PARTS).map_while(|event| match event {
            Event::Move(part) if part.course == Course::Rapid && !part.in_cycle => Some(part),
            _ => None,
        });
        rapids.position(|part| reached(&part.to, &part.known)).map(|at| at + 1)
    }

    /// RETRCT: up to the level of the settings, never down.
    pub(super) fn retract(&mut self, cl_line: u32) {
        if let Some(made) = self.is_retracted(cl_line) {
            self.report.compared += 1;
            self.report.matched += u64::from(made);
        }
    }

    /// The same where the settings ask for it; says whether the program makes it, `None` where the
    /// tool is as high already.
    fn is_retracted(&mut self, cl_line: u32) -> Option<bool> {
        let level = self.settings.retract_level(self.limits.metric)?;
        let stands = self.settings.forward.restated(&self.at, &Position::default()).linear[2];
        let is_above = self.known[2] && stands >= level;
        let is_asked = !is_above || self.settings.names_machine_positions();
        let made = is_asked.then(|| self.is_at_machine(cl_line, [None, None, Some(level)]));
        self.facts.add_if(Fact::Away, is_above);
        made
    }

    /// The way up before another work offset, of a tool that has come to the part.
    pub(super) fn go_up_for_offset(&mut self, cl_line: u32) {
        let is_in_part = !self.facts.has(Fact::FreshTool) && !self.facts.has(Fact::Away);
        if self.settings.goes_up_for_offsets() && is_in_part {
            self.is_retracted(cl_line);
        }
    }

    /// The way up before a rapid to a pose that turns the machine, of a tool that has come to the part.
    /// Under tool-tip control that stays on none comes.
    pub(super) fn go_up_for_turns(&mut self, cl_line: u32, pose: &Pose) {
        if !self.settings.turns_at_top() {
            return;
        }
        // A text may have turned the machine to that pose, or brought the tool away.
        self.pass_own();
        let is_in_part = !self.facts.has(Fact::FreshTool) && !self.facts.has(Fact::Away);
        if !is_in_part {
            return;
        }
        if self.at.names_tip() && self.next_move().is_none_or(|next| next.to.names_tip()) {
            return;
        }
        let here = self.settings.forward.pose(&self.at);
        if (here.axis - pose.axis).norm() > SAME_AXIS {
            self.is_retracted(cl_line);
        }
    }

    /// The rotary axes turn home before the program ends.
    pub(super) fn turn_home(&mut self, cl_line: u32) {
        let mut open = self.settings.forward.rotaries().each_ref().map(Option::is_some);
        while let Some(found) = self.next_move().filter(|_| open.contains(&true)) {
            let stays = (0..3).all(|n| !found.known[n] || found.to.linear[n] == self.at.linear[n]);
            if found.course != Course::Rapid || !stays {
                break;
            }
            for (n, open) in open.iter_mut().enumerate() {
                *open &= self.off_home(n, found.to.rotary[n]) > self.slack.rotary[n];
            }
            self.take_without_length(cl_line, &found);
            self.next += 1;
        }
        let is_home = |n: &usize| self.known[n + 3] && self.off_home(*n, self.at.rotary[*n]) == 0.0;
        if (0..2).filter(|n| open[*n]).any(|n| !is_home(&n)) {
            let message = "the rotary axes do not turn to 0".to_string();
            self.find(FindingKind::Missing, Some(cl_line), None, message);
        }
    }

    /// How far a rotary axis stands from 0, degrees; one that counts within a turn is home after
    /// each turn.
    fn off_home(&self, index: usize, angle: f64) -> f64 {
        let turns = match self.settings.dialect.axes[index + 3].way_round {
            Some(_) => (angle / 360.0).round(),
            None => 0.0,
        };
        (angle - 360.0 * turns).abs()
    }

    /// A rotary axis turns by itself to a position, at rapid.
    pub(super) fn turn(&mut self, cl_line: u32, index: usize, angle: f64, way: TableWay) {
        self.report.compared += 1;
        self.memory.initial = None;
        // A turn to where the axis stands is no motion that is passed over.
        self.pass_own();
        let slack = self.slack.rotary[index];
        let within_a_turn =
            self.settings.dialect.axes[index + 3].way_round.is_some() || way != TableWay::Number;
        // The control counts within one turn, and the way to a position may lead past 0.
        let near = |at: &Position| match within_a_turn {
            true => angle + 360.0 * ((at.rotary[index] - angle) / 360.0).round(),
            false => angle,
        };
        let there = |at: &Position| (at.rotary[index] - near(at)).abs() <= slack;
        if self.known[index + 3] && there(&self.at) {
            self.report.matched += 1;
            return;
        }
        let other = 1 - index;
        let found = self.next_move().filter(|found| {
            let stays = (0..3).all(|n| !found.known[n] || found.to.linear[n] == self.at.linear[n]);
            let alone = found.to.rotary[other] == self.at.rotary[other];
            found.course == Course::Rapid && there(&found.to) && stays && alone
        });
        let Some(found) = found else {
            let message = format!("no rapid turn to {} degrees", short(angle));
            return self.find(FindingKind::Missing, Some(cl_line), None, message);
        };
        self.check_turn_is_away(cl_line, &found);
        if self.known[index + 3] {
            let by = found.to.rotary[index] - self.at.rotary[index];
            self.check_way_of_table(cl_line, found.line, by, way, slack);
        }
        self.take(cl_line, &found);
        self.next += 1;
        self.exact[index] = near(&found.to);
        self.report.matched += 1;
        self.watch.stand(None);
    }

    /// A table turns by so many degrees in the direction that is asked for.
    fn check_way_of_table(&mut self, cl_line: u32, line: u32, by: f64, way: TableWay, slack: f64) {
        let slack = 2.0 * slack;
        let asked = match way {
            TableWay::Number => return,
            TableWay::Direction(way) => {
                let turn = by * way;
                if (-slack..360.0 - slack).contains(&turn) {
                    return;
                }
                by + way * 360.0 * if turn < 0.0 { 1.0 } else { -1.0 }
            }
            TableWay::By(asked) if (by - asked).abs() <= slack => return,
            TableWay::By(asked) => asked,
        };
        let message =
            format!("the table turns by {} degrees, it should be by {}", short(by), short(asked));
        self.find(FindingKind::Position, Some(cl_line), Some(line), message);
    }

    /// The machine turns right after a tool change or a position of the machine, where the tool is away from the part,
    /// for a frame or tool-tip control that the next motion is in.
    pub(super) fn turns_away(&self, found: &Move) -> bool {
        let stays = |n: usize| found.to.linear[n] == self.at.linear[n] || !found.known[n];
        let turns = found.to.rotary != self.at.rotary || self.known[3..] != found.known[3..];
        let goes_over = self.settings.turns_at_top() && stays(2) && !(stays(0) && stays(1));
        let is_still = stays(2) && (turns && stays(0) && stays(1) || goes_over && !turns);
        if found.course != Course::Rapid || found.to.names_tip() || !is_still {
            return false;
        }
        let is_over = |next: &Move| {
            let is_down = next.known[2] && next.to.linear[2] != found.to.linear[2];
            next.course == Course::Rapid && !is_down && next.to.rotary == found.to.rotary
        };
        let behind = self.nc.from(self.next + 1).find_map(|event| match event {
            Event::Move(next) if next.to.names_tip() => Some(true),
            Event::Move(next) if self.settings.turns_at_top() && is_over(&next) => None,
            Event::Move(_) => Some(false),
            _ => None,
        });
        (self.facts.has(Fact::Away) || found.modes.tool != self.moved.modes.tool)
            && behind == Some(true)
    }

    /// Takes a turn of the machine, in which nothing moves that the length of the tool acts on.
    pub(super) fn take_turn_away(&mut self, cl_line: u32, found: &Move) {
        self.take_without_length(cl_line, found);
        self.next += 1;
    }

    /// Takes a motion on which the length of the tool does not act: tool-tip control has ended,
    /// and the length comes back where it begins again.
    fn take_without_length(&mut self, cl_line: u32, found: &Move) {
        let mut seen = *found;
        if found.modes.length.offset.is_none() {
            seen.modes.length.offset = self.expected.length.now().flatten();
        }
        self.take(cl_line, &seen);
    }

    /// An arc as the settings of the machine correct it; `None` where they leave it.
    pub(super) fn corrected(&mut self, step: &Step) -> Option<Step> {
        let before = self.memory.corrected_end.take();
        let ExpectedStep::Arc(arc, rate) = &step.what else { return None };
        let mut corrected = arc.from(before.filter(|[end, _]| *end == arc.start).map(|[_, at]| at));
        corrected.end.tip = self.settings.arc_end(&corrected, self.limits.metric);
        self.memory.corrected_end = Some([arc.end.tip, corrected.end.tip]);
        (corrected != **arc)
            .then(|| Step { what: ExpectedStep::Arc(corrected.into(), *rate), ..step.clone() })
    }
}
