//! What a program does, counted along the CL path: lengths, times, extents, tools.
//!
//! Times are those of the programmed feeds and of the machine's rapid traverse
//! (`rapid.rate`), without acceleration; a hole is its way down at the feed of its cycle
//! and back at rapid.

use std::f64::consts::TAU;

use fil_cl::{Record, Word, record::kind, words};
use fil_machine::commons::EMPTY;
use fil_machine::modes::{FeedMode, Unit};
use fil_machine::{Commons, Kind};
use fil_post::Post;
use fil_post::operation::{Arc, Feed, SpindleSpeed};
use fil_post::path::cycle::CycleFeed;

use crate::report::Extents;

/// DBLCOM with the rapid traverse, mm/min, and with the seconds of a tool change.
const RAPID_RATE: u32 = 107;
const CHANGE_TIME: u32 = 481;

const MM_IN_AN_INCH: f64 = 25.4;

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
}

impl Totals {
    /// All of the time.
    pub fn seconds(&self) -> f64 {
        self.cutting_seconds + self.rapid_seconds + self.other_seconds
    }

    fn add(&mut self, motion: &Motion) {
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
        Extents::add(&mut self.extents, motion.point);
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
    /// Its length; of a hole the way to it.
    pub length: f64,
    /// Its time; `None` where it can't be told.
    pub seconds: Option<f64>,
}

/// What the post knew before a record.
pub(crate) struct Before {
    point: Option<[f64; 3]>,
    arc: Option<Arc>,
    rapid: bool,
}

impl Before {
    pub fn new(post: &Post) -> Self {
        Before { point: post.point(), arc: post.path.arc, rapid: post.path.rapid.is_some() }
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
            words::LOADTL | words::LOAD | words::TURRET => {
                let time = setting(commons, CHANGE_TIME).unwrap_or(0.0);
                self.total.other_seconds += time;
                let mut tool = ToolTotals { tool: first_number(record), ..ToolTotals::default() };
                tool.diameter = post.cutter_diameter();
                tool.totals.other_seconds = time;
                self.tools.push(tool);
            }
            words::DELAY if !record.has(words::REV) => {
                let time = first_number(record).unwrap_or(0.0);
                self.total.other_seconds += time;
                self.current().totals.other_seconds += time;
            }
            words::CUTTER => self.current().diameter = post.cutter_diameter(),
            _ => {}
        }
        if record.kind != kind::MOTION || record.major == words::FROM {
            return None;
        }
        let motion = motion(before, post)?;
        self.total.add(&motion);
        self.current().totals.add(&motion);
        Some(motion)
    }

    fn current(&mut self) -> &mut ToolTotals {
        if self.tools.is_empty() {
            self.tools.push(ToolTotals::default());
        }
        self.tools.last_mut().expect("it was just pushed")
    }
}

fn motion(before: &Before, post: &Post) -> Option<Motion> {
    let point = post.point()?;
    let start = before.point.unwrap_or(point);
    let length =
        before.arc.map_or_else(|| distance(start, point), |arc| arc_length(&arc, start, point));
    let rate = rapid_rate(post);
    let feed = post.path.feed;
    if let Some(cycle) = &post.path.cycle {
        let down = cycle.depth + cycle.clear;
        let feed = match &cycle.feed {
            CycleFeed::Feed(feed) => Some(*feed),
            CycleFeed::Lead(_) => None,
        };
        let way = rate.map(|rate| (length + down) / rate * 60.0);
        let hole = feed.and_then(|feed| at_feed(down, &feed, post));
        let seconds = way.zip(hole).map(|(way, hole)| way + hole);
        return Some(Motion {
            point,
            rapid: false,
            feed: feed.map(|feed| feed.value),
            length,
            seconds,
        });
    }
    if before.rapid && before.arc.is_none() {
        let seconds = rate.map(|rate| length / rate * 60.0);
        return Some(Motion { point, rapid: true, feed: None, length, seconds });
    }
    let seconds = feed.and_then(|feed| at_feed(length, &feed, post));
    Some(Motion { point, rapid: false, feed: feed.map(|feed| feed.value), length, seconds })
}

fn at_feed(length: f64, feed: &Feed, post: &Post) -> Option<f64> {
    let per_minute = if feed.mode == FeedMode::PerMinute {
        feed.value
    } else if let (FeedMode::PerRevolution, Some(SpindleSpeed::Revolutions(rpm))) =
        (feed.mode, post.control.speed)
    {
        feed.value * rpm
    } else {
        return None;
    };
    (per_minute > 0.0).then(|| length / per_minute * 60.0)
}

/// Rapid traverse in the unit of the CL file a minute.
fn rapid_rate(post: &Post) -> Option<f64> {
    let rate = setting(&post.control.commons, RAPID_RATE).filter(|rate| *rate > 0.0)?;
    Some(if post.unit() == Some(Unit::Inch) { rate / MM_IN_AN_INCH } else { rate })
}

fn setting(commons: &Commons, location: u32) -> Option<f64> {
    commons.get(Kind::Dbl, location).ok().filter(|value| *value != EMPTY)
}

fn first_number(record: &Record) -> Option<f64> {
    record.data.iter().find_map(|word| match word {
        Word::Number(number) => Some(*number),
        _ => None,
    })
}

fn distance(from: [f64; 3], to: [f64; 3]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt()
}

/// Length of an arc or helix between two points.
fn arc_length(arc: &Arc, from: [f64; 3], to: [f64; 3]) -> f64 {
    let center = [arc.center.x, arc.center.y, arc.center.z];
    let axis = [arc.axis.x, arc.axis.y, arc.axis.z];
    let (from, low) = in_plane(minus(from, center), axis);
    let (to, high) = in_plane(minus(to, center), axis);
    let radius = arc.radius.unwrap_or_else(|| dot(from, from).sqrt());
    let angle = dot(axis, cross(from, to)).atan2(dot(from, to));
    let mut angle = if angle < 0.0 { angle + TAU } else { angle };
    // Ends that meet are a full circle.
    if angle < 1e-9 && arc.turns == 0.0 {
        angle = TAU;
    }
    (radius * (angle + arc.turns * TAU)).hypot(high - low)
}

/// The part of a vector across an axis, and its length along it.
fn in_plane(vector: [f64; 3], axis: [f64; 3]) -> ([f64; 3], f64) {
    let along = dot(vector, axis);
    (minus(vector, axis.map(|part| part * along)), along)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
