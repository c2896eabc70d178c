//! A face milled by X and C alone, where the machine has neither Y nor polar interpolation: the
//! radius and the angle of each point, in as many motions as keep the tool on its line.

use fil_diag::Result;
use fil_machine::axes::Position;

use super::polar;
use crate::control::needs::Act;
use crate::operation::Target;
use crate::path::{linearization, position, tip};
use crate::post::Post;

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
