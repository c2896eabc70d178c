//! GOTO/x,y,z\[,i,j,k] (and GOHOME): the next point of the path.

use fil_cl::record::FIRST_DATA;
use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;
use nalgebra::{Point3, Vector3};

use super::{csys, home};
use crate::control::needs::Act;
use crate::control::word_address::spindle;
use crate::control_state::Rotation;
use crate::control_state::modal::{self, Group, GroupSet};
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::{MotionKind, Operation, Target};
use crate::path::{Since, carry_out, linear, places, thread_points};
use crate::post::Post;

/// Levels nearer than this are one level, mm or inch.
const SAME_LEVEL: f64 = 1e-6;

/// Moves to the point; ends an arc or drills a hole when CIRCLE or CYCLE ask for it.
///
/// # Errors
/// All that the motion refuses.
#[inline]
pub fn handle(post: &mut Post, target: Target) -> Result<()> {
    csys::settle(post, target.axis)?;
    if let Some(arc) = post.path.arc.take() {
        if post.path.rapid.take().is_some() {
            let message = "RAPID before a CIRCLE: the arc is cut at feed".to_string();
            post.warn(PostCode::IgnoredPart, message);
        }
        warn_of_standing_spindle(post);
        return carry_out(post, Operation::Arc(arc, target));
    }
    point(post, target)
}

/// Drills a hole at a point, where a cycle is in force, or goes straight to it.
///
/// # Errors
/// All that the hole or the motion refuses.
#[inline]
pub fn point(post: &mut Post, target: Target) -> Result<()> {
    if drills(post) {
        return carry_out(post, Operation::Hole(target));
    }
    if let Some(clear) = post.path.cycle.as_ref().map(|cycle| cycle.clear) {
        rapid_between_holes(post, target, clear)?;
    }
    straight(post, target)
}

/// Says that a RAPID in a cycle in force drills no hole.
///
/// # Errors
/// It goes down to where the tool would be nearer to the last hole than CLEAR, or lower than it stands
/// before the first one: nobody knows whether that is a hole.
#[cold]
fn rapid_between_holes(post: &mut Post, target: Target, clear: f64) -> Result<()> {
    let least = if post.path.last.since == Since::Hole { clear } else { 0.0 };
    let above = |from: Point3<f64>| (target.point - from).dot(&target.axis.normalize());
    let is_below = post.path.point.is_some_and(|from| above(from) < least - SAME_LEVEL);
    if is_below && post.path.last.since != Since::ToolChange {
        return PostCode::CycleForm.err_with(
            "RAPID in a cycle goes below the plane over the holes: a move to a hole, or a hole",
            "Remove RAPID if the point is a hole, which the cycle approaches at rapid; if it is not, put CYCLE / OFF before it.",
        );
    }
    let message = "RAPID in a cycle: the tool goes there at rapid, and no hole is drilled";
    post.warn(PostCode::IgnoredPart, message.to_string());
    Ok(())
}

/// The next point is a hole of the cycle in force.
#[inline]
pub fn drills(post: &Post) -> bool {
    post.path.cycle.is_some() && post.path.rapid.is_none()
}

/// Goes straight to the point: at rapid, at feed, or in a pass of a thread.
///
/// # Errors
/// All that the motion refuses.
#[inline]
pub fn straight(post: &mut Post, target: Target) -> Result<()> {
    if post.places.are_on {
        places::begin(post)?;
    }
    match take_kind_of_motion(post) {
        MotionKind::Thread(lead) => thread_points::point(post, target, lead),
        // The most frequent operation is carried out without being made: its copy would have
        // to wait for the target, which was written a moment ago.
        kind => {
            if kind == MotionKind::Feed {
                warn_of_standing_spindle(post);
            }
            linear::carry_out(post, &target, kind)
        }
    }
}

/// Warns of a motion at feed while the spindle is known to stand, once for each tool. A lathe feeds
/// by the minute so to pull bar and to part off; by the revolution it would wait for the spindle.
#[inline]
fn warn_of_standing_spindle(post: &mut Post) {
    if !post.control.state.groups().are_usual(OF_SPINDLE) {
        warn_if_it_stands(post);
    }
}

/// What may stop a spindle.
const OF_SPINDLE: GroupSet = GroupSet::of(&[Group::Spindle, Group::SpindleHalted]);

#[cold]
fn warn_if_it_stands(post: &mut Post) {
    if matches!(post.control.state.rotation(), Rotation::Standing | Rotation::Unsaid) {
        warn_where_it_must_turn(post);
    } else if post.control.state.may_be(modal::SPINDLE_HALTED, true) {
        warn_behind_stop(post);
    }
}

#[cold]
fn warn_where_it_must_turn(post: &mut Post) {
    let control = &post.control;
    let must_turn = match control.commons.read(loc::LATHE_DIAMETER) {
        true => !control.spindle.side_turns && turns_its_feed(post),
        false => control.state.rotation() == Rotation::Standing,
    };
    if !must_turn || spindle::waits(control) {
        return;
    }
    let tool =
        control.state.get(modal::TOOL).map(|tool| format!(" of tool {tool}")).unwrap_or_default();
    post.warn(PostCode::SpindleStands, format!("a feed move{tool}: the spindle is stopped"));
}

/// The feed is one for each turn of the spindle.
fn turns_its_feed(post: &Post) -> bool {
    post.path.feed.is_some_and(|feed| feed.mode == FeedMode::PerRevolution)
}

/// Warns of a motion at feed behind a stop of the program, which stops the spindle on some
/// machines.
#[cold]
fn warn_behind_stop(post: &mut Post) {
    if spindle::may_stand_behind_stop(&post.control) {
        post.warn(PostCode::SpindleStands, format!("a feed move {}", spindle::BEHIND_STOP));
    }
}

/// Rapid after RAPID, a pass of a thread in a thread, else at feed.
#[inline]
pub fn take_kind_of_motion(post: &mut Post) -> MotionKind {
    match (post.path.rapid.take(), post.path.thread.passes.map(|passes| passes.lead)) {
        (Some(cause), _) => MotionKind::Rapid(cause),
        (None, Some(lead)) => MotionKind::Thread(lead),
        (None, None) => MotionKind::Feed,
    }
}

/// GOHOME/x,y,z\[,i,j,k]: a motion to that point; without one to the machine's home.
///
/// # Errors
/// As [`home::gohome`]; other than three or six numbers, a CIRCLE that waits for its end, and all that the
/// motion refuses.
pub fn gohome(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.is_empty() {
        return home::gohome(post, items);
    }
    let (point, axis) = match items.numbers()[..] {
        [x, y, z] => (Point3::new(x, y, z), post.path.axis.given),
        [x, y, z, i, j, k] => (Point3::new(x, y, z), checked_axis(post, Vector3::new(i, j, k))?),
        _ => return Err(items.error("a point x, y, z is missing")),
    };
    items.deny_rest()?;
    post.require(Act::OtherPoints)?;
    csys::settle(post, axis)?;
    let target = Target { point, axis, word: FIRST_DATA as u16 };
    straight(post, target)
}

/// A tool axis may be this far from length 1, unless MULTAX is on.
const AXIS_LENGTH: f64 = 0.01;

/// A tool axis that is one.
///
/// # Errors
/// As [`target`].
pub(crate) fn checked_axis(post: &Post, axis: Vector3<f64>) -> Result<Vector3<f64>> {
    let length = axis.norm();
    let near = (length - 1.0).abs() <= AXIS_LENGTH;
    let on = post.path.multax == Some(true);
    if !(near || (on && length > AXIS_LENGTH)) {
        return PostCode::AxisLength.err(format!("a tool axis of length {length:.4}"));
    }
    if post.path.multax == Some(false) && (axis - Vector3::z()).amax() > AXIS_LENGTH {
        return PostCode::AxisLength.err("a tool axis other than 0,0,1 after MULTAX/OFF");
    }
    Ok(axis)
}
