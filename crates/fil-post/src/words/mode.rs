//! MODE/MILL and MODE/TURN: a mill-turn machine's way of writing X.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::{Kind, locations as loc};

use crate::items::Items;
use crate::post::Post;

/// Output scale of X when it is a diameter.
const DIAMETER: f64 = 2.0;

/// TURN writes X as a diameter (output scale 486 = 2), MILL as it is (1); X is
/// said again in the next block.
///
/// # Errors
/// Any other form.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let scale = match items.any_of(&[w::MILL, w::TURN]) {
        Some(w::TURN) => DIAMETER,
        Some(_) => 1.0,
        None => return Err(items.error("MILL or TURN is needed")),
    };
    items.deny_rest()?;
    let control = &mut post.control;
    control.state.doubt(control.tables.axis(0).letter);
    control.commons.set(Kind::Dbl, u32::from(loc::SCALE_X.0), scale)
}
