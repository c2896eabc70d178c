//! Straight motions: rapid, at feed, and as passes of a thread.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};

use super::{
    feed_rules, frame, mill_turn, rapid, reposition_rapid, rotary, scaled_lead, solution, thread,
    tip_control, travel, turning,
};
use crate::control::word_address::motion::Motion;
use crate::control::{family, full_turn};
use crate::errors::PostCode;
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
        family::cancel_cycle(&mut post.control)?;
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
        true => go(post, *target, kind)?,
        false => travel::carry_out(post, *target, kind)?,
    }
    post.control.tip.begins_unsaid = false;
    post.path.last.in_cut = !matches!(kind, MotionKind::Rapid(_));
    post.path.arrive(*target);
    Ok(())
}

/// Makes a motion for which all is ready.
///
/// # Errors
/// As [`carry_out`].
#[inline(always)]
pub(super) fn go(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    let before = post.path.rotary;
    let word = rotary::word_of(post, target);
    let mut motion = Motion::new(Position::default(), AxisSet::ALL, word);
    let solution = rotary::find_position(post, target, &mut motion.position)?;
    rotary::establish(post, solution)?;
    if post.control.is_compensated() {
        rotary::refuse_compensated(post, before)?;
    }
    match kind {
        MotionKind::Rapid(cause)
            if post.control.tables.watches_rapids
                && reposition_rapid::carry_out(post, before, target, cause)? => {}
        MotionKind::Rapid(cause) => match feed_rules::of_short_rapid(post, &motion, target) {
            Some(feed) => family::feed(&mut post.control, &motion, Some(&feed))?,
            None if post.path.last.in_cut => rapid::out_of_cut(&mut post.control, &motion, cause)?,
            None => rapid::rapid(&mut post.control, &motion, cause)?,
        },
        MotionKind::Feed => {
            match rotary::turned(before, post.path.rotary) {
                Some(before) if !rotary::warn_where_lost(post)? => {
                    return turning::feed(post, before, &motion, target);
                }
                Some(before) => turning::from_elsewhere(post, before, &motion)?,
                None if before.is_none() && post.path.rotary.is_some() => {
                    turning::from_unsaid(post, &motion)?;
                }
                None => {}
            }
            match feed_rules::apply(post) {
                true => feed_rules::line(post, &motion, target, None)?,
                false => family::feed(&mut post.control, &motion, post.path.feed.as_ref())?,
            }
        }
        MotionKind::Thread(lead) => {
            if post.writes_tip() {
                return PostCode::TipControl.err_with("a thread", tip_control::OUTSIDE);
            }
            rotary::refuse_thread(before.or_else(|| turning::unsaid(post)), post.path.rotary)?;
            scaled_lead::refuse(&post.control, &thread::AXES, PostCode::Thread)?;
            let counted = thread::counted_lead(post, lead, target)?;
            let change = thread::counted_change(post, lead, &counted, target)?;
            let motion = motion.of(AxisSet::LINEAR);
            family::thread(&mut post.control, &motion, &counted, change)?;
        }
    }
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
    let at_feed = !matches!(kind, MotionKind::Rapid(_));
    if post.writes_tip() {
        tip_control::say_by_vector(post, at_feed);
        tip_control::ready(post, target)?;
    } else if post.control.tables.frame_output {
        frame::turn_to(post, target, at_feed)?;
    }
    Ok(false)
}
