//! TRANS: transformation of the input.
//!
//! `TRANS/x,y,z` is a translation (DBLCOM 286–288). Twelve numbers are the rows
//! of a 3x4 matrix: X' = X*a1 + Y*b1 + Z*c1 + d1, and so on. With OPTION,10 it acts
//! on points only; without OPTION on points and tool axis, unless the machine says
//! otherwise (INTCOM 2093). `TRANS/NOMORE` ends both.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::Kind;
use fil_machine::locations::{self as loc, InputKind};
use nalgebra::Matrix3x4;

use crate::errors::PostCode;
use crate::items::Items;
use crate::path::Transformation;
use crate::post::Post;

/// OPTION that leaves the tool axis alone.
const POINTS_ONLY: f64 = 10.0;

/// Sets the transformation; it acts on the next motion.
///
/// # Errors
/// Other than 3 or 12 numbers, an OPTION that is not known, a transformation between
/// a CIRCLE and its end.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if post.path.arc.is_some() {
        return PostCode::ArcEnd.err("TRANS came between a CIRCLE and its GOTO");
    }
    if items.any_of(&[w::NOMORE, w::OFF]).is_some() {
        items.deny_rest()?;
        post.path.transformation = None;
        return translate(post, [0.0; 3]);
    }
    let option = items.couplet(w::OPTION)?;
    if option.is_some_and(|option| option != POINTS_ONLY) {
        return Err(items.error("only OPTION,10 (points, not the tool axis) is known"));
    }
    let numbers = items.numbers();
    items.deny_rest()?;
    if let [x, y, z] = numbers[..] {
        if option.is_some() {
            return Err(items.error("OPTION needs the twelve numbers of a matrix"));
        }
        return translate(post, [x, y, z]);
    }
    if numbers.len() != 12 {
        return Err(items.error(format!("3 or 12 numbers are needed, not {}", numbers.len())));
    }
    let kind = post.control.commons.read(loc::INPUT_KIND);
    post.path.transformation = Some(Transformation {
        matrix: Matrix3x4::from_row_slice(&numbers),
        turns_axis: option.is_none() && kind != InputKind::MatrixOnPoints,
    });
    Ok(())
}

fn translate(post: &mut Post, by: [f64; 3]) -> Result<()> {
    for (location, value) in loc::INPUT_TRANSLATE.into_iter().zip(by) {
        post.control.commons.set(Kind::Dbl, u32::from(location.0), value)?;
    }
    Ok(())
}
