//! CUTCOM/LEFT|RIGHT\[,n|OSETNO,n]\[,XYPLAN|YZPLAN|ZXPLAN], CUTCOM/OFF: cutter
//! compensation.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::modes::Plane;

use crate::control::length_plane::usual_plane;
use crate::control::needs::Act;
use crate::control_state::Compensation;
use crate::items::Items;
use crate::operation::{CutterCompensation, Operation};
use crate::path::{carry_out, compensation_side};
use crate::post::Post;

/// Switches compensation.
///
/// # Errors
/// A form that is not known; compensation in a cycle.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let side = match items.any_of(&[w::LEFT, w::RIGHT, w::OFF]) {
        Some(w::LEFT) => Compensation::Left,
        Some(w::RIGHT) => Compensation::Right,
        Some(_) => Compensation::Off,
        None => return Err(items.error("LEFT, RIGHT or OFF is needed")),
    };
    let side_word = items.last_word();
    let plane = items.any_of(&[w::XYPLAN, w::YZPLAN, w::ZXPLAN, w::XZPLAN]).map(|word| {
        let plane = match word {
            w::YZPLAN => Plane::Yz,
            w::ZXPLAN | w::XZPLAN => Plane::Zx,
            _ => Plane::Xy,
        };
        (plane, items.last_word())
    });
    let named = items.couplet(w::OSETNO)?;
    let offset = named.or_else(|| items.number()).map(|offset| (offset, items.last_word()));
    items.deny_rest()?;
    if side == Compensation::Off && offset.is_some() {
        return Err(items.error("OFF takes no offset"));
    }
    if side != Compensation::Off {
        post.require(Act::Compensation)?;
    }
    // A FIL section that carries CUTCOM out says the side on the tape.
    if side != Compensation::Off && post.control.tape.cause.stack == 0 {
        let machine = || usual_plane(&post.control);
        let meant = plane.map_or_else(machine, |(plane, _)| plane);
        compensation_side::check(post, meant)?;
        compensation_side::refuse_across_tool(post, meant, plane.is_some())?;
    }
    let compensation = CutterCompensation { side, plane, offset, side_word };
    carry_out(post, Operation::Compensation(compensation))
}
