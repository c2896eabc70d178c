//! The head of a program: `%_N_NAME_MPF` and its folder.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ControlProgramHead};

use crate::control::Control;

/// Longest name of a program.
const NAME: usize = 24;

/// Writes the head, where the machine wants one.
///
/// # Errors
/// As a line on the tape.
pub fn head(control: &mut Control) -> Result<()> {
    let head = control.commons.read(loc::CONTROL_PROGRAM_HEAD);
    if head == ControlProgramHead::None {
        return Ok(());
    }
    let cause = control.head.cause;
    let line = format!("%_N_{}_MPF", name(control));
    control.because(cause, |control| control.put_line(&line, false))?;
    if head == ControlProgramHead::NameAndFolder {
        control.put_line(";$PATH=/_N_MPF_DIR", false)?;
    }
    Ok(())
}

/// Says that X is a diameter, on a lathe.
///
/// # Errors
/// As a line on the tape.
pub fn say_diameters(control: &mut Control) -> Result<()> {
    if !control.commons.read(loc::LATHE_DIAMETER) {
        return Ok(());
    }
    super::put_text(control, "DIAMON")
}

/// The number of the program where the machine fixes it, else the name of PARTNO in
/// letters, digits and underscores. A name begins with two letters.
fn name(control: &Control) -> String {
    let fixed = control.commons.read(loc::PROGRAM_NUMBER).map(i64::from);
    let of_part = control.head.name.trim().to_ascii_uppercase();
    let letters = of_part.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let name: String = letters.take(NAME).collect();
    if fixed.is_some() || name.trim_matches('_').is_empty() {
        return format!("MPF{}", fixed.or(control.head.number).unwrap_or(1));
    }
    let begins = name.chars().take(2).all(|c| c.is_ascii_alphabetic()) && name.len() > 1;
    if begins { name } else { format!("N_{name}").chars().take(NAME).collect() }
}
