//! What a random CL program asks of the machine, lengths in mm.

use crate::path::{Axis, Point};

/// Values that are right for a mode at a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Want<T> {
    /// The CL program says nothing about it, or the machine decides.
    Any,
    /// One of these.
    OneOf(Vec<T>),
}

impl<T: PartialEq + Clone> Want<T> {
    /// Exactly this value.
    pub fn only(value: T) -> Self {
        Want::OneOf(vec![value])
    }

    /// These values and those of another.
    pub fn or(&self, other: &Want<T>) -> Want<T> {
        match (self, other) {
            (Want::OneOf(a), Want::OneOf(b)) => Want::OneOf([&a[..], b].concat()),
            _ => Want::Any,
        }
    }

    /// True when the value, by a comparison, is one of the right ones.
    pub fn accepts(&self, same: impl FnMut(&T) -> bool) -> bool {
        match self {
            Want::Any => true,
            Want::OneOf(values) => values.iter().any(same),
        }
    }
}

/// A feed: mm a minute or a revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// The number.
    pub value: f64,
    /// A revolution, not a minute.
    pub per_revolution: bool,
}

/// What the spindle does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turning {
    /// It stands.
    Stopped,
    /// It turns.
    At {
        /// Revolutions a minute.
        speed: f64,
        /// Counterclockwise.
        ccw: bool,
    },
    /// It turns so that the surface goes by at one speed.
    Surface {
        /// Metres a minute, or feet in a program in inches.
        speed: f64,
        /// Counterclockwise.
        ccw: bool,
    },
}

/// What flows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coolant {
    /// Flood.
    pub flood: bool,
    /// Mist.
    pub mist: bool,
}

/// Cutter compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// None.
    Off,
    /// To the left, with this offset number.
    Left(u32),
    /// To the right, with this offset number.
    Right(u32),
}

/// What must be in force while a step is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// The feed; of no account in a rapid.
    pub feed: Want<Rate>,
    /// The spindle.
    pub spindle: Want<Turning>,
    /// The coolant.
    pub coolant: Want<Coolant>,
    /// Cutter compensation.
    pub compensation: Want<Compensation>,
    /// Number of the length offset; of no account in a rapid.
    pub length: Want<u32>,
    /// Highest speed of the spindle while a surface speed is in force.
    pub limit: Want<f64>,
}

/// A hole: rapid to it, feed to the bottom, back.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// X and Y.
    pub at: [f64; 2],
    /// Where the feed begins.
    pub clear: f64,
    /// Where it ends.
    pub bottom: f64,
    /// Most that is cut without lifting the tool, for a cycle that pecks.
    pub step: Option<f64>,
    /// Lowest and highest Z to come back to.
    pub back: [f64; 2],
    /// Dwell at the bottom, seconds; `None` where the control decides.
    pub dwell: Option<f64>,
    /// How the tool comes out.
    pub out: WayOut,
}

/// How a tool comes out of its hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayOut {
    /// At rapid.
    Rapid,
    /// At feed.
    Feed,
    /// At feed, or at rapid with the spindle stopped.
    Bored,
    /// At feed, with the spindle turned round on the way.
    Tapped,
}

/// An arc or helix from where the tool is.
#[derive(Clone, Debug, PartialEq)]
pub struct Arc {
    /// Start.
    pub from: Point,
    /// End.
    pub to: Point,
    /// Center; the coordinate along the normal means nothing.
    pub center: Point,
    /// Normal of the plane.
    pub normal: Axis,
    /// Counterclockwise seen against the normal.
    pub ccw: bool,
    /// Angle in all, radians.
    pub total: f64,
}

/// What a step does.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Rapid to a point.
    Rapid(Point),
    /// Straight line at feed.
    Feed(Point),
    /// Arc at feed.
    Arc(Arc),
    /// Pass of a thread.
    Thread {
        /// End.
        to: Point,
        /// How far it goes in one turn.
        lead: f64,
    },
    /// Hole of a cycle.
    Hole(Hole),
    /// Tool change.
    Tool(u32),
    /// Dwell in seconds.
    Dwell(f64),
    /// Program stop.
    Stop,
    /// Optional stop.
    OptionalStop,
}

/// A step and the CL line that asks for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What it does.
    pub act: Act,
    /// What must be in force.
    pub modes: Modes,
    /// Line of the CL text, 1-based.
    pub line: u32,
    /// Nothing is known of the height before it (program start, tool change).
    pub height_unknown: bool,
}

/// Everything a CL program asks for.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    /// The CL text.
    pub cl: String,
    /// The steps.
    pub steps: Vec<Step>,
    /// Why the post may refuse it: each is doubtful, and also right when done right.
    pub may_refuse: Vec<&'static str>,
    /// Why the post has to refuse it: no program is right.
    pub must_refuse: Option<&'static str>,
    /// The model can't tell what happens; such a program proves nothing.
    pub unpredictable: bool,
}
