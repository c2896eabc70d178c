//! What a CL file asks of a machine, as plain data: mm, degrees, mm/min.

use fil_cl::operation_sign::Sign;
use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Point3, Vector3};

use super::report::FindingKind;
use crate::dialect::SKIP;
use crate::forward::Pose;
use crate::motion::{Compensation, Rate, Speed, Spindle};

/// One thing a CL file asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Line of the CL file, 1-based.
    pub line: u32,
    /// What it is.
    pub what: ExpectedStep,
}

/// How a table comes to a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TableWay {
    /// To the number itself.
    Number,
    /// In this direction, 1 or -1 as positions count, by less than a turn.
    Direction(f64),
    /// By so many degrees from where it stood.
    By(f64),
}

/// What a step of a CL file asks for. What is long and rare lies elsewhere, as most steps are lines
/// and go through several hands.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpectedStep {
    /// The unit of the file and of the program: mm, else inch.
    Metric(bool),
    /// Rapid traverse to a pose.
    Rapid(Pose),
    /// A straight line at feed; the rate is `None` before the first FEDRAT.
    Feed(Pose, Option<Rate>),
    /// A thread pass.
    Thread(Pose, Rate),
    /// THREAD: the passes behind it are another thread than those before.
    ThreadBegins,
    /// A whole thread, in passes that the machine divides.
    WholeThread(Box<WholeThread>),
    /// The second spindle: clockwise or not, `None` where it stops.
    SideSpindle(Option<bool>),
    /// The control counts the second spindle or the main one, where it is told which.
    Counts(bool),
    /// What the second spindle does on such a machine.
    OfSide(Box<ExpectedStep>),
    /// An arc or helix at feed.
    Arc(Box<Arc>, Option<Rate>),
    /// A hole of a cycle.
    Hole(Box<Hole>),
    /// Rapid traverse to the home position of the machine.
    Home,
    /// Rapid traverse up to the machine's level for it.
    Retract,
    /// A rotary axis turns to a position at rapid, where the tool stands.
    Turn {
        /// The axis, 0 or 1.
        index: usize,
        /// Its position, degrees.
        angle: f64,
        /// The way there.
        way: TableWay,
    },
    /// A cutter of this diameter, mm.
    Cutter(f64),
    /// How far the tip may leave its line between the ends of a motion, mm; `None` for
    /// as far as it does.
    Straight(Option<f64>),
    /// The cycle ends, or another one begins.
    CycleEnd,
    /// Change to a tool, with the number of its length offset.
    Tool {
        /// Its number.
        number: u32,
        /// Its length offset, where the record gives one.
        offset: Option<GivenOffset>,
        /// The operator makes it while the program stops.
        by_hand: bool,
    },
    /// A change to a tool that was left out with the blocks that may be skipped: what moves behind
    /// them needs that tool all the same.
    ToolLeftOut {
        /// Its number.
        number: u32,
        /// Its length offset, where the record gives one.
        offset: Option<GivenOffset>,
    },
    /// The spindle stands or turns; `None` for the direction the machine turns by itself.
    Spindle(Option<Spindle>),
    /// The spindle turns as a record before has said it.
    SpindleAgain,
    /// Spindle speed.
    Speed(Speed),
    /// What surface speed may turn the spindle up to, turns a minute.
    SpeedLimit(f64),
    /// The spindle is stopped where the machine orients it, or at an angle in degrees:
    /// neither speed nor direction are known.
    Orient(Option<f64>),
    /// A range of spindle speeds.
    SpindleRange(SpindleRange),
    /// A coolant is switched on or off.
    Coolant(CoolantKind),
    /// Cutter compensation by the control, with the number of its offset where the
    /// record gives one.
    Compensation(Compensation, Option<u32>),
    /// The plane that cutter compensation names, by the index of its normal.
    Plane(usize),
    /// A work offset, by its preparatory function.
    Fixture(u32),
    /// A work offset by its number from 1; `None` for the machine's usual one.
    WorkOffset(Option<f64>),
    /// MODE: live tools mill from here on, or the machine turns.
    Mills(bool),
    /// The program waits, seconds.
    Dwell(Option<f64>),
    /// The program waits turns of the spindle.
    DwellTurns(f64),
    /// The operator is waited for, always or where he asks for it; what was to come with
    /// a motion comes now.
    Stop {
        /// Only where the operator asks for it.
        optional: bool,
    },
    /// The operator's feed override is locked, or acts again.
    OverrideLock(bool),
    /// The clamp of an axis, on or off.
    Clamp(bool),
    /// An auxiliary function by its number.
    Auxiliary(u32),
    /// A line of the tape, as it stands.
    Insert {
        /// The line.
        text: String,
        /// It stands in a block that may be skipped.
        may_be_skipped: bool,
    },
    /// Words of the user's own that the CL file says, in a block of their own.
    Words(String),
    /// Words of the user's own in each motion that follows.
    Repeated(String),
    /// A record that says where an operation begins.
    Sign(Sign),
    /// Something was left out that the operator may skip: what follows begins elsewhere than
    /// with it.
    LeftOut,
    /// Nothing is done any more that modes of records left out would hold for.
    Unfollowed,
    /// The end of the program.
    End(End),
    /// Something whose effect on the machine is not known from the CL file.
    Unknown {
        /// What it is, for the report.
        what: String,
        /// What it leaves open.
        effect: Effect,
    },
}

/// How a CL file ends the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// END.
    Stay,
    /// REWIND.
    Rewind,
    /// AUXFUN with this code.
    By(u32),
    /// By its own end: FINI, or the end of the text.
    OfFile,
}

/// What a statement leaves open that the CL file does not explain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// An M function.
    Auxiliary,
    /// Words of the user's own, none of them M, S or a work offset by its function; the
    /// motions of the CL file go on.
    Words,
    /// The same, and one of them may be the function of a work offset.
    WordsOrOffset,
    /// Words of the user's own, M or S too.
    AnyWords,
    /// The path from here on.
    Path,
    /// The same, of a statement that no reading makes certain: no program for it is right.
    Doubtful(FindingKind),
}

/// A range of spindle speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleRange {
    /// By its number, from 1.
    Number(f64),
    /// The lowest.
    Low,
    /// The middle one.
    Medium,
    /// The highest.
    High,
}

/// What COOLNT asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoolantKind {
    /// Off.
    Off,
    /// The machine's usual one.
    On,
    /// The machine's usual one at low pressure.
    OnLow,
    /// The machine's usual one at medium pressure.
    OnMedium,
    /// The machine's usual one at high pressure.
    OnHigh,
    /// Flood.
    Flood,
    /// Flood at high pressure.
    FloodHigh,
    /// Flood at medium pressure.
    FloodMedium,
    /// Flood at low pressure.
    FloodLow,
    /// Mist.
    Mist,
    /// Through the tool.
    Through,
    /// Through the tool at medium pressure.
    ThroughMedium,
    /// Through the tool at low pressure.
    ThroughLow,
    /// Tapping oil.
    Tap,
    /// Air.
    Air,
}

/// An arc or helix in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// A point of its axis.
    pub center: Point3<f64>,
    /// Unit vector; the arc is counterclockwise seen against it.
    pub normal: Vector3<f64>,
    /// Where it begins.
    pub start: Point3<f64>,
    /// Where it ends.
    pub end: Pose,
    /// Swept angle, degrees, above 0.
    pub sweep: f64,
}

/// A whole thread. Lengths in mm, in the frame of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeThread {
    /// Where the crest begins and ends.
    pub crest: [Point3<f64>; 2],
    /// Unit vector from the crest to where the tool stands clear.
    pub out: Vector3<f64>,
    /// How far the tool goes in a turn.
    pub lead: f64,
    /// Number of threads beside each other.
    pub starts: u32,
    /// From the crest to the root.
    pub depth: f64,
    /// Depth of the first pass.
    pub first: f64,
    /// Number of passes, where it is laid down.
    pub passes: Option<u32>,
    /// Passes at full depth after the last one, where it is laid down.
    pub springs: Option<u32>,
    /// How far from the crest the tool goes back, where it is laid down.
    pub clearance: Option<f64>,
    /// Angle of the profile, degrees.
    pub angle: f64,
}

impl WholeThread {
    /// Index of the axis that it runs along: X on a face, else Z.
    pub(super) fn axis(&self) -> usize {
        if self.out.z.abs() > 0.5 { 0 } else { 2 }
    }
}

/// A hole along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Where the hole begins.
    pub start: Pose,
    /// FindingKind of cycle.
    pub kind: CycleKind,
    /// Depth below the start, above 0.
    pub depth: f64,
    /// R level above the start; `None` where the machine's settings give it.
    pub clear: Option<f64>,
    /// Level above the start to return to; 0 for the level before the cycle.
    pub retract: Option<f64>,
    /// Peck.
    pub step: Option<f64>,
    /// Of so many pecks that break chips the last one leaves the hole.
    pub out_each: Option<u32>,
    /// Dwell at the bottom, seconds; `None` where the machine's settings give it.
    pub dwell: Option<f64>,
    /// Feed.
    pub rate: Option<Rate>,
    /// A tap in step with the spindle.
    pub rigid: bool,
}

/// The offset that a tool change names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GivenOffset {
    /// Number of an offset of the machine.
    OfMachine(u32),
    /// Number of one of the tool's own compensations.
    Compensation(u32),
}

impl ExpectedStep {
    /// A block of INSERT with block delete.
    pub(super) fn has_block_delete(&self) -> bool {
        matches!(self, ExpectedStep::Insert { text, .. }
            if text.trim_start().as_bytes().first() == Some(&SKIP))
    }

    /// A line of the tape stands in a block that may be skipped.
    pub(super) fn mark_as_skipped(&mut self) {
        if let ExpectedStep::Insert { may_be_skipped, .. } = self {
            *may_be_skipped = true;
        }
    }

    /// What is left of a step that is left out: what holds on behind it.
    pub(super) fn left_out(self) -> Option<ExpectedStep> {
        match self {
            ExpectedStep::Tool { number, offset, .. } => {
                Some(ExpectedStep::ToolLeftOut { number, offset })
            }
            done if done.is_done_once() => None,
            holds_on => Some(holds_on),
        }
    }

    /// True for what blocks do, false for what holds on after them.
    pub fn is_done_once(&self) -> bool {
        self.end().is_some()
            || matches!(
                self,
                ExpectedStep::Home
                    | ExpectedStep::Retract
                    | ExpectedStep::Turn { .. }
                    | ExpectedStep::Tool { .. }
                    | ExpectedStep::Dwell(..)
                    | ExpectedStep::DwellTurns(_)
                    | ExpectedStep::WholeThread(_)
                    | ExpectedStep::SideSpindle(_)
                    | ExpectedStep::Stop { .. }
                    | ExpectedStep::OverrideLock(_)
                    | ExpectedStep::Clamp(_)
                    | ExpectedStep::Auxiliary(_)
                    | ExpectedStep::Insert { .. }
                    | ExpectedStep::Words(_)
            )
    }

    /// Where a motion ends; `None` for all else.
    pub fn end(&self) -> Option<Pose> {
        match self {
            ExpectedStep::Rapid(pose)
            | ExpectedStep::Feed(pose, _)
            | ExpectedStep::Thread(pose, _) => Some(*pose),
            ExpectedStep::Arc(arc, _) => Some(arc.end),
            ExpectedStep::Hole(hole) => Some(hole.start),
            _ => None,
        }
    }
}

impl Arc {
    /// The vector from the arc's axis to a point.
    pub fn spoke(&self, point: Point3<f64>) -> Vector3<f64> {
        let from = point - self.center;
        from - self.normal * self.normal.dot(&from)
    }

    /// The same arc from another start, which is near.
    pub(super) fn from(&self, start: Option<Point3<f64>>) -> Arc {
        let Some(start) = start else { return *self };
        let (old, new) = (self.spoke(self.start), self.spoke(start));
        let turned = libm::atan2(self.normal.dot(&old.cross(&new)), old.dot(&new)).to_degrees();
        Arc { start, sweep: self.sweep - turned, ..*self }
    }

    /// The point at a share of the arc, from 0 to 1.
    pub fn at(&self, share: f64) -> Point3<f64> {
        let from = self.spoke(self.start);
        let (sine, cosine) = libm::sincos((self.sweep * share).to_radians());
        let rise = self.normal * (self.rise_of(self.end.tip) * share);
        self.start - from + from * cosine + self.normal.cross(&from) * sine + rise
    }

    /// Radius at the start, mm.
    pub fn radius(&self) -> f64 {
        self.spoke(self.start).norm()
    }

    /// Angle from the start about the normal, degrees, 0 to 360.
    pub fn angle_of(&self, point: Point3<f64>) -> f64 {
        let (from, to) = (self.spoke(self.start), self.spoke(point));
        let angle = libm::atan2(self.normal.dot(&from.cross(&to)), from.dot(&to)).to_degrees();
        angle.rem_euclid(360.0)
    }

    /// How far a point has risen along the normal since the start, mm.
    pub fn rise_of(&self, point: Point3<f64>) -> f64 {
        self.normal.dot(&(point - self.start))
    }
}
