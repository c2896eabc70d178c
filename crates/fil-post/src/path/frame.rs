//! Tilted frames: while the tool axis stands still, X, Y and Z count in a frame of the
//! control that lies as the machine's axes do when the tables and heads have turned there.
//!
//! So arcs and cycles stay what they are on the face they are cut on. The machine turns
//! where a tool change or a position of the machine has brought the tool away, or after a
//! way up to `home.retract_z`; then the frame begins. It ends before the next tool, a
//! position of the machine, another work offset and the end of the program.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use fil_machine::commons::EMPTY;
use fil_machine::locations as loc;
use nalgebra::{Point3, Rotation3, Vector3};

use super::rotary::Solution;
use super::{height, machine_position, rotary, tip_control};
use crate::control::needs::Act;
use crate::control::word_address::motion::{Motion, RapidCode};
use crate::control::{Control, Function, family, full_turn};
use crate::control_state::{Meaning, modal};
use crate::errors::PostCode;
use crate::operation::{Operation, Target};
use crate::post::Post;

/// What helps where the tool would begin elsewhere at feed.
const RAPID_FIRST: &str = "Put RAPID before the GOTO.";

/// Two tool axes nearer than this are one.
const SAME_AXIS: f64 = 1e-6;

/// A smaller turn of a rotary axis counts as none, degrees.
const STILL: f64 = 1e-9;

/// A rotary axis that would turn by more for the angles on the tape stands elsewhere, degrees.
const ELSEWHERE: f64 = 0.05;

/// The frame that motions are written in.
#[derive(Clone, Copy, Debug)]
pub struct TiltedFrame {
    /// Tool axis in the part.
    axis: Vector3<f64>,
    /// Where the rotary axes stand, degrees.
    angles: [f64; 2],
    /// Turns directions of the frame, as the tape has it, into those of the part; `None`
    /// where the machine stands at zero and the control is in no frame.
    turn: Option<Rotation3<f64>>,
}

/// The words of a motion to a point, in the frame in force.
///
/// # Errors
/// None is in force for this tool axis; a position outside the travel.
#[cold]
pub(super) fn position_of(
    post: &Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<(Position, Solution)> {
    let frame = along(post, normalized(axis)?).filter(|frame| is_in_force(&post.control, frame));
    let Some(frame) = frame else {
        return PostCode::Frame.err("no tilted frame has begun for this tool axis");
    };
    let tables = &post.control.tables;
    let linear = tables.chain().linear(point, frame.angles);
    tables.check_travel(&[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    let point = frame.turn.map_or(point, |turn| turn.inverse() * point);
    let [first, second] = frame.angles;
    Ok(([point.x, point.y, point.z, first, second], Solution::InFrame))
}

/// Refuses a point on the way, as the words of the frame in force name it, outside the travel
/// of X, Y and Z.
///
/// # Errors
/// It lies outside.
pub(super) fn check_on_the_way(post: &Post, point: [f64; 3]) -> Result<()> {
    let Some(frame) = post.path.frame else { return Ok(()) };
    let point = Point3::from(point);
    let point = frame.turn.map_or(point, |turn| turn * point);
    let at = post.control.tables.chain().linear(point, frame.angles);
    post.control.tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], AxisSet::LINEAR)
}

/// The direction of a tool axis.
fn normalized(axis: Vector3<f64>) -> Result<Vector3<f64>> {
    axis.try_normalize(1e-9)
        .ok_or_else(|| PostCode::AxisLength.diag("the tool axis has length zero"))
}

/// The frame that motions were last written in, where it is that of a tool axis.
fn along(post: &Post, axis: Vector3<f64>) -> Option<TiltedFrame> {
    post.path.frame.filter(|frame| (frame.axis - axis).norm() < SAME_AXIS)
}

/// The control is in a frame, and the machine stands as it wants it.
fn is_in_force(control: &Control, frame: &TiltedFrame) -> bool {
    control.state.is(modal::WORK_PLANE, frame.turn.is_some()) && stands_at(control, frame.angles)
}

/// Brings the machine and the control into the frame of a target; says whether it began
/// there.
///
/// # Errors
/// A motion at feed that would turn the machine; as [`begin`].
#[cold]
pub(super) fn turn_to(post: &mut Post, target: Target, at_feed: bool) -> Result<bool> {
    let axis = normalized(rotary::transformed(post, target).1)?;
    let same = along(post, axis);
    if same.is_some_and(|frame| is_in_force(&post.control, &frame)) {
        post.path.turning.chosen = None;
        return Ok(false);
    }
    if at_feed && same.is_none() && post.path.frame.is_some() && !post.control.tip.is_away {
        return PostCode::Frame.err_with(
            "the tool axis changes in a motion at feed, and a tilted frame stands still; \
             rotary.tip_output = 1 takes it under MULTAX/ON",
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
    control.require(Act::WorkPlaneOn)?;
    family::cancel_cycle(control)?;
    control.flush_function(Function::WorkOffset)?;
    let stands = post.path.rotary.unwrap_or_else(|| rotary::on_tape(post));
    let near = post.path.turning.chosen.take().unwrap_or(stands);
    let chain = post.control.tables.chain();
    let angles = match zero(chain, axis) {
        true => [0.0; 2],
        false => chain.solve(axis, near)?,
    };
    let turn = turn_of(chain, angles);
    let known = knows_rotary(&post.control);
    let rests = known && still(stands, angles);
    if at_feed && !post.control.tip.is_away && post.path.point.is_some() {
        refuse_at_feed(&post.control, rests)?;
    }
    let away = if rests { None } else { Some(away(post, stands)?) };
    tip_control::end(&mut post.control)?;
    end(&mut post.control)?;
    if let Some(away) = away {
        turn_machine(post, away, angles)?;
    }
    let flat = (turn.matrix() - Rotation3::identity().matrix()).amax() < SAME_AXIS;
    let higher = higher(post.control.tables.chain(), axis, angles);
    let turn = match flat {
        true => None,
        false => Some(family::begin_frame(&mut post.control, &turn, higher)?),
    };
    if let Some(turn) = turn {
        check_rounded(post.control.tables.chain(), turn, angles)?;
        forget_positions(&mut post.control, true);
        post.control.tip.frame = Some((turn, angles));
    }
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
            "the machine turns, or a text or another work offset may have turned it, before a \
             motion at feed; RAPID brings the tool there anew",
            RAPID_FIRST,
        );
    }
    if tip_control::ends_elsewhere(control) {
        return PostCode::Frame.err_with(
            "tool-tip control ends before a motion at feed, which would begin elsewhere; RAPID \
             brings the tool there anew",
            RAPID_FIRST,
        );
    }
    Ok(())
}

/// The tool lies along an axis where the machine stands at zero, and it can stand there.
fn zero(chain: &AxisChain, axis: Vector3<f64>) -> bool {
    chain.reaches([0.0; 2]) && (axis - chain.tool.into_inner()).norm() < SAME_AXIS
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
        solutions.iter().any(|other| usual(other[n]) < here - STILL)
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
             angles of a tilted frame can't name it exactly enough",
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
    if leans(control.tables.chain(), stands) {
        return PostCode::Frame.err(
            "a head leans the tool, and straight up to home.retract_z would not be along it: \
             GOHOME or RETRCT must bring it away",
        );
    }
    let Some(level) = control.commons.dbl_opt(loc::HOME_RETRACT_Z) else {
        return PostCode::Frame.err(
            "the machine would turn beside the part: no tool change, GOHOME or RETRCT came \
             before, and no level to go up to is known",
        );
    };
    height::refuse_shifted(control, level)?;
    if !height::is_above(control, level)? {
        return Ok(Away::To(level));
    }
    if post.path.last.in_cut {
        return PostCode::Frame.err_with(
            "the machine would turn in the cut, which lies above home.retract_z",
            "Bring the tool out by RAPID and GOTO before the new tool axis, or name a level above \
             the part.",
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

/// The rotary axes need not turn.
fn still(from: [f64; 2], to: [f64; 2]) -> bool {
    from.iter().zip(to).all(|(from, to)| (from - to).abs() <= STILL)
}

/// A head holds the tool away from the machine's Z.
pub(super) fn leans(chain: &AxisChain, angles: [f64; 2]) -> bool {
    (chain.tool_at(angles) - chain.tool.into_inner()).norm() > SAME_AXIS
}

/// The control has the rotary axes at these angles, to their last digits.
fn stands_at(control: &Control, angles: [f64; 2]) -> bool {
    knows_rotary(control)
        && control.tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
            let (axis, angle) = (control.tables.axis(number), angles[number - 3]);
            let here = control.axis_position(number).map(|here| axis.near(here, angle));
            here.is_some_and(|here| (here - angle).abs() <= axis.resolution())
        })
}

/// The rotary axes stand at these angles, to their last digits, whoever has brought them there.
pub(super) fn rests(control: &Control, angles: [f64; 2]) -> bool {
    control.tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
        let (axis, angle) = (control.tables.axis(number), angles[number - 3]);
        let stands = control.stands(number);
        stands.is_some_and(|at| (axis.near(at, angle) - angle).abs() <= axis.resolution())
    })
}

/// Refuses a text that turns the machine in a tilted frame, which stands still: where X, Y and Z
/// count from then, no control says alike.
///
/// # Errors
/// It does.
pub(super) fn refuse_turned(control: &Control, stood: [Option<f64>; 2]) -> Result<()> {
    let is_in_frame = control.tables.frame_output && control.state.is(modal::WORK_PLANE, true);
    let turned = |n: usize| control.stands(n + 3).is_some() && control.stands(n + 3) != stood[n];
    if is_in_frame && (0..2).any(turned) {
        return PostCode::Frame.err_with(
            "a text turns a rotary axis in a tilted frame",
            "Put it behind GOHOME or LOADTL, where no frame is in force.",
        );
    }
    Ok(())
}

/// The control has the rotary axes where the program has last brought them.
fn knows_rotary(control: &Control) -> bool {
    let tables = &control.tables;
    tables.present().and(AxisSet::ROTARY).numbers().all(|number| {
        let letter = tables.axis(number).letter;
        control.commons.last_output(letter) != EMPTY && control.state.has_last(letter)
    })
}

/// Where X, Y and Z stand in another frame is not known; the rotary axes stay.
fn forget_positions(control: &mut Control, knows_rotary: bool) {
    for number in AxisSet::ROTARY.numbers().filter(|_| knows_rotary) {
        let letter = control.tables.axis(number).letter;
        control.state.trust(letter);
    }
    for number in AxisSet::LINEAR.numbers() {
        let letter = control.tables.axis(number).letter;
        control.commons.set_last_output(letter, EMPTY);
        control.state.clears(letter);
    }
}

/// Ends a tilted frame where the control may be in one.
///
/// # Errors
/// The machine has no code for it; blocks that may be skipped.
pub fn end(control: &mut Control) -> Result<()> {
    if !control.may_be_tilted() {
        return Ok(());
    }
    control.require(Act::WorkPlaneOff)?;
    family::cancel_cycle(control)?;
    let known = knows_rotary(control);
    let slides = height::slides_in_frame(control);
    family::end_frame(control)?;
    control.state.set(modal::WORK_PLANE, false);
    forget_positions(control, known);
    match slides {
        Some(slides) => height::stand(control, slides),
        None => Ok(()),
    }
}

/// What an operation that is no motion of the path asks of a tilted frame.
///
/// # Errors
/// Functions that would change the frame.
pub(super) fn before(control: &mut Control, operation: &Operation) -> Result<()> {
    if !control.tables.frame_output {
        return Ok(());
    }
    match operation {
        Operation::MachinePosition(_) | Operation::WorkOffset(_) | Operation::End(_) => {
            end(control)
        }
        Operation::Function(letter, code)
            if *letter == fil_machine::letters::G
                && !control.state.is(modal::WORK_PLANE, false) =>
        {
            match control.meaning(*code) {
                Meaning::Origin(_) | Meaning::WorkPlane | Meaning::Tcpc | Meaning::Unit(_) => {
                    PostCode::Frame.err_with(
                        "PREFUN: the function would move the frame in force",
                        "Put it where the tool stands along Z of the machine, or write positions \
                         of the axes with rotary.frame_output = 0.",
                    )
                }
                _ => Ok(()),
            }
        }
        _ => Ok(()),
    }
}
