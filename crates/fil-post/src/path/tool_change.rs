//! A tool change with the way to the machine's change position.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations::{self as loc, ToolChangeBlock};

use super::rapid;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control::word_address::motion::Motion;
use crate::control::word_address::tool;
use crate::operation::ToolChange;

/// Goes to the change position and changes the tool.
///
/// # Errors
/// As [`tool::prepare`], [`family::change_tool`] and a rapid motion.
pub fn change(control: &mut Control, wanted: ToolChange) -> Result<()> {
    if !tool::prepare(control, &wanted)? {
        return Ok(());
    }
    control.tape.align();
    let cause = wanted.causes[0].whole();
    control.because(cause, |control| go_to_change_position(control, cause))?;
    family::change_tool(control, wanted)
}

/// Goes to the machine's change position before the change (INTCOM 1872,
/// DBLCOM 604–609); coordinates that are absent stay where they are.
fn go_to_change_position(control: &mut Control, cause: Cause) -> Result<()> {
    let axes = match control.commons.read(loc::TOOL_CHANGE_BLOCK) {
        ToolChangeBlock::None => return Ok(()),
        ToolChangeBlock::Xyz => &loc::CHANGE_POSITION[..3],
        ToolChangeBlock::XyzAndRotary => &loc::CHANGE_POSITION[..],
    };
    let mut position = Position::default();
    let mut moving = AxisSet::NONE;
    for (common, location) in axes.iter().enumerate() {
        let Some(value) = control.commons.dbl_opt(*location) else { continue };
        if let Some(number) = control.tables.axis_of_common(common) {
            position[number] = value;
            moving = moving.or(AxisSet::of(number));
        }
    }
    rapid::to_machine_position(control, &Motion { position, axes: moving, word: 0 }, cause)
}
