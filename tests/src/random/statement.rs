//! The statements of a random CL program, before they are text.

use crate::path::{Axis, Point, Unit};

/// One statement, or a few that belong together (RAPID and its GOTO).
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// RAPID and GOTO, in CL units.
    Rapid(Point),
    /// GOTO, in CL units.
    Feed(Point),
    /// GODLTA, with RAPID before it or not.
    Delta {
        /// The step, in CL units.
        by: Point,
        /// RAPID stands before it.
        rapid: bool,
    },
    /// CIRCLE and the GOTO to its end.
    Arc(ArcShape),
    /// FEDRAT.
    Feedrate(Feedrate),
    /// SPINDL.
    Spindle(SpindleCommand),
    /// COOLNT.
    Coolant(CoolantCommand),
    /// LOADTL, with OSETNO or not.
    Tool {
        /// The tool.
        number: u32,
        /// The number of its length offset, when it is not the tool's.
        offset: Option<u32>,
    },
    /// CUTCOM.
    Cutcom(CutcomCommand),
    /// OPSKIP/ON and OFF.
    Skip(bool),
    /// CYCLE with its couplets.
    Cycle(CycleShape),
    /// GOTO that is a hole of the cycle.
    Hole(Point),
    /// CYCLE/OFF.
    CycleOff,
    /// INSERT.
    Insert(&'static str),
    /// PREFUN.
    Prefun(u32),
    /// AUXFUN.
    Auxfun(u32),
    /// POSTN/OUT of letters with values.
    Postn(&'static [(char, f64)]),
    /// REPEAT of F.
    RepeatFeed(f64),
    /// REPEAT/OFF.
    RepeatOff,
    /// TRANS.
    Trans(Trans),
    /// TRANS/NOMORE.
    TransOff,
    /// DELAY, seconds.
    Delay(f64),
    /// DELAY/REV, turns of the spindle.
    DelayTurns(f64),
    /// STOP.
    Stop,
    /// OPSTOP.
    OptionalStop,
    /// SEQNO.
    Seqno(&'static str),
    /// PPRINT.
    Message(&'static str),
    /// UNITS.
    Units(Unit),
    /// THREAD with its lead, in CL units.
    Thread(f64),
    /// THREAD/OFF.
    ThreadOff,
}

/// The least angle between the ends of an arc that no rounding makes one, degrees: nearer to each
/// other they are refused.
pub fn least_apart(size: f64, radius: f64) -> f64 {
    (1.1e-3 * size / radius).to_degrees().min(180.0)
}

/// An arc from where the tool is, in CL units and degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcShape {
    /// Normal of the plane.
    pub normal: Axis,
    /// The axis of CIRCLE points along the normal: counterclockwise.
    pub ccw: bool,
    /// Radius.
    pub radius: f64,
    /// Direction from the center to the start, from the plane's first axis.
    pub start: f64,
    /// Angle to the end, above 0 and at most 360.
    pub sweep: f64,
    /// TIMES; 0 writes none.
    pub times: u32,
    /// Height of the end over the start, along the normal.
    pub rise: f64,
}

impl ArcShape {
    /// Degrees in all. With TIMES an end that lacks less than 0.001 of the start is the
    /// end of the last full turn: so much may rounded points differ.
    pub fn total(&self) -> f64 {
        let lacks = 2.0 * self.radius * libm::sin((self.sweep / 2.0).to_radians());
        let closes = self.sweep > 180.0 && lacks < 0.001;
        if self.sweep == 360.0 {
            360.0 * f64::from(self.times.max(1))
        } else if self.times > 0 && closes {
            self.sweep + 360.0 * f64::from(self.times - 1)
        } else {
            self.sweep + 360.0 * f64::from(self.times)
        }
    }
}

/// A feed as FEDRAT or a cycle says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feedrate {
    /// The number.
    pub value: f64,
    /// A revolution, not a minute.
    pub per_revolution: bool,
}

/// What SPINDL says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleCommand {
    /// RPM, speed and direction.
    Turn {
        /// Revolutions a minute.
        speed: f64,
        /// CCLW.
        ccw: bool,
    },
    /// SMM or SFM, speed and direction, with MAXRPM or not.
    Surface {
        /// Metres or feet a minute.
        speed: f64,
        /// CCLW.
        ccw: bool,
        /// Highest speed, turns a minute.
        limit: Option<f64>,
    },
    /// OFF.
    Off,
}

/// What COOLNT says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoolantCommand {
    /// ON, which is flood on the machines of these tests.
    On,
    /// MIST.
    Mist,
    /// OFF.
    Off,
}

/// What CUTCOM says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutcomCommand {
    /// LEFT or RIGHT.
    On {
        /// LEFT.
        left: bool,
        /// The offset number; that of the tool without one.
        offset: Option<u32>,
    },
    /// OFF.
    Off,
}

/// A drilling cycle, in CL units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleShape {
    /// The kind.
    pub kind: CycleKind,
    /// Depth under the start of the hole.
    pub depth: f64,
    /// R level over the start of the hole.
    pub clear: f64,
    /// Its feed; that of FEDRAT without one.
    pub feed: Option<Feedrate>,
    /// Peck of DEEP and BRKCHP.
    pub step: Option<f64>,
    /// RETURN.
    pub retract: Option<f64>,
    /// DWELL, seconds.
    pub dwell: Option<f64>,
}

/// A kind of drilling cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// CYCLE/DRILL.
    Drill,
    /// CYCLE/THRU.
    Thru,
    /// CYCLE/FACE.
    Face,
    /// CYCLE/CSINK.
    Csink,
    /// CYCLE/DEEP.
    Deep,
    /// CYCLE/BRKCHP.
    Brkchp,
    /// CYCLE/REAM.
    Ream,
    /// CYCLE/BORE.
    Bore,
    /// CYCLE/TAP.
    Tap,
}

impl CycleKind {
    /// Its minor word.
    pub fn word(self) -> &'static str {
        match self {
            CycleKind::Drill => "DRILL",
            CycleKind::Thru => "THRU",
            CycleKind::Face => "FACE",
            CycleKind::Csink => "CSINK",
            CycleKind::Deep => "DEEP",
            CycleKind::Brkchp => "BRKCHP",
            CycleKind::Ream => "REAM",
            CycleKind::Bore => "BORE",
            CycleKind::Tap => "TAP",
        }
    }

    /// It goes down in pecks.
    pub fn pecks(self) -> bool {
        matches!(self, CycleKind::Deep | CycleKind::Brkchp)
    }
}

/// A transformation of the input, lengths in CL units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trans {
    /// TRANS/x,y,z.
    Shift(Point),
    /// Twelve numbers: a turn about an axis, a mirror, a shift.
    Matrix {
        /// Axis of the turn; other than Z needs `points_only`.
        about: Axis,
        /// Angle of the turn, degrees.
        angle: f64,
        /// X changes its sign before the turn.
        mirror: bool,
        /// The shift after the turn.
        shift: Point,
        /// OPTION,10: the tool axis stays.
        points_only: bool,
    },
}
