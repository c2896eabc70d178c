//! FROM/x,y,z\[,i,j,k]: where the tool stands at the start. No motion: between motions it
//! says where the next arc or GODLTA begins, and the machine stands where it stood.

use fil_diag::Result;

use crate::operation::Target;
use crate::post::Post;

/// Takes the point as the start of an arc or of a GODLTA; nothing is written.
///
/// # Errors
/// None.
pub fn handle(post: &mut Post, target: Target) -> Result<()> {
    let path = &mut post.path;
    path.point = Some(target.point);
    path.axis = target.axis;
    match path.rotary {
        Some(_) => path.leave_point(),
        None => path.stands = target.axis,
    }
    Ok(())
}
