//! PREFUN/n and AUXFUN/n: a preparatory or auxiliary function by its number.

use fil_diag::Result;
use fil_machine::letters::{G, M};
use fil_machine::{FunctionCode, Letter};

use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Writes G n in a block of its own.
///
/// # Errors
/// No number, or one that no function has.
pub fn prefun(post: &mut Post, items: &mut Items) -> Result<()> {
    write(post, items, G)
}

/// Writes M n in a block of its own.
///
/// # Errors
/// No number, or one that no function has.
pub fn auxfun(post: &mut Post, items: &mut Items) -> Result<()> {
    write(post, items, M)
}

fn write(post: &mut Post, items: &mut Items, letter: Letter) -> Result<()> {
    let number = items.required("the number of the function")?;
    post.due_to(items);
    items.deny_rest()?;
    let code = FunctionCode::of_value(number)
        .ok_or_else(|| items.error(format!("{number} is not the number of a function")))?;
    carry_out(post, Operation::Function(letter, code))
}
