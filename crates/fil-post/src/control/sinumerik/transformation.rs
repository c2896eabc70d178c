//! Faces and cylinders of live tools: TRANSMIT, TRACYL, TRAFOOF, and SETMS before them.
//!
//! Whether X is a diameter in a transformation depends on the machine data, so DIAMOF makes it a
//! radius there.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::{program, put_text};
use crate::control::{Control, line};

/// Begins TRANSMIT: X and Y are a plane of lengths, and the control turns the spindle.
///
/// # Errors
/// As a line on the tape.
pub fn transmit(control: &mut Control) -> Result<()> {
    count_radii(control)?;
    put_text(control, "TRANSMIT")
}

/// Begins TRACYL: Y is the way around a cylinder. Gives the radius that the block says.
///
/// # Errors
/// A diameter that X can't hold.
pub fn tracyl(control: &mut Control, radius: f64) -> Result<f64> {
    let letter = control.tables.axis(0).letter;
    let (text, diameter) = line::length(control, letter, 2.0 * radius)?;
    count_radii(control)?;
    put_text(control, &format!("TRACYL({text})"))?;
    Ok(diameter / 2.0)
}

/// Ends either.
///
/// # Errors
/// As a line on the tape.
pub fn end(control: &mut Control) -> Result<()> {
    put_text(control, "TRAFOOF")?;
    program::say_diameters(control)
}

/// Makes the spindle of the live tool the master spindle, whose S and M have no number, or the
/// main spindle again; a machine that says no number does it with its M code.
///
/// # Errors
/// As a line on the tape.
pub fn choose_master(control: &mut Control, of_live_tool: bool) -> Result<()> {
    match control.commons.int_opt(loc::MILL_TURN_LIVE_SPINDLE) {
        Some(number) if of_live_tool => put_text(control, &format!("SETMS({number})")),
        Some(_) => put_text(control, "SETMS"),
        None => Ok(()),
    }
}

/// Says what X is: a diameter, or a radius in a transformation.
///
/// # Errors
/// As a line on the tape.
pub fn say_what_x_is(control: &mut Control) -> Result<()> {
    let tables = &control.tables;
    match tables.transforms && (tables.is_polar() || tables.is_unrolled()) {
        true => count_radii(control),
        false => program::say_diameters(control),
    }
}

/// Makes X a radius, where it is a diameter.
///
/// # Errors
/// As a line on the tape.
pub fn count_radii(control: &mut Control) -> Result<()> {
    match control.commons.read(loc::LATHE_DIAMETER) {
        true => put_text(control, "DIAMOF"),
        false => Ok(()),
    }
}
