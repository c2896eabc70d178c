//! The small reader of lines that others put on the tape. It is made to say "I can't"
//! rather than guess; then all is unknown.

use fil_machine::modes::FeedMode;
use fil_machine::{FunctionCode, Letter, letters};

use crate::control::Control;
use crate::control_state::{
    Compensation, CutterPath, Distance, Effect, ForeignBlock, MachineSpot, Rotation, Source,
    TOOL_CHANGE, modal,
};

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

/// Reads a line of others.
pub fn read(text: &str) -> ForeignBlock {
    let mut block = ForeignBlock::default();
    let mut line = text.trim();
    line = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    let code = line.split(';').next().unwrap_or("").trim();
    if code.is_empty() || code.starts_with('*') {
        return block;
    }
    let upper = code.to_ascii_uppercase();
    let items: Vec<&str> = upper.split_whitespace().collect();
    block.items = items.iter().map(|item| item.to_string()).collect();
    let forgets_cycle = Effect::Forget(modal::CYCLE_CODE.group);
    match items[..] {
        ["BLK", "FORM", ..] | ["TOOL", "DEF", ..] => {}
        ["STOP", ref rest @ ..] => {
            block.effects.push(Effect::set(modal::SPINDLE_HALTED, true));
            motion(&mut block, rest);
        }
        ["END", "PGM", ..] => {
            block.effects.extend([Effect::EndsProgramText, Effect::set(modal::PROGRAM_END, true)])
        }
        ["TOOL", "CALL", ref rest @ ..] if !rest.is_empty() && rest.iter().all(says_speed) => {
            block.effects.push(Effect::Doubt(letters::S));
        }
        ["TOOL", "CALL", ..] => block.effects.extend([
            Effect::Forget(modal::TOOL.group),
            Effect::set(modal::TOOL_CHANGED, true),
            // The control changes the tool with the spindle standing.
            Effect::set(modal::SPINDLE, Rotation::Standing),
            Effect::ToolChangeMoves,
            Effect::Doubt(letters::S),
        ]),
        ["CYCL", "DEF", number, ..] if !frames(number) => block.effects.push(forgets_cycle),
        ["CYCL", "DEF", number, ..] => {
            let moved = if shifts(number) { Effect::ShiftAxes } else { Effect::LoseAxes };
            block.effects.extend([forgets_cycle, moved, Effect::Forget(modal::WORK_OFFSET.group)]);
        }
        ["CYCL", "CALL", ..] => block.effects.push(Effect::LoseAxes),
        // A parameter gets a value, and no mode and no axis is touched.
        ["FN", number, name, "=", ..] if is_assignment(number) && is_parameter(name) => {}
        [name, "=", ..] if is_parameter(name) => {}
        // The tool goes along its axis to the end of the travel.
        ["M140", "MB", "MAX"] | ["L", "M140", "MB", "MAX"] => {
            block.effects.extend([Effect::DoubtAxes, Effect::Clears(letters::XYZ[2], None)]);
        }
        ["L", ref rest @ ..] => motion(&mut block, rest),
        [first, ..] if first.starts_with('M') => motion(&mut block, &items),
        _ => block.cannot_read(code),
    }
    block
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

/// The frame in which the positions of a line count, where it is not that of the part.
#[derive(Clone, Copy)]
enum MachineFrame {
    /// Machine coordinates (M91).
    OfTheMachine,
    /// From a point that the builder of the machine has chosen (M92).
    OfTheBuilder,
}

impl MachineFrame {
    fn of(item: &str) -> Option<Self> {
        match item {
            "M91" => Some(MachineFrame::OfTheMachine),
            "M92" => Some(MachineFrame::OfTheBuilder),
            _ => None,
        }
    }
}

/// The items of an L line or of one that has only functions.
fn motion(block: &mut ForeignBlock, items: &[&str]) {
    let frame = items.iter().find_map(|item| MachineFrame::of(item));
    for item in items {
        match *item {
            "FMAX" => {}
            "R0" => side(block, Compensation::Off),
            "RL" => side(block, Compensation::Left),
            "RR" => side(block, Compensation::Right),
            _ => word(block, item, frame),
        }
    }
}

fn side(block: &mut ForeignBlock, side: Compensation) {
    let path = match side {
        Compensation::Off => CutterPath::Unmoved,
        _ => CutterPath::Moved,
    };
    block
        .effects
        .extend([Effect::set(modal::CUTTER_COMP, side), Effect::set(modal::CUTTER_PATH, path)]);
}

fn word(block: &mut ForeignBlock, item: &str, frame: Option<MachineFrame>) {
    let mut rest = item.chars();
    let first = rest.next();
    let number = rest.as_str().parse::<f64>();
    let effects = &mut block.effects;
    match (first, number) {
        (Some('M'), Ok(number)) => match meaning(number) {
            Auxiliary::Harmless => effects.push(Effect::Auxiliary(number)),
            Auxiliary::End => effects.push(Effect::set(modal::PROGRAM_END, true)),
            Auxiliary::PerMinute => {
                effects.push(Effect::set(modal::FEED_MODE, FeedMode::PerMinute));
            }
            Auxiliary::PerTurn => effects.extend([
                Effect::set(modal::FEED_MODE, FeedMode::PerRevolution),
                Effect::Doubt(letters::F),
            ]),
            // In the frame of the machine for this line only, and a call of the cycle.
            Auxiliary::Changes if matches!(number as i64, 91 | 92) => {
                effects.push(Effect::DoubtAxes);
            }
            Auxiliary::Changes if number as i64 == 99 => effects.push(Effect::LoseAxes),
            Auxiliary::Changes => block.cannot_read(item),
        },
        (Some('F'), Ok(_)) => effects.push(Effect::Doubt(letters::F)),
        (Some(axis @ ('X' | 'Y' | 'Z' | 'A' | 'B' | 'C' | 'U' | 'V' | 'W')), Ok(value)) => {
            effects.push(Effect::DoubtAxes);
            effects.extend(Letter::of_character(axis).map(|letter| match frame {
                Some(MachineFrame::OfTheMachine) => {
                    Effect::Clears(letter, Some(MachineSpot::At(value)))
                }
                Some(MachineFrame::OfTheBuilder) => Effect::Clears(letter, None),
                None => Effect::Stands(letter, value),
            }));
        }
        (Some('I'), _) if rest.as_str().len() > 1 => effects.push(Effect::LoseAxes),
        _ => block.cannot_read(item),
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
pub fn learn_function(control: &mut Control, number: f64) {
    let Some(code) = FunctionCode::of_value(number) else { return };
    learn_turning(control, number);
    control.state.learn_auxiliary(code, &control.codes, Source::Author, |_| None);
    if code == TOOL_CHANGE {
        control.tool_change_moves();
    }
    // With the coolant.
    let rotation = match number as i64 {
        13 => Rotation::Clockwise,
        14 => Rotation::Counterclockwise,
        _ => return,
    };
    control.state.turns(rotation);
}

/// END PGM stands on the tape.
pub fn ends_program_text(control: &mut Control) {
    control.klartext.ended = true;
}

/// Nothing is known any more but what no line can change.
pub fn forget(control: &mut Control) {
    let (unit, plane) = (control.state.get(modal::UNITS), control.state.get(modal::PLANE));
    control.state.doubt_all(Source::Author);
    control.klartext.clockwise = None;
    control.state.set_if_known(modal::UNITS, unit, Source::Author);
    control.state.set_if_known(modal::PLANE, plane, Source::Author);
    control.state.set(modal::DISTANCE, Distance::Absolute);
    control.state.set(modal::CYCLE, false);
}
