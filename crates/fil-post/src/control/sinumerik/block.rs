//! Blocks of words as the language spells them: `X10`, `X1=10`, `CR=5`, `I=AC(10)`,
//! `M1=3`, `T="5"`.

use fil_diag::Result;
use fil_machine::address::no_address;
use fil_machine::letters::{G, IJK, M, S, T, XYZ};
use fil_machine::locations::{self as loc, CircleCenter, ControlMachineFrame, ControlToolCall};
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter};

use super::tool_names;
use crate::block::{function, named};
use crate::cause::Cause;
use crate::control::line::Line;
use crate::control::{Control, full_turn, vectors};

/// A word with its cause.
type CausedWord = (Letter, f64, Cause);

/// The block counts in the frame of the machine.
const IN_MACHINE: FunctionCode = FunctionCode::whole(53);

/// Names of the parts of the tool's direction.
const VECTOR: [&str; 3] = ["A3", "B3", "C3"];

/// Codes of M that are those of a spindle.
const OF_SPINDLE: [fil_machine::setting::CodeAt; 5] = [
    loc::SPINDLE_CW_CODE,
    loc::SPINDLE_CCW_CODE,
    loc::SPINDLE_STOP_CODE,
    loc::SPINDLE_DEFAULT_CODE,
    loc::SPINDLE_ORIENT_CODE,
];

/// Puts the block under construction on the tape.
///
/// # Errors
/// A function that its address can't write; a line longer than the control reads.
pub fn write(control: &mut Control) -> Result<()> {
    super::check_unit(control)?;
    let addresses = &control.tables.addresses;
    if !control.block.prints(addresses) {
        return Ok(());
    }
    control.block.check_functions(addresses)?;
    let words = control.block.words(addresses);
    put(control, &words)
}

/// Puts words on the tape in their order.
///
/// # Errors
/// The machine has no such address; a value that does not fit.
pub fn put(control: &mut Control, words: &[CausedWord]) -> Result<()> {
    let mut line = Line::default();
    let mut last = Vec::with_capacity(words.len());
    for &(letter, value, cause) in words {
        let (text, value) = word(control, letter, value)?;
        line.item(letter.byte(), &text, cause);
        last.push((letter, value));
    }
    last.into_iter().for_each(|(letter, value)| control.commons.set_last_output(letter, value));
    control.tape.items(&line.text, &line.items, true, &control.tables, &mut control.commons)
}

/// A word as the tape spells it, and the value that it then has.
fn word(control: &Control, letter: Letter, value: f64) -> Result<(String, f64)> {
    let addresses = &control.tables.addresses;
    let position = addresses.position(letter).ok_or_else(|| no_address(letter))?;
    let slot = addresses.slot(position);
    let mut digits = Vec::new();
    if matches!(letter, G | M) {
        let code = function(letter, value)?;
        code.check(letter, &slot.format)?;
        code.write(&slot.format, &mut digits);
        let name = char::from(slot.character);
        return Ok((
            spell_function(control, letter, code, name, &String::from_utf8_lossy(&digits)),
            code.value(),
        ));
    }
    if letter == T && tool_names::are_called(control) {
        let scaled = Rounding::Exact.scale(value, &slot.format).map_err(|diag| named(diag, T))?;
        let value = slot.format.unscale(scaled);
        let name = control.sinumerik.tool_names.of(value as i64)?;
        return Ok((format!("{}=\"{name}\"", char::from(slot.character)), value));
    }
    let names = letter.byte() == b'P' && slot.format.decimals == 0;
    let rounding = if names { Rounding::Exact } else { Rounding::of(letter) };
    let scaled = rounding.scale(value, &slot.format).map_err(|diag| named(diag, letter))?;
    slot.format.write(scaled, &mut digits);
    let name = char::from(slot.character);
    Ok((
        spell(control, letter, name, &String::from_utf8_lossy(&digits)),
        slot.format.unscale(scaled),
    ))
}

fn spell_function(
    control: &Control,
    letter: Letter,
    code: FunctionCode,
    name: char,
    digits: &str,
) -> String {
    if letter == G
        && code == IN_MACHINE
        && control.commons.read(loc::CONTROL_MACHINE_FRAME) == ControlMachineFrame::Supa
    {
        return "SUPA".to_string();
    }
    let of_spindle = || OF_SPINDLE.iter().any(|at| control.code_if_any(*at) == Some(code));
    match control.commons.int_opt(loc::CONTROL_SPINDLE_INDEX) {
        Some(index) if letter == M && of_spindle() => format!("{name}{index}={digits}"),
        _ => format!("{name}{digits}"),
    }
}

fn spell(control: &Control, letter: Letter, name: char, digits: &str) -> String {
    let commons = &control.commons;
    if commons.read(loc::CIRCLE_RADIUS_ADDRESS) == Some(letter) {
        return format!("CR={digits}");
    }
    if letter == T && commons.read(loc::CONTROL_TOOL_CALL) == ControlToolCall::NumberAsAName {
        return format!("{name}=\"{digits}\"");
    }
    let part = IJK.iter().position(|own| *own == letter);
    if let Some(part) = part.filter(|_| vectors::are_in_force(control)) {
        return format!("{}={digits}", VECTOR[part]);
    }
    let absolute = commons.read(loc::CIRCLE_CENTER) == CircleCenter::AbsoluteCenter;
    if absolute && IJK.contains(&letter) {
        return format!("{name}=AC({digits})");
    }
    let index = match letter {
        S => commons.int_opt(loc::CONTROL_SPINDLE_INDEX),
        _ if XYZ.contains(&letter) => commons.int_opt(loc::CONTROL_AXIS_INDEX),
        _ if rotary(control, letter).is_some() => commons.int_opt(loc::CONTROL_ROTARY_INDEX),
        _ => None,
    };
    let rotary = rotary(control, letter).filter(|_| control.tables.within_a_turn);
    let way = rotary.and_then(|number| full_turn::spelled(control, number, digits));
    match (index, way) {
        (Some(index), Some(way)) => format!("{name}{index}={way}"),
        (None, Some(way)) => format!("{name}={way}"),
        (Some(index), None) => format!("{name}{index}={digits}"),
        (None, None) => format!("{name}{digits}"),
    }
}

/// The number of the rotary axis of a letter.
fn rotary(control: &Control, letter: Letter) -> Option<usize> {
    let mut present = control.tables.present().numbers();
    present.find(|number| *number > 2 && control.tables.axis(*number).letter == letter)
}
