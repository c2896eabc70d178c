//! How high the tool stands in the machine, whatever its program counts in: a way up to a level
//! of the machine never goes down.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::functions::WorkPlane;
use nalgebra::Point3;

use crate::control::Control;
use crate::control::machine_frame;
use crate::control::skip::refuse_level;
use crate::control_state::{Place, modal};
use crate::errors::PostCode;

/// Where X, Y and Z of the machine stand in the tilted frame in force; `None` where that is not
/// known.
pub(super) fn slides_in_frame(control: &Control) -> Option<Point3<f64>> {
    let (turn, angles) =
        control.tip.frame.filter(|_| control.state.is(modal::WORK_PLANE, WorkPlane::Tilted))?;
    if !rests(control, angles) {
        return None;
    }
    let [x, y, z] = [0, 1, 2].map(|number| control.stands(number));
    let point = turn * Point3::new(x?, y?, z?);
    Some(control.tables.chain().linear(point, angles))
}

/// Z of the machine, mm or inch; `None` where it is not known.
pub(super) fn machine_height(control: &Control) -> Option<f64> {
    if control.may_name_tip() {
        return slides(control).map(|slides| slides.z);
    }
    if control.may_be_tilted() {
        return slides_in_frame(control).map(|slides| slides.z);
    }
    control.stands(2)
}

/// X, Y and Z stand at these positions of the machine, and are said anew by the next motion.
///
/// # Errors
/// A position that its address can't hold.
pub(super) fn stand(control: &mut Control, slides: Point3<f64>) -> Result<()> {
    for number in AxisSet::LINEAR.and(control.tables.present()).numbers() {
        let axis = *control.tables.axis(number);
        control.state.stand(axis.letter, axis.value(slides[number])?);
    }
    Ok(())
}

/// True where the tool stands at a level of the machine's Z or above: no way up leads there. How
/// high it stands in the frame of the machine is not known.
///
/// # Errors
/// It may stand above, and it may not.
pub fn is_above(control: &Control, level: f64) -> Result<bool> {
    if machine_frame::is_meant(control) {
        return Ok(false);
    }
    if let Some(height) = machine_height(control) {
        return Ok(height >= level);
    }
    let counts_elsewhere = control.may_name_tip() || control.may_be_tilted();
    if counts_elsewhere && !control.tip.is_away {
        return unknown();
    }
    match control.place(2) {
        Place::Between(levels) if levels.low >= level && !levels.unknown => Ok(true),
        Place::Between(levels) if level < levels.high || levels.unknown => refuse_level(control, 2),
        _ => Ok(false),
    }
}

/// Refuses a way up that nobody asked for from where the tool stood above its level before it
/// counted from another zero.
///
/// # Errors
/// It did.
pub(super) fn refuse_shifted(control: &Control, level: f64) -> Result<()> {
    let was_above = matches!(control.place(2), Place::Shifted(stood) if stood >= level);
    if was_above && !machine_frame::is_meant(control) {
        return unknown();
    }
    Ok(())
}

fn unknown<T>() -> Result<T> {
    PostCode::Frame.err_with(
        "a retract to home.retract_z from an unknown machine Z: it may go down",
        "Bring the tool out by RAPID and GOTO before it, or put GOHOME or LOADTL there.",
    )
}

/// Where the tip stands in the part, and the rotary axes, as the tape says it; `None` where that
/// is not known.
pub(super) fn pose(control: &Control) -> Option<(Point3<f64>, [f64; 2])> {
    let mut position = Position::default();
    for number in control.tables.present().numbers() {
        let letter = control.tables.axis(number).letter;
        let said = control.axis_position(number).filter(|_| control.state.has_last(letter));
        let leans = control.tip.leans.filter(|_| number > 2).map(|leans| leans[number - 3]);
        // A word that could be a full turn is not said again where the axis stands.
        let stands = || control.stands(number).filter(|_| number > 2);
        position[number] = said.or(leans).or_else(stands)?;
    }
    let [x, y, z, first, second] = position;
    Some((Point3::new(x, y, z), [first, second]))
}

/// Where X, Y and Z of the machine stand under tool-tip control; `None` where that is not known.
pub(super) fn slides(control: &Control) -> Option<Point3<f64>> {
    pose(control).map(|(tip, angles)| control.tables.chain().linear(tip, angles))
}

/// The rotary axes stand at these angles, to their last digits, whoever has brought them there.
pub(super) fn rests(control: &Control, angles: [f64; 2]) -> bool {
    control.tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
        let (axis, angle) = (control.tables.axis(number), angles[number - 3]);
        let stands = control.stands(number);
        stands.is_some_and(|at| (axis.near(at, angle) - angle).abs() <= axis.resolution())
    })
}
