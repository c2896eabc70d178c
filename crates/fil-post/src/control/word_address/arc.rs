//! Arcs: plane, direction, end, and the center or the radius.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::letters::{F, IJK};
use fil_machine::locations::{
    self as loc, CircleCenter, CircleCutcomPlane, CircleHelixOutput, CircleHelixWord, ControlFamily,
};
use fil_machine::modes::Plane;
use fil_machine::rounding::Rounding;

use super::modes;
use super::motion;
use crate::control::Control;
use crate::operation::Feed;
use crate::operation::motion::{Motion, PlaneArc};

/// How many last digits the path may be off where the control reads an arc from
/// the rounded words, and half of it what start and end may differ in radius.
const DIGITS: f64 = 3.0;

/// An arc of a smaller radius, in last digits, is no arc to the controls that refuse
/// what is nearly a point.
const LEAST_RADIUS: f64 = 25.0;

/// Ends nearer than this, in last digits, are one point to a control: it would make a
/// full circle.
const LEAST_CHORD: f64 = 2.5;

/// A sweep below this, in degrees, is none to some controls; as a line it is off by
/// 0.2 micrometres at a radius of 10 m.
const LEAST_SWEEP: f64 = 0.02;

/// True when the control reads the arc from its rounded words as it is meant: as long,
/// through the same points, and at one radius from start to end, within a few last
/// digits.
///
/// # Errors
/// A position that does not fit its address.
#[inline]
pub fn reads_as_meant(control: &Control, arc: &PlaneArc) -> Result<bool> {
    if reads_at_a_glance(control, arc) { Ok(true) } else { reads_when_rounded(control, arc) }
}

/// True for the common arc, whose words leave no doubt: it is written with its center,
/// as finely as its ends, which lie well apart at its radius. Rounding then moves its
/// path by a digit or two at most.
#[inline]
fn reads_at_a_glance(control: &Control, arc: &PlaneArc) -> bool {
    if control.commons.read(loc::CIRCLE_CENTER) == CircleCenter::Radius {
        return false;
    }
    let mut digit: f64 = 0.0;
    for number in arc.plane.axes() {
        let axis = control.tables.axis(number).resolution();
        let center = control.tables.addresses.format(IJK[number]);
        let is_coarse = center.is_none_or(|format| format.unscale(1) > axis);
        if is_coarse || control.tables.axis(number).leaves_out_small_ways() {
            return false;
        }
        digit = digit.max(axis);
    }
    let squared = |[x, y]: [f64; 2], [i, j]: [f64; 2]| (x - i) * (x - i) + (y - j) * (y - j);
    let end = arc.flat(&arc.to);
    let round = |point| {
        let off = squared(point, arc.center) - arc.radius * arc.radius;
        off.abs() <= 1.5 * digit * arc.radius
    };
    let least_chord = 8.0 * DIGITS * digit;
    arc.sweep >= LEAST_SWEEP
        && arc.radius >= LEAST_RADIUS * digit
        && squared(arc.start, end) > least_chord * least_chord
        && round(arc.start)
        && round(end)
}

/// The same from the words as they will be written.
fn reads_when_rounded(control: &Control, arc: &PlaneArc) -> Result<bool> {
    let axes = arc.plane.axes().map(|number| control.tables.axis(number));
    // `C` of Klartext has both words.
    let leaves_out = control.tables.family != ControlFamily::Klartext
        && control.commons.read(loc::CIRCLE_AXES_MODAL);
    let start = arc.start;
    let mut end = arc.flat(&arc.to);
    let mut digit: f64 = 0.0;
    for index in [0, 1] {
        // A word that is left out leaves the end where the start is.
        let is_left_out = leaves_out && axes[index].is_no_way(start[index], end[index])?;
        end[index] = if is_left_out { start[index] } else { axes[index].on_tape(end[index])? };
        digit = digit.max(axes[index].resolution());
    }
    let Some((center, finest)) = center_on_tape(control, arc, start, end)? else {
        return Ok(false);
    };
    let allowed = DIGITS * digit.max(finest);
    let apart = (start[0] - end[0]).abs().max((start[1] - end[1]).abs());
    let short = arc.sweep < LEAST_SWEEP || (apart < LEAST_CHORD * digit && arc.sweep < 180.0);
    let tiny = arc.radius < LEAST_RADIUS * digit || short;
    if tiny {
        return Ok(false);
    }
    let [at_start, at_end] = [start, end].map(|point| distance(point, center));
    let sweep = sweep_on_tape(arc, start, end, center);
    let between = [0.25, 0.5, 0.75].map(|share| distance(arc.point_at(share), center));
    Ok((at_start - at_end).abs() <= allowed / 2.0
        && between.into_iter().all(|radius| (radius - at_start).abs() <= allowed)
        && (sweep - arc.sweep).abs().to_radians() * arc.radius <= allowed)
}

/// How far two points lie apart.
pub fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    libm::hypot(one[0] - other[0], one[1] - other[1])
}

/// True when a control that turns the tool about a pole, by so many degrees from where it
/// stands, goes along the arc: it ends where the arc does, so it keeps within a last digit.
pub fn turns_as_meant(
    control: &Control,
    arc: &PlaneArc,
    stands: [f64; 2],
    (pole, degrees): ([f64; 2], f64),
) -> bool {
    let digits = arc.plane.axes().map(|number| control.tables.axis(number).resolution());
    let digit = digits[0].max(digits[1]);
    let radius = distance(stands, pole);
    let between = [0.25, 0.5, 0.75].map(|share| distance(arc.point_at(share), pole));
    arc.sweep >= LEAST_SWEEP
        && arc.radius >= LEAST_RADIUS * digit
        && between.into_iter().all(|other| (other - radius).abs() <= digit)
        && (degrees - arc.sweep).abs().to_radians() * arc.radius <= DIGITS * digit
}

/// Degrees from start to end about a center as a control counts them: a start that
/// is the end makes a full circle.
fn sweep_on_tape(arc: &PlaneArc, start: [f64; 2], end: [f64; 2], center: [f64; 2]) -> f64 {
    if start == end {
        return 360.0;
    }
    let angle =
        |point: [f64; 2]| libm::atan2(point[1] - center[1], point[0] - center[0]).to_degrees();
    let turned = angle(end) - angle(start);
    let turned = if arc.counterclockwise { turned } else { -turned };
    if turned <= 0.0 { turned + 360.0 } else { turned }
}

/// The center that the rounded words give, and the last digit they are written to;
/// `None` where there is none.
fn center_on_tape(
    control: &Control,
    arc: &PlaneArc,
    start: [f64; 2],
    end: [f64; 2],
) -> Result<Option<([f64; 2], f64)>> {
    let addresses = &control.tables.addresses;
    let form = control.commons.read(loc::CIRCLE_CENTER);
    if form == CircleCenter::Radius {
        let letter = control.letter(loc::CIRCLE_RADIUS_ADDRESS, "the radius")?;
        let Some(format) = addresses.format(letter) else { return Ok(None) };
        let radius = format.unscale(format.scale(arc.radius)?);
        let center = center_of_radius(arc, start, end, radius);
        return Ok(center.map(|center| (center, format.unscale(1))));
    }
    let mut center = [0.0; 2];
    let mut digit: f64 = 0.0;
    for (index, number) in arc.plane.axes().into_iter().enumerate() {
        let Some(position) = addresses.required(IJK[number])? else { return Ok(None) };
        let format = &addresses.slot(position).format;
        let rounded = |value: f64| format.scale(value).map(|scaled| format.unscale(scaled));
        let offset = arc.center[index] - start[index];
        center[index] = match form {
            CircleCenter::AbsoluteCenter => {
                let moved = control.tables.axis(number).translation();
                rounded(arc.center[index] + moved)? - moved
            }
            _ => start[index] + rounded(offset)?,
        };
        digit = digit.max(format.unscale(1));
    }
    Ok(Some((center, digit)))
}

/// The center at a radius from start and end, on the side that the sweep asks for;
/// `None` where the two are the same or too far apart.
fn center_of_radius(
    arc: &PlaneArc,
    start: [f64; 2],
    end: [f64; 2],
    radius: f64,
) -> Option<[f64; 2]> {
    let half = distance(start, end) / 2.0;
    let height = radius * radius - half * half;
    if half == 0.0 || height < 0.0 {
        return None;
    }
    let (across, along) = ([start[1] - end[1], end[0] - start[0]], 2.0 * half);
    let left = arc.counterclockwise == (arc.sweep <= 180.0);
    let height = if left { height.sqrt() } else { -height.sqrt() };
    Some([0, 1].map(|axis| (start[axis] + end[axis]) / 2.0 + across[axis] / along * height))
}

/// Where the tape stands along X, Y and Z at the start of an arc, mm or inch; `None`
/// when it does not stand where the arc begins: the control counts from there.
#[inline]
pub fn start_on_tape(control: &Control, from: &Position) -> Option<[f64; 3]> {
    let mut stands = [0.0; 3];
    for (number, stand) in stands.iter_mut().enumerate() {
        let axis = control.tables.axis(number);
        *stand = match control.last_value(axis.letter) {
            _ if axis.is_off() => from[number],
            Some(last) => axis.position(last),
            None => return None,
        };
        // What lies off by more than rounding is another position.
        let off = (*stand - from[number]).abs() > 0.51 * axis.resolution();
        if off
            || (!control.repeat.words.is_empty() && control.repeat.words.contains_key(&axis.letter))
        {
            return None;
        }
    }
    Some(stands)
}

/// Writes the block of an arc.
///
/// # Errors
/// A code the machine lacks, a value that does not fit, no feed.
pub fn write(control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
    motion::ready_for_arc(control, arc.plane)?;
    let as_ccw = arc.counterclockwise == codes_by_the_right_hand(control, arc.plane);
    let code = if as_ccw { loc::CIRCLE_CCW_CODE } else { loc::CIRCLE_CW_CODE };
    let code = control.code(code, "an arc")?;
    let modal = control.commons.read(loc::CIRCLE_MODAL);
    let change =
        control.commons.read(loc::CIRCLE_CUTCOM_PLANE) == CircleCutcomPlane::ChangeThePlane;
    control.because(arc.cause, |control| modes::plane_of_arc(control, arc.plane, change))?;
    motion::motion_code(control, code, modal, arc.cause);
    let end = Motion::new(arc.to, AxisSet::LINEAR, arc.word);
    end_words(control, arc, &end)?;
    control.because(arc.cause, |control| {
        center_words(control, arc)?;
        helix_word(control, arc)
    })?;
    if control.commons.read(loc::CIRCLE_PRINT_FEED) {
        control.state.doubt(F);
    }
    motion::feed_words(control, feed)?;
    let [first, second] = arc.plane.axes();
    motion::write_turning(control, AxisSet::of(first).or(AxisSet::of(second)))?;
    control.last_arc = control.tape.count;
    Ok(())
}

/// True when the machine's code for counterclockwise arcs turns by the right-hand rule
/// in this plane: from X to Y, from Z to X, from Y to Z.
fn codes_by_the_right_hand(control: &Control, plane: Plane) -> bool {
    let commons = &control.commons;
    match plane {
        Plane::Xy => commons.read(loc::CIRCLE_CCW_XY),
        Plane::Zx => !commons.read(loc::CIRCLE_CCW_XZ),
        Plane::Yz => commons.read(loc::CIRCLE_CCW_YZ),
    }
}

/// Adds the axes of the plane, all or those that change, and the third where it does.
fn end_words(control: &mut Control, arc: &PlaneArc, end: &Motion) -> Result<()> {
    if control.commons.read(loc::CIRCLE_AXES_MODAL) {
        motion::axis_words(control, end)?;
        return Ok(());
    }
    for number in arc.plane.axes() {
        motion::axis_word(control, number, end)?;
    }
    motion::axis_words(control, &end.of(AxisSet::of(arc.plane.normal())))?;
    Ok(())
}

/// Takes the radius word out of a block right behind an arc of the same radius.
fn drop_same_radius(control: &mut Control, letter: Letter) {
    let follows_an_arc = control.last_arc != 0 && control.last_arc == control.tape.count;
    let Some(position) = control.tables.addresses.position(letter) else { return };
    let format = &control.tables.addresses.slot(position).format;
    let radius = control.block.scaled_at(position).map(|scaled| format.unscale(scaled));
    if follows_an_arc && radius.is_some_and(|radius| control.has_value(letter, radius)) {
        control.block.take_word(position);
    }
}

/// Adds how far a helix rises, where ARCSLP asks for it.
fn helix_word(control: &mut Control, arc: &PlaneArc) -> Result<()> {
    let along = arc.plane.normal();
    let rise = control.tables.axis(along).length(arc.to[along] - arc.from[along]);
    let prints = control.commons.read(loc::CIRCLE_HELIX_WORD) == CircleHelixWord::PrintK;
    if !control.helix_words || !prints || rise == 0.0 {
        return Ok(());
    }
    let a_radian = rise / arc.sweep.to_radians();
    let value = match control.commons.read(loc::CIRCLE_HELIX_OUTPUT) {
        CircleHelixOutput::RisePerRadian => a_radian.abs(),
        CircleHelixOutput::RisePerRadianSigned => a_radian,
        CircleHelixOutput::RisePerTurn => a_radian.abs() * std::f64::consts::TAU,
    };
    control.require_letter(IJK[along])?;
    control.word_rounded(IJK[along], value, Rounding::Rate)
}

/// Adds I J K of the plane, or the radius: negative above 180 degrees.
fn center_words(control: &mut Control, arc: &PlaneArc) -> Result<()> {
    let form = control.commons.read(loc::CIRCLE_CENTER);
    if form == CircleCenter::Radius {
        let letter = control.letter(loc::CIRCLE_RADIUS_ADDRESS, "the radius")?;
        let radius = if arc.sweep > 180.0 + 1e-6 { -arc.radius } else { arc.radius };
        control.word(letter, radius)?;
        if control.commons.read(loc::CIRCLE_RADIUS_MODAL) {
            drop_same_radius(control, letter);
        }
        return Ok(());
    }
    let starts = arc.start.into_iter().zip(arc.center);
    for (number, (start, center)) in arc.plane.axes().into_iter().zip(starts) {
        let value = match form {
            CircleCenter::CenterToStartSigned => start - center,
            CircleCenter::AbsoluteCenter => center + control.tables.axis(number).translation(),
            CircleCenter::StartToCenterUnsigned => (center - start).abs(),
            CircleCenter::StartToCenterSigned | CircleCenter::Radius => center - start,
        };
        control.word(IJK[number], value)?;
    }
    Ok(())
}
