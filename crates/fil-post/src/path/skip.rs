//! What blocks that the operator can skip leave in force.
//!
//! With those blocks left out the control stays with the spindle, the coolant and the work
//! offset from before them, and the CL file goes on with what was said in them. So it is said
//! once more behind them; words of motions are left to what the control knows.

use fil_diag::Result;
use fil_machine::letters;

use super::state::Said;
use crate::control::Control;
use crate::operation::{Operation, Spindle};
use crate::post::Post;

/// Which operations come in place of each other; `None` for one that leaves nothing in force.
fn kind(control: &Control, operation: &Operation) -> Option<u8> {
    Some(match operation {
        Operation::Spindle(Spindle::Range(_)) => 0,
        Operation::Spindle(Spindle::Limit(_)) => 1,
        Operation::Spindle(Spindle::Side(_)) => 2,
        Operation::Spindle(Spindle::Turn(_) | Spindle::Off | Spindle::Orient(_)) => 3,
        Operation::Coolant(_) => 4,
        Operation::WorkOffset(_) => 5,
        Operation::Function(letters::G, code) if control.chooses_offset(*code) => 5,
        _ => return None,
    })
}

/// Notes an operation in blocks that can be skipped.
pub(super) fn note(post: &mut Post, operation: &Operation) {
    if post.control.tape.skip.is_some() {
        post.path.skipped.keep(&post.control, operation);
    }
}

/// Begins or ends blocks that can be skipped, and says behind them what was said in them.
///
/// # Errors
/// As [`Control::skip_blocks`] and the operations.
pub(super) fn switch(post: &mut Post, on: bool) -> Result<()> {
    post.control.skip_blocks(on)?;
    if on {
        return Ok(());
    }
    let Said(said) = std::mem::take(&mut post.path.skipped);
    said.into_iter().try_for_each(|operation| again(&mut post.control, operation))
}

/// The words of the record that said it are not those of OPSKIP.
fn again(control: &mut Control, operation: Operation) -> Result<()> {
    let operation = match operation {
        Operation::Spindle(Spindle::Turn(mut turn)) => {
            turn.words = [0; 2];
            Operation::Spindle(Spindle::Turn(turn))
        }
        Operation::Spindle(Spindle::Side(mut side)) => {
            side.words = [0; 2];
            Operation::Spindle(Spindle::Side(side))
        }
        other => other,
    };
    control.family().write(control, operation)
}

impl Said {
    /// Keeps an operation that stays in force.
    fn keep(&mut self, control: &Control, operation: &Operation) {
        let Some(kind) = kind(control, operation) else { return };
        self.0.retain(|other| self::kind(control, other) != Some(kind));
        self.0.push(operation.clone());
    }
}
