//! SPINDL: RPM,s,CLW in any order; OFF; ON; ORIENT\[,b]; SFM and SMM for
//! constant surface speed; MAXRPM,n; RANGE,n.

use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, WordId};
use fil_diag::Diag;

use super::form::Form;
use crate::commons::Int;
use crate::errors::PostCode;
use crate::letters::S;
use crate::locations as loc;
use crate::post::Post;
use crate::state::Placement;

const RANGE_CODES: [Int; 6] = [
    loc::SPINDLE_RANGE1_CODE,
    loc::SPINDLE_RANGE2_CODE,
    loc::SPINDLE_RANGE3_CODE,
    loc::SPINDLE_RANGE4_CODE,
    loc::SPINDLE_RANGE5_CODE,
    loc::SPINDLE_RANGE6_CODE,
];

/// Writes the spindle's words, in a block of their own or with a motion.
///
/// # Errors
/// A form that is not known, or a speed that does not fit.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.flag(w::OFF) {
        form.end()?;
        return stop(post);
    }
    if form.flag(w::ORIENT) {
        if let Some(angle) = form.number() {
            post.due_to(&form);
            post.word(S, angle)?;
        }
        form.end()?;
        return turn(post, loc::SPINDLE_ORIENT_CODE, "SPINDL/ORIENT");
    }
    if let Some(range) = form.couplet(w::RANGE)? {
        post.due_to(&form);
        range_code(post, &form, range)?;
    }
    if let Some(limit) = form.couplet(w::MAXRPM)? {
        let code = post.code(loc::SPINDLE_MAX_CODE, "SPINDL/MAXRPM")?;
        post.due_to(&form);
        post.block.g_of_record(code);
        post.word(S, limit)?;
        post.write_block()?;
    }
    post.block.cause.word = 0;
    speed(post, &mut form)?;
    let direction = form.any_of(&[w::CLW, w::CCLW]);
    match direction {
        Some(_) => post.due_to(&form),
        None => post.block.cause.word = 0,
    }
    let direction = match direction {
        Some(w::CLW) => loc::SPINDLE_CW_CODE,
        Some(_) => loc::SPINDLE_CCW_CODE,
        None => loc::SPINDLE_DEFAULT_CODE,
    };
    form.flag(w::ON);
    form.end()?;
    turn(post, direction, "the spindle")
}

/// Stops the spindle at once, after all that still waits for a motion.
fn stop(post: &mut Post) -> Result<(), Box<Diag>> {
    post.flush_pending()?;
    match post.commons.int_opt(loc::SPINDLE_STOP_CODE) {
        Some(code) => post.block.m(code),
        None => post.warn_no_code("SPINDL/OFF"),
    }
    post.write_block()
}

/// Adds S, and on a lathe the code for revolutions or surface speed.
fn speed(post: &mut Post, form: &mut Form) -> Result<(), Box<Diag>> {
    let unit = form.any_of(&[w::RPM, w::SFM, w::SMM]);
    let surface = matches!(unit, Some(w::SFM | w::SMM));
    let Some(asked) = form.number() else {
        return match (unit, post.state.spindle) {
            (None, Some(speed)) => post.word(S, speed),
            (None, None) => Ok(()),
            (Some(_), _) => Err(form.error("the speed is missing")),
        };
    };
    post.due_to(form);
    if asked < 0.0 {
        return Err(form.error("the speed is negative; CCLW turns the other way"));
    }
    let code = if surface {
        Some(post.code(loc::SPINDLE_CSS_CODE, "constant surface speed")?)
    } else {
        post.commons.int_opt(loc::SPINDLE_RPM_CODE)
    };
    if let Some(code) = code {
        post.block.g_of_record(code);
    }
    let speed = if surface { surface_speed(post, unit, asked) } else { within_range(post, asked) };
    post.state.spindle = Some(speed);
    post.word(S, speed)
}

/// Surface speed in m/min on a metric tape, feet/min on an inch tape.
fn surface_speed(post: &Post, unit: Option<WordId>, value: f64) -> f64 {
    const FOOT: f64 = 0.3048;
    match (unit == Some(w::SFM), post.state.metric) {
        (true, true) => value * FOOT,
        (false, false) => value / FOOT,
        _ => value,
    }
}

/// Brings a speed within the ranges of the machine, with a warning.
fn within_range(post: &mut Post, speed: f64) -> f64 {
    let ranges = post.commons.int(loc::SPINDLE_RANGES).clamp(1, 6) as usize;
    let limits = loc::RANGE_SPEEDS[..ranges].iter();
    let low = limits.clone().filter_map(|(min, _)| post.commons.rel_opt(*min)).reduce(f64::min);
    let high = if limits.clone().all(|(_, max)| post.commons.rel_opt(*max).is_some()) {
        limits.filter_map(|(_, max)| post.commons.rel_opt(*max)).reduce(f64::max)
    } else {
        None
    };
    let within = speed.max(low.unwrap_or(0.0)).min(high.unwrap_or(f64::MAX));
    if within != speed {
        post.warn(PostCode::Clamped, format!("spindle speed {speed} became {within}"));
    }
    within
}

fn range_code(post: &mut Post, form: &Form, range: f64) -> Result<(), Box<Diag>> {
    let index = (1..=6)
        .position(|number| f64::from(number) == range)
        .ok_or_else(|| form.error(format!("there is no spindle range {range}")))?;
    let code = post.code(RANGE_CODES[index], "this spindle range")?;
    post.block.m(code);
    post.write_block()
}

/// Adds the M code and writes or keeps the block; a machine without the code
/// turns its spindle by other means.
fn turn(post: &mut Post, location: Int, what: &str) -> Result<(), Box<Diag>> {
    match post.commons.int_opt(location) {
        Some(code) => post.block.m(code),
        None => post.warn_no_code(what),
    }
    let placement = Placement::from_setting(post.commons.int(loc::SPINDLE_PLACEMENT));
    post.place_block(placement)
}
