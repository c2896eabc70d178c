//! One straight motion to one position of the machine, in as many blocks as it takes.

use super::pole::apart;
use super::{
    feed_rules, linearization, mill_turn, position, rapid, reposition, reposition_rapid, rotary,
    scaled_lead, thread, tip_control, turning,
};
use crate::control::family;
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::operation::{MotionKind, Target};
use crate::post::Post;
use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};

/// Makes a motion for which all is ready.
///
/// # Errors
/// As [`carry_out`].
#[inline(always)]
pub(super) fn go(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    let before = post.path.rotary;
    let word = position::word_of(post, target);
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
            match position::turned(before, post.path.rotary) {
                Some(before) if !rotary::warn_where_lost(post)? => {
                    return turn(post, before, &motion, target);
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

/// Moves at feed while the rotary axes turn from where they stood before.
///
/// # Errors
/// A limit or a pole on the way; all that the motion refuses.
#[inline(never)]
fn turn(post: &mut Post, before: [f64; 2], motion: &Motion, target: Target) -> Result<()> {
    if post.control.tables.mills() {
        let from = linearization::stands(post, before).position;
        return mill_turn::turning_feed(post, from, motion.position, target);
    }
    turning::may_turn(post, before, motion)?;
    let chain = post.control.tables.chain();
    let now = [motion.position[3], motion.position[4]];
    if chain.is_limited()
        && let Some(free) = post.path.turning.free.filter(|free| apart(*free, now))
    {
        return reposition::feed(post, before, free, target);
    }
    turning::go(post, before, motion, target)
}
