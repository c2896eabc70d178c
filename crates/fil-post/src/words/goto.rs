//! GOTO/x,y,z\[,i,j,k] (and GOHOME): the next point of the path.

use fil_cl::Record;
use fil_cl::record::FIRST_DATA;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use nalgebra::{Point3, Vector3};

use super::form::Form;
use super::{circle, cycle};
use crate::motion::Target;
use crate::post::Post;

/// The word of a motion record that holds its x.
pub const POINT: u16 = 6;

/// Moves to the point; ends an arc or drills a hole when CIRCLE or CYCLE ask for it.
///
/// # Errors
/// A record without a point, and all that the motion refuses.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    post.begin()?;
    let target = target(post, record, vocabulary)?;
    post.state.point_word = POINT;
    if let Some(arc) = post.state.arc.take() {
        circle::finish(post, &arc, target)
    } else if post.state.cycle.is_some() && post.state.rapid.is_none() {
        cycle::hole(post, target)
    } else {
        post.move_to(target)
    }
}

/// GOHOME/x,y,z: a motion to that point.
///
/// # Errors
/// Other than three numbers, and all that the motion refuses.
pub fn gohome(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let [x, y, z] = form.numbers()[..] else {
        return Err(form.error("a point x, y, z is missing"));
    };
    form.end()?;
    post.begin()?;
    post.state.point_word = FIRST_DATA as u16;
    post.move_to(Target { point: Point3::new(x, y, z), axis: post.state.axis })
}

/// The point of a motion record; without an axis of its own it keeps the last one.
///
/// # Errors
/// A record without a point.
pub fn target(post: &Post, record: &Record, vocabulary: &Vocabulary) -> Result<Target, Box<Diag>> {
    let point = record
        .point()
        .ok_or_else(|| Form::new(record, vocabulary).error("a point x, y, z is missing"))?;
    let axis = record.axis().map_or(post.state.axis, Vector3::from);
    Ok(Target { point: Point3::from(point), axis })
}
