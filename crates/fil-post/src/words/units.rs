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
/// Neither MM nor INCHES; another unit than the machine takes, the user gave or an
/// earlier UNITS said.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let unit = match items.any_of(&[w::MM, w::INCHES]) {
        Some(w::MM) => Unit::Mm,
        Some(_) => Unit::Inch,
        None => {
            let mut diag = items.error("MM or INCHES is needed");
            diag.hint = Some("Write UNITS / MM or UNITS / INCHES.".into());
            return Err(diag);
        }
    };
    items.deny_rest()?;
    refuse_other(post, unit)?;
    post.path.stated_unit = Some(unit);
    if post.control.unit == Some(unit) {
        return Ok(());
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

/// Refuses another unit than the one that is known already. Without any length before
/// it nothing tells which of the two is meant.
fn refuse_other(post: &Post, unit: Unit) -> Result<()> {
    if let Some(only) = Unit::of_machine(&post.control.commons).filter(|only| *only != unit) {
        let message = format!("UNITS is {unit}, but the machine takes {only} only (units.mode)");
        let diag = PostCode::Units.diag(message);
        return Err(Box::new(diag.hint(
            "Post it for a machine that takes this unit, or correct units.mode of the machine (1 inch, 2 mm).",
        )));
    }
    match (post.path.stated_unit, post.control.unit) {
        (Some(stated), _) if stated != unit => {
            let lengths = if post.has_lengths() { "lengths or feeds" } else { "UNITS" };
            PostCode::UnitChange
                .err(format!("{lengths} came before it in the other unit ({stated})"))
        }
        (None, Some(given)) if given != unit => {
            PostCode::Units.err(format!("UNITS is {unit}, but {given} is given"))
        }
        _ => Ok(()),
    }
}
