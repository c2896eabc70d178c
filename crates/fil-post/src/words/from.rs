//! FROM/x,y,z\[,i,j,k]: where the tool stands at the start. No motion.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::goto;
use crate::post::Post;

/// Takes the point as the start of an arc or of a GODLTA; nothing is written.
///
/// # Errors
/// A record without a point.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let target = goto::target(post, record, vocabulary)?;
    post.state.point = Some(target.point);
    post.state.axis = target.axis;
    Ok(())
}
