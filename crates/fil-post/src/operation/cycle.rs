//! A canned cycle: what its record asks for, and a hole of it on the machine.

pub use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Point3, Vector3};

use super::{Feed, Lead};
use crate::cause::Cause;

/// How fast the tool goes down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CycleFeed {
    /// At a feed.
    Feed(Feed),
    /// By the lead of a tap.
    Lead(Lead),
}

impl CycleFeed {
    /// The same feed, whoever has said it.
    pub fn is_as_fast_as(&self, other: &Self) -> bool {
        match (self, other) {
            (CycleFeed::Feed(one), CycleFeed::Feed(two)) => {
                one.value == two.value && one.asked == two.asked && one.mode == two.mode
            }
            (CycleFeed::Lead(one), CycleFeed::Lead(two)) => one.value == two.value,
            _ => false,
        }
    }
}

/// Where the tip is above the holes of a cycle, in the part.
#[derive(Clone, Copy, Debug)]
pub struct AboveHoles {
    /// Before the first of them.
    pub before: Point3<f64>,
    /// The tool axis there.
    pub axis: Vector3<f64>,
    /// After the last one.
    pub now: Point3<f64>,
}

/// A cycle in force. Lengths in mm or inch.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Its kind.
    pub kind: CycleKind,
    /// Depth below the hole's start, positive.
    pub depth: f64,
    /// Gaps between the plates that the hole leads through: how deep each begins and ends.
    pub plates: Vec<[f64; 2]>,
    /// Where the tip was before the first hole through several plates, in the part.
    pub came_from: Option<Point3<f64>>,
    /// R level above the hole's start.
    pub clear: f64,
    /// Level above the hole's start to retract to, and to come from; 0 is the level before the
    /// cycle.
    pub retract: Option<f64>,
    /// Peck.
    pub step: Option<f64>,
    /// Of so many pecks that break chips the last one leaves the hole (TIMES).
    pub out_each: Option<u32>,
    /// Dwell at the bottom, seconds.
    pub dwell: f64,
    /// Feed.
    pub feed: CycleFeed,
    /// The feed is that of FEDRAT, and not of the CYCLE itself.
    pub feed_of_fedrat: bool,
    /// Turns of the spindle at the first hole of a tap at a feed a minute, whose lead hangs on them.
    pub turns: Option<f64>,
    /// A tap in step with the spindle (HIGH), with its code where the machine has one.
    pub rigid: bool,
    /// Level of the tool before the cycle along the drilling axis, machine
    /// coordinates; `None` when it is to be taken from the tape at the next hole.
    pub initial: Option<f64>,
    /// Where the tip is above the holes, under tool-tip control.
    pub above: Option<AboveHoles>,
    /// The CYCLE record.
    pub cause: Cause,
    /// Its words with values.
    pub words: CycleWords,
    /// The axis that the last hole ran along.
    pub along: Option<usize>,
    /// What the control has of the last hole, while it is in the cycle.
    pub in_force: Option<Hole>,
}

/// The words of a CYCLE record that hold a value; 0 for one that has none.
#[derive(Clone, Copy, Debug, Default)]
pub struct CycleWords {
    /// DEPTH
    pub depth: u16,
    /// CLEAR
    pub clear: u16,
    /// STEP
    pub step: u16,
    /// DWELL
    pub dwell: u16,
}

/// A hole along a linear axis of the machine: levels after all transformations but
/// the output scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Number of the drilling axis, 0 to 2 for X Y Z.
    pub along: usize,
    /// Bottom.
    pub bottom: f64,
    /// R level.
    pub clear: f64,
    /// Level before the cycle.
    pub initial: f64,
    /// Retract to the level before the cycle (G98).
    pub to_initial: bool,
}

impl Hole {
    /// Where the tool stands after the hole.
    pub fn rest(&self) -> f64 {
        if self.to_initial { self.initial } else { self.clear }
    }
}

impl Cycle {
    /// The tool leaves the hole after its peck of this number, counted from 1.
    pub fn leaves_after(&self, peck: u32) -> bool {
        self.kind == CycleKind::Deep || self.out_each.is_some_and(|each| peck.is_multiple_of(each))
    }

    /// The CYCLE record at one of its words.
    pub fn due_to(&self, word: u16) -> Cause {
        Cause { word, ..self.cause }
    }
}
