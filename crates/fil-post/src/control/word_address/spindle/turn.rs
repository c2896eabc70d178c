//! Whether the spindle turns, and which way: as the tape says it, else as the CL file does.

use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::{Control, Function};
use crate::control_state::{Rotation, modal};
use crate::errors::PostCode;
use crate::operation::SpindleTurn;

/// What is said of what cuts behind STOP or OPSTOP with nothing between that turns the spindle.
pub const BEHIND_STOP: &str =
    "after STOP or OPSTOP, which stop the spindle on some machines; start it again with SPINDL";

/// The spindle turns, or it is not known to stand.
pub fn may_turn(control: &Control) -> bool {
    match control.state.rotation() {
        Rotation::Standing => waits(control),
        Rotation::Unsaid => control.spindle.turning.is_some(),
        _ => true,
    }
}

/// A block that waits for a motion turns it.
pub fn waits(control: &Control) -> bool {
    control.waiting.has(Function::Spindle)
}

/// The spindle is known to stand, and nothing that waits for a motion turns it.
pub fn stands(control: &Control) -> bool {
    control.state.rotation() == Rotation::Standing && !waits(control)
}

/// A tool change may have stopped the spindle, and nothing that waits for a motion turns it.
pub fn may_stand_behind_change(control: &Control) -> bool {
    control.state.tool_is_changed_since_turned() && !waits(control)
}

/// A stop of the program may have stopped the spindle, as some machines do, and nothing that
/// waits for a motion turns it.
pub fn may_stand_behind_stop(control: &Control) -> bool {
    control.state.may_be(modal::SPINDLE_HALTED, true) && may_turn(control) && !waits(control)
}

/// Why a spindle that does not turn is none for a thread or a tap.
pub fn why_it_stands<'a>(control: &Control, usual: &'a str) -> &'a str {
    match control.spindle.side_turns {
        true => {
            "threads and taps of the sub-spindle are not supported, and the main spindle is stopped"
        }
        false => usual,
    }
}

/// The spindle turns clockwise: as the tape says it, else as the CL file does.
pub fn clockwise(control: &Control) -> Option<bool> {
    match control.state.rotation() {
        Rotation::Clockwise => Some(true),
        Rotation::Counterclockwise => Some(false),
        Rotation::Unsaid => control.spindle.turning,
        Rotation::InDoubt | Rotation::Standing => None,
    }
}

/// The same for the next motion, with what waits for it.
pub fn clockwise_in_motion(control: &Control) -> Option<bool> {
    if waits(control) { control.spindle.turning } else { clockwise(control) }
}

/// Which way a record turns the spindle, and keeps it: SPINDL/ON turns it as it turned before.
/// `None` for the code of a SPINDL that names no direction.
pub fn take_turn(control: &mut Control, turn: &SpindleTurn) -> Option<bool> {
    let said = turn.clockwise.or(control.spindle.turned.filter(|_| turn.speed.is_none()));
    control.spindle.turned = said.or_else(|| usual_turn(control));
    said
}

/// Whether the code of a SPINDL that names no direction turns the spindle clockwise.
fn usual_turn(control: &Control) -> Option<bool> {
    let code = control.code_if_any(loc::SPINDLE_DEFAULT_CODE).filter(|_| !control.spindle.is_side);
    let turns = [loc::SPINDLE_CW_CODE, loc::SPINDLE_CCW_CODE]
        .map(|at| code.is_some() && control.code_if_any(at) == code);
    match turns {
        [true, _] => Some(true),
        [_, true] => Some(false),
        // A live tool and a second spindle have no code of their own for it.
        _ => (!super::is_main(control)).then_some(true),
    }
}

/// Refuses a speed without a direction while the spindle turns the other way than the usual
/// code: it would turn back in the cut, and a tap of a left-hand thread would become another.
///
/// # Errors
/// It turns so.
pub fn refuse_turning_back(control: &Control, turn: &SpindleTurn) -> Result<()> {
    let usual = usual_turn(control);
    let now = clockwise_in_motion(control).filter(|_| !may_stand_behind_change(control));
    let turns_back = turn.clockwise.is_none() && turn.speed.is_some();
    if !turns_back || now.is_none() || usual.is_none() || now == usual {
        return Ok(());
    }
    let way = if now == Some(true) { "clockwise" } else { "counterclockwise" };
    PostCode::WordForm.err_with(
        format!(
            "SPINDL with a speed and no direction while the spindle turns {way}: the usual \
             direction (spindle.default_code) would turn it back"
        ),
        "Write CLW or CCLW.",
    )
}
