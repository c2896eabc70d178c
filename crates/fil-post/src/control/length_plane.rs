//! The plane in which the length of a tool acts along the tool.
//!
//! A SINUMERIK counts the lengths of a tool along the axes of the plane in force: the first one of
//! a milling tool acts along Z in G17 and along Y in G18 (Siemens, Programming Manual
//! Fundamentals). Other controls take the axis from the plane in which G43 stands where a parameter
//! says so (Fanuc, 5001 TLB).

use fil_diag::Result;
use fil_machine::letters::G;
use fil_machine::locations::{self as loc, ToolFormat};
use fil_machine::modes::Plane;
use fil_machine::{FunctionCode, Letter};

use super::Control;
use crate::cause::Cause;
use crate::control_state::{Meaning, modal};
use crate::errors::PostCode;
use crate::operation::Operation;

/// Directions are one where the cosine between them is less than this below 1.
const PARALLEL: f64 = 1e-9;

/// The plane that every motion needs; `None` where lengths do not hang on it.
pub fn of_motions(control: &Control) -> Option<Plane> {
    let hangs = control.can().lengths_by_plane && !control.commons.read(loc::TOOL_LENGTH_CONST);
    hangs.then(|| of_tool(control))
}

/// The plane square to which the tool lies where its heads stand at zero: that of turning on a lathe,
/// of the face in polar interpolation.
fn of_tool(control: &Control) -> Plane {
    if control.tables.is_polar() {
        return Plane::Xy;
    }
    if control.commons.read(loc::LATHE_DIAMETER) {
        return Plane::Zx;
    }
    let tool = control.tables.chain().tool;
    let lies_along = |plane: &Plane| tool[plane.normal()].abs() >= 1.0 - PARALLEL;
    Plane::ALL.into_iter().find(lies_along).unwrap_or_else(|| usual_plane(control))
}

/// True where a motion would be made in another plane than it needs, or may be.
#[inline(always)]
pub fn is_left(control: &Control) -> bool {
    control.can().lengths_by_plane
        && of_motions(control).is_some_and(|plane| may_be_another(control, plane))
}

/// True where another plane is in force, or may be: behind a text that can't be read. What a program
/// begins in is the matter of the machine, which says its plane or leaves it to the control.
pub fn may_be_another(control: &Control, plane: Plane) -> bool {
    match control.state.get(modal::PLANE) {
        Some(now) => now != plane,
        None => control.commons.read(loc::CIRCLE_PLANE).is_some(),
    }
}

/// True where arcs, cycles and cutter compensation may choose a plane.
pub fn may_be(control: &Control, plane: Plane) -> bool {
    of_motions(control).is_none_or(|must| must == plane)
}

/// True for the plane of an arc or a cycle that what comes next does not keep, where lengths do not
/// hang on it.
pub fn is_of_one_motion(control: &Control, plane: Plane) -> bool {
    control.can().lengths_by_plane
        && of_motions(control).is_none()
        && !control.tables.is_polar()
        && !control.is_compensated()
        && plane != usual_plane(control)
}

/// Refuses cutter compensation in a plane in which the lengths of the tool act along other axes.
///
/// # Errors
/// It is one.
pub fn refuse_compensation(control: &Control, plane: Plane) -> Result<()> {
    if may_be(control, plane) {
        return Ok(());
    }
    PostCode::CompensationAcross.err_with(
        "CUTCOM in a plane in which this control applies the tool length offset along another axis",
        "Leave the plane out, compensate in the CAM system, or set tool.length_const if the control applies lengths the same way in every plane (SD42940).",
    )
}

/// Refuses REPEAT of a plane, whose motions would be made in it.
///
/// # Errors
/// It repeats one in which the lengths of the tool act along other axes.
pub fn refuse_repeated(control: &Control, operation: &Operation) -> Result<()> {
    let Operation::Repeat(words) = operation else { return Ok(()) };
    let Some(must) = of_motions(control) else { return Ok(()) };
    let is_other = |code| matches!(control.meaning(code), Meaning::Plane(plane) if plane != must);
    let says_other = |(letter, value, _): &(Letter, f64, Cause)| {
        *letter == G && FunctionCode::of_value(*value).is_some_and(is_other)
    };
    if words.iter().any(says_other) {
        return PostCode::Family.err(
            "REPEAT of a plane in which the control applies the tool length offset along another axis",
        );
    }
    Ok(())
}

/// The plane in which a mill whose tool lies along Z takes up lengths by a function; `None` for other
/// machines.
pub fn of_length(control: &Control) -> Option<Plane> {
    let is_mill = control.can().length_functions
        && !control.commons.read(loc::LATHE_DIAMETER)
        && control.commons.read(loc::TOOL_FORMAT) == ToolFormat::TWordAndChangeCode
        && control.code_if_any(loc::TOOL_LENGTH_CODE).is_some();
    let along_z = control.tables.chain().tool.z.abs() >= 1.0 - PARALLEL;
    (is_mill && along_z).then_some(Plane::Xy)
}

/// The plane a machine works in: ZX on a lathe, else the one its program starts in, else XY.
pub fn usual_plane(control: &Control) -> Plane {
    if control.commons.read(loc::LATHE_DIAMETER) {
        return Plane::Zx;
    }
    let start = crate::control::program::state_at_start(&control.commons, None);
    start.get(modal::PLANE).unwrap_or(Plane::Xy)
}
