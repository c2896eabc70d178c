//! UNITS/MM, UNITS/INCHES: the unit of the CL file and of the tape.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::modes::Unit;

use crate::control::program::unit_code;
use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Sets the unit; once the program has started, its code is written at once.
///
/// # Errors
/// Neither MM nor INCHES, a unit the machine does not take, or another unit after
/// lengths or feeds were given in the first.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let unit = match items.any_of(&[w::MM, w::INCHES]) {
        Some(w::MM) => Unit::Mm,
        Some(_) => Unit::Inch,
        None => return Err(items.error("MM or INCHES is needed")),
    };
    items.deny_rest()?;
    if Unit::of_machine(&post.control.commons).is_some_and(|only| only != unit) {
        return Err(items.error("the machine takes the other unit only (units.mode)"));
    }
    if post.control.unit == Some(unit) {
        return Ok(());
    }
    if post.control.unit.is_some() && post.has_lengths() {
        return PostCode::UnitChange.err("lengths or feeds came before it in the other unit");
    }
    post.control.unit = Some(unit);
    post.control.refresh()?;
    if post.control.head.started {
        if let Some(code) = post.control.code_if_any(unit_code(unit)) {
            post.control.g(code);
        }
        return post.control.write_block();
    }
    Ok(())
}
