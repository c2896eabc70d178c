//! FROM/x,y,z\[,i,j,k]: where the tool stands at the start. No motion: between motions it
//! says where the next arc or GODLTA begins, and the machine stands where it stood.

use fil_diag::Result;

use crate::control::needs::Act;
use crate::operation::Target;
use crate::post::Post;

/// Takes the point as the start of an arc or of a GODLTA; nothing is written.
///
/// # Errors
/// Between the two points of a thread.
pub fn handle(post: &mut Post, target: Target) -> Result<()> {
    post.require(Act::Word)?;
    let path = &mut post.path;
    path.point = Some(target.point);
    path.axis.given = target.axis;
    if path.rotary.is_none() {
        path.axis.stands = target.axis;
    }
    if path.last.has_moved {
        path.leave_point();
    }
    // GODLTA counts from here.
    path.last.is_left = false;
    Ok(())
}
