//! A way out and back in the middle of a feed motion, by which a machine whose rotary axis is
//! at its limit turns to other positions for the same tool axis.
//!
//! The tool must go out along its axis, the rotary axes turn there only, and the tool come
//! back straight to the same point with the same tool axis.

use fil_machine::commons::Dbl;
use fil_machine::locations::{self as loc, ReposFeedMethod, ReposRapidMethod, ReposRapidRetract};
use nalgebra::Vector3;

use super::ahead::Steps;
use super::between::way::Way;
use super::lines::is_line;
use super::rapid_lean::{Leg, Lie};
use super::report::FindingKind;
use super::say::short;
use super::settings::Settings;
use super::verifier::Verifier;
use crate::forward::Pose;
use crate::motion::{Course, Event, Modes, Move, Position, Rate, Spindle, unit};

/// Most blocks of the way out, the turn and the way back.
const MOST: usize = 8;

/// Most blocks of the part of a line before it.
const MOST_BEFORE: usize = 1_000;

/// A turn of less than this is none, degrees.
const SMALL: f64 = 0.01;

/// The settings of the way out and back.
pub(super) struct Reposition {
    /// How far the tool goes out, mm.
    distance: f64,
    /// From how far it may come back at feed, mm.
    approach: f64,
    /// It goes out along the tool axis of the next point.
    along_next: bool,
    /// Feeds out and back, where the settings name them.
    rates: [Option<Rate>; 2],
    /// The program stops after the way out, or may: the codes that say so.
    stops: [Option<u32>; 2],
    /// The spindle stands while the machine turns.
    stands: bool,
    /// Coolant is off then.
    dry: bool,
    /// A macro of the script decides: the lengths are the least, and feeds, axis of the way
    /// out, spindle, coolant and stops of the program are its own.
    by_macro: bool,
}

impl Settings<'_> {
    /// How the machine repositions in feed motions; `None` where it does not.
    pub(super) fn reposition(&self, metric: bool) -> Option<Reposition> {
        let commons = self.commons;
        let method = commons.read(loc::REPOS_FEED_METHOD);
        let by_macro = method == ReposFeedMethod::CallTheMacroRepos;
        let does = by_macro || method == ReposFeedMethod::RetractAndApproach;
        if does { self.way_of_reposition(by_macro, metric) } else { None }
    }

    /// The same in rapid motions.
    pub(super) fn reposition_at_rapid(&self, metric: bool) -> Option<Reposition> {
        let commons = self.commons;
        let method = commons.read(loc::REPOS_RAPID_METHOD);
        let asks = commons.read(loc::REPOS_RAPID_RETRACT) == ReposRapidRetract::AsInFeedMoves;
        let does = asks && method != ReposRapidMethod::Nothing;
        let by_macro = method == ReposRapidMethod::CallTheMacroRepos;
        if does { self.way_of_reposition(by_macro, metric) } else { None }
    }

    /// The way out and back of the settings.
    fn way_of_reposition(&self, by_macro: bool, metric: bool) -> Option<Reposition> {
        let commons = self.commons;
        let distance = commons.dbl_opt(loc::REPOS_RETRACT_DISTANCE)?;
        let rate = |at: Dbl| {
            let feed = commons.dbl_opt(at).filter(|feed| *feed > 0.0)?;
            Some(Rate::PerMinute(feed * unit(metric)))
        };
        let stop = |on: bool, optional| if on { self.stop_code(optional) } else { None };
        let approach = commons.dbl_opt(loc::REPOS_APPROACH_DISTANCE).filter(|far| *far > 0.0);
        let near = if by_macro { 0.0 } else { distance };
        Some(Reposition {
            distance: distance * unit(metric),
            approach: approach.unwrap_or(near).min(distance) * unit(metric),
            by_macro,
            stands: !by_macro && commons.read(loc::REPOS_RETRACT_SPINDLE),
            dry: !by_macro && commons.read(loc::REPOS_RETRACT_COOLANT),
            along_next: commons.read(loc::REPOS_NEW_TOOL_AXIS),
            rates: [rate(loc::REPOS_RETRACT_FEED), rate(loc::REPOS_APPROACH_FEED)],
            stops: [
                stop(by_macro || commons.read(loc::REPOS_RETRACT_OPSTOP), true),
                stop(by_macro || commons.read(loc::REPOS_RETRACT_STOP), false),
            ],
        })
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// Takes the blocks of a way out and back, with the part of the line before it; false
    /// when none comes before the end of the line.
    pub(super) fn repositions(&mut self, cl_line: u32, pose: &Pose, rate: Option<Rate>) -> bool {
        let Some(how) = self.settings.reposition(self.limits.metric) else { return false };
        if !self.is_known(&self.known) {
            return false;
        }
        let Some((before, count)) = self.way_out_ahead(pose, &how) else { return false };
        if before > 0 {
            let Some(Event::Move(last)) = self.nc.get(self.next + before - 1) else { return false };
            let (middle, rough) = self.place_on_line(&last, pose);
            if !self.parts_of(cl_line, (&middle, rough), rate) {
                return false;
            }
            self.watch.stand_within(Some(middle), rough);
        }
        let (stands, rough) = (self.begins(), self.roughness());
        self.take_way(cl_line, count, &how, (rate, &stands));
        self.exact = self.settings.forward.refine(self.at.rotary, stands.axis);
        self.watch.stand_within(Some(stands), rough);
        true
    }

    /// How well the place is known where the tool stands, mm.
    fn roughness(&self) -> f64 {
        let known = self.watch.stands_at().filter(|(stands, _)| *stands == self.begins());
        known.map_or_else(|| self.tip_slack(&self.at), |(_, rough)| rough)
    }

    /// Takes the blocks of a rapid motion that goes out before and comes back in behind it; false
    /// when it is none.
    pub(super) fn repositions_at_rapid(&mut self, cl_line: u32, pose: &Pose) -> bool {
        let Some(how) = self.settings.reposition_at_rapid(self.limits.metric) else { return false };
        if !self.is_known(&self.known) {
            return false;
        }
        let Some((over, count)) = self.blocks_out_and_over(pose, &how) else { return false };
        let Some(Event::Move(end)) = self.nc.get(self.next + over) else { return false };
        let stands = self.at;
        for number in 0..=over {
            let Some(Event::Move(part)) = self.nc.get(self.next + number) else { return false };
            if number > 0 {
                self.check_part(cl_line, &part, &end.to, Leg::OfPath);
            }
            self.at = part.to;
        }
        self.at = stands;
        self.take_way(cl_line, count, &how, (None, pose));
        self.exact = self.settings.forward.refine(self.at.rotary, pose.axis);
        true
    }

    /// Behind how many blocks the tool is over the end of a rapid motion, and how many blocks
    /// lead out, over and in.
    fn blocks_out_and_over(&self, pose: &Pose, how: &Reposition) -> Option<(usize, usize)> {
        let (forward, stands) = (&self.settings.forward, self.begins());
        let mut rotary = self.at.rotary;
        let mut over = None;
        for number in 0..MOST {
            let Some(Event::Move(found)) = self.nc.get(self.next + number) else { return None };
            let turns = (0..2).any(|n| (found.to.rotary[n] - rotary[n]).abs() > SMALL);
            if found.arc.is_some() || found.in_cycle {
                return None;
            }
            if number == 0 {
                if turns || !self.leads_out(&found, &stands, pose.axis, how) {
                    return None;
                }
                continue;
            }
            if over.is_some() && !turns && self.reaches(&found, pose) {
                let straight = self.comes_straight(self.next + number, pose);
                return over.filter(|_| straight).map(|over| (over, number + 1));
            }
            if found.course != Course::Rapid {
                return None;
            }
            let there = forward.pose(&found.to);
            let way = there.tip - pose.tip;
            let along = there.axis.angle(&pose.axis) <= self.axis_slack();
            if over.is_none() && along && self.is_away(way, &pose.axis, how, &found) {
                over = Some(number);
            }
            rotary = found.to.rotary;
        }
        None
    }

    /// After how many blocks of a line a way out and back begins, and how many it has.
    fn way_out_ahead(&self, pose: &Pose, how: &Reposition) -> Option<(usize, usize)> {
        let from = self.begins();
        let line = Way::line(from.tip, pose.tip);
        let mut at = self.at;
        for before in 0..MOST_BEFORE {
            let index = self.next + before;
            if let Some(count) = self.blocks_out_and_back(index, &at, pose, how) {
                return Some((before, count));
            }
            let Some(Event::Move(found)) = self.nc.get(index) else { return None };
            let tip = self.settings.forward.pose(&found.to).tip;
            let beside = line.foot(tip, 0.0).distance > self.tip_slack(&found.to);
            if !is_line(&found, Course::Feed) || beside || self.reaches(&found, pose) {
                return None;
            }
            at = found.to;
        }
        None
    }

    /// How many blocks from `index` on lead out and back, if they do.
    fn blocks_out_and_back(
        &self,
        index: usize,
        at: &Position,
        next: &Pose,
        how: &Reposition,
    ) -> Option<usize> {
        let forward = &self.settings.forward;
        let stands = forward.pose(at);
        let mut rotary = at.rotary;
        for count in 1..=MOST {
            let Some(Event::Move(found)) = self.nc.get(index + count - 1) else { return None };
            let pose = forward.pose(&found.to);
            let way = pose.tip - stands.tip;
            let slack = self.tip_slack(&found.to);
            let turns = (0..2).any(|n| (found.to.rotary[n] - rotary[n]).abs() > SMALL);
            if found.arc.is_some() || found.in_cycle {
                return None;
            }
            if count == 1 {
                if turns || !self.leads_out(&found, &stands, next.axis, how) {
                    return None;
                }
                continue;
            }
            let turned = (0..2).any(|n| (found.to.rotary[n] - at.rotary[n]).abs() > SMALL);
            let back = way.norm() <= slack && pose.axis.angle(&stands.axis) <= self.axis_slack();
            if turned && back && !turns && count > 2 {
                return self.comes_straight(index + count - 1, &stands).then_some(count);
            }
            if turns && found.course != Course::Rapid {
                return None;
            }
            rotary = found.to.rotary;
        }
        None
    }

    /// A block brings the tool out as far as the settings say.
    fn leads_out(&self, out: &Move, stands: &Pose, next: Vector3<f64>, how: &Reposition) -> bool {
        let way = self.settings.forward.pose(&out.to).tip - stands.tip;
        let directions = match how {
            Reposition { by_macro: true, .. } => [stands.axis, next],
            Reposition { along_next: true, .. } => [next; 2],
            _ => [stands.axis; 2],
        };
        directions.iter().any(|direction| self.is_away(way, direction, how, out))
    }

    /// A way leads along a direction, as far as the tool goes out.
    fn is_away(
        &self,
        way: Vector3<f64>,
        direction: &Vector3<f64>,
        how: &Reposition,
        at: &Move,
    ) -> bool {
        let slack = self.tip_slack(&at.to);
        let aside = (way - direction * way.dot(direction)).norm();
        let off = way.dot(direction) - how.distance;
        aside <= slack && off >= -slack && (how.by_macro || off <= slack)
    }

    /// A block comes to a point from one over it, along the tool.
    fn comes_straight(&self, index: usize, stands: &Pose) -> bool {
        let Some(Event::Move(before)) = self.nc.get(index - 1) else { return false };
        let pose = self.settings.forward.pose(&before.to);
        let way = pose.tip - stands.tip;
        let along = way.dot(&stands.axis);
        let aside = (way - stands.axis * along).norm();
        along > 0.0 && aside <= self.tip_slack(&before.to)
    }

    /// Takes the blocks: out and back to a pose with all that must be in force, the turn where
    /// the tool is away.
    fn take_way(
        &mut self,
        cl_line: u32,
        count: usize,
        how: &Reposition,
        (rate, end): (Option<Rate>, &Pose),
    ) {
        let mut before = Modes::default();
        for number in 0..count {
            let Some(Event::Move(found)) = self.nc.get(self.next) else { return };
            if number == 0 {
                before = found.modes;
            }
            let cuts = number == 0 || number + 1 == count;
            if cuts && found.course == Course::Feed && !how.by_macro {
                let own = how.rates[usize::from(number > 0)];
                self.check_rate(cl_line, self.at, &found, own.or(rate));
            }
            if cuts {
                self.take(cl_line, &found);
                self.next += 1;
                let stops = if number == 0 { how.stops } else { [None; 2] };
                for code in stops.into_iter().flatten() {
                    match how.by_macro {
                        true => self.allow_auxiliary(code),
                        false => self.ask_auxiliary(cl_line, Some(code)),
                    }
                }
            } else {
                self.check_limits(cl_line, &found);
                self.check_turn_away(cl_line, &found);
                self.check_comes_near(cl_line, &found, end, how);
                self.check_stands_still(cl_line, &found.modes, (&before, found.line), how);
                self.stand(&found);
            }
        }
    }

    /// The rapid back ends where the way at feed begins, or farther away.
    fn check_comes_near(&mut self, cl_line: u32, found: &Move, end: &Pose, how: &Reposition) {
        let way = self.settings.forward.pose(&found.to).tip - end.tip;
        let near = way.norm() < how.approach - self.tip_slack(&found.to);
        if near && found.course == Course::Rapid {
            let (is, must) = (short(way.norm()), short(how.approach));
            let message = format!("rapid to {is} from the part, it should stay {must} away");
            self.find(FindingKind::Order, Some(cl_line), Some(found.line), message);
        }
    }

    /// While the machine turns, spindle and coolant do what they did before, or are off where
    /// the settings say so.
    fn check_stands_still(
        &mut self,
        cl_line: u32,
        found: &Modes,
        (before, line): (&Modes, u32),
        how: &Reposition,
    ) {
        let spindle = if how.stands { Spindle::Off } else { before.spindle.turn };
        if found.spindle.turn != spindle && !(how.by_macro && found.spindle.turn == Spindle::Off) {
            let does = if how.stands { "stand" } else { "continue as before" };
            let message = format!("the spindle should {does} while the machine turns");
            self.find(FindingKind::Spindle, Some(cl_line), Some(line), message);
        }
        let coolant = if how.dry { None } else { before.coolant };
        if found.coolant != coolant && !(how.by_macro && found.coolant.is_none()) {
            let does = if how.dry { "be off" } else { "continue as before" };
            let message = format!("coolant should {does} while the machine turns");
            self.find(FindingKind::Coolant, Some(cl_line), Some(line), message);
        }
    }

    /// While the machine turns the tool is away by no less than the settings say.
    fn check_turn_away(&mut self, cl_line: u32, found: &Move) {
        let turns = (0..2).any(|n| (found.to.rotary[n] - self.at.rotary[n]).abs() > SMALL);
        let plunges = found.to.linear[2] < self.at.linear[2] - self.slack.linear[2];
        let is_along_axis = self.lie(found, &found.to, Leg::OfPath) != Lie::Leaning;
        if turns && plunges && is_along_axis && !found.to.names_tip() && self.limits.splits_rapids {
            let z = short(found.to.linear[2]);
            let message = format!("rapid turns the machine and plunges to Z{z} in one block");
            self.find(FindingKind::Order, Some(cl_line), Some(found.line), message);
        }
    }
}
