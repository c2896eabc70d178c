//! What passes of a thread ask: where they begin, the lead as the machine counts it, the spindle.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ThreadLeadAlong};
use nalgebra::Point3;

use crate::control::needs::Act;
use crate::control::word_address::spindle::{self, counted};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::{Lead, Target};
use crate::post::Post;

/// The axes that a thread runs along, X and Z.
pub const AXES: [usize; 2] = [0, 2];

/// Lengths below this count as zero, mm or inch.
pub(super) const NOTHING: f64 = 1e-6;

/// The point of the CL file at which the tool stands: a thread begins from there, on the side
/// where that lies. `None` where a tool change, a frame, FROM or a text came between.
pub fn stands_at(post: &Post) -> Option<Point3<f64>> {
    let is_known = |number: &usize| matches!(post.control.place(*number), Place::At(_));
    post.path.stands_at().filter(|_| AXES.iter().all(is_known))
}

/// Ends a thread.
///
/// # Errors
/// It waits for one of its points.
pub fn end(post: &mut Post) -> Result<()> {
    post.require(Act::Word)?;
    post.path.thread.passes = None;
    post.path.thread.awaited = None;
    Ok(())
}

/// What the lead gains in each turn of a pass to a point, as the machine counts it, which
/// counts the lead itself as `counted`.
///
/// # Errors
/// The lead comes to nothing before the end, or the pass goes on from another one.
pub fn counted_change(post: &Post, lead: Lead, counted: &Lead, target: Target) -> Result<f64> {
    let change = post.path.thread.passes.map_or(0.0, |passes| passes.change);
    if change == 0.0 {
        return Ok(0.0);
    }
    let Some(from) = stands_at(post) else {
        return PostCode::Thread.err("where the pass begins is not known");
    };
    if post.control.state.goes_on_in_varying_lead(&post.control.commons) {
        return PostCode::Thread.err(
            "a thread with variable lead continues after its first move, and the lead there is not known",
        );
    }
    // In n turns the tool goes n leads and n(n - 1)/2 changes: the square of the lead changes
    // by twice the change times the way.
    let way = (target.point - from).amax();
    if lead.value * lead.value + 2.0 * change * way <= 0.0 {
        return PostCode::Thread.err("the lead reaches zero before the end of the thread");
    }
    Ok(change * (counted.value / lead.value))
}

/// The lead as the machine counts it: along the longer axis, or along the path.
///
/// # Errors
/// The machine counts along the path, and where it begins is not known.
pub fn counted_lead(post: &Post, lead: Lead, target: Target) -> Result<Lead> {
    if post.control.commons.read(loc::THREAD_LEAD_ALONG) == ThreadLeadAlong::TheLongerAxis {
        return Ok(lead);
    }
    let Some(from) = stands_at(post) else {
        return PostCode::Thread.err("where the pass begins is not known");
    };
    let way = target.point - from;
    let longest = way.amax();
    let share = if longest < NOTHING { 1.0 } else { way.norm() / longest };
    Ok(Lead { value: lead.value * share, ..lead })
}

/// Refuses a thread at surface speed, as each pass would begin at another angle of the
/// spindle, and one with the spindle standing, which the control would wait for, or cut
/// without.
///
/// # Errors
/// The last SPINDL gave one, or stopped the spindle; nothing has turned it.
pub fn check_speed(post: &Post) -> Result<()> {
    if counted::is_unknown(&post.control) {
        return PostCode::Thread.err(counted::WHICH);
    }
    if !spindle::may_turn(&post.control) {
        let usual = "the spindle is stopped; put SPINDL before the thread";
        return PostCode::Thread.err(spindle::why_it_stands(&post.control, usual));
    }
    if spindle::may_stand_behind_change(&post.control) {
        return PostCode::Thread
            .err("the tool change may have stopped the spindle; put SPINDL after it");
    }
    if spindle::is_of_surface(&post.control) {
        return PostCode::Thread
            .err("the spindle turns at constant surface speed, so that the passes would not meet");
    }
    Ok(())
}
