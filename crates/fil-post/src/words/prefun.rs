//! PREFUN/n\[,NEXT] and AUXFUN/n\[,NEXT]: a preparatory or auxiliary function by its number.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::letters::{G, M};
use fil_machine::{FunctionCode, Letter};

use crate::items::Items;
use crate::operation::{End, Operation};
use crate::path::carry_out;
use crate::post::Post;

/// Writes G n in a block of its own, or with NEXT in that of the next motion.
///
/// # Errors
/// No number, or one that no function has.
pub fn prefun(post: &mut Post, items: &mut Items) -> Result<()> {
    write(post, items, G)
}

/// The same with M n.
///
/// # Errors
/// No number, or one that no function has.
pub fn auxfun(post: &mut Post, items: &mut Items) -> Result<()> {
    write(post, items, M)
}

fn write(post: &mut Post, items: &mut Items, letter: Letter) -> Result<()> {
    let code = code(post, items)?;
    let next = items.flag(w::NEXT);
    items.deny_rest()?;
    let operation = if next {
        Operation::WithMotion(letter, code)
    } else if letter == M && post.control.ends_main_program(code) {
        Operation::End(End::By(code))
    } else {
        Operation::Function(letter, code)
    };
    carry_out(post, operation)
}

/// The function of the number.
///
/// # Errors
/// No number, or one that no function has.
fn code(post: &mut Post, items: &mut Items) -> Result<FunctionCode> {
    let number = items.required("the number of the function")?;
    post.due_to(items);
    FunctionCode::of_value(number)
        .ok_or_else(|| items.error(format!("{number} is not the number of a function")))
}
