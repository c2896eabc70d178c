//! Drilling cycles 200, 201, 203, 205, 206 and 207: `CYCL DEF` says the hole, `M99` in the
//! line of its position drills it.
//!
//! The settings of the machine say which cycle drills which kind of hole; a kind without
//! a number is written as single moves. Levels count from Q203, the surface, so that
//! the sums are exactly what the rounded levels are.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::AxisSet;
use fil_machine::letters::XYZ;
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, INCH};
use fil_machine::rounding::Rounding;

use super::line;
use super::motion;
use super::phrase::Head;
use crate::block::named;
use crate::control::word_address::motion as words;
use crate::control::{Control, tap};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;

/// By which 203 lifts to break chips, and 205 stops before the last depth, mm.
const GAP: f64 = 0.2;

/// Q208 of a retraction at rapid traverse: the highest feed that the control reads.
const RAPID_OUT: &str = "+99999";

/// Digits after the point of a pitch in mm and in inches.
const PITCH_DIGITS: [usize; 2] = [4, 5];

/// The cycles that are known, with their names.
const CYCLES: [(u16, &str); 6] = [
    (200, "DRILLING"),
    (201, "REAMING"),
    (203, "UNIVERSAL DRILLING"),
    (205, "UNIVERSAL PECKING"),
    (206, "TAPPING NEW"),
    (207, "RIGID TAPPING NEW"),
];

/// The number of the cycle that the settings name for a kind; `None` where they name
/// none.
pub fn code(control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
    control.code_if_any(cycle.kind.code())
}

/// True for a hole along the tool axis of TOOL CALL; others are written as single moves.
pub fn drills(hole: &Hole) -> bool {
    hole.along == 2 && hole.clear >= hole.bottom
}

/// Writes the definition of the cycle unless the control has it, and the line of the
/// hole.
///
/// # Errors
/// A cycle that is not known or can't do what is asked; a value that does not fit.
pub fn hole(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    at: &Motion,
    hole: &Hole,
) -> Result<()> {
    let lines = definition(control, cycle, code, hole)?;
    if !control.state.is(modal::CYCLE_CODE, code) || control.klartext.defined != lines {
        define(control, cycle, &lines)?;
        control.klartext.defined = lines;
        control.state.set(modal::CYCLE_CODE, code);
    }
    let across = at.of(AxisSet::XY.or(AxisSet::ROTARY));
    if !words::axis_words(control, &across)? {
        words::axis_word(control, 0, &across)?;
        words::axis_word(control, 1, &across)?;
    }
    // Its feeds are written a minute.
    motion::say_mode(control, FeedMode::PerMinute);
    let phrase = &mut control.klartext.phrase;
    (phrase.head, phrase.rapid, phrase.calls_cycle) = (Head::Line, true, true);
    motion::write(control, AxisSet::NONE)
}

/// Puts the definition on the tape: one block, whose lines go on with `~`.
fn define(control: &mut Control, cycle: &Cycle, lines: &[String]) -> Result<()> {
    let last = lines.len() - 1;
    for (number, text) in lines.iter().enumerate() {
        let more = if number < last { " ~" } else { "" };
        let text = format!("{text}{more}");
        if number == 0 {
            line::put(control, &line::Line::of_text(&text, cycle.cause))?;
        } else {
            line::put_more(control, &text, cycle.cause)?;
        }
    }
    Ok(())
}

/// The values of a hole as the tape says them.
struct Values {
    set_up: String,
    depth: String,
    surface: String,
    second: String,
    /// From the surface down, positive.
    deep: f64,
    /// From the set-up clearance down, positive.
    way: f64,
}

fn values(control: &Control, cycle: &Cycle, hole: &Hole) -> Result<Values> {
    let axis = control.tables.axis(2);
    let share = cycle.depth / (cycle.depth + cycle.clear);
    if !share.is_finite() || cycle.depth <= 0.0 {
        return PostCode::CycleForm.err("DEPTH must be above zero");
    }
    let surface = axis.value(hole.bottom + (hole.clear - hole.bottom) * share)?;
    let below = |level: f64| Ok::<f64, Box<fil_diag::Diag>>(axis.value(level)? - surface);
    let (bottom, clear) = (below(hole.bottom)?, below(hole.clear)?);
    let second = below(hole.rest())?;
    let digit = axis.length(axis.resolution()).abs() / 2.0;
    if bottom > 0.0 {
        return PostCode::Family.err("a hole that goes up in the program (scale.z below zero)");
    }
    if clear < -digit {
        return PostCode::Family.err("an R plane below the surface of the hole (CLEAR below zero)");
    }
    if second < clear - digit {
        return PostCode::Family.err("a return plane below the R plane");
    }
    let z = XYZ[2];
    Ok(Values {
        set_up: line::length(control, z, clear)?.0,
        depth: line::length(control, z, bottom)?.0,
        surface: line::length(control, z, surface)?.0,
        second: line::length(control, z, second)?.0,
        deep: -bottom,
        way: clear - bottom,
    })
}

/// The lines of a definition, without the signs that they go on.
fn definition(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    hole: &Hole,
) -> Result<Vec<String>> {
    let number = code.value() as u16;
    let Some((_, name)) = CYCLES.iter().find(|(known, _)| *known == number) else {
        return PostCode::Family.err(format!("CYCL DEF {number} is not known here"));
    };
    if cycle.kind.pecks() != matches!(number, 203 | 205) {
        return PostCode::Family.err(format!("CYCL DEF {number} for {:?}", cycle.kind));
    }
    if (cycle.kind == CycleKind::Tap) != matches!(number, 206 | 207) {
        return PostCode::Family.err(format!("CYCL DEF {number} for {:?}", cycle.kind));
    }
    let at = values(control, cycle, hole)?;
    let mut lines = vec![format!("CYCL DEF {number} {name}")];
    let mut say = |q: u16, value: &str, what: &str| lines.push(format!("  Q{q}={value} ;{what}"));
    say(200, &at.set_up, "SET-UP CLEARANCE");
    say(201, &at.depth, "DEPTH");
    if number == 207 {
        if cycle.dwell > 0.0 {
            return PostCode::Family
                .err("CYCL DEF 207 does not dwell; 206 does, with a floating tap holder");
        }
        let pitch = pitch(control, cycle)?;
        say(239, &pitch, "THREAD PITCH");
        say(203, &at.surface, "SURFACE COORDINATE");
        say(204, &at.second, "2ND SET-UP CLEARANCE");
        return Ok(lines);
    }
    let dwell = if cycle.dwell > 0.0 { line::seconds(control, cycle.dwell)? } else { "0".into() };
    if number == 206 {
        say(206, &tapping_feed(control, cycle)?, "FEED RATE FOR PLNGNG");
        say(211, &dwell, "DWELL TIME AT DEPTH");
        say(203, &at.surface, "SURFACE COORDINATE");
        say(204, &at.second, "2ND SET-UP CLEARANCE");
        return Ok(lines);
    }
    let feed = feed(control, cycle)?;
    say(206, &feed, "FEED RATE FOR PLNGNG");
    let peck = match cycle.step {
        Some(step) => control.tables.axis(2).length(step).abs(),
        None => at.deep.max(at.way),
    };
    let plunge = peck_text(control, peck)?;
    let gap = gap(control)?;
    if number == 201 {
        say(211, &dwell, "DWELL TIME AT DEPTH");
        say(208, &feed, "RETRACTION FEED RATE");
        say(203, &at.surface, "SURFACE COORDINATE");
        say(204, &at.second, "2ND SET-UP CLEARANCE");
        return Ok(lines);
    }
    say(202, &plunge, "PLUNGING DEPTH");
    if number != 205 {
        say(210, "+0", "DWELL TIME AT TOP");
    }
    say(203, &at.surface, "SURFACE COORDINATE");
    say(204, &at.second, "2ND SET-UP CLEARANCE");
    match number {
        203 => {
            let breaks = if cycle.kind == CycleKind::Brkchp { breaks(cycle, &at, peck) } else { 0 };
            say(212, "+0", "DECREMENT");
            say(213, &breaks.to_string(), "NR OF BREAKS");
            say(205, "+0", "MIN. PLUNGING DEPTH");
            say(211, &dwell, "DWELL TIME AT DEPTH");
            say(208, RAPID_OUT, "RETRACTION FEED RATE");
            say(256, &gap, "DIST FOR CHIP BRKNG");
        }
        205 => {
            if cycle.kind == CycleKind::Brkchp {
                return PostCode::Family.err("CYCL DEF 205 for BRKCHP");
            }
            say(212, "+0", "DECREMENT");
            say(205, "+0", "MIN. PLUNGING DEPTH");
            say(258, &gap, "UPPER ADV STOP DIST");
            say(259, &gap, "LOWER ADV STOP DIST");
            say(257, "+0", "DEPTH FOR CHIP BRKNG");
            say(256, &gap, "DIST FOR CHIP BRKNG");
            say(211, &dwell, "DWELL TIME AT DEPTH");
            say(379, "+0", "STARTING POINT");
            say(253, "+0", "F PRE-POSITIONING");
        }
        _ => say(211, &dwell, "DWELL TIME AT DEPTH"),
    }
    Ok(lines)
}

/// How many times chips are broken before the tool leaves the hole: at all pecks, or at those
/// before each that TIMES counts.
fn breaks(cycle: &Cycle, at: &Values, peck: f64) -> u32 {
    let all = (at.way / peck).ceil().clamp(1.0, 99999.0) as u32;
    cycle.out_each.map_or(all, |each| all.min(each - 1))
}

/// How far above the last depth a peck goes on, and by which it lifts to break chips.
fn gap(control: &Control) -> Result<String> {
    let gap = control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(GAP);
    match if control.is_metric() { gap } else { gap / INCH } {
        gap if gap > 0.0 => peck_text(control, control.tables.axis(2).length(gap).abs()),
        _ => Ok("+0".to_string()),
    }
}

/// A peck as the tape counts Z, positive.
fn peck_text(control: &Control, peck: f64) -> Result<String> {
    if peck <= 0.0 {
        return PostCode::CycleForm.err("STEP must be above zero");
    }
    let z = XYZ[2];
    let format = control.tables.addresses.format(z).copied().unwrap_or_default();
    let scaled = Rounding::Rate.scale(peck, &format).map_err(|diag| named(diag, z))?;
    Ok(line::scaled_text(control, z, scaled).unwrap_or_default())
}

/// The feed of a hole as F would say it: mm a minute, or tenths of an inch. One a turn of
/// the spindle is that at its speed: a new speed makes a new definition.
fn feed(control: &Control, cycle: &Cycle) -> Result<String> {
    let CycleFeed::Feed(feed) = cycle.feed else {
        return PostCode::Family.err("a lead in place of a feed in a cycle that does not tap");
    };
    let value = match feed.mode {
        FeedMode::PerMinute => feed.value,
        FeedMode::PerRevolution => motion::a_minute(control, feed.value)?,
        FeedMode::InverseTime => return PostCode::Family.err("inverse time in a cycle"),
    };
    line::feed(control, motion::spelled(control, value))
}

/// The feed of a tap in a floating holder: its pitch at the speed of the spindle, so a new
/// speed makes a new definition.
fn tapping_feed(control: &Control, cycle: &Cycle) -> Result<String> {
    if control.klartext.clockwise.is_none() {
        return PostCode::Family
            .err("TAP before SPINDL: CYCL DEF 206 taps with the spindle that turns");
    }
    let asked = motion::spelled(control, tap::a_minute(control, cycle)?);
    let text = line::feed(control, asked)?;
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - asked).abs() > tap::SHARE * asked {
        return PostCode::Family
            .err(format!("a feed of {asked} to tap with would be written as {written}"));
    }
    Ok(text)
}

/// The lead of a tap with the sign of its sense: minus for a left-hand thread, which the
/// spindle that turns counterclockwise cuts.
fn pitch(control: &Control, cycle: &Cycle) -> Result<String> {
    let Some(clockwise) = control.klartext.clockwise else {
        return PostCode::Family
            .err("TAP before SPINDL: the sign of Q239 depends on the spindle direction");
    };
    let digits = PITCH_DIGITS[usize::from(!control.is_metric())];
    let pitch = tap::text(tap::pitch(control, cycle)?, digits)?;
    Ok(format!("{}{pitch}", if clockwise { '+' } else { '-' }))
}
