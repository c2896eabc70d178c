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
use fil_machine::locations::{self as loc, ControlFamily, RotaryTipControl};
use nalgebra::{Point3, Vector3};

use super::cycle::{AboveHoles, Cycle, CycleFeed, CycleKind};
use super::expand::{WayOut, way_out};
use super::turning::spelled;
use super::{Since, frame, linear, rapid, rotary};
use crate::control::word_address::motion::{Motion, RapidCode};
use crate::control::word_address::spindle;
use crate::control::{Control, Function};
use crate::control::{family, vectors};
use crate::control_state::{Compensation, Meaning};
use crate::errors::PostCode;
use crate::operation::{Dwell, MotionKind, Operation, Target};
use crate::post::Post;

/// Least part of a way along the tool that must lead up to the level of the next hole.
const LEAST_WAY_UP: f64 = 0.2;

/// Heights nearer than this are one, mm or inch.
const SAME_HEIGHT: f64 = 1e-9;

/// The words of a motion to a point: the tip, and the angles of the rotary axes.
///
/// # Errors
/// A tool axis out of reach, a position outside the travel; as [`begin`].
#[cold]
pub(super) fn position_of(
    post: &mut Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<Position> {
    if post.control.state.tip_control != Some(true) {
        begin(post, axis)?;
    }
    let near = post.path.chosen.take().or(post.path.rotary);
    let last = near.unwrap_or_else(|| rotary::on_tape(post));
    let tables = &post.control.tables;
    let (angles, free) = tables.chain().solve_with_free(axis, last)?;
    let linear = tables.chain().linear(point, angles);
    tables.check_travel(&[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    if post.control.tip.by_vector {
        check_vector(post, angles, axis)?;
    }
    post.path.rotary = Some(angles);
    post.path.free = Some(free);
    Ok([point.x, point.y, point.z, angles[0], angles[1]])
}

/// The next motion says the direction of the tool by a vector, where the machine does: all
/// motions where the control takes no angles then, else those at feed.
pub(super) fn say_by_vector(post: &mut Post, at_feed: bool) {
    let tables = &post.control.tables;
    post.control.tip.by_vector =
        tables.tip_vectors && (at_feed || !vectors::takes_angles_too(tables.family));
}

/// Takes angles instead where the control could bring the tool along a direction by other
/// positions of the rotary axes.
///
/// # Errors
/// It takes no angles.
fn check_vector(post: &mut Post, angles: [f64; 2], axis: Vector3<f64>) -> Result<()> {
    let stands = post.path.rotary.unwrap_or_else(|| rotary::on_tape(post));
    let tables = &post.control.tables;
    let solutions = tables.chain().solutions(axis, stands);
    if vectors::stand_known(&post.control) && vectors::say_the_same(&solutions, stands, angles) {
        return Ok(());
    }
    if vectors::takes_angles_too(tables.family) {
        post.control.tip.by_vector = false;
        return Ok(());
    }
    PostCode::TipControl.err(format!(
        "the rotary axes turn from {} to {} degrees, and for the same direction of the tool the \
         control may take other positions",
        spelled(stands),
        spelled(angles)
    ))
}

/// Begins tool-tip control. `axis`: the tool at the end of the first motion.
///
/// # Errors
/// No tool whose length the control has; cutter compensation; tables that would turn
/// beside the part.
fn begin(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    let control = &mut post.control;
    control.begin()?;
    control.require_unit()?;
    if control.is_compensated() {
        return PostCode::CompensationOn.err("where tool-tip control begins");
    }
    family::cancel_cycle(control)?;
    frame::end(control)?;
    post.path.frame = None;
    let control = &mut post.control;
    let of_tool = control.tip.offset;
    if of_tool.is_none() && control.tables.family == ControlFamily::WordAddress {
        return PostCode::TipControl
            .err("tool-tip control takes up the length of a tool, and no LOADTL came before");
    }
    control.flush_function(Function::WorkOffset)?;
    if post.control.tip.by_vector {
        turn_to_first_axis(post, axis)?;
    }
    turn_tables_to_zero(post)?;
    let known = vectors::stand_known(&post.control);
    let stands = post.path.rotary.filter(|_| known);
    let control = &mut post.control;
    control.waiting.length_offset = None;
    let in_doubt = control.state.tip_control.is_none();
    if in_doubt || std::mem::take(&mut control.tip.length_is_called) {
        family::end_tip_control(control)?;
    }
    family::begin_tip_control(control, of_tool)?;
    control.tip.is_away = false;
    control.tip.leans = stands;
    Ok(())
}

/// Turns the rotary axes by angles to where the first motion has them, where a vector could
/// turn them otherwise: the control begins anywhere, and the tool is away from the part.
///
/// # Errors
/// The machine can't reach the tool axis.
fn turn_to_first_axis(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    let control = &post.control;
    let anywhere =
        control.commons.read(loc::ROTARY_TIP_CONTROL) == RotaryTipControl::BeginsAnywhere;
    if !(anywhere && control.tip.is_away) {
        return Ok(());
    }
    let near = post.path.chosen.or(post.path.rotary);
    let near = near.unwrap_or_else(|| rotary::on_tape(post));
    let angles = control.tables.chain().solve(axis, near)?;
    let position = [0.0, 0.0, 0.0, angles[0], angles[1]];
    let motion = Motion { position, axes: AxisSet::ROTARY, word: 0 };
    let cause = post.control.block.cause.whole();
    rapid::rapid(&mut post.control, &motion, cause)?;
    post.path.rotary = Some(angles);
    Ok(())
}

/// Turns the tables to zero, where the control needs that.
///
/// # Errors
/// The tool may stand at the part; a table that does not reach zero.
fn turn_tables_to_zero(post: &mut Post) -> Result<()> {
    let control = &mut post.control;
    let anywhere =
        control.commons.read(loc::ROTARY_TIP_CONTROL) == RotaryTipControl::BeginsAnywhere;
    if anywhere {
        return Ok(());
    }
    let mut tables = AxisSet::NONE;
    let mut stands = post.path.rotary.unwrap_or([0.0; 2]);
    for (index, rotary) in control.tables.chain().rotaries.iter().enumerate() {
        let Some(rotary) = rotary.as_ref().filter(|rotary| rotary.carries == Carries::Table) else {
            continue;
        };
        if rotary.min.is_some_and(|min| min > 0.0) || rotary.max.is_some_and(|max| max < 0.0) {
            return PostCode::TipControl.err(format!(
                "tool-tip control begins with {} at 0, and its travel does not reach it",
                rotary.letter
            ));
        }
        stands[index] = 0.0;
        let number = index + 3;
        let axis = control.tables.axis(number);
        if control.axis_position(number).map(|at| axis.near(at, 0.0)) != Some(0.0) {
            tables = tables.or(AxisSet::of(number));
        }
    }
    if !tables.is_empty() && !control.tip.is_away {
        return PostCode::TipControl.err(
            "tool-tip control would begin anew with its tables at 0, and they would turn beside \
             the part; a tool change must come before",
        );
    }
    let motion = Motion { position: Position::default(), axes: tables, word: 0 };
    let cause = control.block.cause.whole();
    if !tables.is_empty() {
        rapid::rapid(control, &motion, cause)?;
    }
    post.path.rotary = Some(stands);
    Ok(())
}

/// Ends tool-tip control where it may be on; what goes to a position of the machine next
/// still has the length of the tool, with its motion of Z.
///
/// # Errors
/// The machine has no code for it; as the way up that comes before it.
pub fn end(control: &mut Control) -> Result<()> {
    if !control.tables.tip_output || control.state.tip_control == Some(false) {
        return Ok(());
    }
    if control.tables.family == ControlFamily::WordAddress {
        go_up(control)?;
    }
    family::end_tip_control(control)?;
    for number in AxisSet::LINEAR.numbers() {
        let letter = control.tables.axis(number).letter;
        control.commons.set_last_output(letter, EMPTY);
        control.state.clears(letter);
    }
    if control.tables.family == ControlFamily::WordAddress {
        control.waiting.length_offset = control.tip.offset;
    }
    Ok(())
}

/// Goes up along the tool before G49, at which a control may come down by the length of the
/// tool.
///
/// # Errors
/// Where the tool stands is not known; a position outside the travel; cutter compensation.
fn go_up(control: &mut Control) -> Result<()> {
    let distance = control.commons.dbl_opt(loc::ROTARY_TIP_END_RETRACT).unwrap_or(0.0);
    if distance <= 0.0 {
        return Ok(());
    }
    let distance = distance / control.require_unit()?.in_mm();
    let known = |number: &usize| {
        let letter = control.tables.axis(*number).letter;
        control.axis_position(*number).filter(|_| control.state.has_last(letter))
    };
    let mut position = Position::default();
    for number in control.tables.present().numbers() {
        let leans = control.tip.leans.filter(|_| number > 2).map(|leans| leans[number - 3]);
        let Some(stands) = known(&number).or(leans) else {
            return PostCode::TipControl.err(
                "tool-tip control ends, and where the tool stands is not known: it can't go up \
                 before (rotary.tip_end_retract)",
            );
        };
        position[number] = stands;
    }
    let chain = control.tables.chain();
    let angles = [position[3], position[4]];
    let tip = Point3::new(position[0], position[1], position[2]);
    let up = tip + chain.axis_at(angles) * distance;
    let linear = chain.linear(up, angles);
    control.tables.check_travel(&[linear.x, linear.y, linear.z, 0.0, 0.0], AxisSet::LINEAR)?;
    position[..3].copy_from_slice(&[up.x, up.y, up.z]);
    let motion = Motion { position, axes: AxisSet::LINEAR, word: 0 };
    let cause = control.block.cause.whole();
    family::rapid(control, &motion, RapidCode::Along, cause)
}

/// What an operation that is no motion of the path asks of tool-tip control.
///
/// # Errors
/// Cutter compensation, and functions that controls take in different ways under it.
pub(super) fn before(control: &mut Control, operation: &Operation) -> Result<()> {
    let what = match operation {
        Operation::MachinePosition(_) | Operation::WorkOffset(_) | Operation::End(_) => {
            return end(control);
        }
        Operation::Compensation(wanted) if wanted.side != Compensation::Off => "CUTCOM",
        Operation::Function(letter, code) if *letter == fil_machine::letters::G => {
            match control.meaning(*code) {
                Meaning::Frame | Meaning::Cycle | Meaning::Plane(_) | Meaning::Unit(_) => "PREFUN",
                _ => return Ok(()),
            }
        }
        _ => return Ok(()),
    };
    if control.state.tip_control == Some(false) {
        return Ok(());
    }
    PostCode::TipControl.err(format!("{what}: controls differ in what it does under it"))
}

/// Drills a hole in single moves along its axis.
///
/// # Errors
/// A tap; a level to return to that is not known; as a straight motion.
pub(super) fn hole(post: &mut Post, cycle: &mut Cycle, target: Target) -> Result<()> {
    let CycleFeed::Feed(feed) = cycle.feed else { return cant_tap() };
    if cycle.kind == CycleKind::Tap {
        return cant_tap();
    }
    let axis = target.axis.normalize();
    let height = |point: Point3<f64>| (point - target.point).dot(&axis);
    let above = cycle.above.or(post.path.point.map(|at| AboveHoles { before: at, now: at }));
    let above = above.filter(|_| post.path.since != Since::ToolChange);
    if above.is_some() && post.path.since == Since::Frame {
        return PostCode::TipControl.err(
            "a hole right behind TRANS, ORIGIN, TRACUT, ROTABL, FROM or a text that moves the tool: \
             a GOTO between them must say where it stands",
        );
    }
    let rest = match (cycle.retract, above) {
        (None, _) => cycle.clear,
        (Some(0.0), None) => {
            return PostCode::CycleForm
                .err("the level before the cycle, to return to, is not known");
        }
        (Some(0.0), Some(above)) => height(above.before).max(cycle.clear),
        (Some(level), _) => level.max(cycle.clear),
    };
    let clear = cycle.clear;
    let was = (post.path.feed.replace(feed), post.control.block.cause);
    let stands = post.path.stands.normalize();
    let mut moves = Moves { post, cycle, target, axis };
    match above {
        Some(above) => moves.across(above.now, stands, rest.max(clear))?,
        None if rest > clear + SAME_HEIGHT => moves.rapid(rest)?,
        None => {}
    }
    moves.down_and_up(rest)?;
    let now = target.point + axis * rest;
    cycle.above = Some(AboveHoles { before: above.map_or(now, |above| above.before), now });
    (post.path.feed, post.control.block.cause) = was;
    post.path.point = Some(target.point);
    Ok(())
}

fn cant_go_up() -> Result<()> {
    PostCode::TipControl.err(
        "the tool turns far to the next hole of a cycle, whose level lies above where it stands",
    )
}

fn cant_tap() -> Result<()> {
    PostCode::TipControl.err("a tap can't be written as single moves, and no cycle runs under it")
}

/// The moves of a hole along its axis.
struct Moves<'a> {
    post: &'a mut Post,
    cycle: &'a Cycle,
    target: Target,
    axis: Vector3<f64>,
}

impl Moves<'_> {
    /// Goes across above what stands between the holes, as a cycle of the control does: out of
    /// the part along the tool as it stands where that is below `lowest`, then on that level.
    ///
    /// # Errors
    /// The tool turns so far that along itself is no way up; as a straight motion.
    fn across(&mut self, now: Point3<f64>, stands: Vector3<f64>, lowest: f64) -> Result<()> {
        let way = self.target.point - now;
        let here = -way.dot(&self.axis);
        if here < lowest - SAME_HEIGHT {
            let slope = stands.dot(&self.axis);
            if slope < LEAST_WAY_UP {
                return cant_go_up();
            }
            let point = now + stands * ((lowest - here) / slope);
            self.rapid_to(Target { point, axis: stands, word: 0 })?;
        }
        let level = here.max(lowest);
        let least = self.post.control.tables.axis(0).resolution();
        let across = (way - self.axis * way.dot(&self.axis)).norm() > least;
        if across && level > self.cycle.clear + SAME_HEIGHT {
            self.rapid(level)?;
        }
        Ok(())
    }

    fn down_and_up(&mut self, rest: f64) -> Result<()> {
        let (clear, bottom) = (self.cycle.clear, -self.cycle.depth);
        self.rapid(clear)?;
        self.post.control.block.cause = self.cycle.cause;
        if let Some(step) = self.cycle.step {
            self.pecks(step)?;
        }
        self.feed(bottom)?;
        if self.cycle.dwell > 0.0 {
            self.post.control.block.cause = self.cycle.due_to(self.cycle.words.dwell);
            family::dwell(&mut self.post.control, Dwell::Seconds(self.cycle.dwell))?;
            self.post.control.block.cause = self.cycle.cause;
        }
        match way_out(&mut self.post.control, self.cycle)? {
            WayOut::Rapid => self.rapid(rest),
            WayOut::Feed => {
                self.feed(clear)?;
                self.rapid(rest)
            }
            WayOut::Standing => {
                let clockwise = spindle::stand(&mut self.post.control)?;
                self.rapid(rest)?;
                spindle::turn_on(&mut self.post.control, clockwise)
            }
        }
    }

    /// DEEP comes out to the R level after each peck, BRKCHP only lifts.
    fn pecks(&mut self, step: f64) -> Result<()> {
        let mm = self.post.control.require_unit()?.in_mm();
        let gap = self.post.control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
        let (clear, length) = (self.cycle.clear, self.cycle.clear + self.cycle.depth);
        let mut reached = 0.0;
        while reached + step < length - SAME_HEIGHT {
            reached += step;
            self.feed(clear - reached)?;
            if self.cycle.kind == CycleKind::Deep {
                self.rapid(clear)?;
            }
            self.rapid(clear - (reached - gap / mm).max(0.0))?;
        }
        Ok(())
    }

    fn at(&self, height: f64) -> Target {
        Target { point: self.target.point + self.axis * height, axis: self.target.axis, word: 0 }
    }

    fn rapid(&mut self, height: f64) -> Result<()> {
        let to = self.at(height);
        self.rapid_to(to)
    }

    fn rapid_to(&mut self, to: Target) -> Result<()> {
        let cause = self.post.control.block.cause;
        linear::carry_out(self.post, &to, MotionKind::Rapid(cause))
    }

    fn feed(&mut self, height: f64) -> Result<()> {
        let to = self.at(height);
        linear::carry_out(self.post, &to, MotionKind::Feed)
    }
}
