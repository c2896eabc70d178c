//! What is not as it must be: at a motion, at one of no length, and while the axes stand.

use super::super::lag::Moved;
use super::super::modes_said::{
    name_of_fixture, said_of_compensation, said_of_offset, said_of_speed, said_of_spindle,
};
use super::super::report::FindingKind;
use super::super::settings::{Quantity, Tolerances};
use super::Expected;
use crate::motion::{Modes, Speed, Spindle};

/// Allowed deviation of an oriented spindle, degrees.
const ANGLE: f64 = 6e-4;

/// What the machine does while its modes are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doing {
    Standing,
    Moving,
    Cutting,
}

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
            *kind != FindingKind::Tool || !(changes || self.offset_waits() || self.tool_is_left_out)
        });
        if self.unfollowed {
            wrong.retain(|(kind, _)| matches!(kind, FindingKind::Tool | FindingKind::Compensation));
        }
        if modes.frame.tip_control {
            let said = "tool-tip control is on, it should be off";
            wrong.push((FindingKind::Tool, said.to_string()));
        }
        if modes.frame.tilted {
            let said = "a tilted frame is in force, it should be ended";
            wrong.push((FindingKind::Tool, said.to_string()));
        }
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
        self.speed.flush();
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
        self.offset_on = modes.length.offset;
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
        self.offset.moved(moved);
        self.compensation.moved(moved);
        self.spindle.moved(moved);
        self.speed.moved(moved);
        self.coolant.moved(moved);
        if cuts {
            self.resume();
            // What turns the spindle waits for no other axis.
            self.spindle.flush();
            self.speed.flush();
        }
        self.offset_on = modes.length.offset;
        let doing = if cuts { Doing::Cutting } else { Doing::Moving };
        let wrong = self.wrong(modes, doing, slack);
        self.news(wrong)
    }

    /// A motion with a new tool is over: what is wrong when its length offset is
    /// not yet on.
    pub(in super::super) fn settle(&mut self) -> Option<(FindingKind, String)> {
        let (must, _) = self.offset.next?;
        self.offset.flush();
        let one = (FindingKind::Tool, said_of_offset(self.offset_on, must));
        (self.offset_on != must && !self.said.contains(&one)).then(|| {
            self.said.push(one.clone());
            one
        })
    }

    fn wrong(&self, modes: &Modes, doing: Doing, slack: &Tolerances) -> Vec<(FindingKind, String)> {
        let mut wrong = Vec::new();
        if let Some(tool) = self.tool.filter(|tool| *tool != modes.tool) {
            wrong.push((
                FindingKind::Tool,
                format!("tool {} moves, it should be tool {tool}", modes.tool),
            ));
        }
        // Between the change and the new offset, and at the end, the old one may be given up.
        // Tool-tip control has an offset, whether one is asked for or not.
        let own = |may: Option<u32>| may.is_none() && modes.frame.tip_control;
        let offset = |may: Option<u32>| may == modes.length.offset || own(may);
        let may_give_up = self.offset.next.is_some() || doing == Doing::Standing;
        let given_up = may_give_up && modes.length.offset.is_none();
        if let Some(must) = self.offset.refuses(offset).filter(|_| !given_up) {
            wrong.push((FindingKind::Tool, said_of_offset(modes.length.offset, must)));
        }
        let found = (modes.compensation.side, modes.compensation.offset);
        if let Some(must) = self.compensation.refuses(|may| may == found) {
            wrong.push((FindingKind::Compensation, said_of_compensation(found, must)));
        }
        wrong.extend(self.wrong_plane(modes).map(|said| (FindingKind::Compensation, said)));
        let spindle = |may: Option<Spindle>| may.is_none_or(|may| may == modes.spindle.turn);
        if let Some(Some(must)) = self.spindle.refuses(spindle) {
            wrong.push((
                FindingKind::Spindle,
                said_of_spindle(modes.spindle.turn, must, doing == Doing::Cutting),
            ));
        }
        let speed =
            |may: Option<Speed>| may.is_none_or(|may| same_speed(may, modes.spindle.speed, slack));
        if let Some(Some(must)) = self.speed.refuses(speed) {
            let found = modes.spindle.speed.map_or("no speed".to_string(), said_of_speed);
            let must = said_of_speed(must);
            wrong.push((
                FindingKind::Speed,
                format!("the spindle has {found}, it should be {must}"),
            ));
        }
        if let Some(speed) = modes.spindle.speed.filter(|_| !self.has_speed) {
            let said = format!("the spindle has {}, none is asked for", said_of_speed(speed));
            wrong.push((FindingKind::Speed, said));
        }
        self.again.wrong(self, modes, &mut wrong);
        let limit = |must: &Option<f64>| match (must, modes.spindle.speed_limit) {
            (Some(must), Some(limit)) => (must - limit).abs() > slack.of(Quantity::Speed),
            (must, limit) => must.is_some() != limit.is_some(),
        };
        if let Some(must) = self.speed_limit.filter(limit) {
            let name = |limit: Option<f64>| limit.map_or("none".to_string(), |s| s.to_string());
            let (found, must) = (name(modes.spindle.speed_limit), name(must));
            let said = format!("the limit of the spindle speed is {found}, it should be {must}");
            wrong.push((FindingKind::Speed, said));
        }
        wrong.extend(self.counted.wrong(modes).map(|said| (FindingKind::Spindle, said)));
        self.wrong_spindle(modes, &mut wrong);
        if let Some(must) = self.coolant.refuses(|may| may == modes.coolant) {
            let name =
                |code: Option<u32>| code.map_or("off".to_string(), |m| format!("on by M{m}"));
            let said = format!("coolant is {}, it should be {}", name(modes.coolant), name(must));
            wrong.push((FindingKind::Coolant, said));
        }
        let allowed = |found: Option<u32>| {
            !self.asks_fixture && found.is_some_and(|found| self.allowed_offsets.contains(&found))
        };
        let other =
            |must: &Option<u32>| *must != modes.frame.fixture && !allowed(modes.frame.fixture);
        if let Some(must) = self.fixture.filter(other) {
            let name = |fixture: Option<u32>| fixture.map_or("none".to_string(), name_of_fixture);
            let (found, must) = (name(modes.frame.fixture), name(must));
            wrong.push((FindingKind::Fixture, format!("work offset {found}, it should be {must}")));
        }
        wrong
    }

    /// What is not as it must be of the spindle's range and orientation.
    fn wrong_spindle(&self, modes: &Modes, wrong: &mut Vec<(FindingKind, String)>) {
        if let Some(must) = self.range.filter(|must| modes.spindle.range != Some(*must)) {
            let found = modes.spindle.range.map_or("none".to_string(), |range| range.to_string());
            let said = format!("spindle range {found} is chosen, it should be {must}");
            wrong.push((FindingKind::Spindle, said));
        }
        let near =
            |must: f64| modes.spindle.orientation.is_some_and(|is| (is - must).abs() <= ANGLE);
        if let Some(must) = self.orientation.filter(|must| !near(*must)) {
            let said = format!("the spindle is not oriented at {must} degrees");
            wrong.push((FindingKind::Spindle, said));
        }
    }
}

fn same_speed(must: Speed, found: Option<Speed>, slack: &Tolerances) -> bool {
    match (must, found) {
        (Speed::Turns(must), Some(Speed::Turns(found))) => {
            (must - found).abs() <= slack.of(Quantity::Speed)
        }
        (Speed::Surface(must), Some(Speed::Surface(found))) => {
            (must - found).abs() <= slack.of(Quantity::SurfaceSpeed)
        }
        _ => false,
    }
}
