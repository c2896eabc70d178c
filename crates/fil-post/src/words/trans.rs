//! TRANS, and ORIGIN and TRACUT under its name: transformation of the input.
//!
//! `TRANS/x,y,z` is a translation (DBLCOM 286–288). Twelve numbers are the rows
//! of a 3x4 matrix: X' = X*a1 + Y*b1 + Z*c1 + d1, and so on. With OPTION,10 it acts
//! on points only; without OPTION on points and tool axis, unless the machine says
//! otherwise (INTCOM 2093). `TRANS/NOMORE` ends both. A SINUMERIK may shift its zero by a
//! TRANS of its own instead of the points (`control.translation`).

use fil_cl::vocabulary::words as w;
use fil_diag::{Diag, Result};
use fil_machine::Kind;
use fil_machine::locations::{self as loc, InputKind, InputOrigin, InputTracut};
use nalgebra::Matrix3x4;

use crate::control::needs::Act;
use crate::control::sinumerik::translation;
use crate::errors::PostCode;
use crate::items::Items;
use crate::path::{Shift, Statement, Transformation, compensation_side};
use crate::post::Post;

/// OPTION that leaves the tool axis alone.
const POINTS_ONLY: f64 = 10.0;

/// Sets the transformation; it acts on the next motion.
///
/// # Errors
/// Other than 3 or 12 numbers, an OPTION that is not known, a transformation between
/// a CIRCLE and its end.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    post.require(Act::OtherPoints)?;
    let by_matrix = post.path.transformation.as_ref().map(|it| it.of);
    if post.path.shift == Shift::Origin || by_matrix.is_some_and(|of| of != Statement::Trans) {
        return Err(items.error(
            "ORIGIN, TRACUT, ROTABL, a named frame or input.matrix moves the points already",
        ));
    }
    if items.any_of(&[w::NOMORE, w::OFF]).is_some() {
        items.deny_rest()?;
        post.path.shift = Shift::None;
        turn(post, None)?;
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
        if by_matrix.is_some() {
            return Err(both(items));
        }
        let moves = numbers.iter().any(|number| *number != 0.0);
        post.path.shift = if moves { Shift::Trans } else { Shift::None };
        return translate(post, [x, y, z]);
    }
    if post.path.shift == Shift::Trans {
        return Err(both(items));
    }
    if numbers.len() != 12 {
        return Err(items.error(format!("3 or 12 numbers are needed, not {}", numbers.len())));
    }
    let kind = post.control.commons.read(loc::INPUT_KIND);
    let trans = Transformation {
        matrix: Matrix3x4::from_row_slice(&numbers),
        turns_axis: option.is_none() && kind != InputKind::MatrixOnPoints,
        of: Statement::Trans,
    };
    turn(post, Some(trans))
}

/// Three numbers and twelve: whether the later TRANS takes the place of the earlier one, or adds
/// to it, is not published.
fn both(items: &Items) -> Box<Diag> {
    items.error("a TRANS of three numbers and one of twelve: put TRANS/NOMORE between them, or write both with twelve")
}

/// Takes another transformation.
fn turn(post: &mut Post, trans: Option<Transformation>) -> Result<()> {
    compensation_side::refuse_a_turn(post, trans.as_ref())?;
    post.path.transformation = trans;
    post.path.leave_point();
    Ok(())
}

/// Follows the matrix of the machine's settings, which a script may change.
///
/// # Errors
/// Something else moves the points by a matrix; a place between a CIRCLE and its end.
#[cold]
pub fn follow_machine(post: &mut Post) -> Result<()> {
    if post.path.transformation.is_some() && !post.path.is_moved_by(Statement::Machine) {
        return PostCode::WordForm
            .err("input.matrix: TRANS, TRACUT, ROTABL or a named frame moves the points already");
    }
    post.require(Act::OtherPoints)?;
    let turns_axis = post.control.commons.read(loc::INPUT_KIND) != InputKind::MatrixOnPoints;
    let of_machine = |matrix: &Matrix3x4<f64>| Transformation {
        matrix: *matrix,
        turns_axis,
        of: Statement::Machine,
    };
    let matrix = post.control.tables.input_matrix().map(of_machine);
    turn(post, matrix)
}

/// True where the machine's matrix is another one than that which moves the points.
#[inline]
pub fn machine_has_changed(post: &Post) -> bool {
    let moved = post.path.transformation.as_ref().filter(|it| it.of == Statement::Machine);
    moved.map(|it| &it.matrix) != post.control.tables.input_matrix()
}

/// ORIGIN/x,y,z: the zero of the machine in the part or that of the part on the machine, as
/// the machine says; false where it does not. ORIGIN/NOMORE ends it. It is the translation of
/// `TRANS/x,y,z` under another name, so the two do not go together.
///
/// # Errors
/// Other than three numbers, another translation in force, a place between a CIRCLE and its
/// end.
pub fn origin(post: &mut Post, items: &mut Items) -> Result<bool> {
    let sign = match post.control.commons.read(loc::INPUT_ORIGIN) {
        InputOrigin::Refused => return Ok(false),
        InputOrigin::MachineZeroInThePart => -1.0,
        InputOrigin::PartZeroOnTheMachine => 1.0,
    };
    post.require(Act::OtherPoints)?;
    if [Statement::Table, Statement::Machine].into_iter().any(|it| post.path.is_moved_by(it)) {
        return Err(items.error("ROTABL or input.matrix moves the points already"));
    }
    let stands = loc::INPUT_TRANSLATE
        .iter()
        .any(|at| post.control.commons.dbl_opt(*at).is_some_and(|value| value != 0.0));
    if stands && post.path.shift != Shift::Origin {
        return Err(items.error("TRANS or the machine moves the points already"));
    }
    if items.any_of(&[w::NOMORE, w::OFF]).is_some() {
        post.path.shift = Shift::None;
        translate(post, [0.0; 3])?;
        return Ok(true);
    }
    let [x, y, z] = items.numbers()[..] else {
        return Err(items.error("three numbers x, y, z, or NOMORE, are needed"));
    };
    post.path.shift = Shift::Origin;
    translate(post, [sign * x, sign * y, sign * z])?;
    Ok(true)
}

/// TRACUT with twelve numbers, as TRANS, where the machine says that the points are not moved
/// yet; false where it does not. TRACUT/NOMORE ends it.
///
/// # Errors
/// Other than twelve numbers, a matrix of TRANS in force, a place between a CIRCLE and its
/// end.
pub fn tracut(post: &mut Post, items: &mut Items) -> Result<bool> {
    if post.control.commons.read(loc::INPUT_TRACUT) == InputTracut::Refused {
        return Ok(false);
    }
    post.require(Act::OtherPoints)?;
    if post.path.transformation.is_some() && !post.path.is_moved_by(Statement::Tracut) {
        return Err(items.error("TRANS or a named frame moves the points already"));
    }
    if items.any_of(&[w::NOMORE, w::OFF]).is_some() {
        turn(post, None)?;
        return Ok(true);
    }
    let numbers = items.numbers();
    if numbers.len() != 12 {
        return Err(
            items.error(format!("12 numbers, or NOMORE, are needed, not {}", numbers.len()))
        );
    }
    let matrix = Matrix3x4::from_row_slice(&numbers);
    let trans = Transformation { matrix, turns_axis: true, of: Statement::Tracut };
    turn(post, Some(trans))?;
    Ok(true)
}

/// CSYS and its like: the transformation of the frame at hand into the first, or none.
///
/// # Errors
/// Another word that moves the points, a place between a CIRCLE and its end.
pub(super) fn csys(post: &mut Post, word: &str, moved: Option<Transformation>) -> Result<()> {
    let is_moved = post.path.is_moved_by(Statement::NamedFrame);
    if moved.is_none() && !is_moved {
        return Ok(());
    }
    post.require(Act::OtherPoints)?;
    let has_matrix = post.path.transformation.is_some() && !is_moved;
    if has_matrix || post.path.shift != Shift::None {
        return PostCode::OtherFrame
            .err(format!("{word}: TRANS, ORIGIN, TRACUT or ROTABL moves the points already"));
    }
    turn(post, moved)
}

fn translate(post: &mut Post, by: [f64; 3]) -> Result<()> {
    if translation::is_of_control(&post.control) {
        post.control.require(Act::OriginShift)?;
        post.path.interrupt();
        translation::write(&mut post.control, by)?;
    }
    post.path.leave_point();
    for (location, value) in loc::INPUT_TRANSLATE.into_iter().zip(by) {
        post.control.commons.set(Kind::Dbl, u32::from(location.0), value)?;
    }
    Ok(())
}
