//! `TRANS X10 Y0 Z0`: the zero of the control, shifted from that of the work offset.

use fil_diag::Result;
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self as loc, ControlFamily, ControlTranslation};
use fil_machine::rounding::Rounding;

use crate::block::named;
use crate::control::word_address::fixture;
use crate::control::{Control, line};

/// True for a machine whose control shifts its zero in place of the points.
pub fn is_of_control(control: &Control) -> bool {
    control.tables.family == ControlFamily::Sinumerik
        && control.commons.read(loc::CONTROL_TRANSLATION) == ControlTranslation::Trans
}

/// Shifts the zero by X, Y and Z, or takes the shift back. The points that the post counts in
/// stay what they are: each axis counts from the new zero. They are said again all the same.
///
/// # Errors
/// Cutter compensation; a length that the axis words can't say exactly: each point would be
/// off by the rest.
pub fn write(control: &mut Control, by: [f64; 3]) -> Result<()> {
    control.begin()?;
    control.require_unit()?;
    fixture::prepare(control)?;
    let mut text = "TRANS".to_string();
    for (number, by) in by.into_iter().enumerate().filter(|_| by != [0.0; 3]) {
        let letter = control.tables.axis(number).letter;
        control.require_letter(letter)?;
        let format = control.tables.addresses.format(letter).copied().unwrap_or_default();
        let scaled =
            Rounding::ExactLength.scale(by, &format).map_err(|diag| named(diag, letter))?;
        let value = line::scaled_text(control, letter, scaled).unwrap_or_default();
        let name = match control.commons.int_opt(loc::CONTROL_AXIS_INDEX) {
            Some(index) => format!("{letter}{index}="),
            None => letter.to_string(),
        };
        text.push_str(&format!(" {name}{value}"));
    }
    super::put_text(control, &text)?;
    count_from(control, by)?;
    control.state.doubt_axes();
    Ok(())
}

/// What the tape said last is said from the new zero.
fn count_from(control: &mut Control, zero: [f64; 3]) -> Result<()> {
    let before = control.tables.zero();
    control.tables.set_zero(zero);
    control.refresh()?;
    for (number, (from, to)) in before.into_iter().zip(zero).enumerate() {
        let letter = control.tables.axis(number).letter;
        let last = control.commons.last_output(letter);
        if last != EMPTY {
            control.commons.set_last_output(letter, last + from - to);
        }
    }
    Ok(())
}
