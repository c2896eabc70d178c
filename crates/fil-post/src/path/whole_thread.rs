//! A whole thread: the control's cycle, or its passes as single motions.
//!
//! Each pass goes parallel to the crest, square to it deeper than the one before by a chip
//! of the same area, so that pass i of n lies at the root of i/n of the depth. With an angle
//! of the profile the tool goes in along the flank that it leaves behind. The threads of several starts begin
//! one pitch farther away from the part each.

use super::{linear, rotary, scaled_lead, thread};
use crate::control::needs::Act;
use crate::control::{thread_cycle, word_address};
use crate::errors::PostCode;
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{MotionKind, Target, Thread};
use crate::post::Post;
use fil_diag::Result;
use fil_machine::locations::ThreadCycle;
use nalgebra::Point3;

/// Cuts a thread.
///
/// # Errors
/// Values that make no thread; a spindle at surface speed, cutter compensation, a machine
/// without code for a thread; what the motions refuse.
pub fn carry_out(post: &mut Post, thread: &Thread) -> Result<()> {
    check_machine(post)?;
    let least = thread_cycle::least_depth(&post.control);
    let shape = Shape::of(thread, least, thread_cycle::chamfer(&post.control))?;
    post.path.thread.in_whole = true;
    cut(post, thread, &shape)?;
    post.path.thread.in_whole = false;
    Ok(())
}

/// Brings the tool to each start of the thread, cuts it, and brings the tool back.
fn cut(post: &mut Post, thread: &Thread, shape: &Shape) -> Result<()> {
    let cycle = thread_cycle::cycle_of(&post.control, thread, shape);
    let divides = !matches!(cycle, ThreadCycle::SinglePasses | ThreadCycle::CycleOfOnePass);
    // A cycle that divides the thread begins clear of its start, a pass where it begins itself.
    let begin = |start: u32| match shape.depths.first() {
        Some(first) if !divides => shape.above(start, *first),
        _ => shape.shifted(start),
    };
    approach(post, shape, begin(0))?;
    for start in 0..thread.starts {
        to(post, begin(start), MotionKind::Rapid(thread.lead.cause))?;
        if post.control.family().has_thread_cycle(cycle) {
            by_cycle(post, thread, shape, cycle, start)?;
        } else {
            passes(post, thread, shape, start)?;
        }
    }
    to(post, shape.shifted(thread.starts - 1), MotionKind::Rapid(thread.lead.cause))
}

/// What must hold while a thread is cut.
fn check_machine(post: &mut Post) -> Result<()> {
    post.control.end_compensation()?;
    post.require(Act::Thread)?;
    if post.path.transformation.as_ref().is_some_and(|trans| !trans.is_rigid()) {
        return PostCode::Thread.err("TRANS changes the lengths of the thread");
    }
    scaled_lead::refuse(&post.control, &thread::AXES, PostCode::Thread)?;
    thread::check_speed(post)
}

/// Brings the tool clear of the crest, along the axis first where it stands clear of it,
/// else out first.
fn approach(post: &mut Post, shape: &Shape, goal: Target) -> Result<()> {
    let Some(from) = thread::stands_at(post) else { return Ok(()) };
    let out = shape.out();
    let clear = (from - goal.point).dot(&out) >= -thread::NOTHING;
    refuse_through_the_wall(shape, from)?;
    let along = (goal.point - from) - out * (goal.point - from).dot(&out);
    let corner = if clear { from + along } else { goal.point - along };
    if (corner - from).norm() < thread::NOTHING || (corner - goal.point).norm() < thread::NOTHING {
        return Ok(());
    }
    let cause = post.control.block.cause;
    to(post, Target { point: corner, ..goal }, MotionKind::Rapid(cause))
}

/// Refuses a way out or in to the thread's side that leads through the wall of the part: from
/// the other side of the crest, where the tool does not stand before the thread.
fn refuse_through_the_wall(shape: &Shape, from: Point3<f64>) -> Result<()> {
    let [start, end] = shape.crest.map(|target| target.point);
    let out = shape.out();
    let is_beyond = (from - start).dot(&out).max((from - end).dot(&out)) < -thread::NOTHING;
    let is_before = (from.z - start.z) * (start.z - end.z) >= 0.0;
    if shape.is_on_face() || !is_beyond || is_before {
        return Ok(());
    }
    PostCode::Thread.err_with(
        "the tool is on the other side of the thread's wall, and would go through the part",
        "Bring the tool before the part with RAPID and GOTO first.",
    )
}

/// The passes of one start as single motions.
fn passes(post: &mut Post, thread: &Thread, shape: &Shape, start: u32) -> Result<()> {
    let rapid = MotionKind::Rapid(thread.lead.cause);
    for depth in &shape.depths {
        to(post, shape.above(start, *depth), rapid)?;
        to(post, shape.begin(start, *depth), rapid)?;
        to(post, shape.end(-depth), MotionKind::Thread(thread.lead))?;
        if let Some(left) = shape.left(*depth) {
            to(post, left, MotionKind::Thread(thread.lead))?;
        }
        to(post, shape.clear_of(shape.crest[1]), rapid)?;
    }
    Ok(())
}

/// One start by the cycle of the control, from where the tool stands clear.
fn by_cycle(
    post: &mut Post,
    thread: &Thread,
    shape: &Shape,
    cycle: ThreadCycle,
    start: u32,
) -> Result<()> {
    let ends = ends_of(post, thread, shape, start)?;
    post.control.family().thread_cycle(&mut post.control, thread, shape, cycle, &ends)?;
    if cycle != ThreadCycle::CycleOfOnePass {
        return Ok(());
    }
    for depth in &shape.depths {
        let above = shape.above(start, *depth);
        to(post, above, MotionKind::Rapid(thread.lead.cause))?;
        let way = [on_machine(post, above)?, on_machine(post, shape.root_end(*depth))?];
        word_address::thread::one_pass(&mut post.control, thread, &ends, way)?;
    }
    Ok(())
}

/// Where one start of a thread lies in the machine.
///
/// # Errors
/// A frame that turns the thread out of X and Z.
fn ends_of(post: &Post, thread: &Thread, shape: &Shape, start: u32) -> Result<Ends> {
    let begin = on_machine(post, shape.shifted(start))?;
    let crest = [on_machine(post, shape.crest_of(start))?, on_machine(post, shape.crest[1])?];
    let root = on_machine(post, shape.root_end(thread.depth))?;
    let [across, along] = [root[0] - crest[1][0], root[1] - crest[1][1]];
    if along.abs() > 1e-6 || (across.abs() - thread.depth).abs() > 1e-6 {
        return PostCode::Thread.err("TRANS turns the thread out of the plane of X and Z");
    }
    Ok(Ends { begin, crest, root })
}

fn to(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    linear::carry_out(post, &target, kind)
}

/// Positions of X and Z of the machine for a target.
///
/// # Errors
/// A frame in which the thread does not lie in the plane of X and Z.
fn on_machine(post: &Post, target: Target) -> Result<[f64; 2]> {
    let (position, _) = rotary::position_of(post, target)?;
    for (number, along) in position.into_iter().take(3).enumerate() {
        post.control.tables.axis(number).check(along)?;
    }
    Ok([position[0], position[2]])
}
