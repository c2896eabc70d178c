//! Work offsets: cycle 247 takes a row of the table of presets.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::locations as loc;

use super::line::{self, Line};
use crate::control::Control;
use crate::control::word_address::fixture;
use crate::control_state::{Source, WorkOffset, modal};
use crate::errors::PostCode;

/// The last row of the table of presets that a number can name.
const LAST: i64 = 9999;

/// The cycle that takes a preset.
const PRESET: FunctionCode = FunctionCode::whole(247);

/// Takes a row of the table of presets. Where the axes stand in another one is not known.
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
    let offset = WorkOffset { code: PRESET, number: i32::try_from(row).ok() };
    fixture::counts_anew(control, control.state.get(modal::WORK_OFFSET) == Some(offset));
    control.state.set(modal::WORK_OFFSET, offset);
    control.state.set(modal::ASKED_OFFSET, offset);
    // Which hole the next M99 would drill is not counted on.
    control.state.forget(modal::CYCLE_CODE, Source::Post);
    Ok(())
}
