//! The straight lane: a run of points at one feed. What a motion asks of the control and of the
//! path is asked once for the run; each point then only moves axes.
//!
//! The lane opens behind a motion at feed for which the long way would have nothing to do but write
//! the words of its axes, and any other record closes it. The words and the block are those of the
//! long way, by its own functions, and a point that they refuse is left to it.

use fil_cl::record::motion;
use fil_cl::vocabulary::words as w;
use fil_cl::{Record, record::kind};
use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::commons::EMPTY;
use fil_machine::letters::{F, G};
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;
use nalgebra::Point3;

use crate::control::word_address::motion::axis_words;
use crate::control::{Control, length_plane};
use crate::control_state::Compensation;
use crate::control_state::modal::{self, Group, GroupSet};
use crate::operation::motion::Motion;
use crate::operation::{Feed, MOTION, POINT, Target};
use crate::path::Path;
use crate::post::{Lane, Post};

/// Groups beside whose usual values a motion at feed has nothing to say, to refuse or to warn of.
const USUAL: GroupSet = GroupSet::of(&[
    Group::Distance,
    Group::DiameterMode,
    Group::PlaneIsTemporary,
    Group::Cycle,
    Group::CutterComp,
    Group::CutterPath,
    Group::Spindle,
    Group::SpindleHalted,
    Group::AxisClamp,
    Group::Tool,
    Group::ProgramEnd,
]);

impl Post {
    /// Runs of points may go the straight lane: from now on nobody changes the state of the post
    /// between two records but the post.
    pub fn allow_lane(&mut self) {
        self.lane = Lane::Closed;
    }

    /// Carries a record out where it is a point that goes the straight lane; else says so, and
    /// nothing is done.
    ///
    /// # Errors
    /// The block can't be written.
    #[inline]
    pub(crate) fn goes_straight_on(&mut self, record: &Record) -> Result<bool> {
        let is_open = match self.lane {
            Lane::Barred | Lane::Closed => return Ok(false),
            Lane::Unseen => leads_straight_on(&self.control, &self.path),
            Lane::Open => true,
        };
        self.lane = Lane::Closed;
        if !is_open || !self.move_axes(record)? {
            return Ok(false);
        }
        self.lane = Lane::Open;
        Ok(true)
    }

    /// The long way has carried a record out.
    #[inline]
    pub(crate) fn came_the_long_way(&mut self, record: &Record) {
        if self.lane != Lane::Barred && is_plain_point(record) && self.path.last.in_cut {
            self.lane = Lane::Unseen;
        }
    }

    fn move_axes(&mut self, record: &Record) -> Result<bool> {
        if !is_plain_point(record) {
            return Ok(false);
        }
        self.blocks_come_of(record);
        let Post { control, path, .. } = self;
        let (Some(point), Some(from)) = (record.point().map(Point3::from), path.point) else {
            return Ok(false);
        };
        let at = point + control.tables.input_shift();
        let motion = Motion::new([at.x, at.y, at.z, 0.0, 0.0], AxisSet::LINEAR, POINT);
        let Ok(moves) = axis_words(control, &motion) else { return Ok(false) };
        path.sense.course.line(point - from)?;
        path.arrive(Target { point, axis: path.axis.given, word: POINT });
        if moves {
            control.write_block()?
        }
        Ok(true)
    }
}

/// GOTO/x,y,z.
#[inline]
fn is_plain_point(record: &Record) -> bool {
    (record.kind, record.sub) == (kind::MOTION, motion::GOTO)
        && record.major == w::GOTO
        && record.data.len() == MOTION[0]
        && !record.inert
}

/// True where the long way would write no more than the words of axes for points at feed.
fn leads_straight_on(control: &Control, path: &Path) -> bool {
    moves_axes_alone(control)
        && nothing_is_due(control)
        && goes_on(path)
        && path.axis.given == control.tables.chain().tool.into_inner()
        && path.feed.is_some_and(|feed| is_in_force(control, feed))
}

/// On this machine a straight motion at feed is one block of words of X, Y and Z.
fn moves_axes_alone(control: &Control) -> bool {
    let tables = &control.tables;
    !tables.chain().has_rotary()
        && tables.input_matrix().is_none()
        && !tables.prepares
        && !tables.watches_turns
        && tables.travel_rules.is_empty()
        && tables.most_departure.is_none()
        && !tables.motion.is_special
        && control.commons.read(loc::LINEAR_MODAL) != loc::LinearModal::InEveryBlock
}

/// The program runs, nobody edits its blocks, and the control is in all modes that a motion at feed
/// counts on.
fn nothing_is_due(control: &Control) -> bool {
    let state = &control.state;
    control.head.started
        && control.straight
        && control.repeat.ended.is_empty()
        && control.repeat.words.is_empty()
        && control.waiting.is_empty()
        && control.tools.held.is_empty()
        && control.tools.coolant.is_none()
        && !control.tip.begins_unsaid
        && control.block.is_empty()
        && control.compensation_asked() == Compensation::Off
        && state.groups().are_usual(USUAL)
        && !state.has_doubts()
        && control.unit.is_some_and(|unit| state.is(modal::UNITS, unit))
        && !length_plane::is_left(control)
}

/// The control goes in straight lines, at this feed.
fn is_in_force(control: &Control, feed: Feed) -> bool {
    let linear = control.code_if_any(loc::LINEAR_CODE);
    linear.is_some_and(|linear| control.state.is(modal::MOTION, linear))
        && control.commons.last_output(G) != EMPTY
        && feed.mode == FeedMode::PerMinute
        && control.state.is(modal::FEED_MODE, feed.mode)
        && control.has_value(F, feed.value)
}

/// The CL file has said nothing that a point would take up.
fn goes_on(path: &Path) -> bool {
    path.rapid.is_none()
        && path.arc.is_none()
        && path.cycle.is_none()
        && path.thread.passes.is_none()
        && path.transformation.is_none()
        && !path.inverse_time
        && !path.last.turned_by_words
        && !path.named_frames.waits
        && !path.axis.in_doubt
        && path.sense.course.is_judged()
}
