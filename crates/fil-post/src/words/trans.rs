//! TRANS: transformation of the input.
//!
//! `TRANS/x,y,z` is a translation (DBLCOM 286–288). Twelve numbers are the rows
//! of a 3x4 matrix: X' = X*a1 + Y*b1 + Z*c1 + d1, and so on. With OPTION,10 it acts
//! on points only; without OPTION on points and tool axis. `TRANS/NOMORE` ends both.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use nalgebra::Matrix3x4;

use super::form::Form;
use crate::commons::Kind;
use crate::locations as loc;
use crate::post::Post;
use crate::state::Transformation;

/// OPTION that leaves the tool axis alone.
const POINTS_ONLY: f64 = 10.0;

/// Sets the transformation; it acts on the next motion.
///
/// # Errors
/// Other than 3 or 12 numbers, or an OPTION that is not known.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.any_of(&[w::NOMORE, w::OFF]).is_some() {
        form.end()?;
        post.state.transformation = None;
        return translate(post, [0.0; 3]);
    }
    let option = form.couplet(w::OPTION)?;
    if option.is_some_and(|option| option != POINTS_ONLY) {
        return Err(form.error("only OPTION,10 (points, not the tool axis) is known"));
    }
    let numbers = form.numbers();
    if let [x, y, z] = numbers[..] {
        form.end()?;
        return translate(post, [x, y, z]);
    }
    if numbers.len() != 12 {
        return Err(form.error(format!("3 or 12 numbers are needed, not {}", numbers.len())));
    }
    form.end()?;
    post.state.transformation = Some(Transformation {
        matrix: Matrix3x4::from_row_slice(&numbers),
        turns_axis: option.is_none(),
    });
    Ok(())
}

fn translate(post: &mut Post, by: [f64; 3]) -> Result<(), Box<Diag>> {
    let at = [loc::INPUT_TRANSLATE_X, loc::INPUT_TRANSLATE_Y, loc::INPUT_TRANSLATE_Z];
    for (location, value) in at.into_iter().zip(by) {
        post.commons.set(Kind::Dbl, u32::from(location.0), value)?;
    }
    Ok(())
}
