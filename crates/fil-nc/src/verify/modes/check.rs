//! What is not as it must be: at a motion, at one of no length, and while the axes stand.

use super::super::delayed::Moved;
use super::super::report::FindingKind;
use super::super::settings::Tolerances;
use super::Expected;
use super::rules::{Doing, RULES, Rule, STANDING, Seen, said_of_offset};
use crate::motion::Modes;

impl Expected {
    /// What is not as it must be while the axes stand: before a tool is changed, or
    /// at the end.
    pub(in super::super) fn check_standing(
        &mut self,
        modes: &Modes,
        changes: bool,
        slack: &Tolerances,
    ) -> Vec<(FindingKind, String)> {
        self.flush();
        let mut wrong = self.wrong(modes, Doing::Standing, slack);
        // A change may bring its own offset along; one that waits needs a motion.
        wrong.retain(|(kind, _)| {
            *kind != FindingKind::Tool || !(changes || self.offset_waits() || self.tool.is_left_out)
        });
        if self.unfollowed {
            wrong.retain(|(kind, _)| matches!(kind, FindingKind::Tool | FindingKind::Compensation));
        }
        wrong.extend(self.broken(&STANDING, &Seen { modes, doing: Doing::Standing, slack }));
        self.news(wrong)
    }

    fn news(&mut self, wrong: Vec<(FindingKind, String)>) -> Vec<(FindingKind, String)> {
        let news = wrong.iter().filter(|one| !self.said.contains(one)).cloned().collect();
        self.said = wrong;
        news
    }

    pub(super) fn flush(&mut self) {
        self.compensation.flush();
        self.spindle.flush();
        self.coolant.flush();
    }

    /// What is not as it must be where a motion of no length is made: the spindle and the
    /// coolant may wait there for what comes next.
    pub(in super::super) fn check_resting(
        &mut self,
        modes: &Modes,
        slack: &Tolerances,
    ) -> Vec<(FindingKind, String)> {
        let of_motion = |kind: FindingKind| {
            matches!(kind, FindingKind::Spindle | FindingKind::Speed | FindingKind::Coolant)
        };
        self.length_on = modes.length.offset;
        let mut wrong = self.wrong(modes, Doing::Moving, slack);
        wrong.retain(|(kind, _)| !of_motion(*kind));
        wrong.extend(self.said.iter().filter(|(kind, _)| of_motion(*kind)).cloned());
        self.news(wrong)
    }

    /// What is not as it must be during a motion of these axes; each thing is said
    /// when it begins to be wrong.
    pub(in super::super) fn check(
        &mut self,
        modes: &Modes,
        moved: Moved,
        cuts: bool,
        slack: &Tolerances,
    ) -> Vec<(FindingKind, String)> {
        self.length.moved(moved);
        self.compensation.moved(moved);
        self.spindle.moved(moved);
        self.coolant.moved(moved);
        if cuts {
            self.resume();
            // What turns the spindle waits for no other axis.
            self.spindle.flush();
        }
        self.length_on = modes.length.offset;
        let doing = if cuts { Doing::Cutting } else { Doing::Moving };
        let wrong = self.wrong(modes, doing, slack);
        self.news(wrong)
    }

    /// A motion with a new tool is over: what is wrong when its length offset is
    /// not yet on.
    pub(in super::super) fn settle(&mut self) -> Option<(FindingKind, String)> {
        if !self.length.waits() {
            return None;
        }
        self.length.flush();
        let must = self.length.now().flatten();
        let one = (FindingKind::Tool, said_of_offset(self.length_on, must));
        (self.length_on != must && !self.said.contains(&one)).then(|| {
            self.said.push(one.clone());
            one
        })
    }

    fn wrong(&self, modes: &Modes, doing: Doing, slack: &Tolerances) -> Vec<(FindingKind, String)> {
        self.broken(&RULES, &Seen { modes, doing, slack })
    }

    fn broken(&self, rules: &[(FindingKind, Rule)], seen: &Seen<'_>) -> Vec<(FindingKind, String)> {
        // Each motion is looked at, and hardly one breaks a rule.
        let mut broken = Vec::new();
        for (kind, rule) in rules {
            if let Some(message) = rule(self, seen) {
                broken.push((*kind, message));
            }
        }
        broken
    }
}
