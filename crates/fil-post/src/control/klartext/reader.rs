//! The small reader of lines that others put on the tape. It is made to say "I can't"
//! rather than guess; then all is unknown.

use fil_machine::{FunctionCode, Letter, letters};

use crate::control::Control;
use crate::control_state::{Compensation, CutterPath, Rotation, Source, TOOL_CHANGE, modal};

/// What an M function does to what the post counts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Auxiliary {
    /// Nothing: spindle, coolant, stops, functions of the machine.
    Harmless,
    /// It ends the program.
    End,
    /// F is a feed a minute from here on.
    PerMinute,
    /// F is a feed a turn of the spindle from here on.
    PerTurn,
    /// It changes how motions, feeds or cycles are meant.
    Changes,
}

/// What the number of an M function means. From 89 on lie those of the control that
/// change how it moves.
pub fn meaning(number: f64) -> Auxiliary {
    match number as i64 {
        2 | 30 => Auxiliary::End,
        136 => Auxiliary::PerTurn,
        137 => Auxiliary::PerMinute,
        0..89 if number.fract() == 0.0 => Auxiliary::Harmless,
        _ => Auxiliary::Changes,
    }
}

/// Learns from a line of others.
pub fn learn(control: &mut Control, text: &str) {
    let mut line = text.trim();
    line = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    let code = line.split(';').next().unwrap_or("").trim();
    if code.is_empty() || code.starts_with('*') {
        return;
    }
    let upper = code.to_ascii_uppercase();
    let items: Vec<&str> = upper.split_whitespace().collect();
    match items[..] {
        ["BLK", "FORM", ..] | ["TOOL", "DEF", ..] => {}
        ["STOP", ref rest @ ..] => {
            control.state.set(modal::SPINDLE_HALTED, true);
            motion(control, rest);
        }
        ["END", "PGM", ..] => {
            control.klartext.ended = true;
            control.state.set(modal::PROGRAM_END, true);
        }
        ["TOOL", "CALL", ref rest @ ..] if !rest.is_empty() && rest.iter().all(says_speed) => {
            control.state.doubt(letters::S);
        }
        ["TOOL", "CALL", ..] => {
            control.state.forget(modal::TOOL, Source::Author);
            control.state.set(modal::TOOL_CHANGED, true);
            // The control changes the tool with the spindle standing.
            control.state.set(modal::SPINDLE, Rotation::Standing);
            tool_change_moves(control);
            control.state.doubt(letters::S);
        }
        ["CYCL", "DEF", number, ..] if !frames(number) => {
            control.state.forget(modal::CYCLE_CODE, Source::Author)
        }
        ["CYCL", "DEF", number, ..] => {
            control.state.forget(modal::CYCLE_CODE, Source::Author);
            match shifts(number) {
                true => control.state.shift_axes(),
                false => control.state.lose_axes(),
            }
        }
        ["CYCL", "CALL", ..] => control.state.lose_axes(),
        // A parameter gets a value, and no mode and no axis is touched.
        ["FN", number, name, "=", ..] if is_assignment(number) && is_parameter(name) => {}
        [name, "=", ..] if is_parameter(name) => {}
        // The tool goes along its axis to the end of the travel.
        ["M140", "MB", "MAX"] | ["L", "M140", "MB", "MAX"] => {
            control.state.doubt_axes();
            control.state.clears(control.tables.axis(2).letter);
        }
        ["L", ref rest @ ..] => motion(control, rest),
        [first, ..] if first.starts_with('M') => motion(control, &items),
        _ => forget(control),
    }
}

/// A word of TOOL CALL that leaves tool and length: the tool axis, or a speed.
fn says_speed(word: &&str) -> bool {
    matches!(*word, "X" | "Y" | "Z")
        || word.strip_prefix('S').is_some_and(|speed| speed.parse::<f64>().is_ok())
}

/// Cycles that move the frame: datum shift, mirror, rotation, scaling, plane.
fn frames(number: &str) -> bool {
    let number = number.split('.').next().unwrap_or("");
    !matches!(
        number,
        "9" | "32"
            | "200"
            | "201"
            | "202"
            | "203"
            | "204"
            | "205"
            | "206"
            | "207"
            | "208"
            | "209"
            | "240"
            | "241"
    )
}

/// Cycles that move the zero alone: datum shift and preset.
fn shifts(number: &str) -> bool {
    matches!(number.split('.').next(), Some("7" | "247"))
}

/// FN 0 to FN 8: arithmetic of parameters.
fn is_assignment(number: &str) -> bool {
    let number = number.trim_end_matches(':').parse::<u32>();
    number.is_ok_and(|number| number <= 8)
}

/// Q, QL or QR with a number below those that the control and its cycles keep for themselves.
fn is_parameter(name: &str) -> bool {
    const OF_OTHERS: u32 = 100;
    let digits = ["QL", "QR", "Q"].iter().find_map(|letter| name.strip_prefix(letter));
    digits.and_then(|digits| digits.parse::<u32>().ok()).is_some_and(|n| n < OF_OTHERS)
}

/// The items of an L line or of one that has only functions.
fn motion(control: &mut Control, items: &[&str]) {
    let of_machine = items.iter().any(|item| matches!(*item, "M91" | "M92"));
    for item in items {
        match *item {
            "FMAX" => {}
            "R0" => side(control, Compensation::Off),
            "RL" => side(control, Compensation::Left),
            "RR" => side(control, Compensation::Right),
            _ => word(control, item, of_machine),
        }
    }
}

fn side(control: &mut Control, side: Compensation) {
    control.state.set(modal::CUTTER_COMP, side);
    let path = match side {
        Compensation::Off => CutterPath::Unmoved,
        _ => CutterPath::Moved,
    };
    control.state.set(modal::CUTTER_PATH, path);
}

fn word(control: &mut Control, item: &str, of_machine: bool) {
    let mut rest = item.chars();
    let first = rest.next();
    let number = rest.as_str().parse::<f64>();
    match (first, number) {
        (Some('M'), Ok(number)) => match meaning(number) {
            Auxiliary::Harmless => learn_function(control, number),
            Auxiliary::End => control.state.set(modal::PROGRAM_END, true),
            Auxiliary::PerMinute => {
                control.state.set(modal::FEED_MODE, fil_machine::modes::FeedMode::PerMinute);
            }
            Auxiliary::PerTurn => {
                control.state.set(modal::FEED_MODE, fil_machine::modes::FeedMode::PerRevolution);
                control.state.doubt(letters::F);
            }
            // In the frame of the machine for this line only, and a call of the cycle.
            Auxiliary::Changes if matches!(number as i64, 91 | 92) => control.state.doubt_axes(),
            Auxiliary::Changes if number as i64 == 99 => control.state.lose_axes(),
            Auxiliary::Changes => forget(control),
        },
        (Some('F'), Ok(_)) => control.state.doubt(letters::F),
        (Some(axis @ ('X' | 'Y' | 'Z' | 'A' | 'B' | 'C' | 'U' | 'V' | 'W')), Ok(value)) => {
            control.state.doubt_axes();
            match Letter::of_character(axis) {
                Some(letter) if of_machine => control.state.clears(letter),
                Some(letter) => control.state.stand(letter, value),
                None => {}
            }
        }
        (Some('I'), _) if rest.as_str().len() > 1 => control.state.lose_axes(),
        _ => forget(control),
    }
}

/// Learns from an M function which way the spindle turns, with coolant or without.
pub fn learn_turning(control: &mut Control, number: f64) {
    match number as i64 {
        3 | 13 => control.klartext.clockwise = Some(true),
        4 | 14 => control.klartext.clockwise = Some(false),
        _ => {}
    }
}

/// Learns what a function of others does to the spindle and the program.
fn learn_function(control: &mut Control, number: f64) {
    let Some(code) = FunctionCode::of_value(number) else { return };
    learn_turning(control, number);
    control.state.learn_auxiliary(code, &control.codes, Source::Author);
    if code == TOOL_CHANGE {
        tool_change_moves(control);
    }
    // With the coolant.
    let rotation = match number as i64 {
        13 => Rotation::Clockwise,
        14 => Rotation::Counterclockwise,
        _ => return,
    };
    control.state.turns(rotation);
}

/// A tool change may have moved all axes.
fn tool_change_moves(control: &mut Control) {
    for number in control.tables.present().numbers() {
        control.state.tool_change_moves(control.tables.axis(number).letter);
    }
}

/// Nothing is known any more but what no line can change.
fn forget(control: &mut Control) {
    let (unit, plane) = (control.state.get(modal::UNITS), control.state.get(modal::PLANE));
    control.state.doubt_all(Source::Author);
    control.klartext.clockwise = None;
    control.state.set_if_known(modal::UNITS, unit, Source::Author);
    control.state.set_if_known(modal::PLANE, plane, Source::Author);
    control.state.set(modal::DISTANCE, crate::control_state::Distance::Absolute);
    control.state.set(modal::CYCLE, false);
}
