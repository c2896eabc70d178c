//! FROM/x,y,z\[,i,j,k]: where the tool stands at the start. No motion.

use fil_diag::Result;

use crate::operation::Target;
use crate::post::Post;

/// Takes the point as the start of an arc or of a GODLTA; nothing is written.
///
/// # Errors
/// None.
pub fn handle(post: &mut Post, target: Target) -> Result<()> {
    post.path.point = Some(target.point);
    post.path.axis = target.axis;
    Ok(())
}
