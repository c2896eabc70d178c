//! Rapid motions in which the rotary axes take other positions than the nearest, as a limit or
//! the travel of X, Y and Z asks for: the machine may say so, and may bring the tool out along
//! its axis before and back along the next one behind it, as in feed motions.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, ReposRapidMethod, ReposRapidRetract};

use super::pole::{apart, spelled};
use super::reposition::{self, Change, Plan, start_again, stop_around, straight};
use super::{Since, linearization, position, rapid};
use crate::cause::Cause;
use crate::control::needs::Act;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Makes a rapid motion that takes other positions than the nearest to where the rotary axes
/// stood before, with all that the machine asks for; false where it asks for nothing here, and
/// nothing is moved.
///
/// # Errors
/// No way out is known; all that the motions refuse.
#[cold]
pub(super) fn carry_out(
    post: &mut Post,
    before: Option<[f64; 2]>,
    target: Target,
    cause: Cause,
) -> Result<bool> {
    let in_frame = post.control.tables.frame_output && !post.writes_tip();
    let (Some(before), Some(now), false) = (before, post.path.rotary, in_frame) else {
        return Ok(false);
    };
    let (_, axis) = position::transformed(post, target);
    let nearest = post.control.tables.chain().nearest_anywhere(axis, before);
    let Some(nearest) = nearest.filter(|nearest| apart(*nearest, now)) else { return Ok(false) };
    if post.control.commons.read(loc::REPOS_RAPID_WARNING) {
        let message = format!(
            "the rotary axes go to {} instead of the nearer {}",
            spelled(now),
            spelled(nearest)
        );
        post.warn(PostCode::RapidRepositioned, message);
    }
    let Some(by_macro) = by_macro(post)? else { return Ok(false) };
    // A tool change and a point of the machine have brought the tool away.
    let known = matches!(post.path.last.since, Since::Motion | Since::Hole)
        && linearization::is_where_the_path_is(post, before);
    let Some(start) = post.path.point.filter(|_| known) else { return Ok(false) };
    let change = Change { share: 0.0, before, from: before, to: now, end: now };
    out_and_to(post, Target { point: start, ..target }, target, &change, by_macro, cause)?;
    Ok(true)
}

/// Whether the macro _REPOS is asked for the way out and back; `None` where none is made.
///
/// # Errors
/// The script has no such macro.
fn by_macro(post: &Post) -> Result<Option<bool>> {
    let commons = &post.control.commons;
    if commons.read(loc::REPOS_RAPID_RETRACT) == ReposRapidRetract::NotUsed {
        return Ok(None);
    }
    match commons.read(loc::REPOS_RAPID_METHOD) {
        ReposRapidMethod::RetractAndApproach => Ok(Some(false)),
        ReposRapidMethod::CallTheMacroRepos if reposition::has_macro(post) => Ok(Some(true)),
        ReposRapidMethod::CallTheMacroRepos => PostCode::NoAlternative.err(
            "repos.rapid_retract retracts in a rapid move, but the script has no macro _REPOS",
        ),
        ReposRapidMethod::Nothing => Ok(None),
    }
}

/// Takes the tool out, goes over the end of the motion while the machine turns, and comes in
/// there.
fn out_and_to(
    post: &mut Post,
    start: Target,
    target: Target,
    change: &Change,
    by_macro: bool,
    cause: Cause,
) -> Result<()> {
    post.control.ready_for(Act::Reposition)?;
    let (from, _) = position::transformed(post, start);
    let (to, next_axis) = position::transformed(post, target);
    let plan = Plan::settle(post, from, change, by_macro)?;
    let next = next_axis.normalize();
    let own = post.control.tables.chain().axis_at(change.from);
    let out = if plan.ways.along_next { next } else { own };
    post.path.rotary = Some(change.from);
    let away = position::words_at(post, from + out * plan.retract, change.from)?;
    straight(post, away, plan.feed_out)?;
    let flows = stop_around(post, &plan)?;
    let over = position::words_at(post, to + next * plan.retract, change.to)?;
    rapid::rapid(&mut post.control, &Motion::new(over, AxisSet::ALL, 0), cause)?;
    post.path.rotary = Some(change.to);
    if plan.approach < plan.retract {
        let near = position::words_at(post, to + next * plan.approach, change.to)?;
        straight(post, near, None)?;
    }
    start_again(post, flows)?;
    let end = position::words_at(post, to, change.to)?;
    straight(post, end, plan.feed_back)
}
