//! A hole of the active cycle: its levels on the machine, the way above it, and the
//! control's cycle or single moves.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::locations::{
    self as loc, CycleMultax, CycleMultaxAny, CycleMultaxXy, CycleMultaxYz, CycleMultaxZx,
    CycleReturnCodes,
};
use fil_machine::modes::FeedMode;

use super::position::Solution;
use super::{
    Since, expand, frame_begin, mill_turn, plates, position, rapid, rapid_turn, rotary,
    scaled_lead, tip_control, tip_hole, turn_at_top,
};
use crate::control::needs::Act;
use crate::control::place::cross_unknown;
use crate::control::sinumerik::live_tap;
use crate::control::skip::refuse_level;
use crate::control::tap;
use crate::control::word_address::cycle as words;
use crate::control::word_address::spindle;
use crate::control::{Control, family};
use crate::control_state::{Place, modal};
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;
use crate::operation::{SpindleSpeed, Target};
use crate::post::Post;

/// Differences below this count as none, mm or inch.
const SAME: f64 = 1e-6;

/// Levels nearer than this are one level, mm or inch.
const SAME_LEVEL: f64 = 1e-9;

/// Drills the hole that starts at the target.
///
/// # Errors
/// A hole that runs along no linear axis of the machine, a level outside the travel,
/// a level to return to that is not known, a value that does not fit.
pub fn carry_out(post: &mut Post, target: Target) -> Result<()> {
    let Some(mut cycle) = post.path.cycle.take() else { return Ok(()) };
    let result = drill(post, &mut cycle, target);
    // The tool stands above the point.
    post.path.last.since = Since::Hole;
    post.path.cycle = Some(cycle);
    post.path.sense.course.interrupt();
    result
}

fn drill(post: &mut Post, cycle: &mut Cycle, target: Target) -> Result<()> {
    if !post.control.state.is(modal::CYCLE, true) {
        cycle.in_force = None;
    }
    post.control.ready_for(Act::Hole)?;
    post.control.flush_waiting()?;
    if cycle.kind != CycleKind::Tap && spindle::stands(&post.control) {
        let message = "CYCLE: the spindle is stopped".to_string();
        post.warn(PostCode::SpindleStands, message);
    }
    if spindle::may_stand_behind_stop(&post.control) {
        post.warn(PostCode::SpindleStands, format!("CYCLE {}", spindle::BEHIND_STOP));
    }
    refuse_scaled(post)?;
    if !cycle.plates.is_empty() {
        return plates::drill(post, cycle, target);
    }
    tip_control::choose(post, target, false);
    if post.writes_tip() {
        refuse_less_than_a_digit(&post.control, cycle)?;
        return tip_hole::hole(post, cycle, target);
    }
    if post.control.tables.frame_output && frame_begin::turn_to(post, target, false)? {
        (cycle.initial, cycle.above, cycle.in_force) = (None, None, None);
    }
    turn_at_top::go_up(post, target)?;
    tip_control::end_outside(post)?;
    post.control.family().ready_for_hole(&mut post.control, cycle.in_force.is_some())?;
    post.control.ready_length()?;
    mill_turn::live_tool::turn_to_hole(post, target)?;
    let (position, mut hole, solution) = locate(post, cycle, target)?;
    rotary::establish(post, solution)?;
    refuse_beside_the_axis(&post.control, &position, &hole)?;
    warn_of_surface_speed(post);
    refuse_without_depth(&post.control, cycle, &position, &hole)?;
    if cycle.kind == CycleKind::Tap {
        scaled_lead::refuse(&post.control, &[hole.along], PostCode::CycleForm)?;
        refuse_another_lead(&post.control, cycle)?;
    }
    post.path.last.in_cut = false;
    post.path.arrive(target);
    let word = position::word_of(post, target);
    let at = Motion::new(position, AxisSet::ALL, word);
    raise(post, cycle, &mut hole, &at)?;
    for level in [hole.bottom, hole.clear, hole.initial] {
        post.control.tables.axis(hole.along).check(level)?;
    }
    let has_cycle =
        post.control.family().drills(&post.control, &hole) && !as_single_moves(post, target);
    let code = post.control.family().cycle_code(&post.control, cycle).filter(|_| has_cycle);
    cycle.along = Some(hole.along);
    if cycle.kind == CycleKind::Tap {
        spindle::counted::check_tap(&post.control, code.is_some())?;
    }
    if let Some(code) = mill_turn::hole::code(&post.control, cycle, &hole) {
        mill_turn::hole::drill(&mut post.control, cycle, &at, &hole, code)?;
    } else if live_tap::taps(&post.control, cycle, &hole) {
        mill_turn::hole::tap_in_step(&mut post.control, cycle, &at, &hole)?;
    } else if let Some(code) = code {
        if !post.control.state.is(modal::CYCLE, true)
            && post.control.commons.read(loc::CYCLE_APPROACH_BLOCK)
        {
            let across = expand::without(hole.along);
            let cause = post.control.block.cause;
            rapid::rapid(&mut post.control, &at.of(across), cause)?;
        }
        let level = without_return_code(post, cycle, &at, &mut hole)?;
        warn_of_turn(&mut post.control, &at, &hole);
        family::hole(&mut post.control, cycle, code, &at, &hole)?;
        cycle.in_force = Some(hole);
        if let Some(level) = level {
            return go_up(post, cycle, &hole, level);
        }
    } else {
        expand::hole(&mut post.control, cycle, &at, &hole)?;
    }
    words::stands_at(&mut post.control, hole.along, hole.rest())
}

/// Refuses a hole where TRANS makes lengths longer or shorter.
fn refuse_scaled(post: &Post) -> Result<()> {
    match &post.path.transformation {
        Some(trans) if !trans.is_rigid() => PostCode::CycleForm.err_with(
            "CYCLE under a TRANS that scales: it is not known which of its lengths are scaled",
            "Let the CAM system scale the holes, or write them by GOTO.",
        ),
        _ => Ok(()),
    }
}

/// Refuses a hole along a tool that may lean whose depth is less than half a last digit.
fn refuse_less_than_a_digit(control: &Control, cycle: &Cycle) -> Result<()> {
    let is_none = cycle.depth > 0.0 && cycle.depth < control.tables.axis(2).resolution() / 2.0;
    if is_none { no_depth(cycle, control.tables.axis(2).letter) } else { Ok(()) }
}

fn no_depth(cycle: &Cycle, letter: Letter) -> Result<()> {
    PostCode::CycleForm.err(format!("DEPTH {} is nothing at the digits of {letter}", cycle.depth))
}

/// Refuses a hole whose bottom is its surface to the last digit of the tape: the control would drill
/// none, or alarm.
fn refuse_without_depth(
    control: &Control,
    cycle: &Cycle,
    surface: &Position,
    hole: &Hole,
) -> Result<()> {
    let axis = control.tables.axis(hole.along);
    let is_none = axis.scaled(surface[hole.along])? == axis.scaled(hole.bottom)?;
    if cycle.depth > 0.0 && is_none { no_depth(cycle, axis.letter) } else { Ok(()) }
}

/// Refuses a tap at a feed a minute behind another speed of the spindle: its lead would be another
/// one than that of the holes before. Where the lead is named and F counts minutes, F is said anew.
fn refuse_another_lead(control: &Control, cycle: &mut Cycle) -> Result<()> {
    let Some(SpindleSpeed::Revolutions(turns)) = control.spindle.speed else { return Ok(()) };
    let is_a_minute =
        matches!(cycle.feed, CycleFeed::Feed(feed) if feed.mode == FeedMode::PerMinute);
    if !is_a_minute && !tap::counts_minutes(control) {
        return Ok(());
    }
    match cycle.turns.replace(turns) {
        Some(before) if before != turns && !is_a_minute => {
            cycle.in_force = None;
            Ok(())
        }
        Some(before) if before != turns => PostCode::CycleForm.err_with(
            format!(
                "the spindle turns at {turns} where the holes before were tapped at {before}: at the \
                 feed of CYCLE/TAP the lead would be another one"
            ),
            "Repeat CYCLE/TAP after SPINDL, or give its lead by MMPR, IPR or TPI.",
        ),
        _ => Ok(()),
    }
}

/// Warns of the rapid motions of a cycle's block that turn the machine from hole to hole with the
/// tip below the line between them.
fn warn_of_turn(control: &mut Control, at: &Motion, hole: &Hole) {
    let mut over = *at;
    over.position[hole.along] = hole.clear;
    let along = AxisSet::of(hole.along);
    rapid_turn::warn_of_dip(control, &over, &[expand::without(hole.along), along]);
}

/// Refuses a hole that does not lie on the axis of a part that turns: the drill would cut a
/// ring, and break.
fn refuse_beside_the_axis(control: &Control, at: &Position, hole: &Hole) -> Result<()> {
    let turns = control.commons.read(loc::LATHE_DIAMETER)
        && !control.tables.mills()
        && spindle::may_turn(control);
    let beside = libm::hypot(at[0], at[1]);
    if !turns || hole.along == 2 && beside <= control.tables.axis(0).resolution() {
        return Ok(());
    }
    let message = format!("a hole {beside:.4} beside the axis of a part that turns");
    let diag = PostCode::CycleForm.diag(message);
    Err(Box::new(diag.hint(
        "Drill it with a live tool: MODE/MILL on a mill-turn machine, or with the spindle stopped.",
    )))
}

/// Warns of a hole in a part that turns at surface speed: a hole at the axis has no radius, so
/// that the spindle goes up to its highest speed.
fn warn_of_surface_speed(post: &mut Post) {
    let of_surface = spindle::is_of_surface(&post.control);
    let turns = post.control.commons.read(loc::LATHE_DIAMETER) && !post.control.tables.mills();
    if of_surface && turns && spindle::may_turn(&post.control) {
        let limit = post.control.state.get(modal::SPEED_LIMIT);
        let limit = limit.map_or("the control's".to_string(), |limit| format!("{limit}"));
        let message = format!(
            "CYCLE at surface speed: at the axis the spindle turns at the highest speed ({limit}); \
             SPINDL / RPM gives another"
        );
        post.warn(PostCode::Clamped, message);
    }
}

/// On a control without G98 and G99 nobody says which level a cycle returns to: it begins
/// on the R level then, which is both. Gives the level to go up to after the hole.
fn without_return_code(
    post: &mut Post,
    cycle: &mut Cycle,
    at: &Motion,
    hole: &mut Hole,
) -> Result<Option<f64>> {
    let control = &mut post.control;
    let says_it = control.commons.read(loc::CYCLE_RETURN_CODES) != CycleReturnCodes::No
        || control.can().cycles_say_return;
    if says_it || (hole.initial - hole.clear).abs() <= SAME_LEVEL {
        return Ok(None);
    }
    let is_level =
        |last: Hole| last.along == hole.along && (last.clear - hole.clear).abs() <= SAME_LEVEL;
    if control.state.is(modal::CYCLE, true) && !cycle.in_force.is_some_and(is_level) {
        words::cancel(control)?;
        cycle.in_force = None;
    }
    if !control.state.is(modal::CYCLE, true) {
        let cause = control.block.cause;
        rapid::rapid(control, &at.of(expand::without(hole.along)), cause)?;
        let clear = Motion::along(hole.along, hole.clear);
        rapid::rapid(control, &clear, cause)?;
    }
    let level = hole.to_initial.then_some(hole.initial);
    (hole.initial, hole.to_initial) = (hole.clear, false);
    Ok(level)
}

/// Ends the control's cycle after a hole and goes up to the level before it.
fn go_up(post: &mut Post, cycle: &mut Cycle, hole: &Hole, level: f64) -> Result<()> {
    words::stands_at(&mut post.control, hole.along, hole.clear)?;
    words::cancel(&mut post.control)?;
    cycle.in_force = None;
    let cause = cycle.cause;
    post.control
        .because(cause, |control| rapid::rapid(control, &Motion::along(hole.along, level), cause))
}

/// The machine wants single moves for a hole of this direction while MULTAX is on
/// (INTCOM 4594 to 4598).
fn as_single_moves(post: &Post, target: Target) -> bool {
    let commons = &post.control.commons;
    if post.path.multax != Some(true) || commons.read(loc::CYCLE_MULTAX) != CycleMultax::ByDirection
    {
        return false;
    }
    let axis = target.axis.normalize();
    let lies_along = |number: usize| 1.0 - axis[number].abs() < SAME;
    if lies_along(2) {
        commons.read(loc::CYCLE_MULTAX_XY) == CycleMultaxXy::SingleMoves
    } else if lies_along(1) {
        commons.read(loc::CYCLE_MULTAX_ZX) == CycleMultaxZx::SingleMoves
    } else if lies_along(0) {
        commons.read(loc::CYCLE_MULTAX_YZ) == CycleMultaxYz::SingleMoves
    } else {
        commons.read(loc::CYCLE_MULTAX_ANY) == CycleMultaxAny::SingleMoves
    }
}

/// Goes away from the last hole of a cycle that has ended, to the level before the cycle.
///
/// # Errors
/// As a rapid motion.
pub fn retract(post: &mut Post, ended: &Cycle) -> Result<()> {
    let (Some(along), Some(level)) = (ended.along, ended.initial) else { return Ok(()) };
    if let Some(levels) = post.control.levels_behind_skip(along) {
        let is_settled = along == 2 && !levels.unknown;
        if is_settled && level <= levels.low {
            return Ok(());
        }
        if !is_settled || level < levels.high {
            return refuse_level(&post.control, along);
        }
        let cause = post.control.block.cause;
        return rapid::rapid(&mut post.control, &Motion::along(along, level), cause);
    }
    let here = post.control.stands(along);
    if here.is_none_or(|here| (here - level).abs() <= SAME_LEVEL) {
        return Ok(());
    }
    let cause = post.control.block.cause;
    rapid::rapid(&mut post.control, &Motion::along(along, level), cause)
}

/// Where the hole lies: the position above it with how the machine comes there, and its levels
/// along the axis that it runs along.
fn locate(post: &Post, cycle: &Cycle, target: Target) -> Result<(Position, Hole, Solution)> {
    let axis = target.axis.normalize();
    let offset = |by: f64| Target { point: target.point + axis * by, ..target };
    let (at, solution) = rotary::position_of(post, target)?;
    if post.control.tables.frame_output {
        let [bottom, clear] = [at[2] - cycle.depth, at[2] + cycle.clear];
        let hole = Hole { along: 2, bottom, clear, initial: clear, to_initial: false };
        return Ok((at, hole, solution));
    }
    let (bottom, _) = rotary::position_of(post, offset(-cycle.depth))?;
    let (clear, _) = rotary::position_of(post, offset(cycle.clear))?;
    let differs = |axis: &usize| (clear[*axis] - bottom[*axis]).abs() > SAME;
    let moving: Vec<usize> = (0..AXES).filter(differs).collect();
    let [along @ 0..=2] = moving[..] else {
        return PostCode::CycleForm.err_with(
            "the hole does not run along a linear axis of the machine",
            "Drill it in a tilted work plane (rotary.frame_output = 1), or with single moves under TCPC (rotary.tip_output = 1).",
        );
    };
    let (bottom, clear) = (bottom[along], clear[along]);
    Ok((at, Hole { along, bottom, clear, initial: clear, to_initial: false }, solution))
}

/// Refuses a hole from a height that is not known: the control would go across at it.
fn refuse_unknown_height(
    control: &mut Control,
    along: usize,
    place: Place,
    rises: bool,
) -> Result<()> {
    match place {
        Place::Unknown => cross_unknown(control, along),
        Place::LeftToScript(_) => {
            control.cross_forgotten(along);
            Ok(())
        }
        Place::Shifted(_) => control.cross_shifted(along, rises),
        _ => Ok(()),
    }
}

/// Brings the tool up before it goes to the hole, when it stands below the
/// hole's R level or below the level to return to, and settles that level. Where it is not
/// known how high it stands, it goes across first and then to the level, unless the last
/// number says that it goes up.
fn raise(post: &mut Post, cycle: &mut Cycle, hole: &mut Hole, at: &Motion) -> Result<()> {
    let start = at.position[hole.along];
    let out = if hole.clear >= hole.bottom { 1.0 } else { -1.0 };
    let above = |one: f64, other: f64| (one - other) * out;
    if let Some(levels) = post.control.levels_behind_skip(hole.along) {
        let lowest = if out > 0.0 { levels.low } else { levels.high };
        let is_above = !levels.unknown && above(hole.clear, lowest) <= SAME_LEVEL;
        // The control would return to the one level or the other, and go across at it.
        if cycle.retract.is_some() || !is_above {
            return refuse_level(&post.control, hole.along);
        }
        cycle.initial = None;
        return Ok(());
    }
    let place = post.control.place(hole.along);
    let other_axis = cycle.along.is_some_and(|along| along != hole.along);
    if other_axis || matches!(place, Place::Shifted(_) | Place::LeftToScript(_)) {
        // The level before the cycle counts from another zero, or is one of another axis.
        cycle.initial = None;
    }
    let here = post.control.stands(hole.along);
    let initial = cycle.initial.or(here);
    let wanted = match (cycle.retract, initial) {
        (Some(0.0), None) => {
            return PostCode::CycleForm.err("the initial plane to return to is not known");
        }
        (Some(0.0), Some(initial)) if above(initial, hole.clear) > 0.0 => initial,
        (Some(level), _) if level > 0.0 && above(start + level * out, hole.clear) > 0.0 => {
            start + level * out
        }
        (Some(level), _) if level > 0.0 && above(hole.clear, start + level * out) > SAME_LEVEL => {
            let message =
                "CYCLE: the return plane is below the R plane; the tool returns to the R plane";
            post.warn(PostCode::IgnoredPart, message.to_string());
            hole.clear
        }
        _ => hole.clear,
    };
    let rounding = (post.control.tables.axis(hole.along).resolution() / 2.0).max(SAME_LEVEL);
    let below = match (here, place) {
        // Where the tool stands is rounded on the tape, and less would be no motion.
        (Some(here), _) => above(wanted, here) > rounding,
        // It stands there, or a tool change has brought it up.
        (None, Place::Shifted(last) | Place::At(last)) => above(wanted, last) > SAME_LEVEL,
        (None, _) => false,
    };
    let unknown = here.is_none() && cycle.retract.is_some();
    refuse_unknown_height(&mut post.control, hole.along, place, below)?;
    // The control returns to where it stood when its cycle began, which is lower than the level
    // before ours where another cycle has left the tool on its R level.
    let of_control = cycle.in_force.map(|last| last.initial).or(here);
    // RETURN names a level above the R plane.
    let is_named = cycle.retract.is_some_and(|retract| retract > 0.0)
        && above(wanted, hole.clear) > SAME_LEVEL;
    let goes_down = is_named && here.is_some_and(|here| above(here, wanted) > rounding);
    let moves = below || goes_down;
    let level = if moves { wanted } else { of_control.or(initial).unwrap_or(wanted) };
    if moves || unknown {
        words::cancel(&mut post.control)?;
        cycle.in_force = None;
        let (across, motion) = (expand::without(hole.along), Motion::along(hole.along, wanted));
        let cause = cycle.cause;
        post.control.because(cause, |control| {
            if !below {
                rapid::rapid(control, &at.of(across), cause)?;
            }
            rapid::rapid(control, &motion, cause)
        })?;
    }
    if is_named && above(level, wanted) > SAME_LEVEL {
        let message = "CYCLE: the return plane is below the initial plane; the tool returns to the initial plane";
        post.warn(PostCode::IgnoredPart, message.to_string());
    }
    // A raise over a high hole is no lower level to return to for the holes behind it.
    cycle.initial = match initial {
        Some(initial) if above(level, initial) <= 0.0 => Some(initial),
        None if !(moves || unknown) => None,
        _ => Some(level),
    };
    hole.initial = level;
    hole.to_initial = match cycle.retract {
        None => false,
        Some(0.0) => true,
        // The level of the control was another hole's, which may be rounded to the same digits.
        Some(_) => is_named && above(level, wanted) > -2.0 * rounding,
    };
    Ok(())
}
