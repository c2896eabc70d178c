//! What moves the zero of the program or changes how its motions are driven, and what no record
//! asks for.

use super::ahead::Steps;
use super::report::FindingKind;
use super::walk::Walk;
use crate::motion::Modes;

impl<C: Steps> Walk<'_, C> {
    /// A statement that moves the zero, or a cycle of tolerances, stands in the settings or in
    /// INSERT; else nobody has asked for it, and a part that is made there is made wrong.
    pub(super) fn check_unasked(&mut self, cl_line: u32, nc_line: u32, modes: &Modes) {
        let found = [modes.moved_zero, modes.path_cycle];
        if found != self.unasked {
            self.find_unasked(cl_line, nc_line, found);
        }
    }

    #[cold]
    fn find_unasked(&mut self, cl_line: u32, nc_line: u32, found: [Option<u32>; 2]) {
        let before = std::mem::replace(&mut self.unasked, found);
        if self.modes.may_have_any_words() {
            return;
        }
        let kinds = [FindingKind::Fixture, FindingKind::Extra];
        for (n, kind) in kinds.into_iter().enumerate() {
            let news = found[n].filter(|line| before[n] != Some(*line) && !self.own.has(*line));
            let Some(line) = news else { continue };
            let message = match kind {
                FindingKind::Fixture => format!(
                    "line {line} has moved the zero of the program, which no record asks for"
                ),
                _ => format!("the cycle of line {line} is one that no record asks for"),
            };
            self.find(kind, Some(cl_line), Some(nc_line), message);
        }
    }
}
