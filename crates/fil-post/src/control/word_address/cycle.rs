//! Canned cycles: G81 to G89 with their levels, pecks, dwell and feed.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::AxisSet;
use fil_machine::letters::{F, R, S};
use fil_machine::locations::{
    self as loc, CycleAxesModal, CycleDataModal, CycleDepthOutput, CycleReturnCodes,
    DwellCycleModal, MillTurnSidePeck,
};
use fil_machine::modes::{FeedMode, Plane};
use fil_machine::rounding::Rounding;

use super::motion;
use super::{dwell, modes, spindle};
use crate::control::{Control, length_plane, tap};
use crate::control_state::{Rotation, modal};
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;
use crate::operation::{Feed, SpindleSpeed};

/// The code of a cycle; `None` where the machine has none that does all of it, so that
/// it must be written as single moves.
///
/// A dwell is lost in a cycle that takes none: G81, G73, G83, G85 and G86 do not. Drilling
/// with a dwell is countersinking (G82).
pub fn code(control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
    if cycle.kind == CycleKind::Tap {
        return tap_code(control, cycle);
    }
    let code = control.code_if_any(cycle.kind.code())?;
    if cycle.dwell == 0.0 || !WITHOUT_DWELL.contains(&code) {
        return Some(code);
    }
    let straight = matches!(
        cycle.kind,
        CycleKind::Drill | CycleKind::Thru | CycleKind::Csink | CycleKind::Face
    );
    let with_dwell = control.code_if_any(loc::CYCLE_CSINK_CODE).filter(|_| straight);
    with_dwell.filter(|code| !WITHOUT_DWELL.contains(code))
}

/// The code of a tap for the way the spindle turns, which the tape has said.
fn tap_code(control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
    let (code, rigid) = match control.state.rotation() {
        Rotation::Unsaid | Rotation::Clockwise => (loc::CYCLE_TAP_CODE, loc::CYCLE_RIGID_TAP_CODE),
        Rotation::Counterclockwise => (loc::CYCLE_TAP_LEFT_CODE, loc::CYCLE_RIGID_TAP_LEFT_CODE),
        // A rigid tap turns the spindle by itself.
        Rotation::Standing if cycle.rigid => (loc::CYCLE_TAP_CODE, loc::CYCLE_RIGID_TAP_CODE),
        Rotation::InDoubt | Rotation::Standing => return None,
    };
    let usual = control.code_if_any(loc::CYCLE_TAP_CODE);
    let tenths = |at| control.commons.int_opt(at).and_then(|tenths| u32::try_from(tenths).ok());
    if cycle.rigid && tenths(loc::CYCLE_RIGID_TAP_CODE).is_some() {
        return tenths(rigid).map(FunctionCode::tenths);
    }
    // A machine without a tapping cycle has none for left-hand threads either.
    let code = usual.and(control.code_if_any(code))?;
    (!(code == G74 && turns_by_g74(control))).then_some(code)
}

const G74: FunctionCode = FunctionCode::whole(74);

/// Where G98 is the feed a minute, G74 is a turning cycle: it pecks or faces and taps
/// nothing.
fn turns_by_g74(control: &Control) -> bool {
    control.commons.read(loc::FEED_UPM_CODE) == Some(98)
}

/// Why the machine has no code for a tap that turns as the spindle does.
pub fn no_tap(control: &Control) -> &'static str {
    match control.state.rotation() {
        Rotation::Counterclockwise
            if turns_by_g74(control)
                && control.code_if_any(loc::CYCLE_TAP_LEFT_CODE) == Some(G74) =>
        {
            "the spindle turns counterclockwise, and G74 (cycle.tap_left_code) is a turning \
             cycle where G98 is a feed"
        }
        Rotation::Counterclockwise if control.code_if_any(loc::CYCLE_TAP_CODE).is_some() => {
            "the spindle turns counterclockwise, and the machine has no cycle for left-hand \
             threads (cycle.tap_left_code, cycle.rigid_tap_left_code)"
        }
        Rotation::InDoubt => {
            "the spindle direction is not known after an unreadable or skippable block while it ran counterclockwise; put SPINDL before the tap"
        }
        _ if length_plane::of_motions(control).is_some()
            && !control.tables.mills()
            && control.code_if_any(loc::CYCLE_TAP_CODE).is_some() =>
        {
            "the tapping cycle needs a plane in which the control applies tool lengths along other axes; set tool.length_const if they apply the same way in every plane (SD42940)"
        }
        _ if control.tables.mills() && control.can().cycle_calls => {
            "tapping with a live tool of a SINUMERIK needs mill_turn.rigid_tap, which positions it by SPOS"
        }
        _ => "the machine has no tapping cycle, and a tap can't be written as single moves",
    }
}

/// Cycles of the usual controls that take no dwell. G86 of Mitsubishi and LinuxCNC has one, that of
/// Fanuc and Haas passes over P.
const WITHOUT_DWELL: [FunctionCode; 5] = [
    FunctionCode::whole(73),
    FunctionCode::whole(81),
    FunctionCode::whole(83),
    FunctionCode::whole(85),
    FunctionCode::whole(86),
];

/// Writes the block of a hole: all words at the first one, later only what has
/// changed.
///
/// # Errors
/// A code or letter the machine lacks, a value that does not fit.
pub fn hole(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    at: &Motion,
    hole: &Hole,
) -> Result<()> {
    let usual = dwell::format_of_cycle(control);
    write_hole(control, cycle, code, at, hole)?;
    dwell::restore_format(control, usual);
    Ok(())
}

fn write_hole(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    at: &Motion,
    hole: &Hole,
) -> Result<()> {
    let across = at.of(across(hole.along));
    let data_modal = control.commons.read(loc::CYCLE_DATA_MODAL);
    let in_force = cycle.in_force == Some(*hole) && control_has_data(control, cycle, code, hole);
    if in_force && data_modal != CycleDataModal::EveryPoint {
        if control.commons.read(loc::DWELL_CYCLE_MODAL) == DwellCycleModal::EachHole {
            dwell_word(control, cycle)?;
        }
        let moves = motion::axis_words(control, &across)?;
        repeated_axes(control, &across, AxisSet::ALL)?;
        if !moves {
            for number in AxisSet::LINEAR.numbers().filter(|number| *number != hole.along) {
                motion::axis_word(control, number, &across)?;
            }
        }
        return motion::write_motion(control);
    }
    modes::plane_of_its_own(control, Plane::across(hole.along))?;
    control.because(cycle.cause, |control| rigid_mode(control, cycle))?;
    control.because(cycle.cause, |control| codes(control, cycle, code, hole))?;
    for number in AxisSet::LINEAR.numbers().filter(|number| *number != hole.along) {
        motion::axis_word(control, number, &across)?;
    }
    motion::axis_words(control, &across.of(AxisSet::ROTARY))?;
    repeated_axes(control, &across, AxisSet::ROTARY)?;
    level_words(control, cycle, hole)?;
    data_words(control, cycle, hole)?;
    motion::write_motion(control)
}

/// Writes the block of a hole of a live tool, which stands on the R level.
///
/// # Errors
/// A letter the machine lacks, a value that does not fit, a rigid tap.
#[cold]
pub fn live_hole(
    control: &mut Control,
    cycle: &Cycle,
    feed: &Feed,
    hole: &Hole,
    code: FunctionCode,
) -> Result<()> {
    if cycle.rigid && control.code_if_any(loc::CYCLE_RIGID_TAP_MODE).is_none() {
        return PostCode::NoCode
            .err("CYCLE/TAP,HIGH by a live tool needs a code before it (cycle.rigid_tap_mode)");
    }
    rigid_mode(control, cycle)?;
    let usual = dwell::format_of_cycle(control);
    let axis = *control.tables.axis(hole.along);
    let bottom = axis.value(hole.bottom)?;
    control.g_of_record(code);
    control
        .because(cycle.due_to(cycle.words.depth), |control| control.word(axis.letter, bottom))?;
    control.require_on_tape(R, "the R plane of a cycle")?;
    control.word(R, 0.0)?;
    live_peck(control, cycle, hole)?;
    dwell_word(control, cycle)?;
    let rounding = if cycle.kind == CycleKind::Tap { Rounding::Lead } else { Rounding::Rate };
    motion::feed_mode(control, feed)?;
    control.because(feed.cause, |control| control.word_rounded(F, feed.value, rounding))?;
    motion::write_motion(control)?;
    dwell::restore_format(control, usual);
    Ok(())
}

/// The depth of a peck of a live tool.
fn live_peck(control: &mut Control, cycle: &Cycle, hole: &Hole) -> Result<()> {
    let Some(step) = cycle.step else { return Ok(()) };
    let is_diameter = hole.along == 0
        && control.commons.read(loc::MILL_TURN_SIDE_PECK) == MillTurnSidePeck::Diameter;
    let step = if is_diameter { 2.0 * step } else { step };
    let letter = control.letter(loc::CYCLE_STEP_ADDRESS, "the peck")?;
    control.require_on_tape(letter, "the peck of a live tool")?;
    control.because(cycle.due_to(cycle.words.step), |control| {
        control.word_rounded(letter, step, Rounding::Rate)
    })
}

/// Adds the words of those axes that each hole says again, whether or not they have
/// changed.
fn repeated_axes(control: &mut Control, across: &Motion, of: AxisSet) -> Result<()> {
    let repeated = match control.commons.read(loc::CYCLE_AXES_MODAL) {
        CycleAxesModal::Both => return Ok(()),
        CycleAxesModal::Linear => AxisSet::ROTARY,
        CycleAxesModal::Rotary => AxisSet::LINEAR,
        CycleAxesModal::Neither => AxisSet::ALL,
    };
    let present = control.tables.present();
    for number in across.axes.and(repeated).and(present).and(of).numbers() {
        motion::axis_word(control, number, across)?;
    }
    Ok(())
}

/// The block that puts the control in step with the spindle, before a rigid tap.
///
/// # Errors
/// The machine has no means for a rigid tap; no speed of the spindle is known.
fn rigid_mode(control: &mut Control, cycle: &Cycle) -> Result<()> {
    if !cycle.rigid {
        return Ok(());
    }
    let Some(mode) = control.code_if_any(loc::CYCLE_RIGID_TAP_MODE) else {
        if control.commons.int_opt(loc::CYCLE_RIGID_TAP_CODE).is_some() {
            return Ok(());
        }
        return PostCode::NoCode.err(
            "CYCLE/TAP,HIGH, and the machine has no rigid tap (cycle.rigid_tap_code or \
             cycle.rigid_tap_mode)",
        );
    };
    if control.state.is(modal::CYCLE, true) {
        return Ok(());
    }
    let Some(asked @ SpindleSpeed::Revolutions(_)) = control.spindle.speed else {
        return PostCode::CycleForm
            .err("a rigid tap needs the turns of the spindle, and no SPINDL gave them");
    };
    let speed = spindle::value_of(control, asked);
    // Said once more it would be an alarm, as would a motion behind an author's.
    if control.spindle.in_step == Some((control.tape.count, speed)) {
        return Ok(());
    }
    let waiting = control.block.take();
    control.m(mode);
    control.word(S, speed)?;
    control.write_block()?;
    control.block = waiting;
    Ok(())
}

/// True when the control still has the words of the last hole: no text has changed
/// cycle, plane, feed, levels or peck since.
fn control_has_data(control: &Control, cycle: &Cycle, code: FunctionCode, hole: &Hole) -> bool {
    let step = control.commons.read(loc::CYCLE_STEP_ADDRESS).filter(|_| cycle.step.is_some());
    let dwell = control.commons.read(loc::CYCLE_DWELL_ADDRESS).filter(|_| cycle.dwell > 0.0);
    let bottom = control.tables.axis(hole.along).letter;
    let letters = [Some(F), Some(R), Some(bottom), step, dwell];
    control.state.is(modal::CYCLE_CODE, code)
        && letters.into_iter().flatten().all(|letter| control.state.has_last(letter))
        && control.state.get(modal::PLANE).is_none_or(|plane| plane == Plane::across(hole.along))
}

/// Writes the code that ends the control's cycle, if it may be in one.
///
/// # Errors
/// The machine has no such code.
pub fn cancel(control: &mut Control) -> Result<()> {
    if !control.state.is(modal::CYCLE, true) {
        return Ok(());
    }
    control.family().leave_cycle(control)
}

/// Says that no canned cycle is in force.
///
/// # Errors
/// The machine has no such code.
pub fn leave_by_code(control: &mut Control) -> Result<()> {
    let waiting = control.block.take();
    let code = control.code(loc::CYCLE_OFF_CODE, "CYCLE/OFF").map_err(|mut diag| {
        diag.hint = Some("Most controls end their cycles by G80: cycle.off_code = 80.".into());
        diag
    })?;
    control.g_of_record(code);
    control.write_block()?;
    control.block = waiting;
    Ok(())
}

/// After a hole the control stands at this level, whatever its last words were.
///
/// # Errors
/// A level that does not fit its address.
pub fn stands_at(control: &mut Control, along: usize, level: f64) -> Result<()> {
    let axis = *control.tables.axis(along);
    control.commons.set_last_output(axis.letter, axis.value(level)?);
    control.state.trust(axis.letter);
    Ok(())
}

/// All axes but the one the hole runs along.
fn across(along: usize) -> AxisSet {
    let others = AxisSet::ALL.numbers().filter(|number| *number != along);
    others.fold(AxisSet::NONE, |set, number| set.or(AxisSet::of(number)))
}

/// The level to return to and the cycle.
fn codes(control: &mut Control, cycle: &Cycle, code: FunctionCode, hole: &Hole) -> Result<()> {
    match control.commons.read(loc::CYCLE_RETURN_CODES) {
        CycleReturnCodes::No => {}
        CycleReturnCodes::Yes => {
            let at = if hole.to_initial {
                loc::CYCLE_RETURN_INITIAL_CODE
            } else {
                loc::CYCLE_RETURN_CLEAR_CODE
            };
            let level = control.code(at, "the return level")?;
            let modal = control.commons.read(loc::CYCLE_RETURN_MODAL);
            if !modal || !control.state.is(modal::RETURN_LEVEL, level) {
                control.g(level);
            }
        }
        CycleReturnCodes::G71OfAnOsp if hole.to_initial => {
            if cycle.in_force.is_none_or(|last| !last.to_initial || last.initial != hole.initial) {
                return_level(control, hole)?;
            }
            control.m(M53);
        }
        CycleReturnCodes::G71OfAnOsp => control.m(M54),
    }
    control.g(code);
    Ok(())
}

/// G71, M53 and M54 of an OSP: the level that cycles return to, and whether they do, or return to R.
const G71: FunctionCode = FunctionCode::whole(71);
const M53: FunctionCode = FunctionCode::whole(53);
const M54: FunctionCode = FunctionCode::whole(54);

/// Writes the block of G71. The tool stays where it is.
fn return_level(control: &mut Control, hole: &Hole) -> Result<()> {
    let axis = *control.tables.axis(hole.along);
    let before = control.commons.last_output(axis.letter);
    let waiting = control.block.take();
    control.g(G71);
    control.word(axis.letter, axis.value(hole.initial)?)?;
    control.write_block()?;
    control.block = waiting;
    control.commons.set_last_output(axis.letter, before);
    Ok(())
}

/// Bottom and R level: absolute, or as increments from the level before and from R.
fn level_words(control: &mut Control, cycle: &Cycle, hole: &Hole) -> Result<()> {
    let axis = *control.tables.axis(hole.along);
    let value = |level: f64| axis.value(level);
    let (bottom, clear, start) = (value(hole.bottom)?, value(hole.clear)?, value(hole.initial)?);
    let (z, r) = match control.commons.read(loc::CYCLE_DEPTH_OUTPUT) {
        CycleDepthOutput::IncrementalSigned => (bottom - clear, clear - start),
        CycleDepthOutput::IncrementalUnsigned => ((bottom - clear).abs(), (clear - start).abs()),
        CycleDepthOutput::Absolute => (bottom, clear),
    };
    control.require_on_tape(R, "the R plane of a cycle")?;
    control.because(cycle.due_to(cycle.words.depth), |control| control.word(axis.letter, z))?;
    control.because(cycle.due_to(cycle.words.clear), |control| control.word(R, r))
}

/// The dwell at the bottom, of a cycle that has one.
fn dwell_word(control: &mut Control, cycle: &Cycle) -> Result<()> {
    if cycle.dwell == 0.0 {
        return Ok(());
    }
    let cause = cycle.due_to(cycle.words.dwell);
    let mode = match cycle.feed {
        CycleFeed::Lead(_) => FeedMode::PerRevolution,
        CycleFeed::Feed(feed) => feed.mode,
    };
    control.because(cause, |control| dwell::cycle_word(control, cycle.dwell, mode))
}

/// Peck, dwell and feed.
fn data_words(control: &mut Control, cycle: &Cycle, hole: &Hole) -> Result<()> {
    if let Some(step) = cycle.step {
        let step = control.tables.axis(hole.along).length(step).abs();
        let letter = control.letter(loc::CYCLE_STEP_ADDRESS, "the peck")?;
        control.because(cycle.due_to(cycle.words.step), |control| {
            control.word_rounded(letter, step, Rounding::Rate)
        })?;
    }
    dwell_word(control, cycle)?;
    let (feed, rounding) = match cycle.feed {
        CycleFeed::Feed(feed) if cycle.kind != CycleKind::Tap => (feed, Rounding::Rate),
        _ => (tap::feed(control, cycle)?, Rounding::Lead),
    };
    motion::feed_mode(control, &feed)?;
    control.because(feed.cause, |control| control.word_rounded(F, feed.value, rounding))
}
