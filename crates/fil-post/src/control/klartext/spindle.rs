//! The spindle: its speed in TOOL CALL, its direction by M3 and M4.

use fil_diag::Result;
use fil_machine::locations as loc;

use super::tool;
use crate::control::Control;
use crate::control::word_address::spindle as words;
use crate::errors::PostCode;
use crate::operation::{Spindle, SpindleSpeed, SpindleTurn};

/// Writes the spindle's words.
///
/// # Errors
/// A surface speed or a limit of the speed; and as [`tool::speed`].
pub fn write(control: &mut Control, spindle: Spindle) -> Result<()> {
    match spindle {
        Spindle::Turn(turn) => start(control, turn),
        Spindle::Limit(_) => PostCode::Family.err("SPINDL/MAXRPM on a mill"),
        Spindle::Side(_) | Spindle::Counted(_) => PostCode::Family.err("SPINDL/SIDE on a mill"),
        other => words::write(control, other),
    }
}

fn start(control: &mut Control, turn: SpindleTurn) -> Result<()> {
    control.begin()?;
    let [speed_word, direction_word] = turn.words;
    control.block.cause.word = speed_word;
    if let Some(speed) = turn.speed {
        if !control.commons.read(loc::SPINDLE_DIRECT_RPM) {
            return PostCode::Family.err("S as a code (spindle.direct_rpm): TOOL CALL takes rpm");
        }
        if !matches!(speed, SpindleSpeed::Revolutions(_)) {
            return PostCode::Family.err("SPINDL with a surface speed on a mill");
        }
        let by_speed = !turn.in_named_range && control.commons.read(loc::SPINDLE_AUTO_RANGE);
        if let (SpindleSpeed::Revolutions(speed), true) = (speed, by_speed) {
            words::take_range_of(control, speed)?;
        }
        control.spindle.speed = Some(speed);
        let value = words::value_of(control, speed);
        tool::speed(control, value)?;
    }
    control.block.cause.word = direction_word;
    words::refuse_turning_back(control, &turn)?;
    let said = words::take_turn(control, &turn);
    control.spindle.turning = control.spindle.turned;
    control.klartext.clockwise = Some(control.spindle.turned.unwrap_or(true));
    let direction = match said {
        Some(true) => loc::SPINDLE_CW_CODE,
        Some(false) => loc::SPINDLE_CCW_CODE,
        None => loc::SPINDLE_DEFAULT_CODE,
    };
    words::place(control, direction, "the spindle")
}
