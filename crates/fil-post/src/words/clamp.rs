//! CLAMP/ON, CLAMP/OFF: the clamp of an axis, by the M codes the machine names.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::letters::M;
use fil_machine::locations as loc;

use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Writes the code in a block of its own.
///
/// # Errors
/// Neither ON nor OFF, an axis or another item; a machine without the code.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let (at, what, on) = match items.any_of(&[w::ON, w::OFF]) {
        Some(w::ON) => (loc::ROTARY_CLAMP_CODE, "CLAMP/ON", true),
        Some(_) => (loc::ROTARY_UNCLAMP_CODE, "CLAMP/OFF", false),
        None => return Err(items.error("ON or OFF is needed")),
    };
    items.deny_rest()?;
    let code = post.control.code(at, what)?;
    carry_out(post, Operation::Function(M, code))?;
    post.control.rotary.clamped = Some(on).filter(|_| !post.control.state.may_be_skipped());
    Ok(())
}
