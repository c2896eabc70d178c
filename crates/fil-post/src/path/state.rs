//! What the CL file has said so far, and where it has brought the tool.

use fil_machine::Unit;
use fil_machine::axis_chain::Turn;
use nalgebra::{Point3, Vector3};

use super::{
    Coming, Cycle, NamedFrames, Straightness, Transformation, cycle, frame, linearization,
    long_arc, sense, skip, thread, turned_apart,
};
use crate::cause::Cause;
use crate::operation::{Arc, Feed, Lead, NextTools, Target};

/// Where the CL file stands: point and axis, and what its records asked for.
#[derive(Clone, Debug)]
pub struct Path {
    /// What UNITS has said; the unit may be known without it.
    pub stated_unit: Option<Unit>,
    /// Last CL point, mm or inch, in the part frame.
    pub point: Option<Point3<f64>>,
    /// The tool axis of points that give none: that of the last point, or of TLAXIS.
    pub axis: Vector3<f64>,
    /// The tool axis in which the last motion has left the machine.
    pub(crate) stands: Vector3<f64>,
    /// A frame has turned under a leaning axis, which motions can't take over without saying it.
    pub(crate) axis_in_doubt: bool,
    /// MULTAX is on: a GOTO may have an axis of any length. Off: it may have none but
    /// 0,0,1. `None` before the file has said it.
    pub multax: Option<bool>,
    /// A motion has come.
    pub(crate) has_moved: bool,
    /// The last motion was at feed: the tool may stand in its cut.
    pub(crate) in_cut: bool,
    /// The points were moved since the last one came, or the tool away from it.
    pub(crate) is_left: bool,
    /// The last point when a section took a motion: behind it the CL file goes on from another one.
    pub(crate) taken_behind: Option<Point3<f64>>,
    /// Last rotary positions in degrees; `None` before the first motion.
    pub rotary: Option<[f64; 2]>,
    /// Last rotary positions as they are the nearest if no axis has limits, degrees.
    pub(crate) free: Option<[f64; 2]>,
    /// The last rotary positions that were found for a motion, with their sines.
    pub(crate) turns: [Turn; 2],
    /// Where the last motion that turned the machine has brought it.
    pub(crate) arrived: Option<linearization::Arrived>,
    /// Positions that the look-ahead has chosen for the rapid motion at hand, degrees.
    pub(crate) chosen: Option<[f64; 2]>,
    /// The tilted frame that motions were last written in.
    pub(crate) frame: Option<frame::TiltedFrame>,
    /// The radius of the cylinder in force about the spindle of a mill-turn machine.
    pub(crate) cylinder: Option<f64>,
    /// How far the tip may leave its line while the machine turns.
    pub straightness: Straightness,
    /// The last feed motion was written in inverse time, in which the control still is.
    pub(crate) writes_inverse_time: bool,
    /// RAPID was given, by this record: the next motion is rapid.
    pub rapid: Option<Cause>,
    /// How often RAPID was given.
    pub(crate) rapids: u32,
    /// Feed of the next feed motion.
    pub feed: Option<Feed>,
    /// FEDRAT/INVERS,AUTO: feed motions say how long they take.
    pub inverse_time: bool,
    /// The lines written now are chords of an arc.
    pub(crate) in_chords: bool,
    /// CIRCLE waits for its end point.
    pub arc: Option<Arc>,
    /// What is left of a CIRCLE that is on the tape in part.
    pub(crate) rest: Option<Box<long_arc::Rest>>,
    /// The canned cycle that each GOTO carries out.
    pub cycle: Option<Cycle>,
    /// Where the last cycle has left the tip above its holes under tool-tip control, with the
    /// last outputs of X, Y and Z then.
    pub(crate) above_left: Option<(cycle::AboveHoles, [f64; 3])>,
    /// A thread is cut by each feed motion.
    pub thread: Option<Lead>,
    /// How the spindle turned in the first pass of that thread.
    pub(crate) thread_turns: Option<thread::Turns>,
    /// The lead that PITCH has given for threads that follow.
    pub(crate) pitch: Option<thread::Pitch>,
    /// What the lead of the thread gains in each turn, mm or inch; below zero it loses.
    pub(crate) lead_change: f64,
    /// Where the last pass has ended, from where the next motion may go on, and the number of blocks then.
    pub(crate) pass_end: Option<(Point3<f64>, u64)>,
    /// A whole thread is being cut: its rapid motions are those of the post.
    pub(crate) in_whole_thread: bool,
    /// A whole thread that waits for its points, or has them.
    pub(crate) awaited_thread: Option<Box<thread::Awaited>>,
    /// TRANS or TRACUT.
    pub transformation: Option<Transformation>,
    /// The translation of the input is that of ORIGIN.
    pub(crate) has_origin: bool,
    /// The transformation is that of TRACUT.
    pub(crate) has_tracut: bool,
    /// The transformation is that of a frame that CSYS or its like has named.
    pub(crate) has_csys: bool,
    /// The frames that the file has named.
    pub(crate) named_frames: NamedFrames,
    /// TRANS with three numbers is in force.
    pub(crate) is_shifted: bool,
    /// The transformation is that of a table that ROTABL has turned under the points.
    pub(crate) has_index: bool,
    /// The tool and the zero with which the machine was turned first.
    pub(crate) turned_with: turned_apart::TurnedWith,
    /// What came behind the last motion.
    pub(crate) since: Since,
    /// POSTN has moved the axes since the last motion. It counts whole turns itself, so that a
    /// rapid motion need not take them back; one at feed turns from where it has left the machine.
    pub(crate) turned_by_words: bool,
    /// Diameter of the cutter, mm or inch.
    pub cutter: Option<f64>,
    /// Where the CL file stood when CUTTER named it.
    pub(crate) cutter_named_at: Option<Point3<f64>>,
    /// The tool changes behind the next one, where whoever drives the post has looked.
    pub next_tools: NextTools,
    /// The motions behind a RAPID, where whoever drives the post has looked.
    pub coming: Vec<Coming>,
    /// How the last feed motion ended, to judge the sense of arcs.
    pub(crate) course: sense::Course,
    /// Whoever chose the dialect has said which way arcs turn.
    pub(crate) sense_is_chosen: bool,
    /// The arcs were refused, and would not be with their sense chosen.
    pub(crate) choice_settles_arcs: bool,
    /// What was said in blocks that can be skipped.
    pub(super) skipped: skip::Said,
}

impl Default for Path {
    fn default() -> Self {
        Path {
            stated_unit: None,
            point: None,
            axis: Vector3::z(),
            stands: Vector3::z(),
            axis_in_doubt: false,
            multax: None,
            has_moved: false,
            in_cut: false,
            is_left: false,
            taken_behind: None,
            rotary: None,
            free: None,
            turns: [Turn::default(); 2],
            arrived: None,
            chosen: None,
            frame: None,
            cylinder: None,
            straightness: Straightness::default(),
            writes_inverse_time: false,
            rapid: None,
            rapids: 0,
            feed: None,
            inverse_time: false,
            in_chords: false,
            arc: None,
            rest: None,
            cycle: None,
            above_left: None,
            thread: None,
            thread_turns: None,
            pitch: None,
            turned_with: turned_apart::TurnedWith::default(),
            lead_change: 0.0,
            pass_end: None,
            in_whole_thread: false,
            awaited_thread: None,
            transformation: None,
            has_origin: false,
            has_tracut: false,
            has_csys: false,
            named_frames: NamedFrames::default(),
            is_shifted: false,
            has_index: false,
            since: Since::Motion,
            turned_by_words: false,
            cutter: None,
            cutter_named_at: None,
            next_tools: NextTools::default(),
            coming: Vec::new(),
            course: sense::Course::default(),
            sense_is_chosen: false,
            choice_settles_arcs: false,
            skipped: skip::Said::default(),
        }
    }
}

/// What came behind the last motion, so that its point may tell nothing of where the tool stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Since {
    /// Nothing that moves the tool or the points.
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
    /// A motion has brought the tool to a point and into its axis.
    #[inline]
    pub(crate) fn arrive(&mut self, target: Target) {
        self.point = Some(target.point);
        self.axis = target.axis;
        self.stands = target.axis;
        self.since = Since::Motion;
        self.has_moved = true;
        self.is_left = false;
    }

    /// The last point, where a motion has brought the tool to it and nothing away since.
    pub(crate) fn stands_at(&self) -> Option<Point3<f64>> {
        self.point.filter(|_| self.since == Since::Motion && self.has_moved)
    }

    /// The last point is no longer the one at which the tool stands.
    pub(crate) fn leave_point(&mut self) {
        self.is_left = true;
        if self.since != Since::ToolChange {
            self.since = Since::Frame;
        }
    }

    /// Something comes between two holes or two motions: the level before the cycle is
    /// the one after it, and the motions tell nothing about each other.
    pub(crate) fn interrupt(&mut self) {
        self.course.interrupt();
        self.above_left = None;
        if let Some(cycle) = &mut self.cycle {
            cycle.initial = None;
            cycle.above = None;
            cycle.in_force = None;
        }
    }
}
