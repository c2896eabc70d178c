//! MODE/MILL and MODE/TURN: which kind of machine a mill-turn machine is from now on.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;

use crate::items::Items;
use crate::post::Post;

/// Takes the mode that the machine is in. No machine has both so far: turning needs
/// its spindle, its plane and its diameters, which a section of FIL can bring.
///
/// # Errors
/// The other mode, and any other form.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let turns = match items.any_of(&[w::MILL, w::TURN]) {
        Some(word) => word == w::TURN,
        None => return Err(items.error("MILL or TURN is needed")),
    };
    items.deny_rest()?;
    let is_lathe = post.control.commons.read(loc::LATHE_DIAMETER);
    if turns == is_lathe {
        return Ok(());
    }
    let [kind, mode] = if turns { ["mill", "TURN"] } else { ["lathe", "MILL"] };
    let mut diag = items.error(format!("{mode} on a {kind}"));
    diag.hint = Some("Take the record with a FIL section that brings the machine there.".into());
    Err(diag)
}
