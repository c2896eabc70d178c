//! A face milled by X and C alone, where the machine has neither Y nor polar interpolation: the
//! radius and the angle of each point, in as many motions as keep the tool on its line.

use fil_diag::Result;
use fil_machine::axes::Position;
use nalgebra::Point3;

use super::live_tool::{FULL, has_y};
use super::polar;
use crate::control::Control;
use crate::control::needs::Act;
use crate::operation::Target;
use crate::path::{linearization, position, tip};
use crate::post::Post;

/// A tool along Z cuts by X and C.
pub(in crate::path) fn is_cut_by_c(control: &Control) -> bool {
    control.tables.mills() && !has_y(control) && !polar::is_there(control)
}

/// The angle of C at which the tool is over a point of the part, degrees, the nearest to `last`.
pub(in crate::path) fn angle(tip: Point3<f64>, last: f64) -> f64 {
    let angle = libm::atan2(tip.y, tip.x).to_degrees();
    angle + FULL * ((last - angle) / FULL).round()
}

/// Cuts across a face while C turns.
///
/// # Errors
/// A way that passes the axis of the spindle; cutter compensation; no feed; too many motions.
pub(super) fn feed(post: &mut Post, from: Position, to: Position, target: Target) -> Result<()> {
    post.control.require(Act::MillTurnMotion)?;
    post.control.ready_for(Act::RotaryMove)?;
    let begin = tip::tip(post.control.tables.chain(), &from);
    let (end, _) = position::transformed(post, target);
    let nearest = polar::nearest(begin.xy(), end.xy());
    if nearest < polar::least(post)? {
        return polar::passes(nearest);
    }
    let allowed = linearization::tolerance(post)?.map_or_else(|| linearization::usual(post), Ok)?;
    linearization::feed_within(post, [from[3], from[4]], to, target, Some(allowed))
}
