//! How far one block may go.

use super::ahead::Steps;
use super::report::FindingKind;
use super::say::short;
use super::verifier::{Fact, Verifier};
use crate::motion::Move;

/// What a last digit may add to a move, mm.
const DIGITS: f64 = 0.01;

impl<C: Steps> Verifier<'_, C> {
    /// A block whose start and end are known goes no farther than the machine says.
    pub(super) fn check_departure(&mut self, cl_line: u32, found: &Move) {
        let Some(most) = self.settings.most_departure(self.limits.metric) else { return };
        // Where the axes stand behind a tool change is the machine's.
        if self.facts.has(Fact::FreshTool) {
            return;
        }
        let in_machine_frame = found.to_machine.iter().any(|is| *is);
        if in_machine_frame || found.in_cycle || self.at.names_tip() != found.to.names_tip() {
            return;
        }
        let moved = |n: usize| match self.known[n] && found.known[n] {
            true => found.to.linear[n] - self.at.linear[n],
            false => 0.0,
        };
        let straight = (0..3).map(|n| moved(n) * moved(n)).sum::<f64>().sqrt();
        let way = match &found.arc {
            Some(arc) => arc.length(self.at.linear, found.to.linear),
            None => straight,
        };
        if way > most + DIGITS {
            let message = format!("a block goes {} mm, and it may go {most} mm", short(way));
            self.find(FindingKind::Limit, Some(cl_line), Some(found.line), message);
        }
    }
}
