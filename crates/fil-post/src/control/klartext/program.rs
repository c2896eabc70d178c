//! BEGIN PGM and END PGM.

use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::modes::{Plane, Unit};

use super::line::{self, Line};
use crate::cause::Cause;
use crate::control::Control;
use crate::control::program::notes;
use crate::control_state::{Source, modal};
use crate::errors::PostCode;

/// Rotary axes take the shorter way.
const SHORTEST_PATH: &str = "M126";

/// They take the way of their numbers again.
pub const PATH_OF_NUMBERS: &str = "M127";

/// Longest name of a program.
const NAME: usize = 32;

/// The head: the name of the program and its unit, then the blocks of the machine.
///
/// # Errors
/// No unit: it stands in the first line. Macros that edit blocks.
pub fn start(control: &mut Control, blocks: &[String]) -> Result<()> {
    let style = &control.tables.style;
    if style.edits_words || style.edits_lines {
        return PostCode::Family.err("_OUTPTP and _MCDWT: lines of Klartext are not edited");
    }
    let unit = control.require_unit()?;
    control.state.set(modal::UNITS, unit);
    control.state.set(modal::PLANE, Plane::Xy);
    control.state.forget(modal::CUTTER_COMP, Source::Post);
    control.klartext.name = name(control);
    let cause = control.head.cause;
    let text = format!("BEGIN PGM {} {}", control.klartext.name, unit_text(unit));
    line::put(control, &Line::of_text(&text, cause))?;
    notes(control)?;
    blocks.iter().try_for_each(|block| control.write_text(block, true))?;
    shortest_path(control, SHORTEST_PATH)
}

/// Rotary axes take the shorter way to positions within a turn, or the way of their numbers.
///
/// # Errors
/// As a line of the tape.
pub fn shortest_path(control: &mut Control, code: &str) -> Result<()> {
    match control.tables.within_a_turn {
        true => line::put(control, &Line::of_text(code, Cause::default())),
        false => Ok(()),
    }
}

/// The last line.
///
/// # Errors
/// No unit.
pub fn end(control: &mut Control) -> Result<()> {
    if std::mem::replace(&mut control.klartext.ended, true) {
        return Ok(());
    }
    control.tape.skip = None;
    let unit = unit_text(control.require_unit()?);
    let text = format!("END PGM {} {unit}", control.klartext.name);
    line::put(control, &Line::of_text(&text, Cause::default()))
}

fn unit_text(unit: Unit) -> &'static str {
    match unit {
        Unit::Mm => "MM",
        Unit::Inch => "INCH",
    }
}

/// The machine's program number, else the PARTNO text in letters that a file name may
/// have, else its number, else 1.
fn name(control: &Control) -> String {
    if let Some(number) = control.commons.read(loc::PROGRAM_NUMBER) {
        return number.to_string();
    }
    let of_part = control.head.name.trim().chars();
    let letters = of_part.map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' });
    let name: String = letters.take(NAME).collect();
    if name.trim_matches('_').is_empty() { "1".to_string() } else { name }
}
