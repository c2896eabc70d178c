//! Operations: what a machine is to do, as a machinist would say it.
//!
//! The post words make them, in coordinates of the part and with their cause; the
//! passes in [`path`](crate::path) bring motions to the machine; the
//! [`control`](crate::control) writes them. No operation knows a G, an M or a
//! letter of the machine, except the few by which a CL file names them itself
//! (PREFUN, AUXFUN, POSTN). LinuxCNC's canonical machining functions were the
//! model for a list that is short and lasts.

pub mod cycle;
pub mod motion;
pub mod thread_shape;

use fil_machine::modes::{FeedMode, Plane};
use fil_machine::{FunctionCode, Letter};
use nalgebra::{Point3, Vector3};

use crate::cause::Cause;
use crate::control_state::{Compensation, ForeignBlock};

/// The word of a motion record that holds its x.
pub const POINT: u16 = 6;

/// Number of data words of a motion to a point, and of one with a tool axis.
pub(crate) const MOTION: [usize; 2] = [5, 8];

/// A CL point with its tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Tool tip in the part frame, mm or inch.
    pub point: Point3<f64>,
    /// Tool axis in the part frame, of any length above 0.
    pub axis: Vector3<f64>,
    /// Word of the record that holds x, as POSTF(7,n) counts; 0 when the target is
    /// not a point of the record.
    pub word: u16,
}

/// A feed in output units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feed {
    /// mm/min, inch/min, mm/rev or inch/rev.
    pub value: f64,
    /// The same before the limits of the machine.
    pub asked: f64,
    /// How it is meant.
    pub mode: FeedMode,
    /// The record that gave it.
    pub cause: Cause,
}

/// A lead: how far a thread or a tap goes in one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lead {
    /// mm or inch a revolution.
    pub value: f64,
    /// The record that gave it.
    pub cause: Cause,
}

/// The kind of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionKind {
    /// As fast as the axes go; with the RAPID record that asked for it.
    Rapid(Cause),
    /// At the feed in force.
    Feed,
    /// A pass of a thread.
    Thread(Lead),
}

/// An arc or helix about an axis, in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// A point on the axis, mm or inch.
    pub center: Point3<f64>,
    /// Unit vector; the arc turns about it by the right-hand rule.
    pub axis: Vector3<f64>,
    /// Radius where the record gives it.
    pub radius: Option<f64>,
    /// Full turns besides the way from start to end.
    pub turns: f64,
    /// Line of the CIRCLE in the CL file; 0 for one that FIL has made.
    pub line: u32,
    /// The CIRCLE record.
    pub cause: Cause,
}

/// Where the tool stands clear of a thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThreadSide {
    /// Farther from the axis of the spindle.
    Outside,
    /// Nearer to it.
    Inside,
    /// Before a face, farther in +Z.
    Before,
    /// Behind a face, farther in -Z.
    Behind,
}

/// How a thread is divided into passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ThreadPasses {
    /// By the depth of the first one, mm or inch.
    First(f64),
    /// By their number.
    Count(u32),
}

/// A whole thread. Lengths in mm or inch, depths square to the axis it runs along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thread {
    /// Where the crest begins and ends.
    pub crest: [Target; 2],
    /// Where the tool stands clear of it.
    pub side: ThreadSide,
    /// How far the tool goes in a turn.
    pub lead: Lead,
    /// Number of threads beside each other.
    pub starts: u32,
    /// From the crest to the root.
    pub depth: f64,
    /// Its passes.
    pub passes: ThreadPasses,
    /// Passes at full depth after the last one.
    pub springs: u32,
    /// Angle of the profile, degrees: the tool goes in along one flank; 0 goes straight in.
    pub angle: f64,
    /// Distance from the crest at which the tool goes back.
    pub clearance: f64,
}

/// How long to dwell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dwell {
    /// Seconds.
    Seconds(f64),
    /// Turns of the spindle.
    Revolutions(f64),
}

/// What a spindle does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spindle {
    /// Stops.
    Off,
    /// Stops where the machine orients it, or at an angle in degrees.
    Orient(Option<f64>),
    /// Takes a range of speeds.
    Range(SpindleRange),
    /// Takes a highest speed, turns a minute.
    Limit(f64),
    /// Turns.
    Turn(SpindleTurn),
    /// The second spindle of a lathe turns or stops.
    Side(SideSpindle),
    /// The control counts the turns of the second spindle of a lathe from here on, or those of
    /// the main one.
    Counted(CountedSpindle),
}

/// Which spindle of a lathe the control counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedSpindle {
    /// The second one.
    pub is_side: bool,
    /// The record says all that the spindle does: speed and direction, or that it stops.
    pub is_whole: bool,
}

/// What the second spindle of a lathe does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideSpindle {
    /// Clockwise or not; `None` where it stops.
    pub turn: Option<bool>,
    /// Turns a minute, where the record says it.
    pub speed: Option<f64>,
    /// Word of the record that gives the speed, and the one that gives the direction.
    pub words: [u16; 2],
}

/// A range of spindle speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleRange {
    /// By its number, from 1.
    Number(f64),
    /// The lowest one.
    Low,
    /// The one between two others.
    Medium,
    /// The highest one.
    High,
}

/// A spindle that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpindleTurn {
    /// Its speed, `None` for the last one.
    pub speed: Option<SpindleSpeed>,
    /// Clockwise or not; `None` for the machine's default.
    pub clockwise: Option<bool>,
    /// The record names the range of speeds too.
    pub in_named_range: bool,
    /// Word of the record that gives the speed, and the one that gives the direction.
    pub words: [u16; 2],
}

/// The speed of a spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleSpeed {
    /// Turns a minute.
    Revolutions(f64),
    /// Constant surface speed, m/min.
    Meters(f64),
    /// Constant surface speed, feet/min.
    Feet(f64),
}

impl SpindleSpeed {
    /// No turn at all.
    pub fn is_zero(self) -> bool {
        let (SpindleSpeed::Revolutions(speed)
        | SpindleSpeed::Meters(speed)
        | SpindleSpeed::Feet(speed)) = self;
        speed == 0.0
    }
}

/// What the coolant does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// Ends.
    Off,
    /// Flows.
    On(CoolantKind, Pressure),
}

/// A kind of coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoolantKind {
    /// What the machine calls coolant on.
    Default,
    /// A jet.
    Flood,
    /// Mist.
    Mist,
    /// Through the tool.
    Through,
    /// Tapping oil.
    Tap,
    /// Air.
    Air,
}

/// The pressure of a coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressure {
    /// The machine's usual one.
    Usual,
    /// Low.
    Low,
    /// Medium.
    Medium,
    /// High.
    High,
}

/// Cutter compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutterCompensation {
    /// Where the cutter runs.
    pub side: Compensation,
    /// The plane, where the record says it, and the word that does.
    pub plane: Option<(Plane, u16)>,
    /// The offset, and the word that gives it; 0 for one taken from the tool.
    pub offset: Option<(f64, u16)>,
    /// The word that gives the side.
    pub side_word: u16,
}

/// What the CL file says of the tool changes behind the one at hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NextTools {
    /// Nobody has looked, or the file could not be read ahead.
    #[default]
    Unknown,
    /// There is none.
    None,
    /// There are some.
    Some {
        /// The first that takes another tool, if there is one.
        other: Option<i64>,
        /// The operator makes that change by hand, so nothing prepares it.
        by_hand: bool,
    },
}

/// What comes behind a tool change, as far as somebody has looked.
#[derive(Clone, Copy, Debug, Default)]
pub struct ToolAhead {
    /// The tool changes behind it.
    pub next: NextTools,
    /// The rev/min of the first SPINDL behind it, where no motion comes before it.
    pub speed: Option<f64>,
    /// The tool axis changes in a motion at feed.
    pub turns_in_cut: bool,
    /// Taps or cutter compensation, which need a tilted work plane where the tool is tilted.
    pub needs_a_plane: bool,
}

/// A tool change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolChange {
    /// Number of the tool.
    pub tool: i64,
    /// Number of its offset: that of the record, else that of the tool.
    pub offset: i64,
    /// What the number of the offset is taken from.
    pub offset_from: OffsetFrom,
    /// The operator changes it by hand, while the program stops.
    pub by_hand: bool,
    /// The tool changes behind this one.
    pub next: NextTools,
    /// The rev/min that SPINDL asks for behind it, where it is known.
    pub speed: Option<f64>,
    /// The record at the word of the tool, and at that of the offset.
    pub causes: [Cause; 2],
}

impl ToolChange {
    /// The record gives the number of the offset.
    pub fn is_offset_given(&self) -> bool {
        self.offset_from != OffsetFrom::Tool
    }
}

/// What the number of an offset is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OffsetFrom {
    /// The number of the tool: the record gives none.
    Tool,
    /// The record gives an offset of the machine.
    Record,
    /// The record gives one of the tool's own compensations.
    Compensation,
}

/// Why the machine waits or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// For its operator.
    Always,
    /// For its operator, when he wants it.
    Optional,
}

/// How a program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// END.
    Stay,
    /// REWIND.
    Rewind,
    /// AUXFUN with this code, in place of the one that the machine has.
    By(FunctionCode),
    /// The end of the CL file: as REWIND, or END on a machine without it.
    OfFile,
}

/// Something the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// A straight motion.
    Linear(Target, MotionKind),
    /// A rapid motion to a position of X, Y and Z on the machine, mm or inch; an axis
    /// without one stays.
    MachinePosition([Option<f64>; 3]),
    /// A rotary axis, 0 or 1, turns to a position at rapid, degrees.
    Turn(usize, f64),
    /// An arc to a point.
    Arc(Arc, Target),
    /// A hole of the active cycle.
    Hole(Target),
    /// A thread in all its passes.
    Thread(Box<Thread>),
    /// A dwell.
    Dwell(Dwell),
    /// A spindle.
    Spindle(Spindle),
    /// The coolant.
    Coolant(Coolant),
    /// Cutter compensation.
    Compensation(CutterCompensation),
    /// A tool change.
    ToolChange(ToolChange),
    /// A work offset by its number from 1; `None` for the machine's usual one.
    WorkOffset(Option<i64>),
    /// The next tool is prepared.
    SelectTool(i64),
    /// A function by its number: G or M.
    Function(Letter, FunctionCode),
    /// A function that the next motion brings along.
    WithMotion(Letter, FunctionCode),
    /// A block of exactly these words, each with its cause.
    Words(Vec<(Letter, f64, Cause)>),
    /// Words for each motion from now on; none ends them.
    Repeat(Vec<(Letter, f64, Cause)>),
    /// Blocks of an author, as they are.
    Text(Vec<ForeignBlock>),
    /// A message to the operator.
    Message(String),
    /// A stop.
    Stop(Stop),
    /// Blocks from now on may be skipped, or no longer.
    Skip(bool),
    /// The end of the program.
    End(End),
}
