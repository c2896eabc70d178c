//! GODLTA/dx,dy,dz or GODLTA/d: a motion relative to the last point.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use nalgebra::Vector3;

use super::form::Form;
use super::goto;
use crate::errors::PostCode;
use crate::motion::Target;
use crate::post::Post;

/// Moves by the increments; one number moves along the tool axis.
///
/// # Errors
/// No point came before, or the numbers are neither one nor three.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let start = post
        .state
        .point
        .ok_or_else(|| Box::new(Diag::new(PostCode::ArcStart, "GODLTA before any FROM or GOTO")))?;
    let step = match form.numbers()[..] {
        [x, y, z] => {
            post.state.point_word = goto::POINT;
            Vector3::new(x, y, z)
        }
        [distance] => post.state.axis * distance,
        _ => return Err(form.error("one or three increments are needed")),
    };
    form.end()?;
    post.begin()?;
    post.move_to(Target { point: start + step, axis: post.state.axis })
}
