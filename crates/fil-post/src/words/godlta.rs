//! GODLTA/dx,dy,dz or GODLTA/d: a motion relative to the last point.

use fil_cl::record::FIRST_DATA;
use fil_diag::Result;
use nalgebra::Vector3;

use super::{csys, goto};
use crate::control::needs::Act;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::POINT;
use crate::operation::Target;
use crate::post::Post;

/// A way with less beside the tool axis than this share of it goes along that.
const ALONG: f64 = 1e-6;

/// Moves by the increments, or drills a hole there in an active cycle; one number moves along the
/// tool axis.
///
/// # Errors
/// No point came before, or the tool does not stand there; the numbers are neither one nor three.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let Some(start) = post.path.point else {
        return PostCode::ArcStart.err("GODLTA before any FROM or GOTO");
    };
    csys::settle(post, post.path.axis.given)?;
    if post.path.last.is_left {
        return PostCode::ArcStart.err(
            "GODLTA right after TRANS, a new coordinate system or a foreign block that moves the tool: it is not at the last point",
        );
    }
    if post.path.last.taken_behind == Some(start) {
        return PostCode::ArcStart.err(
            "GODLTA after a move that a section took: it is measured from a point that the post has not seen",
        );
    }
    post.require(Act::OtherPoints)?;
    // The numbers of a motion stand from its word 6 on.
    items.skip(usize::from(POINT) - FIRST_DATA);
    let (step, word) = match items.numbers()[..] {
        [x, y, z] => (Vector3::new(x, y, z), POINT),
        [distance] => (post.path.axis.given.normalize() * distance, 0),
        _ => return Err(items.error("one or three increments are needed")),
    };
    items.deny_rest()?;
    let target = Target { point: start + step, axis: post.path.axis.given, word };
    if goto::drills(post) && step.cross(&post.path.axis.given).norm() <= ALONG * step.norm() {
        return PostCode::InCycle
            .err("GODLTA along the tool axis: whether it drills a hole or lifts the tool is open");
    }
    goto::point(post, target)
}
