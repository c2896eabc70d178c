//! Findings in words.

use super::ahead::Steps;
use super::expected_step::{ExpectedStep, Step};
use super::gap::Gap;
use super::report::FindingKind;
use super::verifier::Verifier;
use crate::decimals;
use crate::forward::Pose;
use crate::motion::{Arc, Course, Move, Rate};

/// The planes by the index of their normal.
pub(super) const PLANES: [&str; 3] = ["YZ", "ZX", "XY"];

/// What a gap is off by, in millionths, so that two can be compared.
pub(super) type Shape = ([f64; 3], Option<f64>);

impl<C: Steps> Verifier<'_, C> {
    /// Says that a motion is of another kind than the step.
    pub(super) fn say_way(&mut self, step: &Step, found: &Move) {
        let way = (found.course, found.arc.is_some());
        let what = self.spell_move(found);
        let (kind, should) = match (&step.what, way) {
            (ExpectedStep::Rapid(_), (Course::Rapid, _)) => return,
            (ExpectedStep::Rapid(_), (Course::Feed, _)) => (FindingKind::FeedForRapid, "a rapid"),
            (ExpectedStep::Feed(..), (Course::Feed, false)) => return,
            (ExpectedStep::Feed(..), (Course::Rapid, _)) => {
                (FindingKind::RapidForFeed, "a line at feed")
            }
            (ExpectedStep::Feed(..), (Course::Feed, true)) => (FindingKind::Arc, "a straight line"),
            (ExpectedStep::Thread(..), (Course::Thread, _)) => return,
            (ExpectedStep::Thread(..), (Course::Rapid, _)) => {
                (FindingKind::RapidForFeed, "a thread pass")
            }
            (ExpectedStep::Thread(..), _) => (FindingKind::Thread, "a thread pass"),
            (ExpectedStep::Arc(..), (Course::Rapid, _)) => {
                (FindingKind::RapidForFeed, "an arc at feed")
            }
            (ExpectedStep::Arc(..), (_, false)) => (FindingKind::Arc, "an arc"),
            (ExpectedStep::Arc(..), _) => return self.say_arc(step, found),
            (_, (Course::Thread, _)) => (FindingKind::Thread, "a motion without lead"),
            _ => return,
        };
        let message = format!("{what}, it should be {should}");
        self.find(kind, Some(step.line), Some(found.line), message);
    }

    /// Says where a motion ends, when that is not where it should, and has not
    /// been said of the motion before.
    pub(super) fn say_gap(&mut self, cl_line: u32, found: &Move, pose: &Pose) {
        let gap = self.gap(&found.to, pose);
        if gap.closed() && self.is_known(&found.known) {
            return;
        }
        let shape = shape(&gap);
        if self.said == Some(shape) {
            return;
        }
        self.said = Some(shape);
        let unknown = !self.is_known(&found.known);
        if let Some(angle) = gap.turned {
            let message = format!("the tool is tilted {} degrees away from its axis", short(angle));
            return self.find(FindingKind::Axis, Some(cl_line), Some(found.line), message);
        }
        let parts: Vec<String> = (0..3)
            .filter(|n| gap.excess[*n])
            .map(|n| spell_gap(n, found.to.linear[n], gap.linear[n]))
            .collect();
        let message = match (parts.is_empty(), unknown) {
            (true, _) => "moves before all axes have been given a position".to_string(),
            (false, _) => parts.join(", "),
        };
        self.find(FindingKind::Position, Some(cl_line), Some(found.line), message);
    }

    pub(super) fn spell_step(&self, wanted: &ExpectedStep) -> String {
        let Some(pose) = wanted.end() else { return String::new() };
        let point = self.settings.forward.frame_of(&self.at).linear(pose.tip);
        let [x, y, z] = point.map(short);
        match wanted {
            ExpectedStep::Rapid(_) => format!("rapid to X{x} Y{y} Z{z}"),
            ExpectedStep::Arc(..) => format!("arc to X{x} Y{y} Z{z}"),
            ExpectedStep::Hole(_) => format!("hole at X{x} Y{y}"),
            ExpectedStep::Thread(..) => format!("thread pass to X{x} Y{y} Z{z}"),
            _ => format!("line at feed to X{x} Y{y} Z{z}"),
        }
    }

    pub(super) fn spell_move(&self, found: &Move) -> String {
        let [x, y, z] = found.to.linear.map(short);
        format!("{} to X{x} Y{y} Z{z}", way(found))
    }
}

pub(super) fn shape(gap: &Gap) -> Shape {
    let millionths = |value: f64| (value * 1e6).round();
    let linear =
        std::array::from_fn(|n| if gap.excess[n] { millionths(gap.linear[n]) } else { 0.0 });
    (linear, gap.turned.map(millionths))
}

/// `Z deeper by 0.3`, `X 0.1 too far in plus`.
pub(super) fn spell_gap(axis: usize, stands: f64, gap: f64) -> String {
    let by = short(gap.abs());
    let wanted = short(stands - gap);
    match (axis, gap < 0.0) {
        (2, true) => format!("Z deeper by {by} (Z{} in place of Z{wanted})", short(stands)),
        (2, false) => format!("Z higher by {by} (Z{} in place of Z{wanted})", short(stands)),
        _ => {
            let name = ["X", "Y", "Z"][axis];
            format!("{name} off by {by} ({name}{} in place of {name}{wanted})", short(stands))
        }
    }
}

pub(super) fn spell_rate(rate: Rate) -> String {
    match rate {
        Rate::PerMinute(rate) => format!("{} mm/min", short(rate)),
        Rate::PerTurn(rate) => format!("{} mm/rev", short(rate)),
        Rate::Varying(rate, change) => {
            format!("{} mm/rev, increasing by {} each revolution", short(rate), short(change))
        }
        Rate::Inverse(rate) => format!("{} blocks per minute", short(rate)),
    }
}

/// What kind of motion a program makes.
pub(super) fn way(found: &Move) -> &'static str {
    match (found.course, &found.arc) {
        (Course::Rapid, _) => "rapid",
        (Course::Machine, _) => "motion to a point of the machine",
        (Course::Thread, _) => "thread pass",
        (Course::Feed, None) => "line at feed",
        (Course::Feed, Some(arc)) => sense(arc),
    }
}

/// Which way an arc goes.
pub(super) fn sense(arc: &Arc) -> &'static str {
    if arc.ccw { "arc counterclockwise (G3)" } else { "arc clockwise (G2)" }
}

/// At most four decimals, no zeros at the end.
pub(super) fn short(value: f64) -> String {
    decimals::short(value, 4)
}
