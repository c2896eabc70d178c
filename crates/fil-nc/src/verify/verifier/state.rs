//! What the verifier keeps from step to step, in groups.

use nalgebra::Point3;

use super::super::hole_tip::FromHole;
use super::super::thread_turns::Turns;
use crate::forward::Pose;
use crate::motion::Modes;

/// What holds of the tool since something has happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Fact {
    /// No motion came since the cutter was named.
    FreshCutter,
    /// No motion came since the tool was changed: where it is is not known.
    FreshTool,
    /// Z has not moved since the tool was changed.
    FreshHeight,
    /// The height of the program has been known before.
    HadHeight,
    /// The last motion was one of a pass.
    InGroove,
    /// The last motion of the tip was at feed.
    InCut,
    /// The tool has gone up for the end of tool center point control.
    Up,
    /// The tool has gone up before tool center point control takes off the length it was brought
    /// with.
    Above,
    /// A tool change or a position of the machine has brought the tool away from the part.
    Away,
}

/// Those that a motion of X, Y or Z ends.
pub(super) const ENDED_BY_MOTION: [Fact; 3] = [Fact::FreshCutter, Fact::FreshTool, Fact::Above];

/// The facts that hold, a bit for each.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Facts(u16);

impl Facts {
    pub(super) fn at_start() -> Self {
        Facts(1 << Fact::Away as u16)
    }

    pub(in super::super) fn has(self, fact: Fact) -> bool {
        self.0 & (1 << fact as u16) != 0
    }

    pub(in super::super) fn set(&mut self, fact: Fact, holds: bool) {
        let bit = 1 << fact as u16;
        self.0 = if holds { self.0 | bit } else { self.0 & !bit };
    }

    pub(in super::super) fn end_unless(&mut self, fact: Fact, stays: bool) {
        self.set(fact, self.has(fact) && stays);
    }

    pub(in super::super) fn add_if(&mut self, fact: Fact, begins: bool) {
        self.set(fact, self.has(fact) || begins);
    }
}

/// The last motion taken.
#[derive(Default)]
pub(in super::super) struct LastMotion {
    /// Its line in the program.
    pub(in super::super) line: u32,
    /// A cycle of the control made it, and no record has ended that since.
    pub(in super::super) in_cycle: bool,
    pub(in super::super) modes: Modes,
    /// It was one under tool center point control.
    pub(super) tip: bool,
    /// Its unusual plane, by the index of its normal.
    pub(in super::super) plane: Option<usize>,
}

/// How the axes are written, and how far they go, in the unit of the program at hand.
pub(in super::super) struct AxisLimits {
    pub(in super::super) metric: bool,
    /// Travel of the linear axes, mm.
    pub(in super::super) travel: [(f64, f64); 3],
    pub(in super::super) written: [bool; 3],
    pub(in super::super) splits_rapids: bool,
    /// What the program multiplies X by.
    pub(in super::super) x_scale: f64,
}

/// What a step leaves for those after it.
#[derive(Default)]
pub(in super::super) struct StepMemory {
    /// Where the rapid has ended that is the last motion.
    pub(in super::super) rapid_end: Option<Pose>,
    /// Where the rapid at hand leads, as the CL file names it.
    pub(in super::super) rapid_to: Option<Pose>,
    /// End of the last arc in the CL file, and as the machine corrects it.
    pub(in super::super) corrected_end: Option<[Point3<f64>; 2]>,
    /// Where the axes stand in the frame of the machine, mm and degrees, as long as nothing has moved
    /// them from there.
    pub(in super::super) machine_at: [Option<f64>; 5],
    /// Level the control's cycle began from.
    pub(in super::super) initial: Option<f64>,
    /// From the directions of the hole, in which its moves are written.
    pub(in super::super) from_hole: Option<FromHole>,
    /// Stops whose next record is not known: lines of the CL file, and their codes.
    pub(in super::super) held_stops: Vec<(u32, u32)>,
    /// The program begins again with a later operation: what those before it have switched on is
    /// not in force at its tool change.
    pub(in super::super) begins_again: bool,
    /// How the spindle turned in the passes of the thread so far.
    pub(in super::super) thread_turns: Option<Turns>,
}

/// What words of the user's own do.
pub(in super::super) struct UserWords {
    /// The first and the last line of the program that may hold them.
    pub(in super::super) lines: [u32; 2],
    /// F that REPEAT writes into each motion, beside its own, as on the tape.
    pub(in super::super) repeated_feed: Option<f64>,
    /// Lines of statements that no record asks for, which were reported.
    pub(in super::super) unasked: [Option<u32>; 2],
}
