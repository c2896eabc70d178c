//! Drilling cycles CYCLE81 to CYCLE86 and CYCLE89: `MCALL` calls one at each position
//! that follows, or it is called at each hole.
//!
//! RTP is the level to return to, RFP the surface of the hole, RFP and SDIS the R level,
//! DP the bottom: levels are positions, and their sums are exactly the rounded levels.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::AxisSet;
use fil_machine::letters::{F, S};
use fil_machine::locations::{self as loc, ControlCycleCall};
use fil_machine::modes::{FeedMode, INCH, Plane};
use fil_machine::rounding::Rounding;

use crate::block::named;
use crate::control::word_address::{dwell, modes, motion, spindle};
use crate::control::{Control, length_plane, line, tap};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;
use crate::operation::{Feed, SpindleSpeed};

/// Drilling, and drilling with a dwell.
const DRILL: u16 = 81;
const WITH_DWELL: u16 = 82;
const PECKS: u16 = 83;
const TAP: u16 = 84;
const REAM: u16 = 85;
const BORE: u16 = 86;
const BORE_AT_FEED: u16 = 89;

/// Digits after the point of seconds.
const SECONDS: usize = 3;

/// Digits after the point of a pitch, mm.
const PITCH_DIGITS: usize = 4;

/// The number of the cycle that the settings name for a kind; `None` where they name
/// none, so that it is written as single moves.
pub fn code(control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
    let code = control.code_if_any(cycle.kind.code())?;
    let dwells = cycle.dwell > 0.0 && code == FunctionCode::whole(DRILL);
    Some(if dwells { FunctionCode::whole(WITH_DWELL) } else { code })
}

/// False for a hole along X of a lathe: RTP, RFP and DP are positions and would be diameters, and
/// whether SDIS, a length without a sign, is one too is not certain. False also for one whose plane is
/// that of other lengths: the cycle drills square to it.
pub fn drills(control: &Control, hole: &Hole) -> bool {
    let along_x_of_lathe = hole.along == 0 && control.commons.read(loc::LATHE_DIAMETER);
    !along_x_of_lathe && length_plane::may_be(control, Plane::across(hole.along))
}

/// Calls the cycle for a hole: by MCALL once and the position, or the position and the
/// cycle.
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
    plane(control, hole)?;
    let call = control.because(cycle.cause, |control| call(control, cycle, code, hole))?;
    let others = AxisSet::ALL.numbers().filter(|number| *number != hole.along);
    let across = at.of(others.fold(AxisSet::NONE, |set, number| set.or(AxisSet::of(number))));
    let moves = motion::axis_words(control, &across)?;
    let each = control.commons.read(loc::CONTROL_CYCLE_CALL) == ControlCycleCall::EachHole;
    // MCALL calls the cycle where a block moves the axes; a hole where the tool stands
    // is called by itself.
    if each || !moves {
        cancel(control)?;
        position(control, moves)?;
        control.because(cycle.cause, |control| super::put_text(control, &call))?;
        spent(control, cycle);
        return Ok(());
    }
    let feed = control.commons.last_output(F);
    let called = format!("{call} F{feed} {:?}", control.state.get(modal::FEED_MODE));
    let in_force = control.state.is(modal::CYCLE, true)
        && control.state.is(modal::CYCLE_CODE, code)
        && control.sinumerik.called == called;
    if !in_force {
        cancel(control)?;
        control
            .because(cycle.cause, |control| super::put_text(control, &format!("MCALL {call}")))?;
        control.state.set(modal::CYCLE, true);
        control.state.set(modal::CYCLE_CODE, code);
        control.sinumerik.called = called;
    }
    position(control, moves)?;
    spent(control, cycle);
    Ok(())
}

/// Chooses the plane that the cycle drills square to; what comes behind the cycle takes the usual
/// one back.
fn plane(control: &mut Control, hole: &Hole) -> Result<()> {
    let drilled = Plane::across(hole.along);
    modes::plane_of_its_own(control, drilled)?;
    control.state.set(modal::PLANE_IS_TEMPORARY, length_plane::is_of_one_motion(control, drilled));
    Ok(())
}

/// Ends the cycle of MCALL, if the control may be in one.
///
/// # Errors
/// As a text on the tape.
pub fn cancel(control: &mut Control) -> Result<()> {
    if control.state.is(modal::CYCLE, false) {
        return Ok(());
    }
    let waiting = control.block.take();
    control.block.cause = control.block.cause.whole();
    super::put_text(control, "MCALL")?;
    control.block = waiting;
    control.state.set(modal::CYCLE, false);
    Ok(())
}

/// What the cycle may have changed.
fn spent(control: &mut Control, cycle: &Cycle) {
    if matches!(cycle.kind, CycleKind::Tap | CycleKind::Bore | CycleKind::Ream) {
        control.state.doubt(F);
        control.state.doubt(S);
    }
}

/// Writes the axis words of the block as a rapid motion above the hole.
fn position(control: &mut Control, moves: bool) -> Result<()> {
    if !moves {
        return Ok(());
    }
    let code = control.code(loc::RAPID_CODE_XY, "rapid move")?;
    let cause = control.block.cause;
    motion::motion_code(control, code, true, cause);
    motion::write_motion(control)
}

/// The levels of a hole as the control says them.
struct Levels {
    rtp: String,
    rfp: String,
    sdis: String,
    dp: String,
    surface: f64,
    bottom: f64,
}

fn levels(control: &Control, cycle: &Cycle, hole: &Hole) -> Result<Levels> {
    if hole.clear < hole.bottom {
        return PostCode::Family.err("a hole that goes up: DP must lie below RFP");
    }
    let axis = control.tables.axis(hole.along);
    let share = cycle.depth / (cycle.depth + cycle.clear);
    if !share.is_finite() || cycle.depth <= 0.0 {
        return PostCode::CycleForm.err("DEPTH must be above zero");
    }
    let surface = axis.value(hole.bottom + (hole.clear - hole.bottom) * share)?;
    let (bottom, clear, rest) =
        (axis.value(hole.bottom)?, axis.value(hole.clear)?, axis.value(hole.rest())?);
    let digit = axis.length(axis.resolution()).abs() / 2.0;
    if surface < bottom {
        return PostCode::Family
            .err("a hole that goes up in the program (scale.z below zero): DP must be below RFP");
    }
    if clear < surface - digit {
        return PostCode::Family.err("an R plane below the surface of the hole (CLEAR below zero)");
    }
    if rest < clear - digit {
        return PostCode::Family.err("a return plane below the R plane");
    }
    let text = |value: f64| line::length(control, axis.letter, value).map(|(text, _)| text);
    Ok(Levels {
        rtp: text(rest)?,
        rfp: text(surface)?,
        sdis: text(clear - surface)?,
        dp: text(bottom)?,
        surface,
        bottom,
    })
}

/// The call of a cycle. The feed that it takes from the program is on the tape.
fn call(control: &mut Control, cycle: &Cycle, code: FunctionCode, hole: &Hole) -> Result<String> {
    let number = code.value() as u16;
    let right = match cycle.kind {
        CycleKind::Deep | CycleKind::Brkchp => number == PECKS,
        CycleKind::Tap => number == TAP,
        _ => matches!(number, DRILL | WITH_DWELL | REAM | BORE | BORE_AT_FEED),
    };
    if !right {
        return PostCode::Family.err(format!("CYCLE{number} for {:?}", cycle.kind));
    }
    let at = levels(control, cycle, hole)?;
    let Levels { rtp, rfp, sdis, dp, .. } = &at;
    let head = format!("CYCLE{number}({rtp},{rfp},{sdis},{dp}");
    let dwell = seconds(control, cycle.dwell)?;
    let rest = match number {
        TAP => tap_words(control, cycle, &dwell)?,
        PECKS => {
            take_feed(control, cycle)?;
            peck_words(control, cycle, &at, hole, &dwell)?
        }
        REAM => {
            let feed = reaming_feed(control, cycle)?;
            format!(",,{dwell},{feed},{feed}")
        }
        BORE => {
            take_feed(control, cycle)?;
            format!(",,{dwell},{},0,0,0,0", sense(control)?)
        }
        WITH_DWELL | BORE_AT_FEED => {
            take_feed(control, cycle)?;
            format!(",,{dwell}")
        }
        _ => {
            take_feed(control, cycle)?;
            String::new()
        }
    };
    Ok(format!("{head}{rest})"))
}

/// FDEP, no degression, DTB and DTS, the whole feed, chips removed or broken, by which
/// it lifts or stops before the last depth, the dwell at the bottom.
fn peck_words(
    control: &Control,
    cycle: &Cycle,
    at: &Levels,
    hole: &Hole,
    dwell: &str,
) -> Result<String> {
    let axis = control.tables.axis(hole.along);
    let Some(step) = cycle.step else {
        return PostCode::CycleForm.err("a cycle of pecks needs its STEP");
    };
    let format = control.tables.addresses.format(axis.letter).copied().unwrap_or_default();
    let scaled = Rounding::Rate
        .scale(axis.length(step).abs(), &format)
        .map_err(|diag| named(diag, axis.letter))?;
    let step = format.unscale(scaled);
    if step <= 0.0 {
        return PostCode::CycleForm.err("STEP must be above zero");
    }
    let (fdep, _) = line::length(control, axis.letter, (at.surface - step).max(at.bottom))?;
    let gap = control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
    let gap = if control.is_metric() { gap } else { gap / INCH };
    let (gap, _) = line::length(control, axis.letter, axis.length(gap).abs())?;
    let removes = cycle.kind == CycleKind::Deep;
    Ok(if removes {
        format!(",,{fdep},,0,0,0,1,1,,,,{dwell},{gap}")
    } else {
        format!(",,{fdep},,0,0,0,1,0,,,{gap},{dwell}")
    })
}

/// DTB, the direction after the cycle, the pitch, the angle to begin at and the speed. In
/// a program in inches PITA says that the pitch counts millimeters, which software without
/// that parameter refuses.
fn tap_words(control: &mut Control, cycle: &Cycle, dwell: &str) -> Result<String> {
    let Some(asked @ SpindleSpeed::Revolutions(_)) = control.spindle.speed else {
        return PostCode::Family.err("TAP before SPINDL: CYCLE84 needs the turns of the spindle");
    };
    let speed = spindle::value_of(control, asked);
    let sense = sense(control)?;
    let (unit, in_mm) = if control.is_metric() { (1.0, "") } else { (INCH, ",,1") };
    let pitch = tap::text(tap::pitch(control, cycle)? * unit, PITCH_DIGITS)?;
    let sign = if sense == 4 { "-" } else { "" };
    let format = control.tables.addresses.format(S).copied().unwrap_or_default();
    let scaled = Rounding::Rate.scale(speed, &format).map_err(|diag| named(diag, S))?;
    let speed = line::scaled_text(control, S, scaled).unwrap_or_default();
    Ok(format!(",,{dwell},{sense},,{sign}{pitch},0,{speed},{speed}{in_mm}"))
}

/// 3 for a spindle that turns clockwise, 4 for one that turns the other way.
fn sense(control: &Control) -> Result<u8> {
    match control.sinumerik.clockwise {
        Some(true) => Ok(3),
        Some(false) => Ok(4),
        None => PostCode::Family
            .err("a cycle that stops the spindle before SPINDL: which way it turns again"),
    }
}

/// Says the feed that the cycle takes from the program.
fn take_feed(control: &mut Control, cycle: &Cycle) -> Result<()> {
    let feed = own_feed(cycle)?;
    super::feed_before(control, &feed)
}

/// FFR and RFF, as F would say it; the mode of feeds is said before.
fn reaming_feed(control: &mut Control, cycle: &Cycle) -> Result<String> {
    let feed = own_feed(cycle)?;
    let waiting = control.block.take();
    motion::feed_mode(control, &feed)?;
    control.write_block()?;
    control.block = waiting;
    line::feed(control, feed.value)
}

fn own_feed(cycle: &Cycle) -> Result<Feed> {
    match cycle.feed {
        CycleFeed::Feed(feed) if feed.mode != FeedMode::InverseTime => Ok(feed),
        CycleFeed::Feed(_) => PostCode::Family.err("a feed in inverse time in a cycle"),
        CycleFeed::Lead(_) => {
            PostCode::Family.err("a lead in place of a feed in a cycle that does not tap")
        }
    }
}

/// Seconds of a dwell; above zero they are seconds, below turns of the spindle.
fn seconds(control: &mut Control, asked: f64) -> Result<String> {
    if asked <= 0.0 {
        return Ok("0".to_string());
    }
    let within = dwell::seconds_within(control, asked);
    let text = format!("{within:.SECONDS$}");
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - within).abs() > 0.01 * within {
        return PostCode::Family
            .err(format!("a dwell of {within} s would be written as {written}"));
    }
    Ok(text.trim_end_matches('0').trim_end_matches('.').to_string())
}
