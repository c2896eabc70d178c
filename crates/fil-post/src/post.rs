//! The post of one run: control and path.

use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Unit};

use crate::cause::Cause;
use crate::control::Control;
use crate::control::needs::{Act, Part};
use crate::errors::PostCode;
use crate::items::Items;
use crate::noted::Noted;
use crate::operation::Feed;
use crate::path::places::Places;
use crate::path::{Choice, Path};

/// What waits for the next motion of the CL file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WaitsForMotion {
    /// How often RAPID was given before.
    rapids: u32,
    /// A CIRCLE waits for its end.
    arc: bool,
}

/// Whether the next point may go the straight lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Lane {
    /// None may: others than the post may change its state between two records.
    #[default]
    Barred,
    /// It may not.
    Closed,
    /// A motion at feed came last: whether it may is to be looked at.
    Unseen,
    /// It may.
    Open,
}

/// The generalized post of one run.
///
/// Finished blocks lie in the tape of its [`Control`]; whoever drives the post takes
/// them away from time to time, so that memory does not grow with the CL file.
#[derive(Clone)]
pub struct Post {
    /// The output side: settings, tape, what the control knows.
    pub control: Control,
    /// Where the CL file stands.
    pub path: Path,
    /// Whether points may go the straight lane.
    pub(crate) lane: Lane,
    /// What has begun that the user's blocks stand around.
    pub(crate) places: Places,
}

impl Post {
    /// Refuses an operation whose needs the control or the CL file does not meet.
    ///
    /// # Errors
    /// As [`Control::require`].
    #[inline(always)]
    pub fn require(&self, act: Act) -> Result<()> {
        let part = Part {
            in_cycle: self.path.cycle.is_some(),
            in_thread: self.path.thread.passes.is_some(),
            in_arc: self.path.arc.is_some(),
            awaits_points: self.path.thread.awaited.as_ref().is_some_and(|it| !it.is_cut),
        };
        self.control.require_within(act, part)
    }

    /// Keeps the causes of blocks and words from now on.
    pub fn observe(&mut self) {
        self.control.tape.noted = Some(Noted::default());
        self.control.block.noting = true;
    }

    /// Says the unit of a CL file that does not say it itself. A machine that takes
    /// one unit only keeps that.
    pub fn assume_unit(&mut self, unit: Unit) {
        self.control.unit = self.control.unit.or(Some(unit));
    }

    /// The last record has more blocks to be written.
    #[inline]
    pub fn has_more(&self) -> bool {
        self.path.long_arc.rest.is_some()
    }

    /// Lets go of what a refused record has begun, so that the records after it can be
    /// looked at for further errors. What is written from now on is no program.
    pub fn let_go(&mut self) {
        self.control.block.clear();
        self.path.arc = None;
        self.path.long_arc.rest = None;
        self.path.long_arc.in_chords = false;
        self.path.rapid = None;
        self.path.interrupt();
    }

    /// What waits for the next motion of the CL file.
    pub fn waits_for_motion(&self) -> WaitsForMotion {
        WaitsForMotion { rapids: self.path.rapids, arc: self.path.arc.is_some() }
    }

    /// A section has taken a motion of the CL file for which this waited when its record came:
    /// RAPID before it was for that motion, and GODLTA behind it counts from a point that the post
    /// has not seen, unless motions of the section have replaced it.
    ///
    /// # Errors
    /// It was the end of a CIRCLE that the post waits for.
    pub fn motion_is_taken(&mut self, waits: WaitsForMotion, is_replaced: bool) -> Result<()> {
        if waits.arc && self.path.arc.is_some() {
            return PostCode::ArcEnd.err_with(
                "a section takes the GOTO that ends the CIRCLE before it, and the next GOTO would \
                 be taken for its end",
                "Take the CIRCLE too, or give its end to the post with POSTF(13).",
            );
        }
        if self.path.rapids == waits.rapids {
            self.path.rapid = None;
        }
        if !is_replaced {
            self.path.last.taken_behind = self.path.point;
        }
        Ok(())
    }

    /// Takes some feed where none was given, to look for errors other than that.
    pub fn assume_feed(&mut self) {
        const SOME: f64 = 1.0;
        let (mode, cause) = (FeedMode::PerMinute, Cause::default());
        self.path.feed.get_or_insert(Feed { value: SOME, asked: SOME, mode, cause });
    }

    /// Which way arcs turn was chosen by whoever runs the post: arcs that prove nothing are
    /// only warned of. Arcs that contradict the choice are still refused.
    pub fn trust_arcs(&mut self) {
        self.path.sense.choice = Choice::Made;
    }

    /// What the system that wrote the CL file is known for: the sense of its arcs is proved, so that
    /// none is refused for the motions beside it; its full turns end exactly where they begin.
    pub fn know_arcs(&mut self, are_proved: bool, exact_turns: bool) {
        let course = &mut self.path.sense.course;
        course.is_proved |= are_proved;
        course.exact_turns |= exact_turns;
    }

    /// The arcs were refused, and [`Post::trust_arcs`] would make that a warning.
    pub fn trust_settles_arcs(&self) -> bool {
        self.path.sense.choice == Choice::WouldSettle
    }

    /// Motions are output under TCPC: on a machine without tilted work planes all that the machine
    /// turns for; else those under MULTAX/ON, and in a file without MULTAX those of a tool whose axis
    /// changes in a cut. A tool that cuts along one axis at a time and does what TCPC has not goes
    /// into the planes.
    #[inline]
    pub(crate) fn writes_tip(&self) -> bool {
        let tables = &self.control.tables;
        if !tables.tip_output {
            return false;
        }
        let tool = &self.path.ahead.tool;
        match self.path.multax {
            Some(true) if tables.frame_output => tool.turns_in_cut || !tool.needs_a_plane,
            None if tables.frame_output => tool.turns_in_cut,
            multax => multax == Some(true) || !tables.frame_output && !self.path.is_upright,
        }
    }

    /// The last CL point, in CL units.
    pub fn point(&self) -> Option<[f64; 3]> {
        self.path.point.map(|p| [p.x, p.y, p.z])
    }

    /// True where a matrix moves the points of the CL file: that of the machine, TRANS, ROTABL or a
    /// named frame.
    pub fn moves_points(&self) -> bool {
        self.path.transformation.is_some()
    }

    /// The unit of CL file and program; `None` before anything has said it.
    pub fn unit(&self) -> Option<Unit> {
        self.control.unit
    }

    /// Diameter of the cutter as the CL file names it, in CL units.
    pub fn cutter_diameter(&self) -> Option<f64> {
        self.path.cutter.map(|cutter| cutter.diameter)
    }

    /// True when rotary positions are chosen by the motions behind a RAPID: whoever drives the
    /// post tells them by `path.ahead.motions` before the record.
    pub fn looks_ahead_for_axes(&self) -> bool {
        self.control.tables.chain().has_rotary() && self.control.commons.read(loc::REPOS_OPTIMISE)
    }

    /// True when lengths or feeds were given: a change of the unit would leave them
    /// in the other one.
    pub(crate) fn has_lengths(&self) -> bool {
        let Path { point, feed, cycle, transformation, cutter, thread, turning, .. } = &self.path;
        point.is_some()
            || feed.is_some()
            || cycle.is_some()
            || transformation.is_some()
            || cutter.is_some()
            || thread.passes.is_some()
            || turning.straightness.tolerance.is_some()
    }

    /// Warns once per code and subject.
    pub(crate) fn warn(&mut self, code: PostCode, message: String) {
        self.control.warnings.add(code, message);
    }

    /// What is put next has the item that was taken last as its cause.
    pub(crate) fn due_to(&mut self, items: &Items) {
        self.control.block.cause.word = items.last_word();
    }
}
