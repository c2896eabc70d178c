//! What a hole adds to lengths and times: the way to its R level, the way down, pecks,
//! the dwell at its bottom and the way out.

use fil_machine::locations::{self as loc, CycleBoreOut};
use fil_machine::modes::{INCH, Unit};
use fil_post::Post;
use fil_post::operation::cycle::{Cycle, CycleFeed, CycleKind};

use super::{at_feed, rapid_rate, turns_of};
use crate::reach::distance;

/// A hole as it is drilled. Lengths in the unit of the CL file, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hole {
    /// From the R level to the bottom.
    pub(crate) down: f64,
    /// At feed: down, and out of a tapped or bored hole.
    pub(super) cutting: f64,
    pub(super) cutting_seconds: Option<f64>,
    /// At rapid between pecks and out of the hole; the way to it is not counted.
    pub(super) rapid: f64,
    /// At the bottom.
    pub(super) dwell: f64,
    /// Where the tool stands after it, above the point of the CL file.
    rest: f64,
}

impl Hole {
    /// The hole of the cycle in force that the post has just drilled, and the way to its R
    /// level from where the tool stood: over the hole at its level, then down or up.
    pub(super) fn new(cycle: &Cycle, from: [f64; 3], to: [f64; 3], post: &Post) -> (Self, f64) {
        let axis = [post.path.axis.given.x, post.path.axis.given.y, post.path.axis.given.z];
        let height: f64 = (0..3).map(|i| (from[i] - to[i]) * axis[i]).sum();
        let over = [0, 1, 2].map(|i| to[i] + axis[i] * height);
        let way = distance(from, over) + (height - cycle.clear).abs();
        let rest = rest(cycle, height);
        let down = cycle.depth + cycle.clear;
        let (lifts, again) = pecks(cycle, down, post);
        let leaves_at_feed = leaves_at_feed(cycle, post);
        let out = if leaves_at_feed { down } else { 0.0 };
        let cutting = down + again + out;
        let hole = Hole {
            down,
            cutting,
            cutting_seconds: seconds(cycle, cutting, post),
            rapid: lifts + (rest + cycle.depth - out).max(0.0),
            dwell: cycle.dwell,
            rest,
        };
        (hole, way)
    }

    /// Where the tool stands behind the hole of a point.
    pub(super) fn rests_at(&self, point: [f64; 3], post: &Post) -> [f64; 3] {
        let axis = [post.path.axis.given.x, post.path.axis.given.y, post.path.axis.given.z];
        [0, 1, 2].map(|i| point[i] + axis[i] * self.rest)
    }

    /// All of its time, the way to it included; `None` where it can't be told.
    pub(super) fn seconds(&self, way: f64, post: &Post) -> Option<f64> {
        let rate = rapid_rate(post)?;
        Some((way + self.rapid) / rate * 60.0 + self.cutting_seconds? + self.dwell)
    }
}

/// Height above the hole's point at which the tool stays: that of the control's cycle where
/// one was written.
fn rest(cycle: &Cycle, height: f64) -> f64 {
    if let Some(hole) = cycle.in_force {
        return (hole.rest() - hole.bottom).abs() - cycle.depth;
    }
    match cycle.retract {
        None => cycle.clear,
        Some(0.0) => height.max(cycle.clear),
        Some(level) => level.max(cycle.clear),
    }
}

/// What pecks add: rapid out of the hole and back, and the feed of the ways that are cut
/// twice.
fn pecks(cycle: &Cycle, down: f64, post: &Post) -> (f64, f64) {
    let Some(step) = cycle.step.filter(|step| *step > 0.0) else { return (0.0, 0.0) };
    let commons = &post.control.commons;
    let gap = commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
    let gap = if post.unit() == Some(Unit::Inch) { gap / INCH } else { gap };
    let lifts = ((down / step - 1e-9).ceil() - 1.0).max(0.0);
    let again = gap * lifts;
    match cycle.kind {
        CycleKind::Brkchp => (again, again),
        // Out from each depth but the last, and back to the gap above it.
        _ => ((step * lifts * (lifts + 1.0) - again).max(0.0), again),
    }
}

/// Taps come back at their lead, and some cycles leave a bored hole at feed.
fn leaves_at_feed(cycle: &Cycle, post: &Post) -> bool {
    let commons = &post.control.commons;
    match cycle.kind {
        CycleKind::Tap => true,
        CycleKind::Bore | CycleKind::Ream => match commons.read(cycle.kind.code()) {
            Some(code) => matches!(code, 85 | 89 | 201),
            None => commons.read(loc::CYCLE_BORE_OUT) != CycleBoreOut::AtRapidSpindleStopped,
        },
        _ => false,
    }
}

fn seconds(cycle: &Cycle, length: f64, post: &Post) -> Option<f64> {
    match &cycle.feed {
        CycleFeed::Feed(feed) => at_feed(length, feed, post),
        CycleFeed::Lead(lead) => {
            let a_minute = lead.value * turns_of(post)?;
            (a_minute > 0.0).then(|| length / a_minute * 60.0)
        }
    }
}
