//! A tilted frame begins: the machine turns, clear of the part, and the control is told how it lies.

use super::state::TiltedFrame;
use super::{frame, height, machine_position, position, tip_control};
use crate::control::needs::Act;
use crate::control::word_address::cycle;
use crate::control::{Control, Function, family, full_turn};
use crate::errors::PostCode;
use crate::operation::Target;
use crate::operation::motion::{Motion, RapidCode};
use crate::post::Post;
use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::axis_chain::AxisChain;
use fil_machine::locations::{self as loc, RotaryFrameForm};
use nalgebra::{Rotation3, Vector3};

/// What helps where the tool would begin elsewhere at feed.
const RAPID_FIRST: &str = "Put RAPID before the GOTO.";

/// A rotary axis that would turn by more for the angles on the tape stands elsewhere, degrees.
const ELSEWHERE: f64 = 0.05;

/// Brings the machine and the control into the frame of a target; says whether it began
/// there.
///
/// # Errors
/// A motion at feed that would turn the machine; as [`begin`].
#[cold]
pub(super) fn turn_to(post: &mut Post, target: Target, at_feed: bool) -> Result<bool> {
    let axis = frame::normalized(position::transformed(post, target).1)?;
    let same = frame::along(post, axis);
    if same.is_some_and(|frame| frame::is_in_force(&post.control, &frame)) {
        post.path.turning.chosen = None;
        return Ok(false);
    }
    if at_feed && same.is_none() && post.path.frame.is_some() && !post.control.tip.is_away {
        return PostCode::Frame.err_with(
            "the tool axis changes in a feed move, but a tilted work plane does not move; rotary.tip_output = 1 allows it under MULTAX/ON",
            "Set rotary.tip_output = 1 and put MULTAX/ON before it, or write positions of the axes \
             with rotary.frame_output = 0.",
        );
    }
    begin(post, axis, at_feed)?;
    Ok(true)
}

/// Turns the machine to a tool axis and begins the frame there.
///
/// # Errors
/// Cutter compensation; blocks that may be skipped; a tool axis out of reach, or one whose angles
/// name it not exactly enough; as [`away`] and [`refuse_at_feed`].
fn begin(post: &mut Post, axis: Vector3<f64>, at_feed: bool) -> Result<()> {
    let control = &mut post.control;
    control.begin()?;
    control.require_unit()?;
    control.ready_for(Act::WorkPlaneOn)?;
    cycle::cancel(control)?;
    control.flush_function(Function::WorkOffset)?;
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let near = post.path.turning.chosen.take().unwrap_or(stands);
    let chain = post.control.tables.chain();
    let angles = match zero(chain, axis) {
        true => [0.0; 2],
        false => chain.solve(axis, near)?,
    };
    let turn = turn_of(chain, taken_by_frame(&post.control, angles)?);
    let known = frame::knows_rotary(&post.control);
    let rests = known && frame::still(stands, angles);
    if at_feed && !post.control.tip.is_away && post.path.point.is_some() {
        refuse_at_feed(&post.control, rests)?;
    }
    let away = if rests { None } else { Some(away(post, stands)?) };
    tip_control::end(&mut post.control)?;
    frame::end(&mut post.control)?;
    if let Some(away) = away {
        turn_machine(post, away, angles)?;
    }
    let flat = (turn.matrix() - Rotation3::identity().matrix()).amax() < frame::SAME_AXIS;
    let higher = higher(post.control.tables.chain(), axis, angles);
    let turn = match flat {
        true => None,
        false => Some(family::begin_frame(&mut post.control, &turn, higher)?),
    };
    if let Some(turn) = turn {
        check_rounded(post.control.tables.chain(), turn, angles)?;
        frame::forget_positions(&mut post.control);
        post.control.tip.frame = Some((turn, angles));
    }
    frame::keep_rotary(&mut post.control);
    if post.control.tables.clamps && post.control.rotary.clamped != Some(true) {
        full_turn::clamp(&mut post.control, true)?;
    }
    post.path.interrupt();
    post.path.frame = Some(TiltedFrame { axis, angles, turn });
    post.path.rotary = Some(angles);
    Ok(())
}

/// Refuses a frame that begins in a motion at feed from where the tool does not stand behind its
/// blocks.
///
/// # Errors
/// The machine turns, or tool-tip control ends by G49, before which the tool goes up or behind
/// which the control does not count with its length.
fn refuse_at_feed(control: &Control, rests: bool) -> Result<()> {
    if !rests {
        return PostCode::Frame.err_with(
            "the machine turns, or a text or another work offset may have turned it, before a feed move; RAPID brings the tool there anew",
            RAPID_FIRST,
        );
    }
    if tip_control::ends_elsewhere(control) {
        return PostCode::Frame.err_with(
            "TCPC ends before a feed move, which would start elsewhere; put RAPID before it",
            RAPID_FIRST,
        );
    }
    Ok(())
}

/// The tool lies along an axis where the machine stands at zero, and it can stand there.
fn zero(chain: &AxisChain, axis: Vector3<f64>) -> bool {
    chain.reaches([0.0; 2]) && (axis - chain.tool.into_inner()).norm() < frame::SAME_AXIS
}

/// The angles from which the control takes the frame: those of its words, or where the rotary axes
/// stand to their last digits.
fn taken_by_frame(control: &Control, angles: [f64; 2]) -> Result<[f64; 2]> {
    if control.commons.read(loc::ROTARY_FRAME_FORM) == RotaryFrameForm::Angles {
        return Ok(angles);
    }
    let [first, second] = [0, 1].map(|n| control.tables.axis(n + 3).on_tape(angles[n]));
    Ok([first?, second?])
}

/// How the machine's axes lie in the part where its rotary axes stand.
fn turn_of(chain: &AxisChain, angles: [f64; 2]) -> Rotation3<f64> {
    let turns = chain.rotaries.iter().zip(angles).map(|(rotary, degrees)| match rotary {
        Some(rotary) => Rotation3::from_axis_angle(&rotary.direction, degrees.to_radians()),
        None => Rotation3::identity(),
    });
    turns.fold(Rotation3::identity(), |turn, next| turn * next)
}

/// Which rotary axes stand at the higher one of the two positions that bring the tool along
/// an axis, counted from -180 to 180 degrees.
fn higher(chain: &AxisChain, axis: Vector3<f64>, angles: [f64; 2]) -> [bool; 2] {
    let usual = |angle: f64| angle - 360.0 * (angle / 360.0).round();
    let solutions = chain.solutions(axis, angles);
    [0, 1].map(|n| {
        let here = usual(angles[n]);
        solutions.iter().any(|other| usual(other[n]) < here - frame::STILL)
    })
}

/// Refuses a frame whose angles, rounded, want the machine elsewhere: where it reaches a tool
/// axis only just, or any turn of an axis leaves it as it is.
fn check_rounded(chain: &AxisChain, turn: Rotation3<f64>, angles: [f64; 2]) -> Result<()> {
    let near = |found: [f64; 2]| found.iter().zip(angles).all(|(a, b)| (a - b).abs() < ELSEWHERE);
    match chain.solve(turn * Vector3::z(), angles) {
        Ok(found) if near(found) => Ok(()),
        _ => PostCode::Frame.err_with(
            "the tool axis lies at a pole of the machine or at the end of what it reaches, and the \
             angles of a tilted work plane can't name it exactly enough",
            "Lay the part otherwise on the machine, or write positions of the axes with \
             rotary.frame_output = 0.",
        ),
    }
}

/// What brings the tool away from the part before the machine turns for a frame.
#[derive(Clone, Copy, Debug)]
enum Away {
    /// Nothing need, or it is.
    Stays,
    /// A way up to a level of the machine's Z.
    To(f64),
}

/// How the tool comes away where the machine turns to these angles.
///
/// # Errors
/// Nothing says how; the tool stands in a cut above the level, or nobody knows how high.
fn away(post: &Post, stands: [f64; 2]) -> Result<Away> {
    let control = &post.control;
    if control.tip.is_away {
        return Ok(Away::Stays);
    }
    if frame::leans(control.tables.chain(), stands) {
        return PostCode::Frame.err(
            "the head is tilted, and straight up to home.retract_z would not be along the tool: put GOHOME or RETRCT before it",
        );
    }
    let Some(level) = control.commons.dbl_opt(loc::HOME_RETRACT_Z) else {
        return PostCode::Frame.err(
            "the rotary axes would turn next to the part: no tool change, GOHOME or RETRCT came before, and no retract height is known",
        );
    };
    height::refuse_shifted(control, level)?;
    if !height::is_above(control, level)? {
        return Ok(Away::To(level));
    }
    if post.path.last.in_cut {
        return PostCode::Frame.err_with(
            "the machine would turn in the cut, which lies above home.retract_z",
            "Retract with RAPID and GOTO before the new tool axis, or set a retract height above the part.",
        );
    }
    Ok(Away::Stays)
}

/// Turns the rotary axes, where nothing is beside the tool.
fn turn_machine(post: &mut Post, away: Away, angles: [f64; 2]) -> Result<()> {
    if let Away::To(level) = away {
        machine_position::carry_out(post, [None, None, Some(level)])?;
    }
    let position = [0.0, 0.0, 0.0, angles[0], angles[1]];
    let motion = Motion::new(position, AxisSet::ROTARY, 0);
    let cause = post.control.block.cause;
    family::rapid(&mut post.control, &motion, RapidCode::Turning, cause)
}
