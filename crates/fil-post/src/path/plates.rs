//! A hole through several plates, CYCLE/THRU,DEPTH,a,b,c of Creo: the tool feeds through the first
//! plate to a, goes at rapid over the gap to CLEAR above b, where the next plate begins, and feeds
//! to c. No cycle of a control does so: it is written as single moves.

use fil_diag::Result;
use nalgebra::Point3;

use super::linear;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed};
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// Drills the hole that starts at the target, and goes up to where the tool travels.
///
/// # Errors
/// RETURN,0 where the level before the cycle is not known; all that the motions refuse.
pub(super) fn drill(post: &mut Post, cycle: &mut Cycle, target: Target) -> Result<()> {
    let axis = target.axis.normalize();
    let above = |tip: Point3<f64>| (tip - target.point).dot(&axis);
    let at = |level: f64| Target { point: target.point + axis * level, ..target };
    cycle.came_from = cycle.came_from.or(post.path.point);
    let travel = match (cycle.retract, cycle.came_from) {
        (None, _) => cycle.clear,
        (Some(0.0), Some(before)) => above(before).max(cycle.clear),
        (Some(0.0), None) => {
            return PostCode::CycleForm.err(
                "RETURN,0 of a hole through several plates, and where the tool was before the \
                 cycle is not known",
            );
        }
        (Some(level), _) => level.max(cycle.clear),
    };
    let feed = match cycle.feed {
        CycleFeed::Feed(feed) => post.path.feed.replace(feed),
        CycleFeed::Lead(_) => post.path.feed,
    };
    let rapid = MotionKind::Rapid(cycle.cause);
    let here = post.path.point.map(above).filter(|here| *here > cycle.clear);
    for level in here.into_iter().chain([cycle.clear]) {
        linear::carry_out(post, &at(level), rapid)?;
    }
    for [end, begin] in &cycle.plates {
        linear::carry_out(post, &at(-end), MotionKind::Feed)?;
        linear::carry_out(post, &at(cycle.clear - begin), rapid)?;
    }
    linear::carry_out(post, &at(-cycle.depth), MotionKind::Feed)?;
    linear::carry_out(post, &at(travel), rapid)?;
    post.path.feed = feed;
    Ok(())
}
