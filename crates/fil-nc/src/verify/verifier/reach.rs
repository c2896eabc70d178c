//! Whether the tool stands where the CL file asks it to be, and how far off it is.

use super::super::ahead::Steps;
use super::super::gap::Gap;
use super::super::settings::Tolerances;
use super::Verifier;
use crate::forward::Pose;
use crate::motion::{Move, Position};

impl<C: Steps> Verifier<'_, C> {
    /// Where the axes stand, X, Y, Z as a motion means them; those it leaves unknown keep
    /// their last value.
    pub(in super::super) fn at_as(&self, found: &Move) -> Position {
        let mut at = self.settings.forward.restated(&self.at, &found.to);
        if self.at.tilt != found.to.tilt {
            return at;
        }
        for n in (0..3).filter(|n| !found.known[*n]) {
            at.linear[n] = self.at.linear[n];
        }
        at
    }

    /// True when the tool already is where a pose asks it to be.
    pub(in super::super) fn stands_at(&mut self, pose: &Pose) -> bool {
        if self.awaits_offset() {
            return false;
        }
        let gap = self.gap(&self.at, pose);
        let stands = self.is_known(&self.known) && gap.closed();
        if stands {
            self.exact = gap.rotary;
        }
        stands
    }

    pub(in super::super) fn reaches(&self, found: &Move, pose: &Pose) -> bool {
        self.gap_reached(found, pose).is_some()
    }

    /// The gap at the end of a motion that reaches a pose.
    pub(in super::super) fn gap_reached(&self, found: &Move, pose: &Pose) -> Option<Gap> {
        let known = self.is_known(&found.known);
        known.then(|| self.gap(&found.to, pose)).filter(Gap::closed)
    }

    /// The gap between where the axes stand and a pose.
    pub(in super::super) fn gap(&self, at: &Position, pose: &Pose) -> Gap {
        if self.slack.kept > 0.0 {
            let slack = self.slack_of_moved(&self.at, at);
            return Gap::of(self.settings, &slack, at, pose, self.exact);
        }
        Gap::of(self.settings, &self.slack, at, pose, self.exact)
    }

    /// The slack of a position that the axes come to: those that move are written.
    #[cold]
    pub(in super::super) fn slack_of_moved(&self, from: &Position, to: &Position) -> Tolerances {
        let mut slack = self.slack;
        for n in (0..3).filter(|n| to.linear[*n] != from.linear[*n]) {
            slack.linear[n] -= slack.kept;
        }
        slack
    }

    /// All axes that the program writes are known.
    pub(in super::super) fn is_known(&self, known: &[bool; 5]) -> bool {
        let linear = (0..3).all(|n| known[n] || !self.limits.written[n]);
        let rotary = |n: usize| known[n + 3] || self.settings.forward.rotaries()[n].is_none();
        linear && rotary(0) && rotary(1)
    }

    /// Adds a motion to the deviations.
    pub(in super::super) fn measure(&mut self, found: &Move, pose: &Pose) {
        let gap = self.gap(&found.to, pose);
        self.measure_gap(found, &gap);
    }

    /// The same for a gap that is known.
    pub(in super::super) fn measure_gap(&mut self, found: &Move, gap: &Gap) {
        self.report.position.add(gap.tip, found.line);
        self.report.axis.add(gap.axis, found.line);
        if gap.closed() {
            self.said = None;
        }
        self.exact = gap.rotary;
    }
}
