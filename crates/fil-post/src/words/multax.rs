//! MULTAX[/ON|OFF] and TLAXIS/i,j,k: tool axes in GOTO.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;
use nalgebra::Vector3;

use super::csys;
use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Shortest tool axis that has a direction.
const SHORTEST: f64 = 1e-9;

/// OFF brings the axis back to 0,0,1, and no GOTO may have another; ON lets a GOTO have
/// an axis of any length.
///
/// # Errors
/// Any other form.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let off = items.any_of(&[w::OFF, w::ON]) == Some(w::OFF);
    items.deny_rest()?;
    post.path.multax = Some(!off);
    if off {
        post.path.axis.in_doubt = false;
        post.path.axis.given = Vector3::z();
        post.path.axis.is_said = false;
    }
    Ok(())
}

/// Sets the tool axis of the points to come.
///
/// # Errors
/// Other than three numbers, or an axis without length.
pub fn tlaxis(post: &mut Post, items: &mut Items) -> Result<()> {
    let [i, j, k] = items.numbers()[..] else {
        return Err(items.error("three components of the tool axis are needed"));
    };
    items.deny_rest()?;
    let axis = Vector3::new(i, j, k);
    if axis.norm() < SHORTEST {
        return PostCode::AxisLength.err("the tool axis has length zero");
    }
    let turns = post.control.commons.read(loc::LATHE_DIAMETER) && !post.control.tables.mills();
    if turns && i == 0.0 && k == 0.0 {
        // Y stands across the plane that a lathe turns in: CATIA names the plane so.
        return Ok(());
    }
    csys::settle_moves(post)?;
    post.path.axis.in_doubt = false;
    post.path.axis.is_said = true;
    post.path.axis.given = axis;
    Ok(())
}
