//! PPRINT text: a message to the operator, as a comment on the tape.

use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::Held;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Writes the text between the control-out and control-in characters, where the
/// machine takes messages.
///
/// # Errors
/// As a text on the tape.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let text = items.text().to_string();
    items.deny_rest()?;
    if !post.control.commons.read(loc::MESSAGE_TO_TAPE) {
        return Ok(());
    }
    // Behind a stop that waits a message waits too, so that both come in their order.
    if post.control.commons.read(loc::MESSAGE_WAITS) || !post.control.tools.held.is_empty() {
        let cause = post.control.block.cause.whole();
        post.control.tools.held.push((Held::Message(text), cause));
        return Ok(());
    }
    carry_out(post, Operation::Message(text))
}
