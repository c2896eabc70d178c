//! What moves the zero of the program, changes how its path is followed or turns its plane, and
//! what no record asks for.

use super::ahead::Steps;
use super::report::FindingKind;
use super::verifier::Verifier;
use crate::motion::{Compensation, Modes, Move};

impl<C: Steps> Verifier<'_, C> {
    /// A statement that moves the zero stands in the settings or in INSERT, one that changes how
    /// the path is followed there or among words of the user's own; else nobody has asked for
    /// it, and a part that is made so is made wrong.
    pub(super) fn check_unasked(&mut self, cl_line: u32, nc_line: u32, modes: &Modes) {
        let found = [modes.frame.moved_zero, modes.path_control];
        if found != self.user.unasked {
            self.find_unasked(cl_line, nc_line, found);
        }
    }

    #[cold]
    fn find_unasked(&mut self, cl_line: u32, nc_line: u32, found: [Option<u32>; 2]) {
        let before = std::mem::replace(&mut self.user.unasked, found);
        let kinds = [FindingKind::Fixture, FindingKind::Extra];
        for (n, kind) in kinds.into_iter().enumerate() {
            let is_asked = |line: u32| {
                let [first, last] = self.user.lines;
                let by_words = kind != FindingKind::Fixture && (first..=last).contains(&line);
                by_words || self.own.has(line)
            };
            let news = found[n].filter(|line| before[n] != Some(*line) && !is_asked(*line));
            let Some(line) = news else { continue };
            let message = match kind {
                FindingKind::Fixture => format!(
                    "line {line} has moved the zero of the program, which no record asks for"
                ),
                _ => format!(
                    "line {line} changes how the path is followed, which no record asks for"
                ),
            };
            self.find(kind, Some(cl_line), Some(nc_line), message);
        }
    }

    /// The length of a tool acts across the plane in force: only an arc, a cycle, compensation
    /// that names its plane, or words of the user's own ask for another than that of the drill.
    pub(super) fn check_plane(&mut self, cl_line: u32, found: &Move) {
        let Some((plane, line)) = found.modes.planes.unusual else {
            self.moved.plane = None;
            return;
        };
        let begins = found.modes.compensation.side != Compensation::Off
            && self.moved.modes.compensation.side == Compensation::Off;
        if begins
            && found.arc.is_none()
            && self.expected.plane.named != plane
            && !self.own.has(line)
        {
            return self.find_other_plane(cl_line, found, (plane, line));
        }
        if Some(plane) == self.moved.plane {
            return;
        }
        if found.arc.is_some() || found.in_cycle {
            self.moved.plane = Some(plane);
            return;
        }
        self.check_other_plane(cl_line, found, (plane, line));
    }

    #[cold]
    fn check_other_plane(&mut self, cl_line: u32, found: &Move, (plane, line): (usize, u32)) {
        self.moved.plane = Some(plane);
        let asked = self.expected.plane.named == plane;
        if asked || self.own.has(line) {
            return;
        }
        self.find_other_plane(cl_line, found, (plane, line));
    }

    #[cold]
    fn find_other_plane(&mut self, cl_line: u32, found: &Move, (plane, line): (usize, u32)) {
        let [name, along] = [["G19", "G18", "G17"], ["X", "Y", "Z"]].map(|of| of[plane]);
        let message = format!(
            "{name} of line {line} is active without a record for it: the tool length offset acts along {along}"
        );
        self.find(FindingKind::Tool, Some(cl_line), Some(found.line), message);
    }
}
