//! LINTOL/t, LINTOL/ON and LINTOL/OFF: how far the tip may leave its line while the
//! machine turns.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::items::Items;
use crate::path::Straightness;
use crate::post::Post;

/// Sets the tolerance, or switches the division of motions off and on again with the
/// tolerance that was in force.
///
/// # Errors
/// Any other form; a tolerance that is not above zero.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let switch = items.any_of(&[w::ON, w::OFF]);
    let tolerance = items.number();
    if switch.is_none() && tolerance.is_none() {
        return Err(items.error("ON, OFF or a tolerance is needed"));
    }
    if switch == Some(w::OFF) && tolerance.is_some() {
        return Err(items.error("a tolerance beside OFF"));
    }
    if let Some(tolerance) = tolerance.filter(|tolerance| *tolerance <= 0.0) {
        return Err(items.error(format!("a tolerance of {tolerance} is not above zero")));
    }
    items.deny_rest()?;
    if tolerance.is_some() {
        post.control.require_unit()?;
    }
    let before = post.path.turning.straightness.tolerance;
    post.path.turning.straightness =
        Straightness { tolerance: tolerance.or(before), off: switch == Some(w::OFF) };
    Ok(())
}
