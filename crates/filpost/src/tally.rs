//! What a program does, counted along the CL path: lengths, times, extents, tools.
//!
//! Times are those of the programmed feeds and of the machine's rapid traverse
//! (`rapid.rate`, `rotary.rapid_rate`), without acceleration; a hole is its way to the R level, down in its pecks
//! and out again as its cycle goes.

mod hole;

use fil_cl::{Record, record::kind, words};
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self, RapidSplit};
use fil_machine::modes::{FeedMode, INCH, Unit};
use fil_machine::{Commons, Kind};
use fil_post::Post;
use fil_post::operation::cycle::{Cycle, CycleFeed};
use fil_post::operation::{Arc, Feed, SpindleSpeed};

use crate::reach::{ArcPath, distance};
use crate::report::Extents;

pub(crate) use hole::Hole;

/// DBLCOM with the rapid traverse, mm/min, and with the seconds of a tool change.
const RAPID_RATE: u32 = 107;
const CHANGE_TIME: u32 = 481;

/// DBLCOM with the rapid speed of the rotary axes, degrees a minute.
const TURNING_RATE: u32 = 111;

/// Lengths in the unit of the CL file, times in seconds.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Totals {
    /// Length of the path at feed.
    pub cutting_length: f64,
    /// Length of the path at rapid traverse.
    pub rapid_length: f64,
    /// Time at feed.
    pub cutting_seconds: f64,
    /// Time at rapid traverse.
    pub rapid_seconds: f64,
    /// Time of tool changes and dwells.
    pub other_seconds: f64,
    /// Motions whose time can't be told: a feed per revolution without spindle speed, a
    /// constant surface speed.
    pub untimed: u64,
    /// The box around the points.
    pub extents: Option<Extents>,
    /// The box around the path of the tool's tip: arcs and the bottoms of holes included, the
    /// start of the first motion not.
    pub reach: Option<Extents>,
}

impl Totals {
    /// All of the time.
    pub fn seconds(&self) -> f64 {
        self.cutting_seconds + self.rapid_seconds + self.other_seconds
    }

    /// Counts a motion.
    pub(crate) fn add(&mut self, motion: &Motion) {
        if let Some(hole) = motion.hole {
            self.add_hole(motion, hole);
        } else {
            self.add_way(motion);
        }
        Extents::add(&mut self.extents, motion.point);
        self.widen(&motion.reach);
    }

    fn add_hole(&mut self, motion: &Motion, hole: Hole) {
        self.rapid_length += motion.length + hole.rapid;
        self.cutting_length += hole.cutting;
        self.other_seconds += hole.dwell;
        match (motion.seconds, hole.cutting_seconds) {
            (Some(all), Some(cutting)) => {
                self.cutting_seconds += cutting;
                self.rapid_seconds += all - cutting - hole.dwell;
            }
            _ => self.untimed += 1,
        }
    }

    fn add_way(&mut self, motion: &Motion) {
        let (length, seconds) = if motion.rapid {
            (&mut self.rapid_length, &mut self.rapid_seconds)
        } else {
            (&mut self.cutting_length, &mut self.cutting_seconds)
        };
        *length += motion.length;
        match motion.seconds {
            Some(time) => *seconds += time,
            None => self.untimed += 1,
        }
    }

    fn widen(&mut self, to: &Extents) {
        Extents::add(&mut self.reach, to.min);
        Extents::add(&mut self.reach, to.max);
    }

    /// Counts all that others count.
    pub(crate) fn join(&mut self, other: &Totals) {
        self.cutting_length += other.cutting_length;
        self.rapid_length += other.rapid_length;
        self.cutting_seconds += other.cutting_seconds;
        self.rapid_seconds += other.rapid_seconds;
        self.other_seconds += other.other_seconds;
        self.untimed += other.untimed;
        if let Some(points) = &other.extents {
            Extents::add(&mut self.extents, points.min);
            Extents::add(&mut self.extents, points.max);
        }
        if let Some(reach) = &other.reach {
            self.widen(reach);
        }
    }
}

/// What is done with one tool, from its change to the next one.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ToolTotals {
    /// Its number; `None` before the first tool change.
    pub tool: Option<f64>,
    /// Its diameter as the CL file gives it, in the unit of the CL file.
    pub diameter: Option<f64>,
    /// What is done with it.
    pub totals: Totals,
}

/// The counts of a run.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Tally {
    /// Of the whole program.
    pub total: Totals,
    /// By tool, in the order of the tool changes.
    pub tools: Vec<ToolTotals>,
    /// Where the tool stands behind a hole, until its next motion.
    rest: Option<[f64; 3]>,
}

/// A motion that was carried out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Motion {
    /// Where it ends, in the frame and the unit of the CL file.
    pub point: [f64; 3],
    /// At rapid traverse.
    pub rapid: bool,
    /// Its feed, per minute or per revolution; `None` for a rapid motion.
    pub feed: Option<f64>,
    /// Its feed counts revolutions of the spindle.
    pub per_revolution: bool,
    /// Turns of the spindle a minute, where the CL file gives them.
    pub turns: Option<f64>,
    /// Its length; of a hole the way to its R level.
    pub length: f64,
    /// Its time; `None` where it can't be told.
    pub seconds: Option<f64>,
    /// The box around it, without its start.
    pub(crate) reach: Extents,
    /// What it does at feed where it ends in a hole.
    pub(crate) hole: Option<Hole>,
}

impl Motion {
    /// Seconds that the tool waits at the bottom of a hole.
    pub(crate) fn dwell(&self) -> f64 {
        self.hole.map_or(0.0, |hole| hole.dwell)
    }
}

/// What the post knew before a record.
pub(crate) struct Before {
    point: Option<[f64; 3]>,
    arc: Option<Arc>,
    rapid: bool,
    /// Where the rotary axes stood, degrees.
    rotary: Option<[f64; 2]>,
}

impl Before {
    pub fn new(post: &Post) -> Self {
        Before {
            point: post.point(),
            arc: post.path.arc,
            rapid: post.path.rapid.is_some(),
            rotary: post.path.rotary,
        }
    }
}

impl Tally {
    /// Counts a record that the post has carried out; gives its motion.
    pub(crate) fn count(
        &mut self,
        before: &Before,
        record: &Record,
        post: &Post,
    ) -> Option<Motion> {
        let commons = &post.control.commons;
        match record.major {
            _ if record.takes_tool() => {
                let time = setting(commons, CHANGE_TIME).unwrap_or(0.0);
                self.total.other_seconds += time;
                let mut tool = ToolTotals { tool: record.first_number(), ..ToolTotals::default() };
                tool.totals.other_seconds = time;
                self.tools.push(tool);
            }
            words::DELAY => match delay(record, post) {
                Some(time) => {
                    self.total.other_seconds += time;
                    self.current().totals.other_seconds += time;
                }
                None => {
                    self.total.untimed += 1;
                    self.current().totals.untimed += 1;
                }
            },
            words::ROTABL | words::ROTATE => {
                let time = turning_seconds(before, post);
                self.total.rapid_seconds += time;
                self.current().totals.rapid_seconds += time;
            }
            _ => {}
        }
        let goes_home = record.major == words::GOHOME && post.point().is_some();
        if !goes_home && (record.kind != kind::MOTION || record.major == words::FROM) {
            return None;
        }
        let start = self.rest.take().or(before.point);
        let motion = motion(before, start, post)?;
        self.rest = motion.hole.map(|hole| hole.rests_at(motion.point, post));
        self.total.add(&motion);
        let tool = self.current();
        tool.totals.add(&motion);
        tool.diameter = tool.diameter.or(post.cutter_diameter());
        Some(motion)
    }

    fn current(&mut self) -> &mut ToolTotals {
        if self.tools.is_empty() {
            self.tools.push(ToolTotals::default());
        }
        self.tools.last_mut().expect("it was just pushed")
    }
}

fn motion(before: &Before, start: Option<[f64; 3]>, post: &Post) -> Option<Motion> {
    let point = post.point()?;
    let start = start.unwrap_or(point);
    let arc = before.arc.map(|arc| ArcPath::new(&arc, start, point));
    let length = arc.as_ref().map_or_else(|| distance(start, point), ArcPath::length);
    let feed = post.path.feed;
    // A rapid motion within a cycle drills no hole.
    if let Some(cycle) = post.path.cycle.as_ref().filter(|_| !before.rapid) {
        let (hole, length) = Hole::new(cycle, start, point, post);
        let seconds = hole.seconds(length, post);
        let feed = match &cycle.feed {
            CycleFeed::Feed(feed) => Some(*feed),
            CycleFeed::Lead(_) => None,
        };
        let down = hole_reach(point, cycle, post);
        let motion = at_rate(point, feed, down, post);
        return Some(Motion { length, seconds, hole: Some(hole), ..motion });
    }
    let reach = reach(point, arc.as_ref());
    if before.rapid && before.arc.is_none() {
        let seconds =
            rapid_rate(post).map(|rate| rapid_seconds(length / rate * 60.0, before, post));
        return Some(Motion { rapid: true, length, seconds, ..at_rate(point, None, reach, post) });
    }
    let seconds = feed.and_then(|feed| at_feed(length, &feed, post));
    Some(Motion { length, seconds, ..at_rate(point, feed, reach, post) })
}

/// A motion with its feed, whose length and time are still to be told.
fn at_rate(point: [f64; 3], feed: Option<Feed>, reach: Extents, post: &Post) -> Motion {
    let turns = turns_of(post);
    Motion {
        point,
        rapid: false,
        feed: feed.map(|feed| feed.value),
        per_revolution: feed.is_some_and(|feed| feed.mode == FeedMode::PerRevolution),
        turns,
        length: 0.0,
        seconds: None,
        reach,
        hole: None,
    }
}

/// The box around a motion to a point: an arc or a line.
fn reach(point: [f64; 3], arc: Option<&ArcPath>) -> Extents {
    let mut extents = None;
    Extents::add(&mut extents, point);
    if let Some(arc) = arc {
        arc.widen(&mut extents);
    }
    extents.unwrap_or(Extents { min: point, max: point })
}

/// The box around a hole, down to its bottom.
fn hole_reach(point: [f64; 3], cycle: &Cycle, post: &Post) -> Extents {
    let axis = post.path.axis.given;
    let down = [axis.x, axis.y, axis.z].map(|part| part * cycle.depth);
    let mut extents = None;
    Extents::add(&mut extents, point);
    Extents::add(&mut extents, [0, 1, 2].map(|i| point[i] - down[i]));
    extents.unwrap_or(Extents { min: point, max: point })
}

/// Turns of the spindle a minute, where the CL file gives them.
fn turns_of(post: &Post) -> Option<f64> {
    match post.control.spindle.speed {
        Some(SpindleSpeed::Revolutions(turns)) => Some(turns),
        _ => None,
    }
}

/// Seconds of a DELAY; `None` for turns of a spindle whose speed is not known.
fn delay(record: &Record, post: &Post) -> Option<f64> {
    let value = record.first_number().unwrap_or(0.0);
    if !record.has(words::REV) {
        return Some(value);
    }
    turns_of(post).filter(|turns| *turns > 0.0).map(|turns| value / turns * 60.0)
}

fn at_feed(length: f64, feed: &Feed, post: &Post) -> Option<f64> {
    let per_minute = if feed.mode == FeedMode::PerMinute {
        feed.value
    } else if feed.mode == FeedMode::PerRevolution {
        feed.value * turns_of(post)?
    } else {
        return None;
    };
    (per_minute > 0.0).then(|| length / per_minute * 60.0)
}

/// Rapid traverse in the unit of the CL file a minute.
fn rapid_rate(post: &Post) -> Option<f64> {
    let rate = setting(&post.control.commons, RAPID_RATE).filter(|rate| *rate > 0.0)?;
    Some(if post.unit() == Some(Unit::Inch) { rate / INCH } else { rate })
}

/// Seconds of a rapid motion whose way takes so long: as the turn of the machine before its Z, or
/// in the same block.
fn rapid_seconds(way: f64, before: &Before, post: &Post) -> f64 {
    let turn = turning_seconds(before, post);
    match post.control.commons.read(locations::RAPID_SPLIT) {
        RapidSplit::OneBlock => way.max(turn),
        _ => way + turn,
    }
}

/// Seconds that the rotary axes take at rapid to where they stand.
fn turning_seconds(before: &Before, post: &Post) -> f64 {
    let rate = setting(&post.control.commons, TURNING_RATE).filter(|rate| *rate > 0.0);
    let (Some(rate), Some(to)) = (rate, post.path.rotary) else { return 0.0 };
    let from = before.rotary.unwrap_or(to);
    (to[0] - from[0]).abs().max((to[1] - from[1]).abs()) / rate * 60.0
}

fn setting(commons: &Commons, location: u32) -> Option<f64> {
    commons.get(Kind::Dbl, location).ok().filter(|value| *value != EMPTY)
}
