//! MODE/MILL and MODE/TURN: what a mill-turn machine does from now on.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;

use crate::items::Items;
use crate::path::mill_turn;
use crate::post::Post;

/// Takes the mode that the machine is in, or brings a mill-turn machine to the other one.
///
/// # Errors
/// The other mode on a mill or a lathe, and any other form; as [`mill_turn::switch`].
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let turns = match items.any_of(&[w::MILL, w::TURN]) {
        Some(word) => word == w::TURN,
        None => return Err(items.error("MILL or TURN is needed")),
    };
    items.deny_rest()?;
    if post.control.tables.mill_turn.is_some() {
        return mill_turn::switch(post, !turns);
    }
    let is_lathe = post.control.commons.read(loc::LATHE_DIAMETER);
    if turns == is_lathe {
        return Ok(());
    }
    let [kind, mode] = if turns { ["mill", "TURN"] } else { ["lathe", "MILL"] };
    let mut diag = items.error(format!("{mode} on a {kind}"));
    diag.hint = Some(
        "Name the code that makes the spindle an axis (mill_turn.milling_code), or take the \
         record with a FIL section that brings the machine there."
            .into(),
    );
    Err(diag)
}
