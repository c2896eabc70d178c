//! What an NC program does, as plain data: millimetres, degrees, absolute
//! positions of the machine's axes.

use nalgebra::{Point3, UnitQuaternion};

pub use crate::work_offsets::work_offset;

/// The normal of the plane that a mill's holes are drilled across: the length of the tool acts
/// along it.
pub(crate) const DRILLED: usize = 2;

/// Millimetres of an inch.
pub(crate) const INCH: f64 = 25.4;

/// Meters of a foot.
pub(crate) const FOOT: f64 = 0.3048;

/// Millimetres of a unit of length.
pub(crate) fn unit(metric: bool) -> f64 {
    if metric { 1.0 } else { INCH }
}

/// How a tilted frame lies in the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// Turns directions of the frame into those of the part.
    pub turn: UnitQuaternion<f64>,
    /// Its zero in the part, mm.
    pub origin: Point3<f64>,
}

/// Where the axes stand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position {
    /// X, Y, Z as the program names them, mm; X of a diameter program is halved.
    pub linear: [f64; 3],
    /// Primary and secondary rotary axis of the machine, degrees; 0 without one.
    pub rotary: [f64; 2],
    /// Tool-tip control is on: X, Y, Z are the tip in the frame of the part, and not
    /// positions of the machine's axes.
    pub tip_control: bool,
    /// The tilted frame that X, Y, Z are positions of the tip in; no rotary axis turns
    /// while one is in force.
    pub tilt: Option<Tilt>,
    /// TRANSMIT or TRACYL of a SINUMERIK is in force: the program says X as a radius and the way
    /// of C as a length.
    pub transformed: bool,
}

impl Position {
    /// X, Y, Z are the tip in a frame of the part, wherever the rotary axes stand.
    pub fn names_tip(&self) -> bool {
        self.tip_control || self.tilt.is_some()
    }

    /// X, Y, Z in mm, then the primary and the secondary rotary axis in degrees.
    pub fn axis(&self, number: usize) -> f64 {
        match number {
            0..3 => self.linear[number],
            _ => self.rotary[number - 3],
        }
    }
}

/// How a motion is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// Rapid traverse.
    Rapid,
    /// At feed.
    Feed,
    /// At feed, in step with the spindle.
    Thread,
    /// Rapid traverse to a point of the machine (`G53`, `G28`), which no CL file asks
    /// for. The axes that go there are not `known`; their values are those the
    /// block gives.
    Machine,
}

/// A feed as it is in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rate {
    /// mm/min, or degrees/min of a rotary motion.
    PerMinute(f64),
    /// mm a turn of the spindle.
    PerTurn(f64),
    /// mm a turn of the spindle where the motion begins, and what that gains in each turn.
    Varying(f64, f64),
    /// Blocks a minute.
    Inverse(f64),
}

/// An arc or helix about a principal axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Center, mm; the coordinate along the normal is that of the start.
    pub center: [f64; 3],
    /// Index of the axis that is the plane's normal: 2 for the XY plane.
    pub normal: usize,
    /// Counterclockwise when seen against the normal.
    pub ccw: bool,
    /// Swept angle, degrees, above 0; 360 for a full circle.
    pub angle: f64,
}

impl Arc {
    /// Indices of the two axes of its plane.
    pub fn plane(&self) -> [usize; 2] {
        [(self.normal + 1) % 3, (self.normal + 2) % 3]
    }

    /// Length from its start to its end, mm.
    pub fn length(&self, from: [f64; 3], to: [f64; 3]) -> f64 {
        let [first, second] = self.plane().map(|axis| from[axis] - self.center[axis]);
        let round = self.angle.to_radians() * libm::hypot(first, second);
        libm::hypot(round, to[self.normal] - from[self.normal])
    }
}

/// What the spindle does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spindle {
    /// Stands.
    #[default]
    Off,
    /// Turns clockwise, seen from behind.
    Clockwise,
    /// Turns counterclockwise.
    Counterclockwise,
}

/// How fast the spindle turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// Turns/min.
    Turns(f64),
    /// Constant surface speed, m/min.
    Surface(f64),
}

impl Speed {
    /// Turns/min; `None` for a surface speed.
    pub fn turns(self) -> Option<f64> {
        match self {
            Speed::Turns(turns) => Some(turns),
            Speed::Surface(_) => None,
        }
    }
}

/// Cutter compensation by the control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compensation {
    /// None.
    #[default]
    Off,
    /// Left of the path.
    Left,
    /// Right of the path.
    Right,
}

/// A plane along whose normal the lengths of a tool act, where they should act along another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OtherPlane {
    /// Index of its normal.
    pub normal: usize,
    /// Index of the normal of the plane that should be in force.
    pub must: usize,
    /// The line that has said it; 0 where the machine was in it when the program began.
    pub line: u32,
}

impl std::fmt::Display for OtherPlane {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [name, must] = [self.normal, self.must].map(|normal| ["G19", "G18", "G17"][normal]);
        match self.line {
            0 => write!(f, "{name} is in force when the program begins")?,
            line => write!(f, "{name} of line {line} is in force")?,
        }
        write!(f, ", it should be {must}: the lengths of the tool act along other axes")
    }
}

/// The tool length offset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LengthModes {
    /// Its number; `None` when off.
    pub offset: Option<u32>,
    /// An `H` that stands after a tool change without the function of the length offset:
    /// whether it acts is not certain. `None` after that function.
    pub stray: Option<u32>,
    /// No function has called the length of the tool, or given it up, since the tool was changed by
    /// its function, on a machine that has one for it.
    pub uncalled: bool,
    /// The plane in which a mill has taken up the length that is in force by its function, where it
    /// lies across the tool there: some controls count it square to that plane.
    pub plane: Option<OtherPlane>,
}

/// What the positions of a program count in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameModes {
    /// The work offset: its preparatory function (54 for `G54`), for a numbered one of a
    /// function its tenths and the number (541003 for `G54.1 P3`), for one of a word
    /// 1000000 and the number.
    pub fixture: Option<u32>,
    /// Line of the statement that has moved the zero away from that of the work offset, without
    /// where the axes stand being followed; `None` where it lies there.
    pub moved_zero: Option<u32>,
    /// A tilted work plane is in force.
    pub tilted: bool,
    /// Tool center point control is on.
    pub tip_control: bool,
    /// The line where it began last.
    pub tip_control_line: u32,
}

/// Cutter compensation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensationModes {
    /// Its side.
    pub side: Compensation,
    /// Number of its offset; `None` when off or not said.
    pub offset: Option<u32>,
    /// The plane in force, by the index of its normal, while it is on; of motions alone.
    pub plane: Option<usize>,
}

/// A spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpindleModes {
    /// How it turns.
    pub turn: Spindle,
    /// Angle of the oriented spindle, degrees; `None` when it turns or none was given.
    pub orientation: Option<f64>,
    /// Range that the program has chosen last, from 1.
    pub range: Option<u8>,
    /// Its speed; `None` before the first, and after a change between turns and surface speed.
    pub speed: Option<Speed>,
    /// What surface speed may turn it up to, rpm; `None` before the first limit.
    pub speed_limit: Option<f64>,
}

/// Which spindle of a lathe is the master spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MasterModes {
    /// The sub-spindle, or the main one; `None` before anything has said it.
    pub is_side: Option<bool>,
    /// How the spindle turns that is not the master.
    pub other: Spindle,
}

/// Planes that are not as they must be; of motions alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaneModes {
    /// A plane other than XY that the program of a mill has said, by the index of its normal,
    /// and the line of that.
    pub unusual: Option<(usize, u32)>,
    /// The plane that the program of a SINUMERIK is in, where its motion needs another.
    pub other: Option<OtherPlane>,
}

/// What no word has switched since a tool was changed by its function, or since a stop, where many
/// machines switch it off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unsaid {
    /// The spindle.
    pub spindle: bool,
    /// The coolant.
    pub coolant: bool,
}

/// What is in force besides the motion itself, by modal group.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Modes {
    /// Number of the tool in the spindle; 0 before the first change.
    pub tool: u32,
    /// Its length.
    pub length: LengthModes,
    /// The coordinate system.
    pub frame: FrameModes,
    /// Cutter compensation.
    pub compensation: CompensationModes,
    /// The master spindle.
    pub spindle: SpindleModes,
    /// Which one that is, and what the other one of a lathe does.
    pub master: MasterModes,
    /// Line of the last statement that changes how closely and how smoothly the path is followed
    /// (exact stops, tolerances), or what the feed of an arc counts at.
    pub path_control: Option<u32>,
    /// Planes that are not as they must be.
    pub planes: PlaneModes,
    /// Lengths of the program are inches.
    pub inch: bool,
    /// A drilling cycle is on; said where a tool is changed and at the end.
    pub cycle: bool,
    /// The auxiliary function of the coolant that was switched on last; `None` when off.
    pub coolant: Option<u32>,
    /// What is not switched anew since the tool change or stop.
    pub unsaid: Unsaid,
}

/// A single motion from where the axes stand to `to`; [`Forward::along`] says how it
/// gets there.
///
/// [`Forward::along`]: crate::forward::Forward::along
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Line of the NC program, 1-based.
    pub line: u32,
    /// Rapid, feed, thread.
    pub course: Course,
    /// End of the motion.
    pub to: Position,
    /// The arc it goes along; `None` for a straight line of the axes, or of the tip in
    /// the part when tool-tip control is on.
    pub arc: Option<Arc>,
    /// Feed in force; `None` in rapid traverse.
    pub rate: Option<Rate>,
    /// Made by a canned cycle that is in force.
    pub in_cycle: bool,
    /// Which axes of `to` (X, Y, Z, primary, secondary) are known in the frame of the
    /// program. An axis is not known before its first word, after a motion to a
    /// point of the machine, and after a change of the work offset; its value is
    /// then the last one that was said, or 0.
    pub known: [bool; 5],
    /// Which axes a motion to a point of the machine names; none of another motion.
    pub to_machine: [bool; 5],
    /// What else is in force.
    pub modes: Modes,
}

/// A mode that a control is in when a program begins, whatever the program before it left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartMode {
    /// mm or inch.
    Unit,
    /// Absolute or incremental positions.
    Positions,
    /// Feed a minute, a turn or in inverse time.
    Feed,
    /// The plane of arcs and cycles.
    Plane,
    /// The level that a hole returns to.
    ReturnLevel,
    /// Spindle speed or surface speed.
    Surface,
    /// X is a diameter or a radius.
    Diameter,
}

impl StartMode {
    /// All of them.
    pub const ALL: [StartMode; 7] = [
        StartMode::Unit,
        StartMode::Positions,
        StartMode::Feed,
        StartMode::Plane,
        StartMode::ReturnLevel,
        StartMode::Surface,
        StartMode::Diameter,
    ];

    /// What it is, in a machinist's words.
    pub fn name(self) -> &'static str {
        match self {
            StartMode::Unit => "the unit",
            StartMode::Positions => "whether axis words are positions or increments",
            StartMode::Feed => "what F means",
            StartMode::Plane => "the plane",
            StartMode::ReturnLevel => "the level that holes return to",
            StartMode::Surface => "whether S is a spindle speed or a surface speed",
            StartMode::Diameter => "whether X is a diameter",
        }
    }
}

/// What happens in a program, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A motion.
    Move(Move),
    /// A tool is put into the spindle.
    ToolChange {
        /// Line of the NC program.
        line: u32,
        /// Number of the tool.
        tool: u32,
        /// What is in force while it is changed; its tool is the one before.
        modes: Modes,
    },
    /// The axes wait.
    Dwell {
        /// Line of the NC program.
        line: u32,
        /// Seconds; `None` when the program waits turns of the spindle.
        seconds: Option<f64>,
        /// Turns of the spindle that it waits.
        turns: Option<f64>,
    },
    /// An auxiliary function without a motion of its own, besides spindle, coolant and
    /// tool (`M0`, `M41`).
    Auxiliary {
        /// Line of the NC program.
        line: u32,
        /// Its number.
        code: u32,
    },
    /// A block depends on a mode that no block before it has said and that the machine does
    /// not state either; it comes before what the block does.
    LeftToControl {
        /// Line of the NC program.
        line: u32,
        /// The mode.
        mode: StartMode,
    },
    /// The program gives a tool a length or a radius of its own, in place of those of the
    /// tool table.
    ToolMeasured {
        /// Line of the NC program.
        line: u32,
    },
    /// The end of the program.
    End {
        /// Line of the NC program.
        line: u32,
        /// The number of the auxiliary function that ends it; `None` where it ends without.
        code: Option<u32>,
        /// What is in force at the end.
        modes: Modes,
    },
}

impl Event {
    /// Line of the NC program, 1-based.
    pub fn line(&self) -> u32 {
        match self {
            Event::Move(Move { line, .. })
            | Event::ToolChange { line, .. }
            | Event::Dwell { line, .. }
            | Event::Auxiliary { line, .. }
            | Event::LeftToControl { line, .. }
            | Event::ToolMeasured { line }
            | Event::End { line, .. } => *line,
        }
    }

    /// True for what no other program has a counterpart of: it is right or wrong by itself.
    pub(crate) fn stands_alone(&self) -> bool {
        matches!(self, Event::LeftToControl { .. } | Event::ToolMeasured { .. })
    }
}
