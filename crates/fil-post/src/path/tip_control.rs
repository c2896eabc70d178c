//! Tool-tip control: X, Y and Z name the tip in the part, and the control moves its axes
//! so that the tip goes straight while the machine turns.
//!
//! It begins before the first motion of a tool and ends before the next tool, a position
//! of the machine, another work offset and the end of the program. Controls agree in what
//! it means where their tables stand at zero, so the tables turn there first, unless
//! `rotary.tip_control` says that the control takes the part as it lies; they turn only
//! where a tool change or a position of the machine has brought the tool away.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::Carries;
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self as loc, RotaryTipControl};
use nalgebra::{Point3, Vector3};

use super::height::{pose, slides};
use super::pole::spelled;
use super::position::Solution;
use super::{frame, frame_end, position, rapid, tip, turned_apart};
use crate::control::needs::Act;
use crate::control::word_address::cycle;
use crate::control::{Control, Function};
use crate::control::{family, machine_frame, vectors};
use crate::control_state::{Compensation, Meaning, Source, modal};
use crate::errors::PostCode;
use crate::operation::motion::{Motion, RapidCode};
use crate::operation::{Operation, Target};
use crate::post::Post;

/// What helps where something can't be done under it.
pub(super) const OUTSIDE: &str = "Outside MULTAX/ON, cuts along Z with the rotary axes at zero are output without TCPC after a tool change or GOHOME, and all moves with rotary.frame_output = 1; with rotary.tip_output = 0 nothing is output under TCPC.";

/// What helps where the tool can't go up before its length is taken off.
const WHERE_IT_STANDS: &str = "Put a GOTO after the text or the words that move the tool, or set rotary.tip_end_retract = 0 for a control that does not move at G49.";

/// The machine chooses by itself which motions go under TCPC: it has no tilted work planes for those
/// outside of MULTAX/ON.
fn chooses(post: &Post) -> bool {
    post.control.tables.tip_output && !post.control.tables.frame_output
}

/// Chooses between TCPC and positions of the axes for a motion outside of MULTAX/ON: where no record
/// gives a tool axis, the tool lies as it does with all rotary axes at zero, and they are there or may
/// turn there away from the part, the program is that of a machine without them.
pub(super) fn choose(post: &mut Post, target: Target, at_feed: bool) {
    if !chooses(post) {
        return;
    }
    let chain = post.control.tables.chain();
    let (_, axis) = position::transformed(post, target);
    let is_along = (axis.normalize() - chain.tool.into_inner()).norm() < frame::SAME_AXIS;
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let may_turn = post.control.tip.is_away && !at_feed;
    let turns = !frame::still(stands, [0.0; 2]);
    // Active TCPC stays, as its end would come in the cut.
    let is_free = !post.control.may_name_tip();
    let is_in_three_axes = is_free && is_along && !post.path.axis.is_said;
    post.path.is_upright = is_in_three_axes && (!turns || may_turn) && chain.reaches([0.0; 2]);
    if post.path.is_upright && turns && !post.writes_tip() {
        post.path.turning.chosen = Some([0.0; 2]);
    }
}

/// Ends TCPC before a motion that is output without it: the tool is at the part then.
///
/// # Errors
/// As [`end`].
pub(super) fn end_outside(post: &mut Post) -> Result<()> {
    if !chooses(post) || post.writes_tip() {
        return Ok(());
    }
    end(&mut post.control)?;
    post.control.tip.is_away = false;
    Ok(())
}

/// Begins tool-tip control before a motion, where it is not on: where the tables stand then is
/// where the motion turns them from.
///
/// # Errors
/// As [`begin`].
pub(super) fn ready(post: &mut Post, target: Target) -> Result<()> {
    if post.control.state.is(modal::TCP, true) {
        return Ok(());
    }
    let (point, axis) = position::transformed(post, target);
    begin(post, point, axis)
}

/// The words of a motion to a point: the tip, and the angles of the rotary axes.
///
/// # Errors
/// A tool axis out of reach, a position outside the travel.
#[cold]
pub(super) fn position_of(
    post: &Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<(Position, Solution)> {
    let last = position::nearest_to(post);
    let tables = &post.control.tables;
    let (angles, free) = tables.chain().solve_with_free(axis, last)?;
    let linear = tables.chain().linear(point, angles);
    tables.check_travel(&[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    let by_vector = post.control.tip.by_vector && takes_vector(post, angles, axis)?;
    let position = [point.x, point.y, point.z, angles[0], angles[1]];
    Ok((position, Solution::OfTip { angles, free, by_vector }))
}

/// The next motion says the direction of the tool by a vector, where the machine does: all
/// motions where the control takes no angles then, else those at feed.
pub(super) fn say_by_vector(post: &mut Post, at_feed: bool) {
    let tables = &post.control.tables;
    post.control.tip.by_vector =
        tables.tip_vectors && (at_feed || !post.control.can().angles_beside_vectors);
}

/// True where the control brings the tool along a direction by these positions of the rotary axes;
/// false where it could take others, and takes angles instead.
///
/// # Errors
/// It takes no angles.
fn takes_vector(post: &Post, angles: [f64; 2], axis: Vector3<f64>) -> Result<bool> {
    let stands = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let tables = &post.control.tables;
    let solutions = tables.chain().solutions(axis, stands);
    if vectors::stand_known(&post.control) && vectors::say_the_same(&solutions, stands, angles) {
        return Ok(true);
    }
    if post.control.can().angles_beside_vectors {
        return Ok(false);
    }
    let message = format!(
        "the rotary axes turn from {} to {} degrees, and for the same direction of the tool the \
         control may take other positions",
        spelled(stands),
        spelled(angles)
    );
    PostCode::TipControl.err_with(message, vectors::SAY_ANGLES)
}

/// Activates tool center point control; the first motion ends at `point` with the tool along `axis`.
///
/// # Errors
/// No tool whose length the control has; cutter compensation; tables that would turn
/// beside the part.
fn begin(post: &mut Post, point: Point3<f64>, axis: Vector3<f64>) -> Result<()> {
    let control = &mut post.control;
    control.begin()?;
    control.require_unit()?;
    control.ready_for(Act::TcpOn)?;
    cycle::cancel(control)?;
    let in_doubt = control.state.get(modal::TCP).is_none();
    let length_is_called = std::mem::take(&mut control.tip.length_is_called);
    let comes_down = length_is_called && !in_doubt;
    let is_up = comes_down && go_up_in_frame(post)?;
    frame::end(&mut post.control)?;
    post.path.frame = None;
    let control = &mut post.control;
    control.ready_tip_length()?;
    let of_tool = control.tip.offset;
    if of_tool.is_none() && control.can().length_functions {
        return PostCode::TipControl
            .err("TCPC activates a tool length offset, and no LOADTL came before");
    }
    control.flush_function(Function::WorkOffset)?;
    if comes_down && !is_up {
        go_up_with_length(control)?;
    }
    if post.control.tip.by_vector || post.control.tables.turns_at_top {
        turn_to_first_axis(post, point, axis)?;
    }
    turn_tables_to_zero(post)?;
    let known = vectors::stand_known(&post.control);
    let stands = post.path.rotary.filter(|_| known);
    let control = &mut post.control;
    control.take_length()?;
    if in_doubt || length_is_called {
        family::end_tip_control(control)?;
    }
    control.family().begin_tip_control(control, of_tool)?;
    control.tip.is_away = false;
    control.tip.leans = stands;
    names_tip(control, stands)
}

/// From now on X, Y and Z are those of the tip: where the axes stood is said as its place, and
/// is not known where one of them is not.
///
/// # Errors
/// A place that its address can't hold.
fn names_tip(control: &mut Control, rotary: Option<[f64; 2]>) -> Result<()> {
    let is_said = |number: usize| {
        let letter = control.tables.axis(number).letter;
        control.axis_position(number).is_some() && control.state.has_last(letter)
    };
    control.tip.begins_unsaid = rotary != Some([0.0; 2]) || !(0..3).all(is_said);
    let [x, y, z] = [0, 1, 2].map(|number| control.stands(number));
    let tip = match (x, y, z, rotary) {
        (Some(x), Some(y), Some(z), Some([first, second])) => {
            Some(tip::tip(control.tables.chain(), &[x, y, z, first, second]))
        }
        _ => None,
    };
    for number in AxisSet::LINEAR.numbers() {
        let axis = *control.tables.axis(number);
        match tip {
            Some(tip) => control.state.stand(axis.letter, axis.value(tip[number])?),
            None if control.stands(number).is_some() => {
                control.state.shifts(axis.letter, Source::Post)
            }
            None => {}
        }
    }
    Ok(())
}

/// Turns the rotary axes by angles to where the first motion has them, where a vector could
/// turn them otherwise or the machine turns at its top: the control begins anywhere, and the tool is
/// away from the part. Over tables X and Y go there too, so that the first motion comes down alone.
///
/// # Errors
/// The machine can't reach the tool axis.
fn turn_to_first_axis(post: &mut Post, point: Point3<f64>, axis: Vector3<f64>) -> Result<()> {
    let control = &post.control;
    let anywhere = control.commons.read(loc::ROTARY_TIP_CONTROL) == RotaryTipControl::Anywhere;
    if !(anywhere && control.tip.is_away) {
        return Ok(());
    }
    let angles = control.tables.chain().solve(axis, position::nearest_to(post))?;
    let position = [0.0, 0.0, 0.0, angles[0], angles[1]];
    let motion = Motion::new(position, AxisSet::ROTARY, 0);
    let cause = post.control.block.cause.whole();
    rapid::rapid(&mut post.control, &motion, cause)?;
    post.path.rotary = Some(angles);
    let tables = &post.control.tables;
    if !tables.turns_at_top || tables.chain().has_heads() {
        return Ok(());
    }
    let slides = tables.chain().linear(point, angles);
    let over = Motion::new([slides.x, slides.y, slides.z, 0.0, 0.0], AxisSet::XY, 0);
    rapid::rapid(&mut post.control, &over, cause)
}

/// Turns the tables to zero, where the control needs that.
///
/// # Errors
/// The tool may stand at the part; a table that does not reach zero.
fn turn_tables_to_zero(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    let anywhere = control.commons.read(loc::ROTARY_TIP_CONTROL) == RotaryTipControl::Anywhere;
    if anywhere {
        return Ok(());
    }
    let mut tables = AxisSet::NONE;
    let mut stands = post.path.rotary.unwrap_or([0.0; 2]);
    for (index, rotary) in control.tables.chain().rotaries.iter().enumerate() {
        let Some(rotary) = rotary.as_ref().filter(|rotary| rotary.carries == Carries::Table) else {
            continue;
        };
        if !rotary.goes(stands[index], 0.0) {
            let letter = rotary.letter;
            return PostCode::TipControl.err_with(
                format!("TCPC starts with {letter} at 0, which is outside its travel"),
                "A control that takes the part as it lies needs no zero: rotary.tip_control = 1.",
            );
        }
        stands[index] = 0.0;
        let number = index + 3;
        let axis = control.tables.axis(number);
        if control.axis_position(number).map(|at| axis.near(at, 0.0)) != Some(0.0) {
            tables = tables.or(AxisSet::of(number));
        }
    }
    if !tables.is_empty() && !control.tip.is_away {
        return PostCode::TipControl.err_with(
            "TCPC would restart with its tables at 0, and they would turn next to the part; put a tool change before it",
            "Put LOADTL before it; a control that takes the part as it lies needs no zero: \
             rotary.tip_control = 1.",
        );
    }
    let motion = Motion::new(Position::default(), tables, 0);
    let cause = control.block.cause.whole();
    if !tables.is_empty() {
        rapid::rapid(control, &motion, cause)?;
    }
    post.path.rotary = Some(stands);
    Ok(())
}

/// True where tool-tip control may be on, and the program can't say where the tool stands behind
/// its end.
pub(super) fn ends_elsewhere(control: &Control) -> bool {
    control.may_name_tip() && control.can().length_functions
}

/// Ends tool-tip control where it may be on; what goes to a position of the machine next
/// still has the length of the tool, with its motion of Z.
///
/// # Errors
/// The machine has no code for it; as the way up that comes before it.
pub fn end(control: &mut Control) -> Result<()> {
    if !control.may_name_tip() {
        return Ok(());
    }
    let goes_up = control.can().length_functions && go_up(control)?;
    let slides = if goes_up { None } else { slides(control) };
    family::end_tip_control(control)?;
    for number in AxisSet::LINEAR.numbers() {
        let axis = *control.tables.axis(number);
        let last = control.commons.last_output(axis.letter);
        control.state.remember(axis.letter, last);
        control.commons.set_last_output(axis.letter, EMPTY);
        match slides {
            _ if goes_up => control.state.clears(axis.letter, None),
            Some(slides) => control.state.stand(axis.letter, axis.value(slides[number])?),
            None => control.state.loses_by_post(axis.letter),
        }
    }
    if control.can().length_functions {
        control.await_length(control.tip.offset);
    }
    Ok(())
}

/// How far the tool goes up before G49, mm or inch; `None` for a control at which it may stay.
///
/// # Errors
/// The unit is not known.
fn way_up(control: &Control) -> Result<Option<f64>> {
    let distance = control.commons.dbl_opt(loc::ROTARY_TIP_END_RETRACT).unwrap_or(0.0);
    if distance <= 0.0 {
        return Ok(None);
    }
    Ok(Some(distance / control.require_unit()?.in_mm()))
}

/// Goes up along the tool before G49, at which a control may come down by the length of the
/// tool; says whether it did.
///
/// # Errors
/// Where the tool stands is not known; a position outside the travel; cutter compensation.
fn go_up(control: &mut Control) -> Result<bool> {
    let Some(distance) = way_up(control)? else { return Ok(false) };
    let Some((tip, angles)) = pose(control) else {
        return PostCode::TipControl.err_with(
            "TCPC ends at an unknown tool position: the tool can't retract before it (rotary.tip_end_retract)",
            WHERE_IT_STANDS,
        );
    };
    let chain = control.tables.chain();
    let up = tip + chain.axis_at(angles) * distance;
    let linear = chain.linear(up, angles);
    check_way_up(control, &[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    rapid_to(control, [up.x, up.y, up.z, 0.0, 0.0], AxisSet::LINEAR)?;
    Ok(true)
}

/// Goes up along Z of the frame of a leaning head, before it ends and a G49 takes off the length
/// of the tool; says whether such a frame is in force.
///
/// # Errors
/// As [`frame_end::go_up_by`].
fn go_up_in_frame(post: &mut Post) -> Result<bool> {
    match way_up(&post.control)? {
        Some(distance) => frame_end::go_up_by(post, distance),
        None => Ok(false),
    }
}

/// Goes up in Z before a G49 that takes off the length with which the tool was brought to a
/// position of the machine: the control may come down by it there, too. A tool change since then
/// has brought the tool away.
///
/// # Errors
/// As [`go_up`].
fn go_up_with_length(control: &mut Control) -> Result<()> {
    let Some(distance) = way_up(control)? else { return Ok(()) };
    if control.state.may_be_clear(control.tables.axis(2).letter) {
        return Ok(());
    }
    let Some(z) = control.stands(2) else {
        return PostCode::TipControl.err_with(
            "the tool length offset is cancelled before TCPC starts, at an unknown Z: the tool can't retract before it (rotary.tip_end_retract)",
            WHERE_IT_STANDS,
        );
    };
    let position = [0.0, 0.0, z + distance, 0.0, 0.0];
    check_way_up(control, &position, AxisSet::Z)?;
    rapid_to(control, position, AxisSet::Z)
}

/// Refuses a way up that ends outside the travel.
///
/// # Errors
/// It does.
fn check_way_up(control: &Control, to: &Position, axes: AxisSet) -> Result<()> {
    control.tables.check_travel(to, axes).map_err(|diag| {
        Box::new(diag.hint(
            "The tool retracts by rotary.tip_end_retract before TCPC ends; reduce it, or set 0 for a control that does not move at G49.",
        ))
    })
}

fn rapid_to(control: &mut Control, position: Position, axes: AxisSet) -> Result<()> {
    let motion = Motion::new(position, axes, 0);
    let cause = control.block.cause.whole();
    family::rapid(control, &motion, RapidCode::Along, cause)
}

/// Refuses a level of the machine's Z behind the end of tool-tip control, where a head leans another
/// tool than before: how far up along it the level lies is not known.
///
/// # Errors
/// It does, and the control does not go up along the tool before.
pub(super) fn settle_level(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    if !control.may_name_tip() || machine_frame::is_meant(control) {
        return Ok(());
    }
    let goes_up = ends_elsewhere(control) && way_up(control)?.is_some();
    if goes_up { Ok(()) } else { turned_apart::settle_level(post) }
}

/// What an operation that is no motion of the path asks of tool-tip control.
///
/// # Errors
/// Cutter compensation, and functions that controls take in different ways under it.
pub(super) fn before(post: &mut Post, operation: &Operation) -> Result<()> {
    if !post.control.tables.tip_output {
        return Ok(());
    }
    if matches!(operation, Operation::End(_)) {
        // It ends for who leaves the blocks of OPSKIP out, too.
        post.control.skip_blocks(false)?;
    }
    if let Operation::MachinePosition([_, _, Some(_)]) = operation {
        settle_level(post)?;
    }
    let control = &mut post.control;
    let what = match operation {
        Operation::MachinePosition(_) | Operation::WorkOffset(_) | Operation::End(_) => {
            return end(control);
        }
        Operation::Compensation(wanted) if wanted.side != Compensation::Off => "CUTCOM",
        Operation::Function(letter, code) if *letter == fil_machine::letters::G => {
            match control.meaning(*code) {
                Meaning::Origin(_) | Meaning::Cycle | Meaning::Plane(_) | Meaning::Unit(_) => {
                    "PREFUN"
                }
                _ => return Ok(()),
            }
        }
        _ => return Ok(()),
    };
    if control.state.is(modal::TCP, false) {
        return Ok(());
    }
    let message = format!("{what}: controls differ in what it does under it");
    PostCode::TipControl.err_with(message, OUTSIDE)
}
