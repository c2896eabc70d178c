//! Straight motions: rapid, at feed, and as passes of a thread.

use fil_diag::Result;

use super::{
    frame_begin, lead_in, mill_turn, rotary, solution, straight, tip_control, travel, turn_at_top,
};
use crate::control::full_turn;
use crate::control::word_address::cycle;
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// Moves in a straight line.
///
/// # Errors
/// An unreachable tool axis, no feed, a value that does not fit, a missing code.
#[inline]
pub fn carry_out(post: &mut Post, target: &Target, kind: MotionKind) -> Result<()> {
    if let Some(active) = &mut post.path.cycle {
        active.initial = None;
        active.above = None;
        active.in_force = None;
        cycle::cancel(&mut post.control)?;
    }
    if let (Some(from), false) = (post.path.point, matches!(kind, MotionKind::Rapid(_))) {
        post.path.sense.course.line(target.point - from)?;
    } else {
        post.path.sense.course.interrupt();
        if !post.path.ahead.motions.is_empty() {
            solution::choose(post, *target, kind);
        }
    }
    if post.control.tables.prepares && prepare(post, *target, kind)? {
        return Ok(());
    }
    if post.control.state.has_doubts() {
        post.control.ready_length()?;
        if !matches!(kind, MotionKind::Rapid(_)) {
            rotary::refuse_unknown_start(post)?;
            full_turn::check_zero(&post.control)?;
        }
    }
    if std::mem::take(&mut post.path.last.turned_by_words) && !matches!(kind, MotionKind::Rapid(_))
    {
        rotary::follow(post);
    }
    match post.control.tables.travel_rules.is_empty() {
        true => straight::go(post, *target, kind)?,
        false => travel::carry_out(post, *target, kind)?,
    }
    post.control.tip.begins_unsaid = false;
    post.path.last.in_cut = !matches!(kind, MotionKind::Rapid(_));
    post.path.arrive(*target);
    Ok(())
}

/// What the machine needs before the motion; true where that made the motion itself.
#[cold]
fn prepare(post: &mut Post, target: Target, kind: MotionKind) -> Result<bool> {
    if post.control.tables.mills() {
        return mill_turn::prepare(post, target, kind);
    }
    if post.control.tables.follows_edits {
        rotary::follow(post);
    }
    lead_in::before(post, target, kind)?;
    let at_feed = !matches!(kind, MotionKind::Rapid(_));
    tip_control::choose(post, target, at_feed);
    if !at_feed {
        turn_at_top::go_up(post, target)?;
    }
    if post.writes_tip() {
        tip_control::say_by_vector(post, at_feed);
        tip_control::ready(post, target)?;
    } else if post.control.tables.frame_output {
        frame_begin::turn_to(post, target, at_feed)?;
    }
    tip_control::end_outside(post)?;
    Ok(false)
}
