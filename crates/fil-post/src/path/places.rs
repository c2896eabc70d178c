//! The user's blocks around operations and the holes of cycles: where these begin and end.

use fil_cl::operation_sign::{Operations, Sign};
use fil_diag::Result;
use fil_machine::Commons;
use fil_machine::user_blocks::{self, UserBlocks};

use super::carry_out;
use crate::control::user_texts;
use crate::control::word_address::cycle;
use crate::operation::Operation;
use crate::post::Post;

/// What has begun that such blocks stand around.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// The machine has such blocks.
    pub are_on: bool,
    operations: Operations,
    /// Holes of a cycle were drilled behind its blocks.
    in_cycle: bool,
}

impl Places {
    /// Those of a machine.
    pub(crate) fn of(commons: &Commons) -> Self {
        let around = [user_blocks::OPERATION, user_blocks::CYCLE];
        let is_on = |list: UserBlocks| list.is_on(commons);
        let are_on = around.iter().any(|list| is_on(list.before) || is_on(list.after));
        Places { are_on, ..Places::default() }
    }
}

/// Takes up a record that says where an operation begins.
///
/// # Errors
/// As the user's blocks.
#[cold]
pub(crate) fn note_sign(post: &mut Post, sign: Sign) -> Result<()> {
    if post.places.operations.sign(sign) {
        end_cycle(post)?;
        write(post, user_blocks::OPERATION.after)?;
    }
    Ok(())
}

/// The holes of a cycle end, if there were any.
///
/// # Errors
/// As the user's blocks.
pub(super) fn end_cycle(post: &mut Post) -> Result<()> {
    let list = user_blocks::CYCLE.after;
    if !std::mem::take(&mut post.places.in_cycle) || !list.is_on(&post.control.commons) {
        return Ok(());
    }
    cycle::cancel(&mut post.control)?;
    write(post, list)
}

/// Writes the blocks that stand before an operation of the post.
///
/// # Errors
/// As the user's blocks.
#[cold]
pub(super) fn before(post: &mut Post, operation: &Operation) -> Result<()> {
    match operation {
        Operation::Arc(..) | Operation::Thread(_) => begin(post),
        Operation::Hole(_) => {
            begin(post)?;
            match std::mem::replace(&mut post.places.in_cycle, true) {
                true => Ok(()),
                false => write(post, user_blocks::CYCLE.before),
            }
        }
        Operation::ToolChange(_) => end_cycle(post),
        Operation::End(_) => {
            end_cycle(post)?;
            match post.places.operations.end() {
                true => write(post, user_blocks::OPERATION.after),
                false => Ok(()),
            }
        }
        _ => Ok(()),
    }
}

/// A motion comes: the first of an operation has blocks before it.
///
/// # Errors
/// As the user's blocks.
#[cold]
pub(crate) fn begin(post: &mut Post) -> Result<()> {
    match post.places.operations.moves() {
        true => write(post, user_blocks::OPERATION.before),
        false => Ok(()),
    }
}

/// Writes the blocks of a list as INSERT would.
fn write(post: &mut Post, list: UserBlocks) -> Result<()> {
    let blocks = user_texts::blocks(&post.control, list)?;
    if blocks.is_empty() {
        return Ok(());
    }
    let record = std::mem::take(&mut post.control.block.cause);
    let result = carry_out(post, Operation::Text(blocks));
    post.control.block.cause = record;
    result
}
