//! Left and right of the path, where TRANS or the scale of an axis mirrors it.

use fil_diag::Result;
use fil_machine::modes::Plane;
use nalgebra::{Matrix3, Point3, Vector3};

use super::{Transformation, rapid_lean};
use crate::control::needs::Act;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::post::Post;

/// A plane whose normal comes as near to that of the control is the same.
const SAME: f64 = 1e-6;

/// The cosine between directions that are one.
const SAME_WAY: f64 = 1.0 - 1e-8;

/// Refuses compensation where the tape shows the path of the CL file in a mirror, or seen from
/// below: what is left of the one is right of the other.
///
/// # Errors
/// TRANS, or scales of the axes, that leave no plane as the control sees it; scales that
/// differ within the plane.
pub fn check(post: &Post, plane: Plane) -> Result<()> {
    let stretch = plane.axes().map(|axis| post.control.tables.axis(axis).length(1.0).abs());
    if stretch[0] != stretch[1] {
        return PostCode::CompensationSide
            .err("the scales of the axes stretch the path, and the control shifts it by a circle");
    }
    let sign = |axis| post.control.tables.axis(axis).scale().signum();
    let signs = Matrix3::from_diagonal(&Vector3::new(sign(0), sign(1), sign(2)));
    let trans = post.path.transformation.as_ref();
    let turn = signs * trans.map_or_else(Matrix3::identity, Transformation::linear);
    let chain = post.control.tables.chain();
    let keeps = match trans {
        // The rotary axes turn the plane back.
        Some(trans) if trans.turns_axis && chain.has_rotary() => turn.determinant() > 0.0,
        _ => faces(&turn, plane),
    };
    if keeps {
        return Ok(());
    }
    PostCode::CompensationSide
        .err("TRANS, or a scale below zero, shows the path in a mirror or from below")
}

/// Refuses compensation that a text or a function of others has switched on where CUTCOM could not.
///
/// # Errors
/// Under tool-tip control, and as [`refuse_across_tool`].
pub fn refuse_of_others(post: &Post) -> Result<()> {
    let state = &post.control.state;
    if !(state.groups().changed_since_foreign(modal::CUTTER_COMP) && state.compensates()) {
        return Ok(());
    }
    if post.writes_tip() {
        return PostCode::TipControl.err("cutter compensation by a text");
    }
    let plane = state.get(modal::PLANE).unwrap_or(Plane::Xy);
    refuse_across_tool(post, plane, plane != Plane::Xy)
}

/// Refuses compensation in a plane in which the tool of a machine with rotary axes, or of one
/// whose tool lies along another axis than Z, does not cut with its side: the control would shift
/// the path along the tool, into the part. A plane that CUTCOM names is one of the part, and must be
/// that of the control, too. Under a tool along Z it may be any, for ball cutters.
///
/// # Errors
/// The tool lies across the plane's normal or leans, or the part stands turned.
pub fn refuse_across_tool(post: &Post, plane: Plane, is_named: bool) -> Result<()> {
    let tables = &post.control.tables;
    let chain = tables.chain();
    let is_upright = !chain.has_rotary() && chain.tool == Vector3::z_axis();
    // Under tool-tip control all compensation is refused elsewhere.
    if tables.mills() || is_upright || post.writes_tip() {
        return Ok(());
    }
    let Some(angles) = rapid_lean::turned(&post.control) else { return Ok(()) };
    let of_part = post.path.axis.stands.normalize();
    let normal = Vector3::ith(plane.normal(), 1.0);
    let (tool, seen) = if post.control.may_be_tilted() {
        (Vector3::z(), if of_part.z > SAME_WAY { normal } else { Vector3::zeros() })
    } else {
        let at = |point| chain.linear(point, angles);
        let seen = at(Point3::origin() + normal) - at(Point3::origin());
        (chain.tool_at(angles), seen)
    };
    let cuts = tool.dot(&normal) > SAME_WAY || is_named && tool.z > SAME_WAY;
    if cuts && (!is_named || seen.dot(&normal) > SAME_WAY) {
        return Ok(());
    }
    PostCode::CompensationAcross
        .err("the tool does not lie square to the plane in which the control would compensate it")
}

/// True where one of the planes of the CL file lies in that of the control, the same side up.
fn faces(turn: &Matrix3<f64>, plane: Plane) -> bool {
    let normal = match plane {
        Plane::Xy => Vector3::z(),
        Plane::Zx => Vector3::y(),
        Plane::Yz => Vector3::x(),
    };
    [(0, 1), (2, 0), (1, 2)].into_iter().any(|(first, second)| {
        let seen = turn.column(first).cross(&turn.column(second));
        (seen.normalize() - normal).norm() < SAME
    })
}

/// Refuses another direction of the path while it is compensated.
///
/// # Errors
/// Compensation is on, and the new transformation turns, mirrors or stretches otherwise.
pub fn refuse_a_turn(post: &Post, trans: Option<&Transformation>) -> Result<()> {
    let linear =
        |one: Option<&Transformation>| one.map_or_else(Matrix3::identity, Transformation::linear);
    match linear(trans) == linear(post.path.transformation.as_ref()) {
        true => Ok(()),
        false => post.control.require(Act::Transformation),
    }
}
