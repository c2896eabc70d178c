//! Cutter compensation: its plane, its side, its offset.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::letters::T;
use fil_machine::locations::{self as loc, Placement, ToolFormat};
use fil_machine::modes::Plane;

use super::modes;
use crate::control::length_plane::usual_plane;
use crate::control::{Control, Function, length_plane};
use crate::control_state::modal::{self, Know};
use crate::control_state::{Compensation, Length, Source};
use crate::errors::PostCode;
use crate::operation::CutterCompensation;

/// Puts the compensation code, and the offset number when it is switched on, with
/// the next motion in its plane or in a block of their own.
///
/// # Errors
/// A code the machine lacks; an offset where no tool and no number gives one.
pub fn write(control: &mut Control, wanted: CutterCompensation) -> Result<()> {
    let at = match wanted.side {
        Compensation::Left => loc::CUTCOM_LEFT_CODE,
        Compensation::Right => loc::CUTCOM_RIGHT_CODE,
        Compensation::Off => loc::CUTCOM_OFF_CODE,
    };
    if control.tables.mills() {
        plane_of_live_tool(control, wanted)?;
    } else if let Some((plane, word)) = wanted.plane {
        control.block.cause.word = word;
        refuse_plane_of_no_lathe(control, plane)?;
        length_plane::refuse_compensation(control, plane)?;
        modes::plane_of_its_own(control, plane)?;
    } else if wanted.side != Compensation::Off {
        let usual = usual_plane(control);
        length_plane::refuse_compensation(control, usual)?;
        modes::plane_of_its_own(control, usual)?;
    }
    let code = control.code(at, "cutter compensation")?;
    control.block.cause.word = wanted.side_word;
    control.g(code);
    let takes_offset = !control.can().cutting_edges;
    if wanted.side != Compensation::Off && takes_offset {
        offset_word(control, wanted.offset)?;
    }
    control.asked = wanted.side;
    let with_motion = control.commons.read(loc::CUTCOM_WITH_MOTION);
    let placement = if with_motion { Placement::NextXyBlock } else { Placement::BlockOfItsOwn };
    control.place_block(Function::Compensation, placement)?;
    control.comes_with_motion_of(Function::Compensation, axes_of_plane(control));
    if control.commons.read(loc::LATHE_DIAMETER) && !control.tables.mills() {
        // Its plane is that of X and Z, and no motion leaves it.
        control.comes_with_any_motion(Function::Compensation);
    }
    Ok(())
}

/// The axes of the plane in force, in polar interpolation those of the face.
fn axes_of_plane(control: &Control) -> AxisSet {
    let said =
        if control.tables.is_polar() { Some(Plane::Xy) } else { control.state.get(modal::PLANE) };
    let [first, second] = said.unwrap_or_else(|| usual_plane(control)).axes();
    AxisSet::of(first).or(AxisSet::of(second))
}

/// Refuses a plane of Y on a lathe that has none: its tool goes by X and Z alone.
fn refuse_plane_of_no_lathe(control: &Control, plane: Plane) -> Result<()> {
    let has_y = !control.tables.transforms && !control.tables.axis(1).is_off();
    if has_y || plane == Plane::Zx || !control.commons.read(loc::LATHE_DIAMETER) {
        return Ok(());
    }
    let mut diag = PostCode::WordForm.diag("CUTCOM: a plane of Y, and this lathe turns without Y");
    diag.hint = Some(
        "Leave the plane out, or write ZXPLAN: the nose of a turning tool is compensated in X and Z."
            .into(),
    );
    Err(diag)
}

/// The plane of a live tool: in polar interpolation that of X and C, which no code says;
/// else it must be said.
///
/// # Errors
/// Another plane in polar interpolation; none outside of it.
fn plane_of_live_tool(control: &mut Control, wanted: CutterCompensation) -> Result<()> {
    if control.tables.is_unrolled() && wanted.side != Compensation::Off {
        return PostCode::MillTurn.err("CUTCOM under TRACYL");
    }
    match wanted.plane {
        Some((plane, _)) if control.tables.is_polar() && plane != Plane::Xy => {
            PostCode::MillTurn.err("CUTCOM: polar interpolation has the plane XYPLAN")
        }
        Some((plane, word)) if !control.tables.is_polar() => {
            control.block.cause.word = word;
            length_plane::refuse_compensation(control, plane)?;
            modes::plane_of_its_own(control, plane)
        }
        None if !control.tables.is_polar() && wanted.side != Compensation::Off => {
            PostCode::MillTurn.err("CUTCOM of a live tool needs its plane (XYPLAN, YZPLAN, ZXPLAN)")
        }
        _ => Ok(()),
    }
}

/// The nose of a turning tool is in the offset that its T word has called: a number in
/// the record must be the same, and no word is written.
///
/// # Errors
/// Another offset, or one that is not known.
fn nose(control: &Control, given: Option<(f64, u16)>) -> Result<()> {
    let Some((offset, _)) = given else { return Ok(()) };
    let called = control.last_value(T).map(|word| word.rem_euclid(OFFSETS as f64));
    if called == Some(offset) {
        return Ok(());
    }
    let called = called.map_or("not known".to_string(), |called| format!("{called}"));
    let mut diag = PostCode::WordForm
        .diag(format!("CUTCOM: offset {offset}, and that of the T word in force is {called}"));
    diag.hint = Some("The nose radius is in the offset of the T word; leave the number out, or give LOADTL the same OSETNO.".into());
    Err(diag)
}

/// The offset that a control without a word takes another radius than: it takes that of the tool
/// in the spindle, and on a lathe the nose belongs to the offset that LOADTL has called.
fn unlike_tool(control: &Control, given: Option<(f64, u16)>) -> Option<(f64, u16)> {
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    let called = control.state.get(modal::TOOL_OFFSET).filter(|_| is_lathe);
    let wanted = given.or_else(|| called.map(|offset| (offset as f64, 0)))?;
    let of_tool = control.state.get(modal::TOOL).is_some_and(|tool| tool as f64 == wanted.0);
    Some(wanted).filter(|_| !(is_lathe && of_tool))
}

/// The tool in the spindle: behind an author's block that may have changed it that of LOADTL.
///
/// # Errors
/// The doubt of that, by its level.
fn tool_in_spindle(control: &mut Control) -> Result<Option<i64>> {
    // A change that can be read leaves none to guess.
    let is_changed = control.state.length() == Length::OfAnotherTool
        || control.state.get(modal::NAMED_TOOL).is_some();
    let loaded = control.tools.loaded.filter(|_| !is_changed);
    match (control.state.groups().know(modal::TOOL), loaded) {
        (Know::Unknown(Source::Author), Some(tool)) => {
            let diag = PostCode::AuthorChange.diag(format!(
                "a foreign block may have changed tool {tool}, whose offset CUTCOM takes"
            ));
            control.doubt(Source::Author, diag, "taken to be that tool")?;
            Ok(loaded)
        }
        (known, _) => Ok(known.value()),
    }
}

/// Adds the offset: that of the record, else the number of the tool.
fn offset_word(control: &mut Control, given: Option<(f64, u16)>) -> Result<()> {
    if control.commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode {
        return nose(control, given);
    }
    let from_tool = control.commons.read(loc::TOOL_DIAMETER_FROM_TOOL);
    let given = if from_tool { given } else { unlike_tool(control, given) };
    let of_tool = match given {
        None if from_tool => tool_in_spindle(control)?.map(|tool| (tool as f64, 0)),
        _ => None,
    };
    let Some((offset, word)) = given.or(of_tool) else {
        if from_tool {
            let message = "CUTCOM: no offset number, and the tool in the spindle is not known";
            return Err(Box::new(PostCode::WordForm.diag(message).hint(
                "put LOADTL / n before it, or write CUTCOM / LEFT, n; where the control takes the \
                 tool in the spindle, set tool.diameter_from_tool to 0",
            )));
        }
        if !control.commons.read(loc::LATHE_DIAMETER) {
            let message = "CUTCOM: no offset number, and none is taken from the tool";
            control.warnings.add(PostCode::NoDiameterOffset, message.into());
        }
        return Ok(());
    };
    let Some(letter) = control.commons.read(loc::CUTCOM_ADDRESS) else {
        return PostCode::NoCode.err("the machine has no letter for the offset (cutcom.address)");
    };
    if given.is_some() {
        control.require_letter(letter)?;
    }
    control.block.cause.word = word;
    control.word(letter, offset)
}

/// How many offsets the second half of T0303 can name.
pub(super) const OFFSETS: i64 = 100;
