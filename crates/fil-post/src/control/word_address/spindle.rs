//! The spindle: speed, direction, range, limit, orientation.

pub mod counted;
mod limit;
mod range;
mod turn;

use fil_diag::Result;
use fil_machine::commons::EMPTY;
use fil_machine::letters::{P, S};
use fil_machine::locations::{self as loc, Placement};
use fil_machine::rounding::Rounding;
use fil_machine::setting::CodeAt;
use fil_machine::{FunctionCode, Letter};

use super::modes::{self, Own};
use crate::control::needs::Act;
use crate::control::{Control, Function};
use crate::control_state::{Rotation, modal};
use crate::errors::PostCode;
use crate::operation::{SideSpindle, Spindle, SpindleSpeed, SpindleTurn};
pub use limit::say_limit_again;
use limit::{limit_block, require_limit, warn_above_limit};
use range::{range_of, select_range, warn_of_limit, within_range};
pub(in crate::control) use range::{speed_in_range, take_range_of};
pub use turn::{
    BEHIND_STOP, clockwise, clockwise_in_motion, may_stand_behind_change, may_stand_behind_stop,
    may_turn, refuse_turning_back, stands, take_turn, waits, why_it_stands,
};

/// Meters of a foot.
const FOOT: f64 = 0.3048;

/// An angle of an oriented stop is rounded to this, degrees: finer ones come from the
/// arithmetic of a CAM system.
const SMALLEST_ANGLE: f64 = 1e-3;

/// Writes the spindle's words, in a block of their own or with a motion.
///
/// # Errors
/// A code the machine lacks, or a speed that does not fit.
pub fn write(control: &mut Control, spindle: Spindle) -> Result<()> {
    refuse_of_live_tool(control, &spindle)?;
    match spindle {
        Spindle::Off => off(control),
        Spindle::Orient(angle) => orient(control, angle),
        Spindle::Range(range) => {
            let index = range_of(control, range)?;
            select_range(control, index)
        }
        Spindle::Limit(limit) => {
            if !(limit.is_finite() && limit > 0.0) {
                return PostCode::WordForm.err(format!("SPINDL: a highest speed of {limit}"));
            }
            limit_block(control, limit)?;
            warn_of_limit(control, limit);
            warn_above_limit(control, control.spindle.speed);
            Ok(())
        }
        Spindle::Turn(turn) => start(control, turn),
        Spindle::Side(side) => side_spindle(control, side),
        Spindle::Counted(chosen) => counted::choose(control, chosen),
    }
}

/// Refuses what only a main spindle does, while it is an axis and the live tool turns.
fn refuse_of_live_tool(control: &Control, spindle: &Spindle) -> Result<()> {
    let what = match spindle {
        _ if !control.tables.mills() => return Ok(()),
        Spindle::Orient(_) => "SPINDL/ORIENT",
        Spindle::Range(_) => "SPINDL/RANGE",
        Spindle::Limit(_) => "SPINDL/MAXRPM",
        Spindle::Turn(SpindleTurn {
            speed: Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_)),
            ..
        }) => "a surface speed",
        _ => return Ok(()),
    };
    PostCode::MillTurn.err(format!("{what} of a live tool"))
}

/// The codes that turn the spindle clockwise and counterclockwise and stop it: those of the
/// live tool where the main spindle is an axis, those of the second spindle where it is counted.
fn codes(control: &Control) -> [CodeAt; 3] {
    match (control.tables.mills(), counted::has_own_codes(control)) {
        (true, _) => [
            loc::MILL_TURN_LIVE_CW_CODE,
            loc::MILL_TURN_LIVE_CCW_CODE,
            loc::MILL_TURN_LIVE_STOP_CODE,
        ],
        (_, true) => {
            [loc::SPINDLE_SIDE_CW_CODE, loc::SPINDLE_SIDE_CCW_CODE, loc::SPINDLE_SIDE_STOP_CODE]
        }
        _ => [loc::SPINDLE_CW_CODE, loc::SPINDLE_CCW_CODE, loc::SPINDLE_STOP_CODE],
    }
}

/// The settings of ranges, and the code of a spindle that nothing gives a direction, are those of
/// the main spindle.
fn is_main(control: &Control) -> bool {
    !control.tables.mills() && !control.spindle.is_side
}

/// S is a surface speed when the next motion is made, whoever has said it.
pub fn is_of_surface(control: &Control) -> bool {
    let asked =
        matches!(control.spindle.speed, Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_)));
    asked || control.state.is(modal::SURFACE_SPEED, true) && !waits(control)
}

/// Brings the control into the unit of the program: S counts meters or feet by it, and a text may
/// have changed it.
fn require_unit(control: &mut Control) -> Result<()> {
    let unit = control.require_unit()?;
    match control.state.is(modal::UNITS, unit) {
        true => Ok(()),
        false => modes::require(control, unit, Own::Nothing),
    }
}

/// Turns or stops the second spindle, in a block of its own.
fn side_spindle(control: &mut Control, side: SideSpindle) -> Result<()> {
    let at = match side.turn {
        None => loc::SPINDLE_SIDE_STOP_CODE,
        Some(true) => loc::SPINDLE_SIDE_CW_CODE,
        Some(false) => loc::SPINDLE_SIDE_CCW_CODE,
    };
    let code = control.code(at, "the sub-spindle")?;
    let of_surface =
        matches!(control.spindle.speed, Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_)));
    if side.speed.is_some() && of_surface {
        return PostCode::WordForm.err(
            "SPINDL/SIDE with a speed while the main spindle runs at constant surface speed, which the rpm code would end",
        );
    }
    control.flush_waiting()?;
    control.block.cause.word = side.words[0];
    if let Some(speed) = side.speed {
        if let Some(code) = code_of_turns(control) {
            control.g_of_record(code);
        }
        control.word(S, speed)?;
        control.spindle.speed = None;
    }
    control.block.cause.word = side.words[1];
    control.m(code);
    control.spindle.side_turns = side.turn.is_some();
    control.write_block()
}

/// Stops the spindle at once, after all that still waits for a motion.
fn off(control: &mut Control) -> Result<()> {
    control.flush_waiting()?;
    control.spindle.turning = None;
    let [.., stop] = codes(control);
    match control.code_if_any(stop) {
        Some(code) => turn_by(control, code)?,
        None => control.warn_no_code("SPINDL/OFF"),
    }
    control.write_block()
}

/// Adds the code that turns or stops the spindle, and the P that selects it.
fn turn_by(control: &mut Control, code: FunctionCode) -> Result<()> {
    control.m(code);
    select(control)
}

/// Adds the P that selects the spindle of the block, where the control has such.
fn select(control: &mut Control) -> Result<()> {
    let at = match control.tables.mills() {
        true => loc::MILL_TURN_LIVE_SELECT_NUMBER,
        false => loc::SPINDLE_SELECT_NUMBER,
    };
    let Some(number) = control.commons.int_opt(at) else { return Ok(()) };
    control.require_on_tape(P, "the number of the spindle")?;
    control.word_rounded(P, number.into(), Rounding::Exact)?;
    control.state.doubt(P);
    Ok(())
}

/// The letter of the speed: a live tool may have one of its own, which nothing else counts.
fn speed_letter(control: &Control) -> Letter {
    let own = control.commons.read(loc::MILL_TURN_LIVE_SPEED_ADDRESS);
    own.filter(|_| control.tables.mills()).unwrap_or(S)
}

/// Stops the spindle where the machine orients it. An angle has another address on each
/// control: S would be a speed to most.
///
/// # Errors
/// The machine has no address for an angle, or its format can't hold it.
fn orient(control: &mut Control, angle: Option<f64>) -> Result<()> {
    control.spindle.turning = None;
    let Some(angle) = angle else {
        return place(control, loc::SPINDLE_ORIENT_CODE, "SPINDL/ORIENT");
    };
    let Some(letter) = control.commons.read(loc::SPINDLE_ORIENT_ADDRESS) else {
        let message = format!("SPINDL: no address is known for the angle {angle}");
        let mut diag = PostCode::WordForm.diag(message);
        diag.hint = Some(
            "Name the letter with spindle.orient_address, or write the block of this control in \
             a FIL section for SPINDL."
                .into(),
        );
        return Err(diag);
    };
    let code = control.code(loc::SPINDLE_ORIENT_CODE, "SPINDL/ORIENT")?;
    control.flush_waiting()?;
    control.m(code);
    let angle = (angle / SMALLEST_ANGLE).round() * SMALLEST_ANGLE;
    control.word_rounded(letter, angle, Rounding::Exact)?;
    control.write_block()?;
    control.state.doubt(letter);
    Ok(())
}

fn start(control: &mut Control, turn: SpindleTurn) -> Result<()> {
    control.begin()?;
    let [speed_word, direction_word] = turn.words;
    if matches!(turn.speed, Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_))) {
        control.code(loc::SPINDLE_CSS_CODE, "constant surface speed")?;
        require_unit(control)?;
        require_limit(control)?;
    }
    control.block.cause.word = speed_word;
    if turn.speed.is_some() && !control.commons.read(loc::SPINDLE_DIRECT_RPM) {
        let mut diag = PostCode::NoCode.diag(
            "S of this machine is a code (spindle.direct_rpm), and no table of codes is known",
        );
        diag.hint = Some("Write S in a FIL section for SPINDL.".into());
        return Err(diag);
    }
    let by_speed =
        !turn.in_named_range && control.commons.read(loc::SPINDLE_AUTO_RANGE) && is_main(control);
    if let (Some(SpindleSpeed::Revolutions(speed)), true) = (turn.speed, by_speed) {
        take_range_of(control, speed)?;
    }
    refuse_speed_of_the_other(control, &turn)?;
    warn_above_limit(control, turn.speed.or(control.spindle.speed));
    match (turn.speed, control.spindle.speed) {
        (Some(speed), _) => speed_words(control, speed)?,
        // What S counts is not known, as behind blocks that may be skipped.
        (None, Some(speed)) if !counts_as(control, speed) => speed_words(control, speed)?,
        (None, Some(speed)) => word_of_speed(control, speed)?,
        (None, None) => refuse_without_speed(control)?,
    }
    control.block.cause.word = direction_word;
    refuse_clamped(control)?;
    refuse_turning_back(control, &turn)?;
    let said = take_turn(control, &turn);
    control.spindle.turning = control.spindle.turned;
    let [clockwise, counterclockwise, _] = codes(control);
    let direction = match (said, control.spindle.turning) {
        (Some(true), _) => clockwise,
        (Some(false), _) => counterclockwise,
        (None, Some(false)) if !is_main(control) => counterclockwise,
        (None, _) if !is_main(control) => clockwise,
        (None, _) => loc::SPINDLE_DEFAULT_CODE,
    };
    select(control)?;
    place(control, direction, "the spindle")
}

/// Refuses to turn a main spindle that is an axis under MODE/MILL while that axis is clamped.
fn refuse_clamped(control: &Control) -> Result<()> {
    let is_axis = control.tables.mill_turn.is_some() && !control.tables.mills();
    if is_axis { control.require(Act::ClampedMove) } else { Ok(()) }
}

/// Refuses SPINDL without a speed behind MODE or SIDE: S is that of the other spindle there, and
/// this one would turn by it.
fn refuse_speed_of_the_other(control: &Control, turn: &SpindleTurn) -> Result<()> {
    let unknown = turn.speed.is_none() && control.spindle.speed.is_none();
    if !unknown || control.commons.last_output(speed_letter(control)) == EMPTY {
        return Ok(());
    }
    if control.tables.mill_turn.is_some() {
        return PostCode::MillTurn.err(
            "SPINDL without a speed after MODE, where the last S belongs to the other spindle",
        );
    }
    if control.code_if_any(loc::SPINDLE_SIDE_CW_CODE).is_some() || counted::is_chosen(control) {
        return PostCode::WordForm
            .err("SPINDL without a speed after SIDE, where the last S belongs to the sub-spindle");
    }
    Ok(())
}

/// Refuses a spindle that is switched on before anything has said a speed: the control would
/// take whatever S it had. A machine without S turns it as fast as its operator has set it.
fn refuse_without_speed(control: &Control) -> Result<()> {
    let said = control.commons.last_output(S) != EMPTY || !control.state.has_last(S);
    if said || control.tables.addresses.required(S)?.is_none() {
        return Ok(());
    }
    let mut diag = PostCode::WordForm.diag("SPINDL: no speed is given, here or before");
    diag.hint = Some("Give the speed: SPINDL / RPM, 1000, CLW.".into());
    Err(diag)
}

/// Turns the spindle the other way, in a block of its own; says which way it turned.
///
/// # Errors
/// It does not turn, or nothing has said which way; the machine has no such code.
pub fn turn_back(control: &mut Control) -> Result<bool> {
    let Some(clockwise) = clockwise(control) else {
        return PostCode::CycleForm.err("a tap, and which way the spindle turns is not known");
    };
    turn_on(control, !clockwise)?;
    Ok(clockwise)
}

/// Stops the spindle in a hole, in a block of its own; says which way it turned.
///
/// # Errors
/// As [`turn_back`].
pub fn stand(control: &mut Control) -> Result<bool> {
    let Some(clockwise) = clockwise(control) else {
        return PostCode::CycleForm.err(
            "a bored hole that is left with the spindle stopped, while its direction is not known",
        );
    };
    let [.., stop] = codes(control);
    let code = control.code(stop, "the spindle that stands")?;
    turn_by(control, code)?;
    control.write_block()?;
    Ok(clockwise)
}

/// Turns the spindle with the speed that it had, in a block of its own.
///
/// # Errors
/// The machine has no such code.
pub fn turn_on(control: &mut Control, clockwise: bool) -> Result<()> {
    let [right, left, _] = codes(control);
    let at = if clockwise { right } else { left };
    let code = control.code(at, "the spindle turned again")?;
    turn_by(control, code)?;
    control.write_block()?;
    control.spindle.turning = Some(clockwise);
    Ok(())
}

/// S is known to count what a speed counts, turns or a way of the surface; on a control without
/// surface speeds nothing else.
fn counts_as(control: &Control, speed: SpindleSpeed) -> bool {
    let of_surface = !matches!(speed, SpindleSpeed::Revolutions(_));
    let is_open = control.code_if_any(loc::SPINDLE_CSS_CODE).is_some();
    !is_open || control.state.is(modal::SURFACE_SPEED, of_surface)
}

/// Adds S, and on a lathe the code for revolutions or surface speed.
fn speed_words(control: &mut Control, speed: SpindleSpeed) -> Result<()> {
    let code = match speed {
        SpindleSpeed::Revolutions(_) => code_of_turns(control),
        _ => Some(control.code(loc::SPINDLE_CSS_CODE, "constant surface speed")?),
    };
    if let Some(code) = code {
        control.g_of_record(code);
    }
    control.spindle.speed = Some(speed);
    let of_surface = !matches!(speed, SpindleSpeed::Revolutions(_));
    let letter = control.commons.read(loc::SPINDLE_MAX_ADDRESS).filter(|_| of_surface);
    if let (Some(letter), Some(limit)) = (letter, control.state.get(modal::SPEED_LIMIT)) {
        control.require_on_tape(letter, "the highest spindle speed")?;
        control.word_rounded(letter, limit, Rounding::Rate)?;
        control.state.doubt(letter);
    }
    word_of_speed(control, speed)
}

/// Adds the word of a speed.
fn word_of_speed(control: &mut Control, speed: SpindleSpeed) -> Result<()> {
    let value = value_of(control, speed);
    let letter = speed_letter(control);
    control.word_rounded(letter, value, Rounding::of(S))?;
    if letter != S {
        control.state.doubt(letter);
    }
    Ok(())
}

/// The code that makes S turns a minute. Fanuc's controls take none in polar interpolation (its
/// manual names the functions that may be specified there), where S counts them already.
fn code_of_turns(control: &Control) -> Option<FunctionCode> {
    let is_said = control.tables.is_polar() && !control.tables.transforms && counts_turns(control);
    control.code_if_any(loc::SPINDLE_RPM_CODE).filter(|_| !is_said)
}

/// S is known to count turns a minute.
pub fn counts_turns(control: &Control) -> bool {
    control.state.is(modal::SURFACE_SPEED, false)
}

/// What S says: turns a minute within the range, or a surface speed, which counts meters
/// a minute in a metric program and feet in one in inches.
pub(crate) fn value_of(control: &mut Control, speed: SpindleSpeed) -> f64 {
    match speed {
        SpindleSpeed::Revolutions(asked) => within_range(control, asked),
        SpindleSpeed::Meters(asked) | SpindleSpeed::Feet(asked) => {
            surface_in_unit(speed, control.is_metric()).unwrap_or(asked)
        }
    }
}

/// A surface speed in meters a minute of a metric program, or in feet; `None` for turns.
pub(super) fn surface_in_unit(speed: SpindleSpeed, metric: bool) -> Option<f64> {
    match (speed, metric) {
        (SpindleSpeed::Revolutions(_), _) => None,
        (SpindleSpeed::Meters(value), true) | (SpindleSpeed::Feet(value), false) => Some(value),
        (SpindleSpeed::Feet(value), true) => Some(value * FOOT),
        (SpindleSpeed::Meters(value), false) => Some(value / FOOT),
    }
}

/// The rpm of a constant surface speed at a radius, mm or inch, limited by `limit` or by the speed
/// limit in force. `None` on the spindle axis without a limit, and for a speed in rpm.
pub fn turns_at(
    control: &Control,
    turn: &SpindleTurn,
    limit: Option<f64>,
    radius: f64,
) -> Option<f64> {
    let metric = control.is_metric();
    let speed = surface_in_unit(turn.speed?, metric)?;
    let of_machine = control.commons.dbl_opt(loc::SPINDLE_CSS_LIMIT);
    let limit = limit.or(control.state.get(modal::SPEED_LIMIT)).or(of_machine);
    let in_unit = if metric { 1000.0 } else { 12.0 };
    let turns = speed * in_unit / (2.0 * std::f64::consts::PI * radius.abs());
    let turns = turns.min(limit.unwrap_or(f64::INFINITY));
    turns.is_finite().then(|| speed_in_range(control, turns))
}

/// Adds the M code and writes or keeps the block; a machine without the code
/// turns its spindle by other means.
pub(in crate::control) fn place(control: &mut Control, at: CodeAt, what: &str) -> Result<()> {
    match control.code_if_any(at) {
        Some(code) => control.m(code),
        None => {
            control.warn_no_code(what);
            control.state.set(modal::SPINDLE, Rotation::Unsaid);
        }
    }
    let placement = match control.codes.speeds_are_feeds() && !control.block.g_codes().is_empty() {
        // The code of the feed in the motion's block is one of the same group.
        true => Placement::BlockOfItsOwn,
        false => control.commons.read(loc::SPINDLE_PLACEMENT),
    };
    control.place_block(Function::Spindle, placement)
}
