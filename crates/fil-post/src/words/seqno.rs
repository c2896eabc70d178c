//! SEQNO/n\[,INCR,m], SEQNO/ON, SEQNO/OFF: sequence numbers.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::letters::N;

use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Sets the next number and the increment, or switches numbers on or off.
///
/// # Errors
/// A number or an increment that is not a whole number, or out of range; a machine without N.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let increment = items.couplet(w::INCR)?;
    if increment.is_some_and(|increment| increment <= 0.0 || increment.fract() != 0.0) {
        return Err(items.error("the increment must be a positive whole number"));
    }
    let is_written = post.control.tables.addresses.required(N);
    match items.any_of(&[w::ON, w::OFF]) {
        Some(w::ON) => {
            is_written?;
            post.control.tape.switch_numbers(true);
        }
        Some(_) => post.control.tape.switch_numbers(false),
        None if post.control.can().numbers_lines => {
            let next = items.required("the number")?;
            let by = increment.map_or(String::new(), |increment| format!(" by {increment}"));
            let message =
                format!("SEQNO from {next}{by}: the lines of Klartext are numbered by the control");
            post.warn(PostCode::IgnoredPart, message);
        }
        None => {
            let next = items.required("the number")?;
            if next < 0.0 || next.fract() != 0.0 {
                return Err(items.error("the number must be a whole number, not negative"));
            }
            is_written?;
            post.control.tape.switch_numbers(true);
            post.control.tape.renumber(next, increment);
        }
    }
    items.deny_rest()
}
