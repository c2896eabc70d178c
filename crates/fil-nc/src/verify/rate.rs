//! The feed of a motion.

use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Point3, Vector3};

use super::ahead::Steps;
use super::expected_step::Hole;
use super::report::FindingKind;
use super::say::{short, spell_rate};
use super::settings::Quantity;
use super::verifier::{Fact, Verifier};
use crate::dialect::{Amount, Family, Habit};
use crate::motion::{Compensation, Course, Move, Position, Rate, Speed, unit};

/// Share of a lead, or of a feed by its pitch, that rounding may change.
const PITCH: f64 = 0.0005;

/// Steps in which the way of a tip is measured that axes turn on it.
const STEPS: u32 = 64;

/// A tip that goes less than this stands, mm: the feed of the CL file says nothing then.
const STANDS: f64 = 1e-3;

impl<C: Steps> Verifier<'_, C> {
    /// Compares the feed of a motion from a position.
    pub(super) fn check_rate(
        &mut self,
        cl_line: u32,
        from: Position,
        found: &Move,
        wanted: Option<Rate>,
    ) {
        if found.rate.is_some_and(|rate| self.is_repeated(rate)) {
            return;
        }
        let wanted = match wanted {
            Some(Rate::PerMinute(rate)) => {
                let rate = self.settings.feed_within(rate, self.limits.metric);
                let rate = self.at_the_edge(&from, found, rate);
                Rate::PerMinute(self.within_axes(rate, &from, found))
            }
            Some(rate) => rate,
            None => return,
        };
        let agrees = match (wanted, found.rate) {
            (Rate::PerMinute(a), Some(Rate::PerMinute(b))) => {
                (a - b).abs() <= self.slack.of(Quantity::Feed) + a * self.share_slack(&from, found)
            }
            (Rate::PerTurn(a), Some(Rate::PerTurn(b))) => {
                (a - b).abs() <= self.slack_of_pass(found, a)
            }
            (Rate::Varying(a, gains), Some(Rate::Varying(b, others))) => {
                let slack = self.slack_of_lead(found, a);
                (a - b).abs() <= slack && (gains - others).abs() <= slack
            }
            (Rate::PerTurn(a), Some(Rate::PerMinute(b))) if self.settings.feeds_by_the_minute() => {
                self.is_by_the_minute(found, a, b)
            }
            (Rate::PerMinute(rate), Some(Rate::Inverse(inverse))) => {
                return self.check_time(cl_line, (from, found), rate, inverse);
            }
            (Rate::PerTurn(rate), Some(Rate::Inverse(inverse))) => {
                let Some(speed) = found.modes.spindle.speed.and_then(Speed::turns) else { return };
                return self.check_time(cl_line, (from, found), rate * speed, inverse);
            }
            _ => false,
        };
        if !agrees && !self.says_the_time(from, found, wanted) {
            let found_rate = found.rate.map_or("none".to_string(), spell_rate);
            let message = format!("feed {found_rate}, it should be {}", spell_rate(wanted));
            self.find(FindingKind::Feed, Some(cl_line), Some(found.line), message);
        }
    }

    /// Compares the feed of a motion in a hole from a position.
    pub(super) fn check_rate_of_hole(
        &mut self,
        cl_line: u32,
        from: Position,
        found: &Move,
        hole: &Hole,
    ) {
        let wanted = self.rate_of_hole(hole);
        if !self.is_told_by_the_minute(hole, found, wanted) {
            self.check_rate(cl_line, from, found, wanted);
        }
    }

    /// A feed per minute may stand for the feed per revolution of a tap, at the spindle speed, and
    /// of a live tool, which the control may not measure. A drill does not keep its feed per
    /// revolution when the operator overrides the speed.
    fn is_told_by_the_minute(&self, hole: &Hole, found: &Move, wanted: Option<Rate>) -> bool {
        let (Some(Rate::PerTurn(turn)), Some(Rate::PerMinute(minute))) = (wanted, found.rate)
        else {
            return false;
        };
        let is_live = self.settings.is_mill_turn() && self.expected.mills();
        let may_be = found.in_cycle && (hole.kind == CycleKind::Tap || is_live);
        may_be && self.is_by_the_minute(found, turn, minute)
    }

    /// A feed per minute equals one per revolution at the spindle speed.
    fn is_by_the_minute(&self, found: &Move, turn: f64, minute: f64) -> bool {
        let agrees = |speed: f64| (turn * speed - minute).abs() <= self.slack.of(Quantity::Feed);
        found.modes.spindle.speed.and_then(Speed::turns).is_some_and(agrees)
    }

    /// The feed of a hole: CYCLE brings it within that of Z, along which cycles go.
    fn rate_of_hole(&self, hole: &Hole) -> Option<Rate> {
        hole.rate.map(|rate| match rate {
            Rate::PerMinute(rate) => {
                let rate = self.settings.feed_within(rate, self.limits.metric);
                Rate::PerMinute(self.settings.cycle_feed_within(rate, self.limits.metric))
            }
            rate => rate,
        })
    }

    /// A feed within the limits of Y and Z. From a place that nobody knows each axis may go
    /// alone, also while the machine turns.
    fn within_axes(&self, rate: f64, from: &Position, found: &Move) -> f64 {
        let begins = (0..3).all(|n| self.known[n] || !self.limits.written[n])
            && !self.facts.has(Fact::FreshTool)
            && found.modes.frame.fixture == self.moved.modes.frame.fixture;
        let turns = turned(from, found) != [0.0; 2] && !found.to.tip_control;
        if turns && begins {
            return rate;
        }
        let (from, found) = self.on_tape(from, found);
        let from = Some(&from).filter(|_| begins);
        self.settings.feed_within_axes(rate, from, &found, self.limits.metric)
    }

    /// A motion in directions of the program: in a hole along the tool, it is said in those of
    /// the hole.
    fn on_tape(&self, from: &Position, found: &Move) -> (Position, Move) {
        let Some(to_axes) = self.memory.from_hole.map(|hole| hole.turn) else {
            return (*from, *found);
        };
        // Under tool-tip control X, Y and Z are those of the part.
        let turn = match found.modes.frame.tip_control {
            true => self.settings.forward.frame(found.to.rotary).turn * to_axes,
            false => to_axes,
        };
        let turned = |at: &Position| {
            let linear = (turn * Vector3::from(at.linear)).into();
            Position { linear, ..*at }
        };
        (turned(from), Move { to: turned(&found.to), ..*found })
    }

    /// By what share rounding on the tape changes a feed that the ways of Y and Z limit.
    fn share_slack(&self, from: &Position, found: &Move) -> f64 {
        let (from, found) = self.on_tape(from, found);
        let digits = self.memory.from_hole.map_or(self.slack.linear, |hole| hole.slack);
        let share = |axis: usize| {
            let way = (found.to.linear[axis] - from.linear[axis]).abs();
            if way > digits[axis] { 4.0 * digits[axis] / way } else { 0.0 }
        };
        let limits = self.settings.limits_feed_of_axes();
        [1, 2].into_iter().filter(|axis| limits[axis - 1]).map(share).fold(0.0, f64::max)
    }

    /// The feed is the F that REPEAT writes.
    fn is_repeated(&self, rate: Rate) -> bool {
        let (dialect, unit) = (&self.settings.dialect, unit(self.limits.metric));
        let Some(feed) = self.user.repeated_feed else { return false };
        match rate {
            Rate::PerMinute(rate) => {
                (rate - feed / dialect.factor(Amount::Feed) * unit).abs()
                    <= self.slack.of(Quantity::Feed)
            }
            Rate::PerTurn(rate) => {
                (rate - feed * unit).abs() <= self.slack.of(Quantity::FeedPerTurn)
            }
            Rate::Inverse(rate) => {
                (rate - feed / dialect.factor(Amount::Inverse)).abs()
                    <= self.slack.of(Quantity::InverseTime)
            }
            Rate::Varying(..) => false,
        }
    }

    /// How far a lead may be off: a cycle that says it in a word of its own has more digits
    /// than F.
    pub(super) fn slack_of_lead(&self, found: &Move, lead: f64) -> f64 {
        let by_letters = self.settings.dialect.family == Family::WordAddress;
        match found.course {
            Course::Thread if found.in_cycle && !by_letters => PITCH * lead,
            Course::Thread => self.slack.of(Quantity::Lead),
            _ => self.slack.of(Quantity::FeedPerTurn),
        }
    }

    /// How far the lead of a pass may be off: a cycle that says it in a word of its own has other
    /// digits than the address, and along the path the rounded ends of the pass change it, too.
    pub(super) fn slack_of_pass(&self, pass: &Move, lead: f64) -> f64 {
        let along_path = self.settings.dialect.has(Habit::LeadAlongPath);
        let share = if along_path { PITCH * lead } else { 0.0 };
        share + self.slack_of_lead(pass, lead)
    }

    /// The feed of the center of the cutter on a compensated arc, where the machine's
    /// settings ask for the feed at its edge.
    fn at_the_edge(&self, from: &Position, found: &Move, rate: f64) -> f64 {
        let Some(arc) = found.arc.filter(|_| self.settings.feeds_at_the_edge()) else {
            return rate;
        };
        let inside = match found.modes.compensation.side {
            Compensation::Off => return rate,
            Compensation::Left => arc.ccw,
            Compensation::Right => !arc.ccw,
        };
        let [first, second] = arc.plane().map(|axis| from.linear[axis] - arc.center[axis]);
        let (radius, cutter) = (libm::hypot(first, second), self.cutter.unwrap_or(0.0));
        let of_center = if inside { radius - cutter / 2.0 } else { radius + cutter / 2.0 };
        if of_center <= 0.0 {
            return rate;
        }
        self.settings.feed_within(rate * of_center / radius, self.limits.metric)
    }

    /// Inverse time: the motion takes `1 / inverse` minutes. Posts take the straight way
    /// of the tip for its length, or the way it really goes; both are right.
    fn check_time(
        &mut self,
        cl_line: u32,
        (from, found): (Position, &Move),
        rate: f64,
        inverse: f64,
    ) {
        let straight = self.straight_length(from, found);
        let slack = self.slack.of(Quantity::InverseTime);
        let turned = turned(&from, found);
        let alone = from.linear == found.to.linear;
        // F counts the way before its ends were rounded.
        let off = 2.0 * self.slack.linear.iter().map(|half| half * half).sum::<f64>().sqrt()
            + self.off_by_its_center(found);
        // So does the share that the ways of Y and Z have in a feed that they limit.
        let share = self.share_slack(&from, found);
        let agrees = |length: f64| {
            let ends = [(length + off, rate * (1.0 - share)), (length - off, rate * (1.0 + share))];
            let inverses = ends.map(|(length, rate)| {
                let length = length.max(STANDS);
                let time = self.settings.turning_time(length / rate, turned, alone);
                [rate / length, 1.0 / time].map(|it| self.settings.inverse_within(it))
            });
            let [low, high] = inverses;
            (0..2).any(|n| inverse >= low[n] - slack && inverse <= high[n] + slack)
        };
        // The way is at least as long, and takes long to measure: most motions need it not.
        if straight >= STANDS && agrees(straight) {
            return;
        }
        let way = self.way_length(from, found).max(straight);
        if way < STANDS {
            return self.check_turn(cl_line, (&from, found), turned, inverse);
        }
        if agrees(straight) || agrees(way) {
            return;
        }
        if straight <= off && self.turns_at(rate, [&from, &found.to], inverse) {
            return;
        }
        let message = format!(
            "feed {} blocks per minute, which is {} mm/min on this move of {}, it should be {} mm/min",
            short(inverse),
            short(inverse * way),
            short(way),
            short(rate)
        );
        self.find(FindingKind::Feed, Some(cl_line), Some(found.line), message);
    }

    /// Inverse time of a turn while the tip stands to its last digits: as long as the machine
    /// needs, or the feed taken as degrees a minute where its settings don't say that.
    fn turns_at(&self, rate: f64, [from, to]: [&Position; 2], inverse: f64) -> bool {
        let turned = [0, 1].map(|n| (to.rotary[n] - from.rotary[n]).abs());
        let most = turned[0].max(turned[1]);
        let time = match self.settings.turning_time(0.0, turned, true) {
            0.0 => self.settings.turning_time(most / rate, turned, true),
            time => time,
        };
        let must = self.settings.inverse_within(1.0 / time);
        let digits = 2.0 * self.slack.rotary[0].max(self.slack.rotary[1]);
        (inverse - must).abs() <= self.slack.of(Quantity::InverseTime) + must * digits / most
    }

    /// How much longer or shorter an arc may be by its rounded center, mm: a center that is off
    /// by `d` makes the radius as much larger, and turns both ends by `d` over the radius.
    fn off_by_its_center(&self, found: &Move) -> f64 {
        let Some(arc) = &found.arc else { return 0.0 };
        let [first, second] = arc.plane();
        let center = libm::hypot(self.slack.center[first], self.slack.center[second]);
        center * (arc.angle.to_radians().abs() + 2.0)
    }

    /// Inverse time where the tip stands: the turn takes as long as the machine needs for it,
    /// where its settings say that.
    fn check_turn(
        &mut self,
        cl_line: u32,
        (from, found): (&Position, &Move),
        turned: [f64; 2],
        inverse: f64,
    ) {
        let time = self.settings.turning_time(0.0, turned, true);
        if time == 0.0 {
            return;
        }
        let must = self.settings.inverse_within(1.0 / time);
        // Angles of a direction that is written as a vector are not those of the program.
        let digits = 2.0 * self.slack.rotary[0].max(self.slack.rotary[1])
            + self.settings.turn_by_rounding([from, &found.to]);
        let slack = self.slack.of(Quantity::InverseTime) + must * digits / turned[0].max(turned[1]);
        if (inverse - must).abs() > slack {
            let message = format!(
                "feed {} blocks per minute, it should be {}, the shortest time of the rotary move",
                short(inverse),
                short(must)
            );
            self.find(FindingKind::Feed, Some(cl_line), Some(found.line), message);
        }
    }

    /// A feed a minute that is counted over the way of the axes, as the machine takes it in
    /// motions that turn it, and leads the tip as fast as asked for.
    fn says_the_time(&self, from: Position, found: &Move, wanted: Rate) -> bool {
        let turned = turned(&from, found);
        if turned == [0.0; 2] || from.names_tip() || found.to.names_tip() {
            return false;
        }
        let rate = match (wanted, found.modes.spindle.speed.and_then(Speed::turns)) {
            (Rate::PerMinute(rate), _) => rate,
            (Rate::PerTurn(rate), Some(speed)) => rate * speed,
            _ => return false,
        };
        let Some(Rate::PerMinute(feed)) = found.rate else { return false };
        let Some(counted) = self.settings.counted_way(&from, &found.to, self.limits.metric) else {
            return false;
        };
        let says = |way: f64| {
            let time =
                self.settings.turning_time(way / rate, turned, from.linear == found.to.linear);
            let expected = self.settings.feed_within(counted / time, self.limits.metric);
            (feed - expected).abs() <= self.slack.of(Quantity::Feed)
        };
        let straight = self.straight_length(from, found);
        says(straight) || says(self.way_length(from, found).max(straight))
    }

    /// How far the tip goes in the part straight, or along an arc of the program, mm.
    fn straight_length(&self, from: Position, found: &Move) -> f64 {
        match &found.arc {
            Some(arc) if !self.settings.takes_chords() => arc.length(from.linear, found.to.linear),
            _ => (self.tip_after(&from, found, STEPS) - self.tip_after(&from, found, 0)).norm(),
        }
    }

    /// How far the tip goes in the part as the axes lead it, mm.
    fn way_length(&self, from: Position, found: &Move) -> f64 {
        let mut last = self.tip_after(&from, found, 0);
        let step = |step: u32| {
            let tip = self.tip_after(&from, found, step);
            (tip - std::mem::replace(&mut last, tip)).norm()
        };
        (1..=STEPS).map(step).sum()
    }

    /// Where the tip is in the part behind so many of the steps of a motion.
    fn tip_after(&self, from: &Position, found: &Move, step: u32) -> Point3<f64> {
        let forward = &self.settings.forward;
        let share = f64::from(step) / f64::from(STEPS);
        forward.tip(&forward.along(from, &found.to, found.arc.as_ref(), share))
    }
}

/// How far each rotary axis turns, degrees.
fn turned(from: &Position, found: &Move) -> [f64; 2] {
    [0, 1].map(|n| (found.to.rotary[n] - from.rotary[n]).abs())
}
