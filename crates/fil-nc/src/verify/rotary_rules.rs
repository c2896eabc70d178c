//! What no program with rotary axes may do, whatever it is compared with: turn the machine under
//! cutter compensation, turn at feed from a place that nobody knows, give a time for a way that
//! nobody knows.

use fil_machine::locations as loc;

use super::report::FindingKind;
use super::settings::Settings;
use crate::dialect::WayRound;
use crate::motion::{Compensation, Course, Event, Move, Position, Rate};

/// A turn of less, degrees, is the rounding of an angle, which leaves the side of the cutter.
const TURNED: f64 = 0.01;

/// Half a turn with the rounding of an angle, degrees.
const HALF_TURN: f64 = 180.0 + TURNED;

/// Follows where the axes stand, as far as it is known.
#[derive(Debug)]
pub(super) struct RotaryRules {
    at: Position,
    /// X, Y, Z and the rotary axes.
    known: [bool; 5],
    /// The work offset that they stand in.
    fixture: Option<u32>,
    /// A point of the machine that no word has named since: its angle in the program is not known.
    sent_away: [bool; 2],
    /// A tool was changed, and nothing has moved since.
    is_fresh: bool,
    /// The main spindle of a mill-turn machine is its axis, with rules of its own.
    turns_spindle: bool,
    /// The first rotary axis can't turn at feed.
    only_indexes: bool,
    /// Rotary axes that the control turns one way to a position within a turn.
    turns_one_way: [bool; 2],
    /// What was said of the last motion, so that it is said once.
    said: bool,
}

impl Settings<'_> {
    /// The rules of the rotary axes of this machine; the main spindle of a mill-turn machine is
    /// one, with rules of its own.
    pub(super) fn rotary_rules(&self) -> RotaryRules {
        let is_one_way = |n: usize| {
            let way = self.dialect.axes[n + 3].way_round;
            way.is_some_and(|way| way != WayRound::Shortest)
        };
        RotaryRules {
            only_indexes: self.commons.read(loc::ROTARY_INDEX_ONLY),
            turns_one_way: [0, 1].map(is_one_way),
            ..RotaryRules::new(self.is_mill_turn())
        }
    }
}

impl RotaryRules {
    fn new(turns_spindle: bool) -> Self {
        RotaryRules {
            at: Position::default(),
            known: [false; 5],
            fixture: None,
            sent_away: [false; 2],
            is_fresh: false,
            turns_spindle,
            only_indexes: false,
            turns_one_way: [false; 2],
            said: false,
        }
    }

    /// Takes in the next event; what is wrong with it.
    pub(super) fn look(&mut self, event: &Event) -> Vec<(FindingKind, String)> {
        match event {
            Event::Move(found) if !self.turns_spindle => {
                let wrong = self.wrong(found);
                self.go(found);
                wrong
            }
            Event::ToolChange { .. } => {
                self.is_fresh = true;
                Vec::new()
            }
            _ => Vec::new(),
        }
    }

    fn wrong(&mut self, found: &Move) -> Vec<(FindingKind, String)> {
        let mut wrong = Vec::new();
        let turned = self.turns_compensated(found);
        let turned_before = std::mem::replace(&mut self.said, turned);
        if turned && !turned_before {
            let said = "a rotary axis turns under cutter compensation, whose side is that of the \
                        face before";
            wrong.push((FindingKind::Compensation, said.to_string()));
        }
        if let Some(said) = self.turns_wrongly(found) {
            wrong.push((FindingKind::Axis, said.to_string()));
        }
        if found.course != Course::Feed {
            return wrong;
        }
        if (0..2).any(|n| self.sent_away[n] && found.known[n + 3]) {
            let said = "a rotary axis turns at feed from a point of the machine, whose angle in \
                        the program is not known";
            wrong.push((FindingKind::Axis, said.to_string()));
        }
        if matches!(found.rate, Some(Rate::Inverse(_))) && self.begins_anywhere(found) {
            let said = "inverse-time feed on a move from an unknown start point";
            wrong.push((FindingKind::Feed, said.to_string()));
        }
        wrong
    }

    /// What is wrong with how a motion at feed turns the axes: one that can only index, or nearly
    /// a full turn behind a tool change. Before its first word an axis stands at zero, as far as
    /// anybody knows.
    fn turns_wrongly(&self, found: &Move) -> Option<&'static str> {
        let cuts = matches!(found.course, Course::Feed | Course::Thread) && !found.in_cycle;
        let turn = |n: usize| match found.known[n + 3] {
            true => (found.to.rotary[n] - self.at.rotary[n]).abs(),
            false => 0.0,
        };
        match cuts {
            true if self.only_indexes && turn(0) > TURNED => {
                Some("a rotary axis that can only index turns at feed")
            }
            true if (0..2)
                .any(|n| self.is_fresh && self.turns_one_way[n] && turn(n) > HALF_TURN) =>
            {
                Some("a rotary axis turns the long way at feed after a tool change")
            }
            _ => None,
        }
    }

    /// Where a motion begins is not known in the frame that it ends in.
    fn begins_anywhere(&self, found: &Move) -> bool {
        let found_out = (0..5).any(|n| found.known[n] && !self.known[n]);
        let stands_at_zero = self.at.rotary == [0.0; 2];
        let other_frame = found.modes.frame.fixture != self.fixture
            || found.to.tilt != self.at.tilt
            || found.to.tip_control != self.at.tip_control && !stands_at_zero;
        self.is_fresh || found_out || other_frame
    }

    /// A rotary axis turns under compensation that no frame turns with it.
    fn turns_compensated(&self, found: &Move) -> bool {
        // In a tilted frame nothing turns; its angles are told exactly.
        let follows = found.to.tip_control || found.to.tilt.is_some();
        let turns = |n: usize| {
            let differs = (found.to.rotary[n] - self.at.rotary[n]).abs() > TURNED;
            differs || self.sent_away[n] && found.known[n + 3] || found.to_machine[n + 3]
        };
        found.modes.compensation.side != Compensation::Off && !follows && (0..2).any(turns)
    }

    fn go(&mut self, found: &Move) {
        for n in 0..2 {
            self.sent_away[n] =
                (self.sent_away[n] || found.to_machine[n + 3]) && !found.known[n + 3];
        }
        self.at = found.to;
        self.known = found.known;
        self.fixture = found.modes.frame.fixture;
        self.is_fresh = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Modes, Position};

    fn at_feed(rotary: f64) -> Move {
        Move {
            line: 1,
            course: Course::Feed,
            to: Position { rotary: [rotary, 0.0], ..Position::default() },
            arc: None,
            rate: Some(Rate::Inverse(1.0)),
            in_cycle: false,
            known: [true; 5],
            to_machine: [false; 5],
            modes: Modes::default(),
        }
    }

    fn kinds(moves: &[Move]) -> Vec<FindingKind> {
        let mut rules = RotaryRules::new(false);
        rules.known = [true; 5];
        let found = moves.iter().flat_map(|found| rules.look(&Event::Move(*found)));
        found.map(|(kind, _)| kind).collect()
    }

    #[test]
    fn a_turn_under_compensation_is_said_once_and_none_in_a_frame_or_under_tip_control() {
        let mut turned = at_feed(10.0);
        turned.modes.compensation.side = Compensation::Left;
        let further = Move { to: at_feed(20.0).to, ..turned };
        assert_eq!(kinds(&[at_feed(0.0), turned, further]), [FindingKind::Compensation]);
        assert_eq!(kinds(&[at_feed(10.0), turned]), []);
        turned.to.tip_control = true;
        assert_eq!(kinds(&[turned]), []);
    }

    #[test]
    fn a_turn_at_feed_from_a_point_of_the_machine_is_found() {
        let known = [true, true, true, false, true];
        let to_machine = [false, false, false, true, false];
        let away = Move { course: Course::Machine, known, to_machine, rate: None, ..at_feed(0.0) };
        assert_eq!(kinds(&[away, at_feed(0.0)]), [FindingKind::Axis, FindingKind::Feed]);
        let found_out = Move { course: Course::Rapid, ..at_feed(5.0) };
        assert_eq!(kinds(&[away, found_out, at_feed(0.0)]), []);
        // X, Y and Z may move at feed while it stands there.
        let beside = Move { known, ..at_feed(0.0) };
        assert_eq!(kinds(&[away, beside, at_feed(0.0)]), [FindingKind::Axis, FindingKind::Feed]);
    }

    #[test]
    fn a_time_behind_a_tool_change_or_another_zero_is_of_no_known_way() {
        let mut rules = RotaryRules::new(false);
        rules.known = [true; 5];
        let change = Event::ToolChange { line: 1, tool: 2, modes: Modes::default() };
        assert!(rules.look(&change).is_empty());
        let said = rules.look(&Event::Move(at_feed(0.0)));
        assert_eq!(said.len(), 1);
        assert!(rules.look(&Event::Move(at_feed(1.0))).is_empty());
        let mut offset = at_feed(2.0);
        offset.modes.frame.fixture = Some(55);
        assert_eq!(rules.look(&Event::Move(offset)).len(), 1);
        assert!(rules.look(&Event::Move(offset)).is_empty());
    }
}
