//! A table that turns to an angle by itself (ROTABL), and what the points after it count in.

use fil_diag::Result;
use fil_machine::axes::AXES;
use fil_machine::axis_chain::Carries;
use fil_machine::locations::{self as loc, RotaryTableWords};
use nalgebra::{Matrix3x4, Vector3};

use super::{Statement, Transformation, position, rapid, tip};
use crate::control::needs::Act;
use crate::control::word_address::cycle;
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Turns a rotary axis at rapid, where the tool stands.
///
/// # Errors
/// Output in frames or under tool-tip control; cutter compensation; an angle outside the
/// travel; points that something else moves already; a head that leans the tool.
pub(super) fn turn(post: &mut Post, index: usize, to: f64) -> Result<()> {
    let tables = &post.control.tables;
    if tables.tip_output || tables.frame_output {
        return PostCode::WordForm.err(
            "ROTABL: under TCPC and in tilted work planes a table turns only with the tool axis of the points",
        );
    }
    post.control.ready_for(Act::Table)?;
    let chain = post.control.tables.chain();
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let mut angles = stands;
    angles[index] = to;
    if !chain.goes(stands, angles) {
        return PostCode::WordForm
            .err(format!("ROTABL: {to} degrees lie outside the travel of the table"));
    }
    let points_stay =
        post.control.commons.read(loc::ROTARY_TABLE_WORDS) == RotaryTableWords::PointsStay;
    let moved =
        if points_stay { Some(under_points(post, angles, Statement::Table)?) } else { None };
    post.path.interrupt();
    cycle::cancel(&mut post.control)?;
    let motion = Motion::along(index + 3, to);
    let cause = post.control.block.cause.whole();
    rapid::rapid(&mut post.control, &motion, cause)?;
    post.path.rotary = Some(angles);
    match moved {
        Some(transformation) => {
            post.path.transformation = transformation;
            post.path.leave_point();
        }
        None => {
            post.path.axis.given = post.control.tables.chain().axis_at(angles);
            post.path.axis.stands = post.path.axis.given;
            post.path.point = None;
        }
    }
    Ok(())
}

/// A table that a block of an author has turned stays where it is: the points of the file behind
/// it, which have no tool axis of their own, are written as they are. What turns the machine by
/// itself (MULTAX/ON, tilted work planes, tool center point control), or moves the points, goes on as
/// before.
pub(super) fn stay_turned(post: &mut Post, stood: [Option<f64>; AXES]) {
    let tables = &post.control.tables;
    let turned = |index: usize| {
        let rotary = tables.chain().rotaries[index].as_ref();
        let is_table = rotary.is_some_and(|rotary| rotary.carries == Carries::Table);
        is_table && stands_elsewhere(post, stood, index + 3)
    };
    let is_turned = turned(0) || turned(1);
    let by_points = post.path.multax == Some(true) || post.path.axis.given != Vector3::z();
    if !is_turned || by_points || tables.tip_output || tables.frame_output || tables.mills() {
        return;
    }
    let angles = position::on_tape(post);
    let Ok(transformation) = under_points(post, angles, Statement::AuthorBlock) else { return };
    post.path.transformation = transformation;
    post.path.rotary = Some(angles);
    post.warn(
        PostCode::AuthorTurns,
        "a foreign block turned a table: it stays there, and the points after it are output as they are"
            .to_string(),
    );
}

/// True for an axis that is known to stand elsewhere than before.
fn stands_elsewhere(post: &Post, stood: [Option<f64>; AXES], number: usize) -> bool {
    let stands = post.control.stands(number);
    stands.is_some() && stands != stood[number]
}

/// A point has a tool axis of its own, and turns the table by it.
#[cold]
pub(crate) fn turns_by_points(post: &mut Post) {
    post.path.transformation = None;
    let message = "a point with a tool axis of its own turns the table that a block of an author \
                   has turned";
    post.warn(PostCode::AuthorTurns, message.to_string());
}

/// Brings points of the machine into the part, with the tables at these angles; `None` where
/// they stand at zero.
///
/// # Errors
/// TRANS, ORIGIN or TRACUT moves the points too; a head that leans the tool.
fn under_points(post: &Post, angles: [f64; 2], of: Statement) -> Result<Option<Transformation>> {
    let moves = post.path.transformation.as_ref().is_some_and(|it| !it.undoes_tables());
    if moves || post.control.tables.input_shift() != Vector3::zeros() {
        return PostCode::WordForm.err(
            "ROTABL: TRANS, ORIGIN or the machine moves the points too, in an order left open",
        );
    }
    let chain = post.control.tables.chain();
    let head = |(rotary, angle): (&Option<fil_machine::axis_chain::Rotary>, f64)| {
        rotary.as_ref().is_some_and(|rotary| rotary.carries == Carries::Head) && angle != 0.0
    };
    if chain.rotaries.iter().zip(angles).any(head) {
        return PostCode::WordForm.err("ROTABL: the head is tilted");
    }
    if angles == [0.0; 2] {
        return Ok(None);
    }
    let at = |x: f64, y: f64, z: f64| tip::tip(chain, &[x, y, z, angles[0], angles[1]]);
    let zero = at(0.0, 0.0, 0.0);
    let columns =
        [at(1.0, 0.0, 0.0) - zero, at(0.0, 1.0, 0.0) - zero, at(0.0, 0.0, 1.0) - zero, zero.coords];
    let matrix = Matrix3x4::from_columns(&columns);
    Ok(Some(Transformation { matrix, turns_axis: true, of }))
}
