//! Cutter compensation: its plane, its side, its offset.

use fil_diag::Result;
use fil_machine::locations::{self as loc, Placement};
use fil_machine::modes::Plane;

use super::modes;
use crate::control::{Control, Function};
use crate::control_state::Compensation;
use crate::errors::PostCode;
use crate::operation::CutterCompensation;

/// Puts the compensation code, and the offset number when it is switched on, with
/// the next motion of X or Y or in a block of their own.
///
/// # Errors
/// A code the machine lacks; an offset where no tool and no number gives one.
pub fn write(control: &mut Control, wanted: CutterCompensation) -> Result<()> {
    let at = match wanted.side {
        Compensation::Left => loc::CUTCOM_LEFT_CODE,
        Compensation::Right => loc::CUTCOM_RIGHT_CODE,
        Compensation::Off => loc::CUTCOM_OFF_CODE,
    };
    if let Some((plane, word)) = wanted.plane {
        control.block.cause.word = word;
        modes::plane_of_its_own(control, plane)?;
    } else if wanted.side != Compensation::Off {
        let usual = usual_plane(control);
        modes::plane_of_its_own(control, usual)?;
    }
    let code = control.code(at, "cutter compensation")?;
    control.block.cause.word = wanted.side_word;
    control.g(code);
    if wanted.side != Compensation::Off {
        offset_word(control, wanted.offset)?;
    }
    control.asked = wanted.side;
    let with_motion = control.commons.read(loc::CUTCOM_WITH_MOTION);
    let placement = if with_motion { Placement::NextXyBlock } else { Placement::BlockOfItsOwn };
    control.place_block(Function::Compensation, placement)
}

/// The plane a machine works in: the one its program starts in, else XY.
fn usual_plane(control: &Control) -> Plane {
    let start = crate::control::program::state_at_start(&control.commons, None);
    start.plane.unwrap_or(Plane::Xy)
}

/// Adds the offset: that of the record, else the number of the tool.
fn offset_word(control: &mut Control, given: Option<(f64, u16)>) -> Result<()> {
    let from_tool = control.commons.read(loc::TOOL_DIAMETER_FROM_TOOL);
    let of_tool = control.state.tool.filter(|_| from_tool).map(|tool| (tool as f64, 0));
    let Some((offset, word)) = given.or(of_tool) else {
        if from_tool {
            return PostCode::WordForm
                .err("CUTCOM: no offset number, and the tool in the spindle is not known");
        }
        return Ok(());
    };
    let letter = control.letter(loc::CUTCOM_ADDRESS, "the offset's address")?;
    if given.is_some() {
        control.require_letter(letter)?;
    }
    control.block.cause.word = word;
    control.word(letter, offset)
}
