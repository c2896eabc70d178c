//! THREAD/TPI,n: the feed motions that follow are thread passes.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::modes::{INCH, Unit};

use crate::items::Items;
use crate::operation::Lead;
use crate::post::Post;

/// Remembers the lead. THREAD/AUTO asks for a whole cycle whose form is the
/// machine's own, so it is left to a FIL section.
///
/// # Errors
/// THREAD/AUTO, or no lead.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.any_of(&[w::OFF, w::NOMORE]).is_some() {
        post.path.thread = None;
        return Ok(());
    }
    if items.flag(w::AUTO) {
        return Err(items.error("AUTO needs a FIL section that writes the machine's thread cycle"));
    }
    let lead = lead(post, items)?;
    items.flag(w::TURN);
    items.deny_rest()?;
    post.path.thread = Some(lead);
    Ok(())
}

/// The lead of TPI (threads an inch), MMPR or IPR, in the unit of the program.
///
/// # Errors
/// None of them, more than one, or a value that is not positive.
pub fn lead(post: &mut Post, items: &mut Items) -> Result<Lead> {
    let inch = match post.control.require_unit()? {
        Unit::Mm => INCH,
        Unit::Inch => 1.0,
    };
    let value = if let Some(threads) = items.couplet(w::TPI)? {
        inch / threads
    } else if let Some(millimetres) = items.couplet(w::MMPR)? {
        millimetres * inch / INCH
    } else if let Some(inches) = items.couplet(w::IPR)? {
        inches * inch
    } else {
        return Err(items.error("TPI (threads an inch), MMPR or IPR with a number is needed"));
    };
    post.due_to(items);
    if !value.is_finite() || value <= 0.0 {
        return Err(items.error("the lead must be above zero"));
    }
    Ok(Lead { value, cause: post.control.block.cause })
}
