//! Rotary axes that are clamped in tilted frames: none turns while it is held, and nothing
//! is cut in a frame while they are free.

use super::report::{Finding, FindingKind, Report};
use super::settings::Settings;
use super::walk::STILL;
use crate::motion::{Course, Event, Move};

/// What the codes of a program have said.
#[derive(Debug)]
pub(super) struct Clamps {
    clamp: u32,
    release: u32,
    held: Option<bool>,
    /// Where the rotary axes stand, degrees.
    stands: Option<[f64; 2]>,
    /// What was found wrong.
    pub(super) findings: Report,
}

impl Clamps {
    /// `None` for a machine that does not clamp them.
    pub(super) fn new(settings: &Settings<'_>) -> Option<Self> {
        let [clamp, release] = settings.frame_clamps()?;
        Some(Clamps { clamp, release, held: None, stands: None, findings: Report::default() })
    }

    /// Takes up an event; true for a code of the clamps.
    pub(super) fn takes(&mut self, event: &Event) -> bool {
        match event {
            Event::Auxiliary { code, .. } if [self.clamp, self.release].contains(code) => {
                self.held = Some(*code == self.clamp);
                true
            }
            Event::Move(found) => {
                self.look(found);
                false
            }
            _ => false,
        }
    }

    fn look(&mut self, found: &Move) {
        let to = found.to.rotary;
        // In a frame nothing turns: its angles are those that the rounded ones stand for.
        let framed = found.to.tilt.is_some() && self.stands.is_some();
        let differs = |at: [f64; 2]| (0..2).any(|n| (at[n] - to[n]).abs() > STILL);
        let turns = !framed && self.stands.is_none_or(differs);
        let cuts = matches!(found.course, Course::Feed | Course::Thread);
        let message = match self.held {
            Some(false) if cuts && found.to.tilt.is_some() => {
                Some(format!("cuts in a tilted frame before M{}", self.clamp))
            }
            Some(false) => None,
            _ if turns => Some(format!("a rotary axis turns without M{}", self.release)),
            _ => None,
        };
        if found.known[3..] == [true; 2] {
            self.stands = Some(to);
        }
        if let Some(message) = message {
            let (kind, nc_line) = (FindingKind::Auxiliary, Some(found.line));
            self.findings.find(Finding { kind, cl_line: None, nc_line, message });
        }
    }
}
