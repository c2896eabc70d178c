//! Leads along an axis whose output is scaled: a turn of the spindle is none of the lengths
//! that the scale changes, so nobody can say which lead the control would cut.

use fil_diag::Result;

use crate::control::Control;
use crate::errors::PostCode;

/// Refuses a tap or a thread by this code, along axes of which one is scaled.
///
/// # Errors
/// The output scale of one of these axes is neither 1 nor -1, nor that of diameters.
pub fn refuse(control: &Control, along: &[usize], code: PostCode) -> Result<()> {
    let axes = along.iter().map(|number| control.tables.axis(*number));
    let Some(axis) = axes.into_iter().find(|axis| !axis.keeps_lengths()) else { return Ok(()) };
    let (letter, scale) = (axis.letter, axis.scale());
    let diag = code.diag(format!("a lead along {letter}, whose output is scaled by {scale}"));
    Err(Box::new(diag.hint("The lead is per revolution of the spindle, which is not scaled.")))
}
