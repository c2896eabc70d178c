//! Straight motions that would leave the travel of X, Y or Z, on a machine with rotary axes
//! whose settings say what is done there: other positions of the rotary axes for the same tool
//! axis, or a warning.

use fil_diag::Result;

use super::way::Way;
use super::{position, reposition, straight};
use crate::errors::PostCode;
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// Makes a straight motion of a machine whose settings say what it does where X, Y or Z would
/// leave its travel.
///
/// # Errors
/// As a straight motion; no other positions keep within the travel.
#[cold]
pub(super) fn carry_out(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    let Some(way) = way_of(post, target, kind) else { return straight::go(post, target, kind) };
    let rules = post.control.tables.travel_rules;
    let exceeded = way.exceeded(&post.control.tables);
    let in_frame = post.control.tables.frame_output && !post.writes_tip();
    if !exceeded.and(rules.reposition).is_empty() && !in_frame {
        match kind {
            MotionKind::Rapid(_) => choose(post, target, &way),
            _ if reposition::at_travel(post, &way, target)? => return Ok(()),
            _ => {}
        }
        return straight::go(post, target, kind);
    }
    let warned = exceeded.and(rules.warn);
    if warned.is_empty() {
        return straight::go(post, target, kind);
    }
    for number in warned.numbers() {
        if let Some(told) = way.told(&post.control.tables, number) {
            post.warn(PostCode::BeyondTravel, told);
        }
    }
    let bounds = post.control.tables.unbound(warned);
    let made = straight::go(post, target, kind);
    post.control.tables.bound_again(bounds);
    made
}

/// The way of a motion: as if rotary axes had no limits, since those have settings of their own;
/// of a rapid motion its end, to which the axes need not go evenly. `None` for a motion
/// that turns past a limit, for a thread, and for a tool axis out of reach.
fn way_of(post: &Post, target: Target, kind: MotionKind) -> Option<Way> {
    let (to, axis) = position::transformed(post, target);
    let chain = post.control.tables.chain();
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    match kind {
        MotionKind::Rapid(_) => {
            let angles = chain.solve(axis, post.path.turning.chosen.unwrap_or(stands)).ok()?;
            Some(Way { line: [to; 2], turn: [angles; 2] })
        }
        MotionKind::Feed => {
            let angles =
                chain.nearest_anywhere(axis, stands).filter(|at| chain.goes(stands, *at))?;
            let from = post.path.point.map(|point| Target { point, ..target });
            let from = from.map_or(to, |from| position::transformed(post, from).0);
            Some(Way { line: [from, to], turn: [stands, angles] })
        }
        MotionKind::Thread(_) => None,
    }
}

/// Chooses for a rapid motion the nearest positions that keep X, Y and Z within their travel.
fn choose(post: &mut Post, target: Target, way: &Way) {
    let (point, axis) = position::transformed(post, target);
    let tables = &post.control.tables;
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let far = |to: &[f64; 2]| (to[0] - stands[0]).abs() + (to[1] - stands[1]).abs();
    let fits = |to: &[f64; 2]| Way { line: [point; 2], turn: [*to; 2] }.is_inside(tables);
    let others = tables.chain().positions(axis, way.turn[1]).into_iter().filter(fits);
    if let Some(to) = others.min_by(|a, b| far(a).total_cmp(&far(b))) {
        post.path.turning.chosen = Some(to);
    }
}
