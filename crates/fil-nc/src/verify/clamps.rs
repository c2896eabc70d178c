//! Clamps of the rotary axes: no axis turns while it is clamped, by any code. Where the post clamps
//! them, it releases them before each turn, and cuts in a tilted work plane only while they are clamped.

use super::report::{Finding, FindingKind, Report};
use super::settings::Settings;
use super::verifier::STILL;
use crate::motion::{Course, Event, Move};

/// What the codes of a program have said.
#[derive(Debug)]
pub(super) struct Clamps {
    clamp: u32,
    release: u32,
    /// The post clamps the axes itself, in tilted work planes or after rapid turns.
    of_post: bool,
    /// Y is no axis: it stands for the second one of a plane for which the control turns C.
    y_turns: bool,
    held: Option<bool>,
    /// Where the last motion has them.
    stands: Option<[f64; 4]>,
    /// What was found wrong.
    pub(super) findings: Report,
}

impl Clamps {
    /// `None` for a machine that has no such codes.
    pub(super) fn new(settings: &Settings<'_>) -> Option<Self> {
        let [clamp, release] = [settings.clamp_code(true)?, settings.clamp_code(false)?];
        Some(Clamps {
            clamp,
            release,
            of_post: settings.clamps_of_post().is_some(),
            y_turns: settings.is_mill_turn() && !settings.written()[1],
            held: None,
            stands: None,
            findings: Report::default(),
        })
    }

    /// Takes up an event; true for a code of the clamps that no record asks for.
    pub(super) fn takes(&mut self, event: &Event) -> bool {
        match event {
            Event::Auxiliary { code, .. } if [self.clamp, self.release].contains(code) => {
                self.held = Some(*code == self.clamp);
                self.of_post
            }
            Event::Move(found) => {
                self.look(found);
                false
            }
            _ => false,
        }
    }

    fn look(&mut self, found: &Move) {
        let turns = self.turns(found);
        let cuts = matches!(found.course, Course::Feed | Course::Thread);
        let message = match self.held {
            Some(false) if cuts && self.of_post && found.to.tilt.is_some() => {
                Some(format!("cuts in a tilted work plane before M{}", self.clamp))
            }
            Some(false) => None,
            None if !self.of_post => None,
            _ if turns => Some(format!("a rotary axis turns without M{}", self.release)),
            _ => None,
        };
        if let Some(message) = message {
            let (kind, nc_line) = (FindingKind::Auxiliary, Some(found.line));
            self.findings.find(Finding { kind, cl_line: None, nc_line, message });
        }
    }

    /// Whether a motion turns a rotary axis, or may; takes up where it ends.
    fn turns(&mut self, found: &Move) -> bool {
        let to = self.place(found);
        let is_known = found.known[3..] == [true; 2];
        let is_to_machine = found.to_machine[3..].contains(&true);
        // In a frame nothing turns: its angles are those that the rounded ones stand for.
        let framed = found.to.tilt.is_some() && self.stands.is_some();
        let turns = match self.stands {
            Some(at) => (is_known || self.of_post) && Self::differs(at, to),
            // A program of such a post may begin by going up, which turns nothing.
            None if self.of_post => Self::differs([0.0; 4], to),
            None => is_known,
        };
        match () {
            () if is_known => self.stands = Some(to),
            () if is_to_machine => self.stands = None,
            () => {}
        }
        !framed && (turns || is_to_machine)
    }

    /// Where a motion has the rotary axes, degrees, and X and Y of a plane for which C turns, mm.
    fn place(&self, found: &Move) -> [f64; 4] {
        let [primary, secondary] = found.to.rotary;
        let [x, y, _] = found.to.linear.map(|value| if self.y_turns { value } else { 0.0 });
        [primary, secondary, x, y]
    }

    /// X alone turns C where it goes beside the axis of the spindle.
    fn differs(at: [f64; 4], to: [f64; 4]) -> bool {
        let moved = |n: usize| (at[n] - to[n]).abs() > STILL;
        moved(0) || moved(1) || moved(3) || moved(2) && to[3].abs() > STILL
    }
}
