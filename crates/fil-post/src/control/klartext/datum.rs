//! Work offsets: cycle 247 takes a row of the table of presets.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::line::{self, Line};
use crate::control::Control;
use crate::control::word_address::fixture;
use crate::control_state::{Source, modal};
use crate::errors::PostCode;

/// The last row of the table of presets that a number can name.
const LAST: i64 = 9999;

/// Takes a row of the table of presets; no axis stands where it stood before.
///
/// # Errors
/// No number; a row that the table can't have; cutter compensation.
pub fn write(control: &mut Control, number: Option<i64>) -> Result<()> {
    let Some(number) = number else {
        return PostCode::Family
            .err("SET/OFSETL without a number: cycle 247 takes a row of the presets");
    };
    let row = number + i64::from(control.commons.int_opt(loc::FIXTURE_BASE).unwrap_or(0));
    if !(0..=LAST).contains(&row) {
        return PostCode::WordForm.err(format!("SET: the table of presets has no row {row}"));
    }
    fixture::prepare(control)?;
    let cause = control.block.cause;
    line::put(control, &Line::of_text("CYCL DEF 247 DATUM SETTING ~", cause))?;
    line::put_more(control, &format!("  Q339=+{row} ;DATUM NUMBER"), cause)?;
    control.state.shift_axes(Source::Post);
    // Which hole the next M99 would drill is not counted on.
    control.state.forget(modal::CYCLE_CODE, Source::Post);
    Ok(())
}
