//! The spindle: speed, direction, range, limit, orientation.

use fil_diag::Result;
use fil_machine::letters::S;
use fil_machine::locations as loc;
use fil_machine::setting::CodeAt;

use crate::control::{Control, Function};
use crate::errors::PostCode;
use crate::operation::{Spindle, SpindleSpeed, SpindleTurn};

const RANGE_CODES: [CodeAt; 6] = [
    loc::SPINDLE_RANGE1_CODE,
    loc::SPINDLE_RANGE2_CODE,
    loc::SPINDLE_RANGE3_CODE,
    loc::SPINDLE_RANGE4_CODE,
    loc::SPINDLE_RANGE5_CODE,
    loc::SPINDLE_RANGE6_CODE,
];

/// Meters of a foot.
const FOOT: f64 = 0.3048;

/// Writes the spindle's words, in a block of their own or with a motion.
///
/// # Errors
/// A code the machine lacks, or a speed that does not fit.
pub fn write(control: &mut Control, spindle: Spindle) -> Result<()> {
    match spindle {
        Spindle::Off => off(control),
        Spindle::Orient => place(control, loc::SPINDLE_ORIENT_CODE, "SPINDL/ORIENT"),
        Spindle::Range(range) => select_range(control, range),
        Spindle::Limit(limit) => {
            let code = control.code(loc::SPINDLE_MAX_CODE, "SPINDL/MAXRPM")?;
            control.g_of_record(code);
            control.word(S, limit)?;
            control.write_block()
        }
        Spindle::Turn(turn) => start(control, turn),
    }
}

/// Stops the spindle at once, after all that still waits for a motion.
fn off(control: &mut Control) -> Result<()> {
    control.flush_waiting()?;
    match control.code_if_any(loc::SPINDLE_STOP_CODE) {
        Some(code) => control.m(code),
        None => control.warn_no_code("SPINDL/OFF"),
    }
    control.write_block()
}

fn start(control: &mut Control, turn: SpindleTurn) -> Result<()> {
    control.begin()?;
    let [speed_word, direction_word] = turn.words;
    control.block.cause.word = speed_word;
    match (turn.speed, control.speed) {
        (Some(speed), _) => speed_words(control, speed)?,
        (None, Some(speed)) => {
            let value = value_of(control, speed);
            control.word(S, value)?;
        }
        (None, None) => {}
    }
    control.block.cause.word = direction_word;
    let direction = match turn.clockwise {
        Some(true) => loc::SPINDLE_CW_CODE,
        Some(false) => loc::SPINDLE_CCW_CODE,
        None => loc::SPINDLE_DEFAULT_CODE,
    };
    place(control, direction, "the spindle")
}

/// Adds S, and on a lathe the code for revolutions or surface speed.
fn speed_words(control: &mut Control, speed: SpindleSpeed) -> Result<()> {
    let code = match speed {
        SpindleSpeed::Revolutions(_) => control.code_if_any(loc::SPINDLE_RPM_CODE),
        _ => Some(control.code(loc::SPINDLE_CSS_CODE, "constant surface speed")?),
    };
    if let Some(code) = code {
        control.g_of_record(code);
    }
    control.speed = Some(speed);
    let value = value_of(control, speed);
    control.word(S, value)
}

/// What S says: turns a minute within the range, or a surface speed, which counts meters
/// a minute in a metric program and feet in one in inches.
fn value_of(control: &mut Control, speed: SpindleSpeed) -> f64 {
    match (speed, control.is_metric()) {
        (SpindleSpeed::Revolutions(asked), _) => within_range(control, asked),
        (SpindleSpeed::Meters(value), true) | (SpindleSpeed::Feet(value), false) => value,
        (SpindleSpeed::Feet(value), true) => value * FOOT,
        (SpindleSpeed::Meters(value), false) => value / FOOT,
    }
}

/// Brings a speed within the range that was chosen, else within the ranges of the
/// machine, with a warning.
fn within_range(control: &mut Control, speed: f64) -> f64 {
    let commons = &control.commons;
    let ranges = commons.int(loc::SPINDLE_RANGES).clamp(1, 6) as usize;
    let open = match control.range {
        Some(chosen) => chosen..chosen + 1,
        None => 0..ranges,
    };
    let limits = loc::RANGE_SPEEDS[open].iter();
    let low = limits.clone().filter_map(|(min, _)| commons.rel_opt(*min)).reduce(f64::min);
    let tops: Option<Vec<f64>> = limits.map(|(_, max)| commons.rel_opt(*max)).collect();
    let high = tops.and_then(|tops| tops.into_iter().reduce(f64::max));
    let within = speed.max(low.unwrap_or(0.0)).min(high.unwrap_or(f64::MAX));
    if within != speed {
        let message = format!("spindle speed {speed} became {within}");
        control.warnings.add(PostCode::Clamped, message);
    }
    within
}

fn select_range(control: &mut Control, range: f64) -> Result<()> {
    let index = (1..=6).position(|number| f64::from(number) == range);
    let Some(index) = index else {
        return PostCode::WordForm.err(format!("SPINDL: there is no spindle range {range}"));
    };
    let code = control.code(RANGE_CODES[index], "this spindle range")?;
    control.range = Some(index);
    control.m(code);
    control.write_block()
}

/// Adds the M code and writes or keeps the block; a machine without the code
/// turns its spindle by other means.
fn place(control: &mut Control, at: CodeAt, what: &str) -> Result<()> {
    match control.code_if_any(at) {
        Some(code) => control.m(code),
        None => control.warn_no_code(what),
    }
    let placement = control.commons.read(loc::SPINDLE_PLACEMENT);
    control.place_block(Function::Spindle, placement)
}
