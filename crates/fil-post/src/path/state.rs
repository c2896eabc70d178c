//! What the CL file has said so far, and where it has brought the tool.

use fil_machine::Unit;
use fil_machine::axis_chain::Turn;
use nalgebra::{Point3, Rotation3, Vector3};

use super::arc_parts::Rest;
use super::{Coming, NamedFrames, Statement, Transformation, sense};
use crate::cause::Cause;
use crate::control_state::WorkOffset;
use crate::operation::cycle::{AboveHoles, Cycle};
use crate::operation::{Arc, Feed, Lead, Operation, SpindleSpeed, Target, Thread, ToolAhead};
use fil_machine::axes::Position;

/// Where the CL file stands: point and axis, and what its records asked for.
#[derive(Clone, Debug, Default)]
pub struct Path {
    /// What UNITS has said; the unit may be known without it.
    pub stated_unit: Option<Unit>,
    /// Last CL point, mm or inch, in the part frame.
    pub point: Option<Point3<f64>>,
    /// The tool axis.
    pub axis: ToolAxis,
    /// MULTAX is on: a GOTO may have an axis of any length. Off: it may have none but
    /// 0,0,1. `None` before the file has said it.
    pub multax: Option<bool>,
    /// The motion at hand needs no rotary axis away from zero: [`tip_control::choose`].
    ///
    /// [`tip_control::choose`]: super::tip_control::choose
    pub(crate) is_upright: bool,
    /// The last motion, and what has come since.
    pub(crate) last: LastMotion,
    /// Last rotary positions in degrees; `None` before the first motion.
    pub rotary: Option<[f64; 2]>,
    /// How the machine turns from there.
    pub(crate) turning: Turning,
    /// The tilted frame that motions were last written in.
    pub(crate) frame: Option<TiltedFrame>,
    /// The radius of the cylinder in force about the spindle of a mill-turn machine.
    pub(crate) cylinder: Option<f64>,
    /// RAPID was given, by this record: the next motion is rapid.
    pub rapid: Option<Cause>,
    /// How often RAPID was given.
    pub(crate) rapids: u32,
    /// Feed of the next feed motion.
    pub feed: Option<Feed>,
    /// FEDRAT/INVERS,AUTO: feed motions say how long they take.
    pub inverse_time: bool,
    /// CIRCLE waits for its end point.
    pub arc: Option<Arc>,
    /// A CIRCLE that takes many blocks.
    pub(crate) long_arc: LongArc,
    /// The canned cycle that each GOTO carries out.
    pub cycle: Option<Cycle>,
    /// What THREAD, PITCH and OP/THREAD ask for.
    pub(crate) thread: Threads,
    /// TRANS with a matrix, TRACUT, a named frame or a turned table.
    pub transformation: Option<Transformation>,
    /// What has moved the points by three numbers.
    pub(crate) shift: Shift,
    /// The frames that the file has named.
    pub(crate) named_frames: NamedFrames,
    /// CUTTER of the tool at hand.
    pub(crate) cutter: Option<Cutter>,
    /// What comes, where whoever drives the post has looked.
    pub ahead: LookAhead,
    /// What tells which way arcs turn.
    pub(crate) sense: Sense,
    /// What was said in blocks that can be skipped.
    pub(super) skipped: Said,
}

/// The tool axis of the CL file.
#[derive(Clone, Copy, Debug)]
pub struct ToolAxis {
    /// That of points that give none: that of the last point, or of TLAXIS.
    pub given: Vector3<f64>,
    /// A record has given one since MULTAX/OFF: the file is of more than three axes.
    pub(crate) is_said: bool,
    /// A frame has turned under a leaning axis, which motions can't take over without saying it.
    pub(crate) in_doubt: bool,
    /// That in which the last motion has left the machine.
    pub(crate) stands: Vector3<f64>,
}

impl Default for ToolAxis {
    fn default() -> Self {
        ToolAxis { given: Vector3::z(), is_said: false, in_doubt: false, stands: Vector3::z() }
    }
}

/// The last motion, and what has come since.
#[derive(Clone, Debug, Default)]
pub(crate) struct LastMotion {
    /// A motion has come.
    pub has_moved: bool,
    /// It was at feed: the tool may stand in its cut.
    pub in_cut: bool,
    /// It was written in inverse time, in which the control still is.
    pub writes_inverse_time: bool,
    /// What came behind it.
    pub since: Since,
    /// The points were moved since the last one came, or the tool away from it.
    pub is_left: bool,
    /// The last point when a section took a motion: behind it the CL file goes on from another one.
    pub taken_behind: Option<Point3<f64>>,
    /// POSTN has moved the axes. It counts whole turns itself, so that a rapid motion need not take
    /// them back; one at feed turns from where it has left the machine.
    pub turned_by_words: bool,
    /// Where the last cycle has left the tip above its holes under tool-tip control, with the
    /// last outputs of X, Y and Z then.
    pub above_left: Option<(AboveHoles, [f64; 3])>,
}

/// How the machine turns from motion to motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turning {
    /// Last rotary positions as they are the nearest if no axis has limits, degrees.
    pub free: Option<[f64; 2]>,
    /// The last rotary positions that were found for a motion, with their sines.
    pub turns: [Turn; 2],
    /// Positions that the look-ahead has chosen for the rapid motion at hand, degrees.
    pub chosen: Option<[f64; 2]>,
    /// Where the last motion that turned the machine has brought it.
    pub arrived: Option<Arrived>,
    /// How far the tip may leave its line while the machine turns.
    pub straightness: Straightness,
    /// The tool and the zero with which the machine was turned first.
    pub turned_with: TurnedWith,
}

/// A CIRCLE that takes many blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct LongArc {
    /// The lines written now are its chords.
    pub in_chords: bool,
    /// What is left of one that is on the tape in part.
    pub rest: Option<Box<Rest>>,
}

/// What THREAD, PITCH and OP/THREAD ask for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Threads {
    /// Each feed motion is a pass of this thread.
    pub passes: Option<Passes>,
    /// The lead that PITCH has given for threads that follow.
    pub pitch: Option<Pitch>,
    /// Where the last pass has ended, from where the next motion may go on, and the number of blocks then.
    pub pass_end: Option<(Point3<f64>, u64)>,
    /// A whole thread is being cut: its rapid motions are those of the post.
    pub in_whole: bool,
    /// A whole thread that waits for its points, or has them.
    pub awaited: Option<Box<Awaited>>,
}

/// What has moved the points by three numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Shift {
    /// Nothing.
    #[default]
    None,
    /// TRANS with three numbers.
    Trans,
    /// ORIGIN.
    Origin,
}

/// What CUTTER has named.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cutter {
    /// Diameter, mm or inch.
    pub diameter: f64,
    /// Where the CL file stood then.
    pub named_at: Option<Point3<f64>>,
}

/// What comes, where whoever drives the post has looked.
#[derive(Clone, Debug, Default)]
pub struct LookAhead {
    /// What comes behind the last tool change.
    pub tool: ToolAhead,
    /// The motions behind a RAPID.
    pub motions: Vec<Coming>,
    /// A tool change by hand comes right behind a STOP.
    pub change_by_hand: bool,
}

/// What tells which way arcs turn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sense {
    /// How the last feed motion ended.
    pub course: sense::Course,
    /// Whether anybody has chosen it.
    pub choice: Choice,
}

/// Whether whoever chose the dialect has said which way arcs turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Choice {
    /// Nobody has.
    #[default]
    Open,
    /// He has.
    Made,
    /// Nobody has; the arcs were refused, and would not be with their sense chosen.
    WouldSettle,
}

/// What came behind the last motion, so that its point may tell nothing of where the tool stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Since {
    /// Nothing that moves the tool or the points.
    #[default]
    Motion,
    /// TRANS, ORIGIN, TRACUT, ROTABL, a named frame, FROM or a text: the last point is not where
    /// the tool stands.
    Frame,
    /// A hole: the tool stands above the last point.
    Hole,
    /// A tool change: nobody knows where the new tool stands.
    ToolChange,
}

impl Path {
    /// The points are moved by the matrix of a statement.
    pub(crate) fn is_moved_by(&self, statement: Statement) -> bool {
        self.transformation.as_ref().is_some_and(|it| it.of == statement)
    }

    /// A motion has brought the tool to a point and into its axis.
    #[inline]
    pub(crate) fn arrive(&mut self, target: Target) {
        self.point = Some(target.point);
        (self.axis.given, self.axis.stands) = (target.axis, target.axis);
        self.last.since = Since::Motion;
        self.last.has_moved = true;
        self.last.is_left = false;
    }

    /// The last point, where a motion has brought the tool to it and nothing away since.
    pub(crate) fn stands_at(&self) -> Option<Point3<f64>> {
        self.point.filter(|_| self.last.since == Since::Motion && self.last.has_moved)
    }

    /// The last point is no longer the one at which the tool stands.
    pub(crate) fn leave_point(&mut self) {
        self.last.is_left = true;
        if self.last.since != Since::ToolChange {
            self.last.since = Since::Frame;
        }
    }

    /// Something comes between two holes or two motions: the level before the cycle is
    /// the one after it, and the motions tell nothing about each other.
    pub(crate) fn interrupt(&mut self) {
        self.sense.course.interrupt();
        self.last.above_left = None;
        if let Some(cycle) = &mut self.cycle {
            cycle.initial = None;
            cycle.above = None;
            cycle.in_force = None;
        }
    }
}

/// The frame that motions are written in.
#[derive(Clone, Copy, Debug)]
pub struct TiltedFrame {
    /// Tool axis in the part.
    pub(super) axis: Vector3<f64>,
    /// Where the rotary axes stand, degrees.
    pub(super) angles: [f64; 2],
    /// Turns directions of the frame, as the tape has it, into those of the part; `None`
    /// where the machine stands at zero and the control is in no frame.
    pub(super) turn: Option<Rotation3<f64>>,
}

/// What LINTOL has said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Straightness {
    /// LINTOL/t, in the unit of the program; `None` for that of the machine.
    pub tolerance: Option<f64>,
    /// LINTOL/OFF.
    pub off: bool,
}

/// Where the last motion that turned the machine has brought it: the next one begins there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrived {
    /// State of the settings and of the unit that the positions hold for.
    pub(super) settings: (u64, bool),
    /// The point in the part, after TRANS, and the rotary positions.
    pub(super) target: (Point3<f64>, [f64; 2]),
    pub(super) position: Position,
    pub(super) on_tape: OnTape,
    /// The last output values of the axes behind it.
    pub(super) outputs: Position,
}

/// A position as the tape has it, and the tip there, in the part.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnTape {
    pub(super) position: Position,
    pub(super) tip: Point3<f64>,
}

/// The tool and the zero with which the machine was turned first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TurnedWith {
    pub(super) tool: Option<i64>,
    /// The tool for which levels of the machine's Z were counted while a head leaned it.
    pub(super) tool_of_levels: Option<i64>,
    pub(super) zero: Option<WorkOffset>,
    /// A head has turned the tool across Z, and so it was said of its length.
    pub(super) lies_across: bool,
}

/// A lead for threads that follow, and what it gains in each turn, mm or inch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pitch {
    pub lead: Lead,
    pub change: f64,
}

/// A thread of which each feed motion is a pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passes {
    pub lead: Lead,
    /// What the lead gains in each turn, mm or inch; below zero it loses.
    pub change: f64,
    /// How the spindle turned in the first pass.
    pub turns: Option<Turns>,
}

impl Passes {
    /// The passes of a thread that is new.
    pub fn new(lead: Lead, change: f64) -> Passes {
        Passes { lead, change, turns: None }
    }
}

/// How the spindle turns: its speed as SPINDL asked for it, and clockwise or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turns {
    pub(super) speed: Option<SpindleSpeed>,
    /// The highest speed, where the control holds this one to it.
    pub(super) held: Option<f64>,
    pub(super) clockwise: Option<bool>,
    /// It is the second spindle of the lathe.
    pub(super) is_side: bool,
}

/// OP/THREAD with depth and passes: what it asks for, and the points that have come.
#[derive(Clone, Debug)]
pub struct Awaited {
    /// The thread, but for its points and its side.
    pub thread: Thread,
    /// The thread runs across a face.
    pub on_face: bool,
    /// Direction of the cut from Z (CUTANG), degrees.
    pub direction: Option<f64>,
    /// Where the tool stood before.
    pub from: Option<Target>,
    /// Where the crest begins.
    pub start: Option<Target>,
    /// Both points have come.
    pub is_cut: bool,
}

/// The last operation of each kind in blocks that can be skipped, in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Said(pub(super) Vec<Operation>);
