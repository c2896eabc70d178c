//! What the G functions of a SINUMERIK do, by the manual of its language.

use crate::dialect::FeedMode;
use crate::motion::Compensation;

/// What a function asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Function {
    Rapid,
    Linear,
    Arc {
        ccw: bool,
    },
    /// One pass of a thread.
    Thread,
    /// One pass whose lead grows, or shrinks, by F in each turn.
    VaryingThread {
        shrinks: bool,
    },
    /// Into a tapped hole, or back out, in step with a spindle under position control.
    RigidTap {
        back: bool,
    },
    Plane(usize),
    Compensation(Compensation),
    /// Inches or millimeters; of lengths alone, or of feeds too.
    Units {
        metric: bool,
        feeds: bool,
    },
    Positions {
        absolute: bool,
    },
    Feed(FeedMode),
    /// S is a surface speed or turns a minute, with a feed a turn or a minute.
    Surface {
        /// A surface speed.
        on: bool,
        /// How the feed counts.
        feed: FeedMode,
    },
    /// A work offset, or none (500).
    Offset(u32),
    Dwell,
    /// The axes of the block are in the frame of the machine.
    Machine,
    /// To a fixed or reference point.
    FixedPoint,
    /// How exactly the path is followed: no motion of its own.
    PathControl,
}

impl Function {
    /// Functions of a group exclude each other.
    pub(super) fn group(self) -> u8 {
        match self {
            Function::Rapid
            | Function::Linear
            | Function::Arc { .. }
            | Function::Thread
            | Function::VaryingThread { .. }
            | Function::RigidTap { .. } => 1,
            Function::Plane(_) => 2,
            Function::Compensation(_) => 3,
            Function::Units { .. } => 4,
            Function::Positions { .. } => 5,
            Function::Feed(_) | Function::Surface { .. } => 6,
            Function::Offset(_) => 7,
            Function::Dwell | Function::Machine | Function::FixedPoint => 8,
            Function::PathControl => 0,
        }
    }
}

/// The function of a number; `None` for one that is not followed.
pub(super) fn function(code: u32) -> Option<Function> {
    use Function as F;
    Some(match code {
        0 => F::Rapid,
        1 => F::Linear,
        2 => F::Arc { ccw: false },
        3 => F::Arc { ccw: true },
        4 => F::Dwell,
        17 => F::Plane(2),
        18 => F::Plane(1),
        19 => F::Plane(0),
        33 => F::Thread,
        34 => F::VaryingThread { shrinks: false },
        35 => F::VaryingThread { shrinks: true },
        331 => F::RigidTap { back: false },
        332 => F::RigidTap { back: true },
        40 => F::Compensation(Compensation::Off),
        41 => F::Compensation(Compensation::Left),
        42 => F::Compensation(Compensation::Right),
        53 | 153 => F::Machine,
        54..=57 | 500 | 505..=599 => F::Offset(code),
        70 => F::Units { metric: false, feeds: false },
        71 => F::Units { metric: true, feeds: false },
        74 | 75 => F::FixedPoint,
        90 => F::Positions { absolute: true },
        91 => F::Positions { absolute: false },
        93 => F::Feed(FeedMode::Inverse),
        94 => F::Feed(FeedMode::PerMinute),
        95 => F::Feed(FeedMode::PerTurn),
        96 => F::Surface { on: true, feed: FeedMode::PerTurn },
        97 | 973 => F::Surface { on: false, feed: FeedMode::PerTurn },
        961 => F::Surface { on: true, feed: FeedMode::PerMinute },
        971 => F::Surface { on: false, feed: FeedMode::PerMinute },
        700 => F::Units { metric: false, feeds: true },
        710 => F::Units { metric: true, feeds: true },
        9 | 60 | 64 | 450 | 451 | 601..=603 | 641..=645 => F::PathControl,
        _ => return None,
    })
}
