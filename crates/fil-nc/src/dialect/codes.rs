//! What G and M words do, whatever their numbers are.

use crate::motion::{Compensation, Spindle};

/// How a feed is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Length a minute.
    PerMinute,
    /// Length a turn of the spindle.
    PerTurn,
    /// Blocks a minute.
    Inverse,
}

/// What a drilling cycle does at and from the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// Feed in, rapid out.
    Drill,
    /// In pecks, out of the hole after each.
    Peck,
    /// In pecks, lifted a little after each.
    BreakChips,
    /// Feed in, spindle counterclockwise, feed out.
    Tap,
    /// Feed in, spindle clockwise, feed out.
    TapLeft,
    /// Feed in, feed out.
    FeedOut,
    /// Feed in, spindle stopped, rapid out.
    StopOut,
}

/// What a G word asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Rapid traverse.
    Rapid,
    /// Straight line at feed.
    Linear,
    /// Arc at feed.
    Arc {
        /// Counterclockwise.
        ccw: bool,
    },
    /// Straight line in step with the spindle.
    Thread,
    /// The same with a lead that grows or shrinks.
    VaryingThread,
    /// Threading cycle of one pass: in, along, out, back.
    ThreadPass,
    /// Threading cycle of all passes.
    ThreadPasses,
    /// That of LinuxCNC, with its pitch in P.
    ThreadPassesByPitch,
    /// That of an OSP, with its height in H.
    ThreadPassesByHeight,
    /// Drilling cycle; its code takes a dwell, or passes over it.
    Cycle(CycleKind, bool),
    /// Drilling cycle of a lathe for live tools.
    LiveCycle {
        /// Along X; along Z else.
        side: bool,
        /// What it does at and from the bottom.
        kind: CycleKind,
    },
    /// End of a drilling cycle.
    CycleOff,
    /// Level to return to after a hole.
    Return {
        /// That before the cycle, else the R level.
        initial: bool,
    },
    /// The word of this block is the level that a hole may return to.
    ReturnTo,
    /// Plane of arcs, by the index of its normal.
    Plane(usize),
    /// Unit of length.
    Units {
        /// Millimetre, else inch.
        metric: bool,
    },
    /// Meaning of axis words.
    Positions {
        /// Positions, else increments.
        absolute: bool,
    },
    /// Meaning of F.
    Feed(FeedMode),
    /// Cutter compensation.
    Compensation(Compensation),
    /// Tool length offset taken up, else given up.
    Length(bool),
    /// Tool length offset taken up, with tool-tip control by the angles of the rotary
    /// axes.
    TipControl,
    /// The same by the direction of the tool.
    TipControlByDirection,
    /// A tilted frame begins.
    Tilt,
    /// The tool turns along its Z.
    AlignTool,
    /// It ends.
    TiltOff,
    /// X and C become a plane of lengths, or no longer.
    Polar(bool),
    /// The feed counts on a cylinder whose radius is the word of C, or no longer.
    Cylinder,
    /// Work offset.
    Fixture(u32),
    /// Work offset by a number of its own; the code in tenths.
    NumberedFixture(u32),
    /// S is a surface speed, else turns.
    Surface(bool),
    /// S of this block limits the speed.
    SpeedLimit,
    /// Wait.
    Dwell,
    /// Axis words of this block are in the machine frame.
    MachineFrame,
    /// A tilted frame as the rotary axes stand: G254 of a Haas.
    TiltByAxes,
    /// To the ends of the travel of the axes that the block names: `G16 H0` of an OSP.
    EndOfTravel,
    /// To the reference point.
    Reference,
    /// To the second reference point, or to that of a number.
    NumberedReference,
    /// How exactly corners are cut; no motion of its own.
    PathControl,
    /// X is a diameter.
    Diameter,
}

/// Functions of a group exclude each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Group {
    /// Motions.
    Motion,
    /// Drilling cycles and their end.
    Cycle,
    /// Return levels.
    Return,
    /// Planes.
    Plane,
    /// Units.
    Units,
    /// Positions and increments.
    Positions,
    /// Feed modes.
    Feed,
    /// Cutter compensation.
    Compensation,
    /// Tool length.
    Length,
    /// Tilted frames.
    Tilt,
    /// Polar and cylindrical interpolation.
    Interpolation,
    /// Work offsets.
    Fixture,
    /// Speed modes.
    Surface,
    /// Path control.
    PathControl,
    /// Diameters.
    Diameter,
    /// What holds for one block only.
    Once,
}

impl Function {
    /// The group it belongs to.
    pub fn group(self) -> Group {
        match self {
            Function::Rapid
            | Function::Linear
            | Function::Arc { .. }
            | Function::Thread
            | Function::VaryingThread
            | Function::ThreadPass => Group::Motion,
            Function::Cycle(..) | Function::LiveCycle { .. } | Function::CycleOff => Group::Cycle,
            Function::Return { .. } => Group::Return,
            Function::Plane(_) => Group::Plane,
            Function::Units { .. } => Group::Units,
            Function::Positions { .. } => Group::Positions,
            Function::Feed(_) => Group::Feed,
            Function::Compensation(_) => Group::Compensation,
            Function::Length(_) | Function::TipControl | Function::TipControlByDirection => {
                Group::Length
            }
            Function::Tilt | Function::TiltByAxes | Function::TiltOff => Group::Tilt,
            Function::Polar(_) | Function::Cylinder => Group::Interpolation,
            Function::Fixture(_) | Function::NumberedFixture(_) => Group::Fixture,
            Function::Surface(_) => Group::Surface,
            Function::PathControl => Group::PathControl,
            Function::Diameter => Group::Diameter,
            Function::ThreadPasses
            | Function::ThreadPassesByPitch
            | Function::ThreadPassesByHeight
            | Function::ReturnTo
            | Function::SpeedLimit
            | Function::Dwell
            | Function::MachineFrame
            | Function::EndOfTravel
            | Function::AlignTool
            | Function::Reference
            | Function::NumberedReference => Group::Once,
        }
    }

    /// A motion to a point of the machine, which has no place in the frame of the part.
    pub fn goes_to_machine(self) -> bool {
        matches!(
            self,
            Function::MachineFrame
                | Function::EndOfTravel
                | Function::Reference
                | Function::NumberedReference
        )
    }
}

/// What an M word asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Auxiliary {
    /// Spindle clockwise.
    Clockwise,
    /// Spindle counterclockwise.
    Counterclockwise,
    /// Spindle stands.
    SpindleOff,
    /// Spindle stands where the machine orients it.
    Orient,
    /// The main spindle becomes the axis C, or a spindle again; with the number.
    CAxis(bool, u32),
    /// The live tool turns or stands.
    Live(Spindle),
    /// The control counts the second spindle of a lathe, or the main one.
    Counts(bool),
    /// The second spindle turns or stands, where the control is told which one it counts.
    Side(Spindle),
    /// A range of spindle speeds, from 1.
    SpindleRange(u8),
    /// The coolant of this number flows.
    Coolant {
        /// Its number.
        code: u32,
        /// The number that ends it.
        off: Option<u32>,
    },
    /// The coolants that this number ends stop.
    CoolantOff(u32),
    /// Tool change.
    ToolChange,
    /// End of the program, by this number.
    End(u32),
    /// Call of a subprogram.
    Call,
    /// End of a subprogram.
    Back,
    /// Steers the program in a way that can't be followed.
    Flow,
    /// The cycle of the block returns to the level said before it, else to R.
    Returns {
        /// To that level.
        to_level: bool,
    },
    /// Anything else, by its number: no motion of the axes.
    Other(u32),
}

impl Auxiliary {
    /// True when one block can't ask for both.
    pub fn excludes(self, other: Auxiliary) -> bool {
        let turns = |auxiliary| {
            matches!(
                auxiliary,
                Auxiliary::Clockwise
                    | Auxiliary::Counterclockwise
                    | Auxiliary::SpindleOff
                    | Auxiliary::Orient
                    | Auxiliary::CAxis(..)
                    | Auxiliary::Live(_)
                    | Auxiliary::Counts(_)
                    | Auxiliary::Side(_)
            )
        };
        match (self, other) {
            (Auxiliary::Coolant { .. }, Auxiliary::CoolantOff(_))
            | (Auxiliary::CoolantOff(_), Auxiliary::Coolant { .. }) => true,
            _ => turns(self) && turns(other),
        }
    }
}
