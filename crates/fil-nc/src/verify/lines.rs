//! Rapids and straight lines: where they end and how they get there.

use nalgebra::Vector3;

use super::ahead::Steps;
use super::between::Asked;
use super::rapid_lean::{Leg, Lie, UPRIGHT};
use super::report::FindingKind;
use super::say::short;
use super::verifier::{Fact, STILL, Verifier};
use super::zones;
use fil_machine::locations::LinearMethod;

use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Position, Rate};

/// Distances from the axis of the spindle nearer than this are one where each coordinate is
/// rounded, mm.
pub(super) const AROUND: f64 = 3e-3;

/// Most blocks of one rapid.
pub(super) const RAPID_PARTS: usize = 4;

impl<C: Steps> Verifier<'_, C> {
    /// A rapid in one block or in parts.
    pub(super) fn rapid(&mut self, cl_line: u32, pose: &Pose) -> bool {
        if self.stands_at(pose) && !self.goes_a_digit_to(pose) {
            self.lead_in(self.at.linear[0]);
            return true;
        }
        if let Some(feed) = self.feed_of_short_rapid(pose) {
            return self.line(cl_line, pose, Course::Feed, Some(Rate::PerMinute(feed)));
        }
        let Some(count) = self.rapid_parts(self.next, pose) else { return false };
        let last = self.next + count - 1;
        let Some(Event::Move(end)) = self.nc.get(last) else { return false };
        self.lead_in(end.to.linear[0]);
        let linear = self.settings.forward.frame_of(&end.to).linear(pose.tip);
        let exact = Position { linear, ..end.to };
        let leg = if self.facts.has(Fact::FreshTool) { Leg::FromAfar } else { Leg::OfPath };
        self.memory.rapid_to = Some(*pose);
        let begin = self.at;
        for index in self.next..=last {
            if let Some(Event::Move(part)) = self.nc.get(index) {
                let goes_around = self.settings.is_mill_turn() && self.goes_around(&part, &exact);
                if !goes_around && !self.goes_out_along_x(&part, &end.to) {
                    self.check_part(cl_line, &part, &end.to, leg);
                }
                if index < last && leg != Leg::FromAfar {
                    self.check_order_on_lathe(cl_line, &part, (&end, pose));
                }
                self.check_way_past_axis(cl_line, &part, [&begin, &end.to]);
                self.check_turn_is_away(cl_line, &part);
                self.take(cl_line, &part);
            }
        }
        self.memory.rapid_to = None;
        self.measure(&end, pose);
        self.next = last + 1;
        if self.expected.mills_without_y(self.settings) {
            self.pass_begin_of_polar(cl_line, pose);
        }
        self.memory.rapid_end = Some(*pose);
        true
    }

    /// The first rapid of a tool that comes to the part ends at X, even where the one before it
    /// stood: it leads in to a surface speed.
    fn lead_in(&mut self, x: f64) {
        let is_first = self.facts.has(Fact::FreshTool) && !self.expected.leads_in();
        if self.facts.has(Fact::Away) || is_first {
            self.expected.approach_at(2.0 * x.abs(), self.settings);
        }
    }

    /// The next block is a rapid to where the tool stands but for its last digits.
    fn goes_a_digit_to(&self, pose: &Pose) -> bool {
        self.next_move().is_some_and(|found| {
            found.course == Course::Rapid && !found.in_cycle && self.reaches(&found, pose)
        })
    }

    /// Ways of no length behind a rapid, with which polar interpolation begins, are of it: the
    /// tool has arrived before.
    fn pass_begin_of_polar(&mut self, cl_line: u32, pose: &Pose) {
        while let Some(found) = self.next_move().filter(|found| {
            // A length in the plane has another last digit than a diameter.
            let goes = found.course == Course::Rapid && self.reaches(found, pose);
            let stays = found.course != Course::Machine && self.is_still(found);
            (goes || stays) && !self.own.has(found.line)
        }) {
            self.take(cl_line, &found);
            self.next += 1;
        }
    }

    /// The feed that the machine makes a rapid at which is too short for one.
    fn feed_of_short_rapid(&self, pose: &Pose) -> Option<f64> {
        let (short, feed) = self.settings.short_rapid(self.limits.metric)?;
        let length = (pose.tip - self.begins().tip).norm();
        let slack = 2.0 * self.slack.linear[0];
        let at_feed = self.next_move().is_some_and(|found| found.course == Course::Feed);
        // Behind a tool change no way is known to be short.
        let is_short = length < short - slack && !self.facts.has(Fact::FreshTool)
            || (length < short + slack && at_feed);
        (is_short && self.is_known(&self.known)).then_some(feed)
    }

    /// A slanted line that the machine makes in two blocks, Z before or after X and Y.
    fn corner(&mut self, cl_line: u32, pose: &Pose, rate: Option<Rate>) -> bool {
        let Some(order) = self.settings.first_of_lines() else { return false };
        let from = self.begins();
        let mut corner = *pose;
        match order {
            LinearMethod::ZThenXy => (corner.tip.x, corner.tip.y) = (from.tip.x, from.tip.y),
            _ => corner.tip.z = from.tip.z,
        }
        let two = [self.next, self.next + 1].map(|index| match self.nc.get(index) {
            Some(Event::Move(found)) if is_line(&found, Course::Feed) => Some(found),
            _ => None,
        });
        let [Some(first), Some(second)] = two else { return false };
        // An axis that the second block moves may stand where nobody knows until then.
        let is_known = (0..5).all(|n| first.known[n] || !self.known[n]);
        let moves = |n: usize| (n == 2) == (order == LinearMethod::ZThenXy);
        let is_said = (0..3).all(|n| first.known[n] || !moves(n));
        let at_corner = is_known && is_said && self.gap(&first.to, &corner).closed();
        if !at_corner || !self.reaches(&second, pose) {
            return false;
        }
        for found in [first, second] {
            self.check_rate(cl_line, self.at, &found, rate);
            self.take(cl_line, &found);
        }
        self.measure(&second, pose);
        self.next += 2;
        true
    }

    /// How many rapids from `index` on reach a pose.
    pub(super) fn rapid_parts(&self, index: usize, pose: &Pose) -> Option<usize> {
        let mut rapids = self.nc.from(index).take(RAPID_PARTS).map_while(|event| match event {
            Event::Move(part) if part.course == Course::Rapid && !part.in_cycle => Some(part),
            _ => None,
        });
        let first = rapids.position(|part| self.reaches(&part, pose))?;
        Some(first + 1 + self.turns_about_tool(index + first, pose))
    }

    /// How many rapids behind one that has arrived turn the machine about the tool: X and Y go
    /// along, before it or with it.
    fn turns_about_tool(&self, arrived: usize, pose: &Pose) -> usize {
        let part = |index: usize| {
            self.nc.motion(index).filter(|part| part.course == Course::Rapid && !part.in_cycle)
        };
        let (Some(first), Some(next)) = (part(arrived), part(arrived + 1)) else { return 0 };
        let turns = |part: &Move| {
            !part.to.names_tip() && part.to.rotary != first.to.rotary && self.reaches(part, pose)
        };
        if turns(&next) {
            return 1;
        }
        let goes_across =
            next.to.rotary == first.to.rotary && next.to.linear[2] == first.to.linear[2];
        let last = part(arrived + 2).filter(|last| last.to.linear == next.to.linear);
        if goes_across && last.is_some_and(|last| turns(&last)) { 2 } else { 0 }
    }

    /// A rapid to where the last one has ended already: a coordinate half way between two
    /// last digits may be written once as each. A mill-turn machine goes to the level of the
    /// next hole, which may lie a last digit apart, before C turns there.
    pub(super) fn goes_there_again(&self, found: &Move) -> bool {
        let rapid = found.course == Course::Rapid && !found.in_cycle;
        let near = |n: usize| {
            let way = (found.to.linear[n] - self.at.linear[n]).abs();
            way <= 2.0 * self.slack.linear[n] + STILL
        };
        let a_digit = || self.settings.is_mill_turn() && (0..3).all(near);
        let stays = || found.to.rotary == self.at.rotary && found.known == self.known;
        rapid
            && self
                .memory
                .rapid_end
                .is_some_and(|pose| self.reaches(found, &pose) || (a_digit() && stays()))
    }

    /// Each axis stays or ends in a part of a rapid, and the height is the safe one.
    pub(super) fn check_part(&mut self, cl_line: u32, part: &Move, end: &Position, leg: Leg) {
        if part.to.tilt != end.tilt {
            if end.tip_control {
                self.check_way_up_in_frame(cl_line, part);
            }
            return self.check_before_frame(cl_line, part);
        }
        for message in self.wrong_part(part, end, leg) {
            self.say_order(cl_line, part, message);
        }
    }

    /// What is wrong with a part of a rapid, by how the tool lies in it.
    fn wrong_part(&self, part: &Move, end: &Position, leg: Leg) -> Vec<String> {
        if leg == Leg::OfPath && self.turns_in_cut(part, end) {
            return vec!["rapid turns the machine before the tool is out of its cut".to_string()];
        }
        if leg == Leg::OfPath && self.leads_out_of_cut(part, end) {
            return Vec::new();
        }
        let lie = match self.lie(part, end, leg) {
            Lie::Leaning if self.limits.splits_rapids && self.leads_along_tool(part, end, leg) => {
                return Vec::new();
            }
            Lie::Leaning => match self.lies_nearly_along(end) {
                None if self.limits.splits_rapids => {
                    return vec!["rapid does not go along the tilted tool".to_string()];
                }
                nearly => nearly.unwrap_or(Lie::Leaning),
            },
            lie => lie,
        };
        let wrong = self.wrong_order(part, end, lie);
        // From a tool change Z may come last, too, however the tool lies: it is away.
        match leg {
            Leg::FromAfar if wrong.is_empty() || self.comes_down_along_tool(part, end) => {
                Vec::new()
            }
            Leg::FromAfar => self.wrong_order(part, end, UPRIGHT),
            _ => wrong,
        }
    }

    /// What is wrong with a part of a rapid of axes that move one after the other.
    fn wrong_order(&self, part: &Move, end: &Position, lie: Lie) -> Vec<String> {
        let (tool, up) = match lie {
            Lie::Along { axis, up } => (axis, up),
            Lie::Leaning => (2, 1.0),
        };
        let mut wrong = Vec::new();
        let others = [0, 1, 2].into_iter().filter(move |n| *n != tool);
        let splits = self.limits.splits_rapids;
        let forward = &self.settings.forward;
        let end_turns = end.rotary;
        // Each part as its own X, Y, Z are meant.
        let at = forward.restated(&self.at, &part.to).linear;
        let end = forward.restated(end, &part.to);
        let to = part.to.linear;
        let known: [bool; 3] = std::array::from_fn(|n| self.known[n] && part.known[n]);
        // From an unknown place the others go to the end; only the one along the tool may go up
        // first.
        let found_out = |n: usize| !self.known[n] && part.known[n];
        let same = |a: f64, b: f64| (a - b).abs() <= STILL;
        let moved = |n: usize| !same(to[n], at[n]);
        let arrived = |n: usize| same(to[n], end.linear[n]);
        let rise = (to[tool] - at[tool]) * up;
        let is_level = tool == 2 && self.is_retract_level(to[2]);
        let leaves = |n: usize| moved(n) && known[n] && !arrived(n);
        // Before it turns its rotary axes the machine may go up to its level.
        let turns = part.to.rotary != end.rotary;
        let lifts = turns && is_level && rise > 0.0 && !others.clone().any(leaves);
        let strays = others.clone().any(|n| found_out(n) && !arrived(n));
        // A way that begins and ends nobody knows where.
        let is_blind = (0..3).any(|n| !self.known[n] && !part.known[n] && moved(n));
        let finds_level = found_out(tool) && !arrived(tool) && !is_level;
        let astray = strays || is_blind || finds_level || self.turns_astray(part, &end);
        if astray || (0..3).any(|n| leaves(n) && !(n == tool && lifts)) {
            let [x, y, z] = to.map(short);
            let message =
                format!("rapid through X{x} Y{y} Z{z}, which is not on a path to its end point");
            wrong.push(message);
        }
        let letter = ["X", "Y", "Z"][tool];
        let across_it = ["Y and Z", "X and Z", "X and Y"][tool];
        let is_mill = self.limits.written == [true; 3];
        let comes_later = is_mill && others.clone().any(|n| !part.known[n] || !arrived(n));
        // Over where the tool last worked a way up hits nothing, behind a tool change too.
        let goes_down = tool != 2 || !self.facts.has(Fact::HadHeight) || rise <= 0.0;
        let finds_height = found_out(tool) && !is_level && goes_down;
        if splits && finds_height && comes_later {
            wrong.push(format!("rapid goes to its height before {across_it} have arrived"));
        }
        if splits
            && tool == 2
            && moved(2)
            && !is_level
            && self.comes_down_before_it_turns(part, end_turns)
        {
            wrong.push("rapid goes to its height before the rotary axes have arrived".to_string());
        }
        if !splits || !known[tool] {
            return wrong;
        }
        let lower = moved(tool) && rise < 0.0;
        // Behind the way up at the end of tool-tip control the level of GOHOME is a safe one.
        let goes_home = self.facts.has(Fact::Up) && tool == 2 && self.is_home_level(to[2]);
        if lower && !others.clone().all(arrived) && !goes_home {
            wrong.push(format!("rapid plunges before {across_it} have arrived"));
        } else if lower && turns && !part.to.names_tip() {
            wrong.push("rapid plunges before the rotary axes have arrived".to_string());
        }
        let across = others.clone().any(moved) && !moved(tool);
        // A tool change has brought Z up, and the level of the end is that of another turn.
        let is_clear = turns && self.facts.has(Fact::FreshTool);
        if across && (end.linear[tool] - at[tool]) * up > STILL && !is_clear {
            wrong.push(format!("rapid goes across before {letter} has gone up"));
        }
        wrong
    }

    /// A rotary axis neither stays nor ends in a part of a rapid.
    fn turns_astray(&self, part: &Move, end: &Position) -> bool {
        // A direction of the tool is rounded, and so are the angles that come of it.
        let rounding = self.settings.direction_rounding().map_or(0.0, f64::to_degrees);
        let differs = |a: f64, b: f64| (a - b).abs() > rounding.max(STILL);
        (0..2).any(|n| {
            let [from, to] = [self.at, part.to].map(|at| at.rotary[n]);
            let moves = differs(from, to) || (part.known[n + 3] && !self.known[n + 3]);
            moves && differs(to, end.rotary[n])
        })
    }

    fn say_order(&mut self, cl_line: u32, part: &Move, message: String) {
        self.find(FindingKind::Order, Some(cl_line), Some(part.line), message);
    }

    /// A part of a rapid of a mill-turn machine that mills in polar interpolation: at C zero and
    /// the distance of the end from the axis, which only X rounds, or around the axis there; Z
    /// stays, or goes up before.
    pub(super) fn goes_around(&self, part: &Move, end: &Position) -> bool {
        let distance = |at: &Position| libm::hypot(at.linear[0], at.linear[1]);
        let in_plane = part.to.linear[1] != 0.0;
        let slack = if in_plane { AROUND } else { self.slack.linear[0] };
        let around = (distance(&part.to) - distance(end)).abs() <= slack;
        let stays = (part.to.linear[2] - self.at.linear[2]).abs() <= STILL;
        around && (stays || !part.known[2]) && part.to.rotary[0] == 0.0
    }

    /// A position of Z is that of the machine's home.
    fn is_home_level(&self, z: f64) -> bool {
        let [.., level] = self.settings.home(self.limits.metric);
        level.is_some_and(|level| (z - level).abs() <= self.slack.linear[2])
    }

    /// A position of Z is the level that the machine goes up to.
    pub(super) fn is_retract_level(&self, z: f64) -> bool {
        let level = self.settings.retract_level(self.limits.metric);
        level.is_some_and(|level| (z - level).abs() <= self.slack.linear[2])
    }

    /// Before the tilted frame that a rapid ends in the machine may go up and turn.
    pub(super) fn check_before_frame(&mut self, cl_line: u32, part: &Move) {
        let at = self.settings.forward.restated(&self.at, &part.to).linear;
        // Up along Z of a frame that ends above.
        let leaves_frame = part.to.tilt.is_some() && part.to.tilt == self.at.tilt;
        let way = |n: usize| match self.known[n] && part.known[n] {
            true => part.to.linear[n] - at[n],
            false => 0.0,
        };
        let raises = part.known[2] && (!self.known[2] || way(2) > STILL);
        // The way up in the frame before is rounded.
        let falls = way(2) < -2.0 * self.slack.linear[2] - STILL;
        let astray = raises && !leaves_frame && !self.is_retract_level(part.to.linear[2]);
        if way(0).abs() > STILL || way(1).abs() > STILL || falls || astray {
            let message = "rapid before its tilted work plane, and not a retract".to_string();
            self.find(FindingKind::Order, Some(cl_line), Some(part.line), message);
        }
    }

    /// A straight line at feed, or a thread pass.
    pub(super) fn line(
        &mut self,
        cl_line: u32,
        pose: &Pose,
        course: Course,
        rate: Option<Rate>,
    ) -> bool {
        if let Some(found) = self.next_move().filter(|found| is_line(found, course))
            && let Some(gap) = self.gap_reached(&found, pose)
        {
            self.check_rate(cl_line, self.at, &found, rate);
            self.look_between(cl_line, &found, |walk| Asked::line(walk.begins(), *pose));
            self.take(cl_line, &found);
            self.measure_gap(&found, &gap);
            self.next += 1;
            return true;
        }
        let cuts = course == Course::Feed;
        self.stands_at(pose)
            || (cuts && self.corner(cl_line, pose, rate))
            || (cuts && self.parts(cl_line, pose, rate))
    }

    pub(super) fn check_limits(&mut self, cl_line: u32, found: &Move) {
        self.check_departure(cl_line, found);
        self.check_square_to_compensation(cl_line, found);
        let axes = self.settings.forward.restated(&found.to, &Position::default()).linear;
        let axes = match self.memory.from_hole {
            Some(hole) => {
                let [x, y, z]: [f64; 3] = (hole.turn * Vector3::from(axes)).into();
                [x, if self.limits.written[1] { y } else { 0.0 }, z]
            }
            // In the plane of X and C the slide stands at the distance from the axis.
            None if self.expected.mills_without_y(self.settings) => {
                [libm::hypot(axes[0], axes[1]), 0.0, axes[2]]
            }
            None => axes,
        };
        // Where an axis stands before a word has said it nobody knows.
        let says = |n: usize| found.known[n] || found.to_machine[n];
        let all = found.to.names_tip() || self.memory.from_hole.is_some();
        let is_straight = found.arc.is_none() && !found.in_cycle && self.memory.from_hole.is_none();
        let may_leave = if is_straight { self.settings.leaves_travel() } else { [false; 3] };
        for (n, (min, max)) in self.limits.travel.into_iter().enumerate() {
            let value = axes[n];
            let is_said = if all { (0..3).all(says) } else { says(n) };
            if !is_said || may_leave[n] {
                continue;
            }
            if !(min..=max).contains(&value) {
                let axis = ["X", "Y", "Z"][n];
                let message =
                    format!("{axis}{} lies outside the travel {min} to {max}", short(value));
                self.find(FindingKind::Limit, Some(cl_line), Some(found.line), message);
            }
        }
        for n in 0..2 {
            let Some(axis) = &self.settings.forward.rotaries()[n] else { continue };
            if !found.known[n + 3] && !found.to_machine[n + 3] {
                continue;
            }
            let value = found.to.rotary[n];
            let low = axis.min.is_some_and(|min| value < min - self.slack.rotary[n]);
            let high = axis.max.is_some_and(|max| value > max + self.slack.rotary[n]);
            let from = self.known[n + 3].then_some(self.at.rotary[n]);
            let slack = self.slack.rotary[n];
            let beyond = zones::outside(axis, from, value, slack).is_some();
            if low || high || beyond {
                let letter = axis.letter.character();
                let message =
                    format!("{letter}{} lies outside the travel of the axis", short(value));
                self.find(FindingKind::Limit, Some(cl_line), Some(found.line), message);
            }
        }
    }
}

/// A straight line of this course that no cycle makes.
pub(super) fn is_line(found: &Move, course: Course) -> bool {
    found.course == course && found.arc.is_none() && !found.in_cycle
}
