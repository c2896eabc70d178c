//! Arcs: from the part frame into a plane of the machine, in as many blocks as the
//! control needs, checked as the control will read them; else short lines.

use fil_diag::Result;
use fil_machine::axes::Position;
use fil_machine::locations::{
    self as loc, CircleCenter, CircleCorrection, CircleCutcomPlane, CircleFullCircle,
};
use fil_machine::modes::{INCH, Plane};
use nalgebra::{Point3, Vector3};

use super::arc_parts::{
    FULL, Parts, RADIUS_TOLERANCE, SAME_POINT, Step, flat, least_angle, start_angle, sweep,
};
use super::mill_turn::live_tool;
use super::position::Solution;
use super::{feed_rules, frame, rotary, tip_control};
use super::{frame_begin, long_arc, position};
use crate::control::word_address::arc as words;
use crate::control::{Function, family};
use crate::control_state::{Compensation, CutterPath, modal};
use crate::errors::PostCode;
use crate::operation::motion::PlaneArc;
use crate::operation::{Arc, Target};
use crate::post::Post;

/// End and start of an arc nearer than this, and farther than that, may be meant as one point: CL
/// files have three digits and more. In mm.
const NEARLY_SAME: f64 = 1e-3;

/// An arc whose axis is less than this, as a cosine, from one of the machine is near its
/// plane.
const NEAR_PLANE: f64 = 1e-6;

/// Angles nearer than this are one, degrees and quarters of a turn.
const SAME_ANGLE: f64 = 1e-6;

const ELSEWHERE: &str = "the position is not the start of the arc: a cycle, a foreign block, POSTN, REPEAT or FROM moved the axes, TRANS moved the coordinate system, or no move came before";

/// Carries out the arc that ends at `target`.
///
/// # Errors
/// No start point, radii that disagree, an arc in a cycle or as the first motion of
/// cutter compensation, and all that a motion refuses.
pub fn carry_out(post: &mut Post, arc: &Arc, target: Target) -> Result<()> {
    post.path.last.in_cut = true;
    let Some(start) = post.path.point else {
        return PostCode::ArcStart.err("CIRCLE before any FROM or GOTO");
    };
    let target = corrected(post, arc, start, target);
    let ends = [start, target.point].map(|point| flat(arc, point));
    let radius = check_radii(arc, ends)?;
    refuse_first_under_compensation(post)?;
    if post.control.state.has_doubts() {
        post.control.ready_length()?;
        rotary::refuse_unknown_start(post)?;
    }
    let sweep = sweep(arc, ends);
    // A turning tool cuts along Z.
    let tables = &post.control.tables;
    let turns = !tables.mills() && post.control.commons.read(loc::LATHE_DIAMETER);
    let tool = Some(target.axis).filter(|_| !turns);
    post.path.sense.course.arc(ends.map(|end| arc.axis.cross(&end)), sweep, tool, arc.line);
    let turns_axis = target.axis != post.path.axis.stands;
    if !turns_axis {
        tip_control::choose(post, target, true);
    }
    if post.control.tables.frame_output && !post.writes_tip() {
        let axis = post.path.axis.stands;
        frame_begin::turn_to(post, Target { axis, ..target }, false)?;
    }
    tip_control::end_outside(post)?;
    let turns_c = live_tool::is_cut_by_c(&post.control);
    let whole = if turns_axis || turns_c {
        None
    } else {
        in_plane(post, arc, start, (radius, sweep), target)?
    };
    let whole = match whole {
        Some((whole, _)) if is_across_compensation(post, &whole)? => None,
        Some((whole, _)) if !post.control.family().has_arc(&post.control, whole.plane) => None,
        whole => whole,
    };
    let Some((mut whole, solution)) = whole else {
        let solution = where_it_begins(post, start)?;
        rotary::establish(post, solution)?;
        post.warn(PostCode::ArcLines, "an arc was written as short lines".to_string());
        return long_arc::as_lines(post, arc, start, sweep, target);
    };
    rotary::establish(post, solution)?;
    check_travel(post, &whole)?;
    post.control.family().ready_for_arc(&mut post.control, whole.plane)?;
    let Some(stands) = words::start_on_tape(&post.control, &whole.from) else {
        return PostCode::ArcStart.err(ELSEWHERE);
    };
    whole.start = post.control.klartext.start(whole.plane.axes().map(|number| stands[number]));
    if usual_step(post, &whole) == Step::Turns
        && sweep <= FULL
        && post.control.family().reads_as_meant(&post.control, &whole)?
    {
        let feed = feed_rules::settle_of_arc(post, &whole)?;
        family::arc(&mut post.control, &whole, feed.as_ref())?;
        post.path.arrive(target);
        Ok(())
    } else if let Some(parts) = parts(post, &whole)? {
        long_arc::in_parts(post, parts, target.point)
    } else {
        // An arc of a few last digits: as lines it is within rounding.
        long_arc::as_lines(post, arc, start, sweep, target)
    }
}

/// Refuses an arc whose end is its start but for a rounding: one a hair past it would be no motion
/// at all, and one a hair before it a full turn. In real CL files full circles end exactly where they
/// begin, and no arc ends nearer.
///
/// # Errors
/// It ends there, and TIMES does not say how many turns it makes.
pub(super) fn refuse_nearly_full(post: &Post, arc: &Arc, end: Target) -> Result<()> {
    let Some(start) = post.path.point.filter(|_| arc.turns == 0.0) else { return Ok(()) };
    let way = end.point - start;
    let apart = (way - arc.axis * arc.axis.dot(&way)).norm();
    let near = if post.control.is_metric() { NEARLY_SAME } else { NEARLY_SAME / INCH };
    if apart < SAME_POINT || apart >= near || 2.0 * flat(arc, start).norm() <= near {
        return Ok(());
    }
    let [from, to] = [start, end.point].map(|point| flat(arc, point));
    if post.path.sense.course.exact_turns && arc.axis.dot(&from.cross(&to)) > 0.0 {
        return Ok(());
    }
    PostCode::ArcNearlyFull
        .err(format!("the end lies {apart:.5} from the start: a full turn, or none"))
}

/// How the machine stands where an arc as lines begins.
///
/// # Errors
/// The tape does not stand there: the first line would not begin on the arc.
fn where_it_begins(post: &Post, start: Point3<f64>) -> Result<Solution> {
    if post.control.tables.mills() {
        return Ok(Solution::Still);
    }
    let here = Target { point: start, axis: post.path.axis.stands, word: 0 };
    let (from, solution) = if post.writes_tip() {
        let (tip, _) = position::transformed(post, here);
        ([tip.x, tip.y, tip.z, 0.0, 0.0], Solution::Still)
    } else {
        rotary::position_of(post, here)?
    };
    match words::start_on_tape(&post.control, &from) {
        Some(_) => Ok(solution),
        None => PostCode::ArcStart.err(ELSEWHERE),
    }
}

/// The end of an arc as the machine wants it: at the radius of the start, and at its level
/// where it is off by a little (INTCOM 1879, DBLCOM 917).
fn corrected(post: &Post, arc: &Arc, start: Point3<f64>, target: Target) -> Target {
    let commons = &post.control.commons;
    let mut point = target.point;
    if commons.read(loc::CIRCLE_CORRECTION) == CircleCorrection::CorrectTheEndPoint {
        let [at_start, at_end] = [start, point].map(|point| flat(arc, point));
        let off = at_start.norm() - at_end.norm();
        let most = commons.dbl_opt(loc::CIRCLE_CORRECTION_MAX).unwrap_or(0.0);
        if off.abs() <= most && at_end.norm() > SAME_POINT {
            point += at_end.normalize() * off;
        }
    }
    let rise = arc.axis.dot(&(point - start));
    let flat_within = commons.dbl_opt(loc::CIRCLE_Z_TOLERANCE).unwrap_or(0.0);
    if rise.abs() <= flat_within && arc.turns == 0.0 {
        point -= arc.axis * rise;
    }
    Target { point, ..target }
}

/// Gives the radius at the start.
fn check_radii(arc: &Arc, ends: [Vector3<f64>; 2]) -> Result<f64> {
    let [at_start, at_end] = ends.map(|end| end.norm());
    let given = arc.radius.unwrap_or(at_start);
    if (at_start - at_end).abs() > RADIUS_TOLERANCE || (given - at_start).abs() > RADIUS_TOLERANCE {
        return PostCode::ArcRadius.err(format!(
            "radius {given:.4}, but {at_start:.4} at the start and {at_end:.4} at the end"
        ));
    }
    Ok(at_start)
}

/// Compensation begins on a straight line: on an arc the control would alarm or
/// choose a way of its own.
fn refuse_first_under_compensation(post: &Post) -> Result<()> {
    let state = &post.control.state;
    let on = !matches!(state.get(modal::CUTTER_COMP), Some(Compensation::Off));
    let waits = post.control.waiting.has(Function::Compensation);
    if !waits
        && state.get(modal::CUTTER_COMP).is_none()
        && !state.is(modal::CUTTER_PATH, CutterPath::Moved)
    {
        let message = "a block before it may have switched cutter compensation on (a called program, an unknown code), which would start on the arc";
        return Err(Box::new(PostCode::CompensationOnArc.diag(message).hint(
            "put a straight move before the CIRCLE, where the post outputs G40, or INSERT the code that cancels compensation",
        )));
    }
    if waits
        || state.may_be(modal::CUTTER_PATH, CutterPath::Leaving)
        || (on && !state.is(modal::CUTTER_PATH, CutterPath::Moved))
    {
        return PostCode::CompensationOnArc.err("cutter compensation would begin or end on an arc");
    }
    Ok(())
}

/// True for an arc in another plane than cutter compensation, on a machine that writes it
/// as lines then.
///
/// # Errors
/// An arc that turns back in the plane of compensation: the cutter would swing round.
fn is_across_compensation(post: &Post, arc: &PlaneArc) -> Result<bool> {
    let control = &post.control;
    let other = control.state.get(modal::PLANE).filter(|plane| *plane != arc.plane);
    let Some(plane) = other.filter(|_| control.state.compensates()) else { return Ok(false) };
    let changes =
        control.commons.read(loc::CIRCLE_CUTCOM_PLANE) != CircleCutcomPlane::StraightMoves;
    if changes && control.family().has_arc(control, arc.plane) {
        return Ok(false);
    }
    let shared = arc.plane.axes().into_iter().position(|axis| axis != plane.normal());
    let turns_back = extremes(arc).any(|angle| {
        let along_first = angle.rem_euclid(180.0) < 45.0 || angle.rem_euclid(180.0) > 135.0;
        along_first == (shared == Some(0))
    });
    if turns_back {
        return PostCode::CompensationOn
            .err("at an arc in another plane, whose lines would turn back on themselves");
    }
    Ok(true)
}

/// The arc in machine coordinates, and how the machine comes to its end; `None` when the control can't say it as an arc.
fn in_plane(
    post: &Post,
    arc: &Arc,
    start: Point3<f64>,
    (radius, sweep): (f64, f64),
    target: Target,
) -> Result<Option<(PlaneArc, Solution)>> {
    if post.writes_tip() {
        return Ok(None);
    }
    let transformation = post.path.transformation.as_ref();
    if transformation.is_some_and(|trans| !trans.is_rigid()) {
        return Ok(None);
    }
    let mirrored = transformation.is_some_and(|trans| trans.mirrors());
    let is_fixed = transformation.is_none() && !post.control.tables.chain().has_rotary();
    let machine = |point: Point3<f64>| {
        rotary::position_of(post, Target { point, axis: target.axis, word: 0 })
            .map(|(position, _)| position)
    };
    let linear = |position: Position| Vector3::new(position[0], position[1], position[2]);
    let (center, from) = (linear(machine(arc.center)?), machine(start)?);
    let normal = if is_fixed {
        arc.axis
    } else {
        let tip = linear(machine(arc.center + arc.axis)?);
        (tip - center) * if mirrored { -1.0 } else { 1.0 }
    };
    let (to, solution) = rotary::position_of(post, target)?;
    let found =
        Plane::ALL.into_iter().find(|plane| normal[plane.normal()].abs() > 1.0 - NEAR_PLANE);
    let Some(plane) = found else { return Ok(None) };
    let most = post.control.commons.dbl_opt(loc::CIRCLE_MAX_RADIUS);
    let least = post.control.commons.dbl_opt(loc::CIRCLE_MIN_RADIUS);
    let axes = plane.axes();
    // A large arc leaves the plane by more than a last digit at a smaller angle.
    let aside = libm::hypot(normal[axes[0]], normal[axes[1]]);
    let last_digit = post.control.tables.axis(plane.normal()).resolution();
    if aside * radius > last_digit {
        return Ok(None);
    }
    let circles = axes.into_iter().all(|number| post.control.tables.axis(number).keeps_circles());
    let is_allowed =
        most.is_none_or(|most| radius <= most) && least.is_none_or(|least| radius >= least);
    if !is_allowed || !circles {
        return Ok(None);
    }
    let arc = PlaneArc {
        plane,
        counterclockwise: normal[plane.normal()] > 0.0,
        center: axes.map(|number| center[number]),
        radius,
        from,
        start: axes.map(|number| from[number]),
        to,
        sweep,
        word: position::word_of(post, target),
        cause: arc.cause,
    };
    Ok(Some((arc, solution)))
}

/// Refuses an arc that bulges out of the travel between its ends.
fn check_travel(post: &Post, arc: &PlaneArc) -> Result<()> {
    let axes = arc.plane.axes().map(|number| post.control.tables.axis(number));
    if !axes.iter().any(|axis| axis.is_limited()) {
        return check_travel_in_frame(post, arc);
    }
    for (axis, number) in axes.iter().zip(arc.plane.axes()) {
        axis.check(arc.to[number])?;
    }
    for angle in extremes(arc) {
        let (sine, cosine) = libm::sincos(angle.to_radians());
        for ((axis, center), part) in axes.iter().zip(arc.center).zip([cosine, sine]) {
            axis.check(center + arc.radius * part)?;
        }
    }
    Ok(())
}

/// The same in a tilted frame, whose axes lie as those of the machine do.
fn check_travel_in_frame(post: &Post, arc: &PlaneArc) -> Result<()> {
    let tables = &post.control.tables;
    if !tables.frame_output || !tables.limits_travel() {
        return Ok(());
    }
    for angle in extremes(arc) {
        let (sine, cosine) = libm::sincos(angle.to_radians());
        let mut point = arc.from;
        for ((number, center), part) in
            arc.plane.axes().into_iter().zip(arc.center).zip([cosine, sine])
        {
            point[number] = center + arc.radius * part;
        }
        frame::check_on_the_way(post, [point[0], point[1], point[2]])?;
    }
    Ok(())
}

/// Angles inside an arc, in degrees from the first axis of the plane, where it is farthest
/// along one of the axes.
fn extremes(arc: &PlaneArc) -> impl Iterator<Item = f64> + use<> {
    let start = start_angle(arc);
    let turned = if arc.counterclockwise { start } else { -start };
    let first = ((turned / 90.0 + SAME_ANGLE).floor() + 1.0) * 90.0;
    let end = turned + arc.sweep.min(FULL) - SAME_ANGLE;
    let sign = if arc.counterclockwise { 1.0 } else { -1.0 };
    std::iter::successors(Some(first), |angle| Some(angle + 90.0))
        .take_while(move |angle| *angle < end)
        .map(move |angle| sign * angle)
}

/// The parts that the control reads as they are meant: as few as the machine's rules
/// allow, more where rounding would change them; `None` when no arc does.
fn parts(post: &Post, arc: &PlaneArc) -> Result<Option<Parts>> {
    let steps: &[Step] = match usual_step(post, arc) {
        Step::Turns => &[Step::Turns, Step::Halves, Step::Quadrants],
        Step::Halves => &[Step::Halves, Step::Quadrants],
        Step::Quadrants => &[Step::Quadrants],
    };
    let least = least_angle(&post.control, arc);
    for step in steps {
        let parts = Parts::new(arc, *step, least);
        if are_meant(post, parts.clone())? {
            return Ok(Some(parts));
        }
    }
    Ok(None)
}

/// True where the control reads each part as it is meant.
fn are_meant(post: &Post, mut parts: Parts) -> Result<bool> {
    while let Some(part) = parts.next(&post.control)? {
        if !post.control.family().reads_as_meant(&post.control, &part)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// What the machine asks for.
fn usual_step(post: &Post, arc: &PlaneArc) -> Step {
    let commons = &post.control.commons;
    let form = commons.read(loc::CIRCLE_CENTER);
    let limit = commons.int(loc::CIRCLE_MAX_DEGREES);
    let halves = form == CircleCenter::Radius
        || commons.read(loc::CIRCLE_FULL_CIRCLE) == CircleFullCircle::Split;
    if (1..=90).contains(&limit) || form == CircleCenter::StartToCenterUnsigned {
        Step::Quadrants
    } else if arc.sweep > FULL - 1e-9 && halves {
        Step::Halves
    } else {
        Step::Turns
    }
}

#[cfg(test)]
mod tests;
