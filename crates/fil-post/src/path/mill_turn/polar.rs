//! Polar interpolation (G12.1, G13.1; TRANSMIT): X and C, of TRANSMIT X and Y, are a plane of
//! lengths, and the control turns the spindle.
//!
//! It begins with C at 0, so that controls that count the plane from where C stands and
//! those that count it from its zero agree. It takes no G0: rapid motions are made at the
//! feed `mill_turn.polar_rapid`.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations::{self as loc, MillTurnMode};
use fil_machine::modes::{FeedMode, Plane};
use nalgebra::{Point2, Point3, Rotation3, Unit};

use super::live_tool::{CENTER, tenths};
use crate::control::family;
use crate::control::needs::{self, Act};
use crate::control::sinumerik::transformation;
use crate::control::word_address::modes;
use crate::control::{Control, Function};
use crate::control_state::{Place, Source, modal};
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::operation::{Arc, Feed, MotionKind, Target};
use crate::path::arc_parts::{flat, sweep};
use crate::path::{position, rapid};
use crate::post::Post;

/// Nearest to the axis of the spindle that a path may pass, mm: nearer, C would have to
/// turn faster than it can.
const NEAREST: f64 = 0.05;

/// Positions nearer than this are one, mm or inch.
const SAME: f64 = 1e-4;

/// Points of an arc at which the travel of X is looked at.
const ARC_STEPS: u32 = 180;

/// A way around the axis to the first point is made of lines that turn no more than this,
/// so that none comes near the axis, radians.
const MOST_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// Says that it begins.
fn say_begin(control: &mut Control) -> Result<()> {
    if control.tables.transforms {
        return transformation::transmit(control);
    }
    let Some(code) = tenths(control, loc::MILL_TURN_POLAR_CODE) else {
        return PostCode::Polar.err("the machine has none");
    };
    control.g_of_record(code);
    control.write_block()
}

/// Says that it ends.
fn say_end(control: &mut Control) -> Result<()> {
    if control.tables.transforms {
        return transformation::end(control);
    }
    let Some(code) = tenths(control, loc::MILL_TURN_POLAR_END_CODE) else {
        return PostCode::NoCode.err("mill_turn.polar_end_code names no function");
    };
    control.g_of_record(code);
    control.write_block()
}

/// Begins it at a rapid motion, and goes to the target.
///
/// # Errors
/// Cutter compensation, blocks that may be skipped; as a motion.
pub(super) fn begin(
    post: &mut Post,
    target: Target,
    point: Point3<f64>,
    kind: MotionKind,
) -> Result<()> {
    let control = &mut post.control;
    control.ready_for(Act::PolarOn)?;
    super::refuse_travel_of_c(control, PostCode::Polar)?;
    control.begin()?;
    control.require_unit()?;
    let cause = control.block.cause;
    let radius = libm::hypot(point.x, point.y);
    let at = |axes| Motion::new([radius, 0.0, point.z, 0.0, 0.0], axes, 0);
    let lifts = match control.place(2) {
        Place::At(_) | Place::Unsaid | Place::Clear => {
            control.stands(2).is_some_and(|here| point.z > here)
        }
        _ => rapid::decide_z_first(control, &at(AxisSet::ALL))?,
    };
    if lifts {
        rapid::rapid(control, &at(AxisSet::Z), cause)?;
    }
    rapid::rapid(control, &at(AxisSet::of(0).or(AxisSet::of(3))), cause)?;
    // The code of its turns a minute is none of those that polar interpolation takes.
    control.flush_function(Function::Spindle)?;
    say_begin(control)?;
    super::set_mode(control, MillTurnMode::PolarInterpolation)?;
    match control.tables.transforms {
        true => modes::plane_of_its_own(control, Plane::Xy)?,
        false => control.state.set(modal::PLANE, Plane::Xy),
    }
    let end = Point2::new(point.x, point.y);
    let turn = libm::atan2(point.y, point.x);
    let parts = (turn.abs() / MOST_TURN).ceil().max(1.0) as u32;
    let feed = feed_of(post, kind)?;
    for number in 1..parts {
        let (sine, cosine) = libm::sincos(turn * f64::from(number) / f64::from(parts));
        go(post, [radius * cosine, radius * sine, point.z], AxisSet::XY, &feed, 0)?;
    }
    go(post, [end.x, end.y, point.z], AxisSet::XY, &feed, position::word_of(post, target))?;
    go(post, [end.x, end.y, point.z], AxisSet::Z, &feed, position::word_of(post, target))?;
    arrive(post, target);
    Ok(())
}

/// A straight motion.
///
/// # Errors
/// A way that passes the axis of the spindle; no feed; as a motion.
pub(super) fn line(
    post: &mut Post,
    target: Target,
    point: Point3<f64>,
    kind: MotionKind,
) -> Result<()> {
    post.control.require(Act::MillTurnMotion)?;
    if let Some(from) = post.path.point {
        let from = position::transformed(post, Target { point: from, ..target }).0;
        let nearest = nearest(from.xy(), point.xy());
        let moves = (from.xy() - point.xy()).norm() > CENTER;
        if moves && nearest < least(post)? {
            return passes(nearest);
        }
    }
    let feed = feed_of(post, kind)?;
    let word = position::word_of(post, target);
    let to = point.coords.into();
    match rising(post, point) {
        Some(_) if kind == MotionKind::Feed => return with_z(),
        Some(true) => {
            go(post, to, AxisSet::Z, &feed, word)?;
            go(post, to, AxisSet::XY, &feed, word)?;
        }
        Some(false) => {
            go(post, to, AxisSet::XY, &feed, word)?;
            go(post, to, AxisSet::Z, &feed, word)?;
        }
        None if kind == MotionKind::Feed => cut(post, to, &feed, word)?,
        None => go(post, to, AxisSet::LINEAR, &feed, word)?,
    }
    arrive(post, target);
    Ok(())
}

/// A motion moves Z together with X and C, and upwards or not; `None` for any other.
fn rising(post: &Post, to: Point3<f64>) -> Option<bool> {
    let from = post.path.point.map(|point| Target { point, axis: post.path.axis.given, word: 0 });
    let from = from.map(|target| position::transformed(post, target).0);
    let moves = |number: usize| {
        let on_tape = post.control.tables.axis(number).on_tape(to[number]);
        match (post.control.axis_position(number), on_tape, from) {
            (Some(here), Ok(there), _) => (here - there).abs() > CENTER,
            // A text has moved nothing, but may have: the words are written again.
            (None, _, Some(from)) => (from[number] - to[number]).abs() > CENTER,
            _ => true,
        }
    };
    let across = moves(0) || moves(1);
    (across && moves(2)).then(|| post.control.axis_position(2).is_some_and(|z| z < to.z))
}

fn with_z() -> Result<()> {
    PostCode::Polar.err(
        "Z moves together with X and C: controls move it by itself then, and not along the line",
    )
}

fn arrive(post: &mut Post, target: Target) {
    post.path.arrive(target);
    post.path.rotary = None;
}

/// A motion at feed, at which Z goes no faster than it may.
fn cut(post: &mut Post, to: [f64; 3], feed: &Feed, word: u16) -> Result<()> {
    let [x, y, z] = to;
    let feed = super::limit_to_axes(post, *feed, &[x, y, z, 0.0, 0.0]);
    go(post, to, AxisSet::LINEAR, &feed, word)
}

fn go(post: &mut Post, [x, y, z]: [f64; 3], axes: AxisSet, feed: &Feed, word: u16) -> Result<()> {
    let of_slides: Position = [libm::hypot(x, y), 0.0, z, 0.0, 0.0];
    post.control.tables.check_travel(&of_slides, axes)?;
    let position: Position = [x, y, z, 0.0, 0.0];
    family::feed(&mut post.control, &Motion::new(position, axes, word), Some(feed))
}

/// The feed of a motion: that of the machine for rapid ones.
fn feed_of(post: &Post, kind: MotionKind) -> Result<Feed> {
    let MotionKind::Rapid(cause) = kind else {
        return needs::feed(post.path.feed.as_ref()).copied();
    };
    let mm = post.control.require_unit()?.in_mm();
    let value = post.control.commons.dbl_opt(loc::MILL_TURN_POLAR_RAPID).filter(|feed| *feed > 0.0);
    let Some(value) = value else {
        return PostCode::Polar.err("mill_turn.polar_rapid gives no feed for a rapid move");
    };
    Ok(Feed { value: value / mm, asked: value / mm, mode: FeedMode::PerMinute, cause })
}

/// Refuses an arc that passes the axis of the spindle, or that leaves the travel.
///
/// # Errors
/// It does.
pub(super) fn check_arc(post: &Post, arc: &Arc, target: Target) -> Result<()> {
    post.control.require(Act::MillTurnMotion)?;
    let Some(start) = post.path.point else { return Ok(()) };
    let place = |point| position::transformed(post, Target { point, ..target }).0;
    let ends = [start, target.point].map(|point| flat(arc, point));
    let center = place(arc.center);
    let of_circle = (libm::hypot(center.x, center.y) - ends[0].norm()).abs();
    let least = least(post)?;
    if arc.axis.dot(&(target.point - start)).abs() > SAME {
        return with_z();
    }
    let part = sweep(arc, ends).to_radians() / f64::from(ARC_STEPS);
    let axis = Unit::new_normalize(arc.axis);
    // No more than this is the arc nearer than a chord of it.
    let sagitta = ends[0].norm() * (1.0 - libm::cos(part / 2.0));
    let mut before = place(start);
    for step in 0..=ARC_STEPS {
        let spoke = Rotation3::from_axis_angle(&axis, part * f64::from(step)) * ends[0];
        let at = place(arc.center + spoke);
        let off = nearest(before.xy(), at.xy()) - sagitta;
        if of_circle < least && off < least {
            return passes(off.max(0.0));
        }
        before = at;
        let of_slides: Position = [libm::hypot(at.x, at.y), 0.0, 0.0, 0.0, 0.0];
        post.control.tables.check_travel(&of_slides, AxisSet::of(0))?;
    }
    Ok(())
}

/// Nearest that a path may come to the axis of the spindle, in the unit of the program.
pub(super) fn least(post: &Post) -> Result<f64> {
    Ok(NEAREST / post.control.require_unit()?.in_mm())
}

/// Refuses a path so near to the axis of the spindle.
pub(super) fn passes(nearest: f64) -> Result<()> {
    PostCode::Polar.err(format!("the path passes the axis of the spindle at {nearest:.4}"))
}

/// Nearest that a line comes to the axis.
pub(super) fn nearest(from: Point2<f64>, to: Point2<f64>) -> f64 {
    let way = to - from;
    let along = if way.norm_squared() > 0.0 {
        (-from.coords.dot(&way) / way.norm_squared()).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (from.coords + way * along).norm()
}

/// Ends it where it is on.
///
/// # Errors
/// Cutter compensation, blocks that may be skipped.
pub(super) fn end(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    if !control.tables.is_polar() {
        return Ok(());
    }
    control.ready_for(Act::PolarOff)?;
    let knows_z = control.axis_position(2).is_some();
    let waiting = control.block.take();
    say_end(control)?;
    control.block = waiting;
    super::set_mode(control, MillTurnMode::Milling)?;
    if knows_z {
        // X and C count otherwise now; Z is the same in both, and a cycle may return to it.
        control.state.trust(control.tables.axis(2).letter);
    }
    match control.tables.transforms {
        true => modes::plane_of_turning(control)?,
        false => control.state.forget(modal::PLANE, Source::Post),
    }
    let here = post.path.point.map(|point| Target { point, axis: post.path.axis.given, word: 0 });
    let here = here.map(|target| position::transformed(post, target).0);
    post.path.rotary = here.map(|point| [libm::atan2(point.y, point.x).to_degrees(), 0.0]);
    Ok(())
}
