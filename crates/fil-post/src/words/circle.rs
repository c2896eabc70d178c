//! CIRCLE/x,y,z,i,j,k\[,r] and the GOTO after it: an arc or a helix.
//!
//! The GOTO before is the start. The axis turns by the right-hand rule: seen
//! against it the arc runs counter-clockwise.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;
use nalgebra::{Point3, Vector3};

use super::form::Form;
use crate::cause::Cause;
use crate::errors::PostCode;
use crate::kinematics::INCH;
use crate::letters::{I, J, K};
use crate::locations as loc;
use crate::motion::{Position, Target};
use crate::post::Post;

/// Radii of start and end may differ by this, mm or inch.
const RADIUS_TOLERANCE: f64 = 1e-3;

/// End and start of an arc nearer than this make a full circle, mm or inch.
const SAME_POINT: f64 = 1e-6;

/// Normals that differ less than this from a machine axis lie in its plane.
const IN_PLANE: f64 = 1e-6;

const FULL: f64 = 360.0;

/// Most full turns of one helix.
const MAX_TURNS: f64 = 10_000.0;

/// How the tape says where the center is (INTCOM 1924).
#[derive(Clone, Copy, PartialEq, Eq)]
enum CenterForm {
    FromStart,
    FromCenter,
    Radius,
    Absolute,
    Unsigned,
}

/// A CIRCLE that waits for its end point, in the part frame.
#[derive(Clone, Debug)]
pub struct Arc {
    center: Point3<f64>,
    axis: Vector3<f64>,
    radius: Option<f64>,
    /// Full turns besides the arc from start to end (TIMES).
    turns: f64,
    /// The CIRCLE record.
    cause: Cause,
}

/// An arc in machine coordinates and in a plane of the machine.
struct PlaneArc {
    /// Axis numbers of the plane, first to second is counter-clockwise.
    first: usize,
    second: usize,
    /// Plane selection code.
    plane: i32,
    counter_clockwise: bool,
    center: [f64; 2],
    radius: f64,
    start_angle: f64,
    /// Degrees, above 0; above 360 for a helix of several turns.
    sweep: f64,
    /// The CIRCLE record.
    cause: Cause,
}

/// Keeps the circle until its end point comes.
///
/// # Errors
/// A second CIRCLE without a GOTO between, or a record without center and axis.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    if post.state.arc.is_some() {
        return Err(Box::new(Diag::new(PostCode::ArcEnd, "a second CIRCLE came before the GOTO")));
    }
    let circle = record
        .circle()
        .ok_or_else(|| Form::new(record, vocabulary).error("center and axis are needed"))?;
    let turns = record.number_after(w::TIMES).unwrap_or(0.0);
    if turns.fract() != 0.0 || !(0.0..=MAX_TURNS).contains(&turns) {
        return Err(
            Form::new(record, vocabulary).error(format!("{turns} turns are no whole turns"))
        );
    }
    let axis = Vector3::from(circle.axis);
    if axis.norm() < SAME_POINT {
        return Err(Form::new(record, vocabulary).error("the axis has length zero"));
    }
    post.state.arc = Some(Arc {
        center: Point3::from(circle.center),
        axis: axis.normalize(),
        radius: circle.radius,
        turns,
        cause: post.block.cause,
    });
    Ok(())
}

/// Writes the arc that ends at `target`.
///
/// # Errors
/// No start point, radii that disagree, and all that a motion refuses.
pub fn finish(post: &mut Post, arc: &Arc, target: Target) -> Result<(), Box<Diag>> {
    let start = post
        .state
        .point
        .ok_or_else(|| Box::new(Diag::new(PostCode::ArcStart, "CIRCLE before any FROM or GOTO")))?;
    check_radii(arc, start, target.point)?;
    super::cycle::cancel(post)?;
    post.state.rapid = None;
    let sweep = sweep(arc, start, target.point);
    let turns_axis = target.axis != post.state.axis;
    match plane_arc(post, arc, start, sweep)? {
        Some(plane) if !turns_axis => write_arc(post, &plane, target),
        _ => write_lines(post, arc, start, sweep, target),
    }
}

fn check_radii(arc: &Arc, start: Point3<f64>, end: Point3<f64>) -> Result<(), Box<Diag>> {
    let radius = |point: Point3<f64>| flat(arc, point).norm();
    let (at_start, at_end) = (radius(start), radius(end));
    let given = arc.radius.unwrap_or(at_start);
    if (at_start - at_end).abs() > RADIUS_TOLERANCE || (given - at_start).abs() > RADIUS_TOLERANCE {
        return Err(Box::new(Diag::new(
            PostCode::ArcRadius,
            format!("radius {given:.4}, but {at_start:.4} at the start and {at_end:.4} at the end"),
        )));
    }
    Ok(())
}

/// The vector from the axis of the arc to a point.
fn flat(arc: &Arc, point: Point3<f64>) -> Vector3<f64> {
    let from = point - arc.center;
    from - arc.axis * arc.axis.dot(&from)
}

/// Angle from start to end about the axis, degrees: above 0, at most 360 and
/// the full turns on top. A start above the end is one turn, or TIMES turns.
fn sweep(arc: &Arc, start: Point3<f64>, end: Point3<f64>) -> f64 {
    let (from, to) = (flat(arc, start), flat(arc, end));
    if (from - to).norm() < SAME_POINT {
        return FULL * arc.turns.max(1.0);
    }
    let angle = arc.axis.dot(&from.cross(&to)).atan2(from.dot(&to)).to_degrees();
    let part = if angle <= 0.0 { angle + FULL } else { angle };
    part + FULL * arc.turns
}

/// The arc in machine coordinates; `None` when the tape can't say it as an arc.
fn plane_arc(
    post: &mut Post,
    arc: &Arc,
    start: Point3<f64>,
    sweep: f64,
) -> Result<Option<PlaneArc>, Box<Diag>> {
    let trans = post.state.transformation.clone();
    if trans.as_ref().is_some_and(|trans| !trans.is_rigid()) {
        return Ok(None);
    }
    let axis = post.state.axis;
    let mut machine = |point: Point3<f64>| {
        post.position_of(Target { point, axis }).map(|p| Vector3::new(p[0], p[1], p[2]))
    };
    let (center, from) = (machine(arc.center)?, machine(start)?);
    let mirrored = trans.is_some_and(|trans| trans.linear().determinant() < 0.0);
    let normal = (machine(arc.center + arc.axis)? - center) * if mirrored { -1.0 } else { 1.0 };
    let planes = [
        (2, 0, 1, loc::CIRCLE_PLANE_XY),
        (1, 2, 0, loc::CIRCLE_PLANE_ZX),
        (0, 1, 2, loc::CIRCLE_PLANE_YZ),
    ];
    let Some((along, first, second, plane)) =
        planes.into_iter().find(|(along, ..)| normal[*along].abs() > 1.0 - IN_PLANE)
    else {
        return Ok(None);
    };
    let radius = (start - arc.center - arc.axis * arc.axis.dot(&(start - arc.center))).norm();
    let too_large = post.commons.dbl_opt(loc::CIRCLE_MAX_RADIUS).is_some_and(|max| radius > max);
    if too_large || !post.machine.keeps_circles(first, second) {
        return Ok(None);
    }
    let center = [center[first], center[second]];
    Ok(Some(PlaneArc {
        first,
        second,
        plane: post.code(plane, "this plane")?,
        counter_clockwise: normal[along] > 0.0,
        center,
        radius,
        start_angle: (from[second] - center[1]).atan2(from[first] - center[0]).to_degrees(),
        sweep,
        cause: arc.cause,
    }))
}

/// Writes the blocks of an arc in a plane.
fn write_arc(post: &mut Post, arc: &PlaneArc, target: Target) -> Result<(), Box<Diag>> {
    let start = post.state.point;
    let mut here = match start {
        Some(point) => post.position_of(Target { point, axis: target.axis })?,
        None => Position::default(),
    };
    let end = post.position_of(target)?;
    let from = here;
    let along = 3 - arc.first - arc.second;
    let mut done = 0.0;
    for stop in stops(post, arc) {
        let share = stop / arc.sweep;
        let mut next = end;
        let point_word = post.state.point_word;
        if stop < arc.sweep {
            // The record's point is where the arc ends, not this part of it.
            post.state.point_word = 0;
            let turned = if arc.counter_clockwise { stop } else { -stop };
            let (sine, cosine) = (arc.start_angle + turned).to_radians().sin_cos();
            next[arc.first] = arc.center[0] + arc.radius * cosine;
            next[arc.second] = arc.center[1] + arc.radius * sine;
            next[along] = from[along] + (end[along] - from[along]) * share;
        }
        arc_block(post, arc, &here, &next, stop - done)?;
        post.state.point_word = point_word;
        here = next;
        done = stop;
    }
    post.state.point = Some(target.point);
    Ok(())
}

/// Angles from the start, in degrees, at which the blocks of an arc end.
fn stops(post: &Post, arc: &PlaneArc) -> Vec<f64> {
    let mut stops = Vec::new();
    let limit = f64::from(post.commons.int(loc::CIRCLE_MAX_DEGREES));
    let halves =
        center_form(post) == CenterForm::Radius || post.commons.int(loc::CIRCLE_FULL_CIRCLE) == 0;
    let (mut next, step) = if (1.0..=90.0).contains(&limit) {
        let turned = if arc.counter_clockwise { arc.start_angle } else { -arc.start_angle };
        (((turned / 90.0).floor() + 1.0) * 90.0 - turned, 90.0)
    } else if arc.sweep > FULL - 1e-9 && halves {
        (FULL / 2.0, FULL / 2.0)
    } else {
        (FULL, FULL)
    };
    while next < arc.sweep - 1e-6 {
        if next > 1e-6 {
            stops.push(next);
        }
        next += step;
    }
    stops.push(arc.sweep);
    stops
}

fn arc_block(
    post: &mut Post,
    arc: &PlaneArc,
    from: &Position,
    to: &Position,
    sweep: f64,
) -> Result<(), Box<Diag>> {
    let code = if arc.counter_clockwise { loc::CIRCLE_CCW_CODE } else { loc::CIRCLE_CW_CODE };
    let code = post.code(code, "an arc")?;
    let modal = post.commons.flag(loc::CIRCLE_MODAL);
    post.because(arc.cause, |post| {
        post.plane_code(arc.plane);
        post.motion_code(code, modal);
    });
    let always = !post.commons.flag(loc::CIRCLE_AXES_MODAL);
    for number in [arc.first, arc.second] {
        post.axis_word(number, to[number], always)?;
    }
    post.axis_word(3 - arc.first - arc.second, to[3 - arc.first - arc.second], false)?;
    post.because(arc.cause, |post| center_words(post, arc, from, sweep))?;
    post.feed_words()?;
    post.write_motion()
}

fn center_form(post: &Post) -> CenterForm {
    match post.commons.int(loc::CIRCLE_CENTER) {
        2 => CenterForm::FromCenter,
        3 => CenterForm::Radius,
        4 => CenterForm::Absolute,
        5 => CenterForm::Unsigned,
        _ => CenterForm::FromStart,
    }
}

/// Adds I J K of the plane, or the radius: negative above 180 degrees.
fn center_words(
    post: &mut Post,
    arc: &PlaneArc,
    from: &Position,
    sweep: f64,
) -> Result<(), Box<Diag>> {
    let form = center_form(post);
    if form == CenterForm::Radius {
        let letter = post.letter(loc::CIRCLE_RADIUS_ADDRESS, "the radius")?;
        let radius = if sweep > 180.0 + 1e-6 { -arc.radius } else { arc.radius };
        return post.word(letter, radius);
    }
    for (number, center) in [arc.first, arc.second].into_iter().zip(arc.center) {
        let start = post.machine.axis(number).rounded(from[number])?;
        let value = match form {
            CenterForm::FromCenter => start - center,
            CenterForm::Absolute => center,
            CenterForm::Unsigned => (center - start).abs(),
            CenterForm::FromStart | CenterForm::Radius => center - start,
        };
        post.word([I, J, K][number], value)?;
    }
    Ok(())
}

/// Writes an arc as short lines within the chord tolerance.
fn write_lines(
    post: &mut Post,
    arc: &Arc,
    start: Point3<f64>,
    sweep: f64,
    target: Target,
) -> Result<(), Box<Diag>> {
    post.warn(PostCode::ArcLines, "an arc was written as short lines".to_string());
    let radius = flat(arc, start).norm();
    let inch = if post.state.metric { 1.0 } else { INCH };
    let tolerance = post.commons.dbl_opt(loc::CIRCLE_CHORD_TOLERANCE).unwrap_or(0.005) / inch;
    let step = 2.0 * (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos().to_degrees();
    let count = (sweep / step.max(0.05)).ceil().max(1.0) as u32;
    let from_axis = post.state.axis;
    let from = flat(arc, start);
    let across = arc.axis.cross(&from);
    let rise = arc.axis.dot(&(target.point - start));
    let base = start - from;
    let point_word = std::mem::take(&mut post.state.point_word);
    for number in 1..count {
        let share = f64::from(number) / f64::from(count);
        let (sine, cosine) = (sweep * share).to_radians().sin_cos();
        let point = base + from * cosine + across * sine + arc.axis * (rise * share);
        let axis = from_axis.lerp(&target.axis, share).normalize();
        post.move_to(Target { point, axis })?;
    }
    post.state.point_word = point_word;
    post.move_to(target)
}
