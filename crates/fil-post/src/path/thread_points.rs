//! The points of a thread: each motion is a pass, or two of them are a whole thread.

use super::state::{Awaited, Turns};
use super::{operations, thread};
use crate::control::needs::Act;
use crate::control::word_address::spindle;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::{Lead, MotionKind, Operation, SpindleSpeed, Target, Thread, ThreadSide};
use crate::post::Post;
use fil_diag::Result;
use nalgebra::Point3;

/// An angle nearer to that of the cone is the same, degrees.
const SAME_ANGLE: f64 = 0.05;

/// Takes a point of a thread that waits for it; a motion of any other thread is one pass.
///
/// # Errors
/// A third point; and as `carry_out`.
#[cold]
pub fn point(post: &mut Post, target: Target, lead: Lead) -> Result<()> {
    thread::check_speed(post)?;
    post.control.end_compensation()?;
    post.require(Act::Thread)?;
    refuse_other_turns(post)?;
    let Some(mut awaited) = post.path.thread.awaited.take() else {
        if thread::stands_at(post).is_none() {
            return PostCode::Thread.err("where the pass begins is not known");
        }
        refuse_blocks_between(post)?;
        operations::carry_out(post, Operation::Linear(target, MotionKind::Thread(lead)))?;
        post.path.thread.pass_end = Some((target.point, post.control.tape.count));
        return Ok(());
    };
    if awaited.is_cut {
        return PostCode::Thread.err(
            "a third point after OP/THREAD with DEPTH and CUTS, which cuts the whole thread \
             between two",
        );
    }
    match awaited.start {
        None => awaited.start = Some(target),
        Some(start) => {
            awaited.is_cut = true;
            check_direction(&awaited, [start.point, target.point])?;
            let side = side_of(&awaited, start, post.control.spindle.is_side)?;
            let clearance = clearance_of(&awaited, start, side);
            let crest = [start, target];
            let thread = Thread { crest, side, clearance, ..awaited.thread };
            operations::carry_out(post, Operation::Thread(Box::new(thread)))?;
        }
    }
    post.path.thread.awaited = Some(awaited);
    Ok(())
}

/// CUTANG gives the direction of the cut from Z: 0 or 180 degrees along the spindle, 90 or 270 across
/// a face, whatever the cone; else the angle of the cone, to either side.
///
/// # Errors
/// Its two points make another cone.
fn check_direction(awaited: &Awaited, [from, to]: [Point3<f64>; 2]) -> Result<()> {
    let Some(asked) = awaited.direction else { return Ok(()) };
    let off = asked.rem_euclid(180.0);
    let from_z = off.min(180.0 - off);
    let cone = libm::atan2((to.x - from.x).abs(), (to.z - from.z).abs()).to_degrees();
    let is = |angle: f64| (from_z - angle).abs() <= SAME_ANGLE;
    if is(cone) || is(0.0) || awaited.on_face && is(90.0) {
        return Ok(());
    }
    PostCode::Thread.err_with(
        format!("CUTANG,{asked} of OP/THREAD, and the two points make a cone of {cone:.2} degrees"),
        "Leave CUTANG out: the cone is that of the two points.",
    )
}

/// Refuses blocks between two motions of one pass: the tool would stand in its groove while the
/// spindle turns on, and the second motion would begin at another angle of it (a control takes
/// a threading block that follows another one at once without waiting for its marker). A THREAD
/// between them that changes the lead is no way out of the groove.
fn refuse_blocks_between(post: &Post) -> Result<()> {
    let Some((end, count)) = post.path.thread.pass_end else { return Ok(()) };
    if count == post.control.tape.count || thread::stands_at(post) != Some(end) {
        return Ok(());
    }
    PostCode::Thread.err_with(
        "blocks between two moves of one pass would stop the tool in the thread",
        "Put these blocks (STOP, COOLNT, SPINDL, DELAY, a text) before or after the pass, or retract with RAPID before the next pass.",
    )
}

/// The side that the tool comes from. The face of a part in the main spindle looks to +Z; that of
/// one in the second spindle (`of_side`) may look to -Z.
fn side_of(awaited: &Awaited, start: Target, of_side: bool) -> Result<ThreadSide> {
    let from = awaited.from.map(|from| from.point);
    let by = |axis: usize| from.map(|from| from[axis].abs() - start.point[axis].abs());
    let along_z = from.map(|from| from.z - start.point.z);
    match (awaited.on_face, by(0), along_z) {
        (false, Some(by), _) if by > thread::NOTHING => Ok(ThreadSide::Outside),
        (false, Some(by), _) if by < -thread::NOTHING => Ok(ThreadSide::Inside),
        (true, _, Some(by)) if by > thread::NOTHING => Ok(ThreadSide::Before),
        (true, _, Some(by)) if by < -thread::NOTHING && of_side => Ok(ThreadSide::Behind),
        _ => PostCode::Thread.err(
            "before OP/THREAD the tool is neither outside nor inside the crest, nor in front of its face",
        ),
    }
}

/// How far from the crest the tool stood.
fn clearance_of(awaited: &Awaited, start: Target, side: ThreadSide) -> f64 {
    let Some(from) = awaited.from else { return awaited.thread.clearance };
    let away = from.point - start.point;
    match side {
        ThreadSide::Outside | ThreadSide::Inside => away.x.abs(),
        ThreadSide::Before | ThreadSide::Behind => away.z.abs(),
    }
}

/// Refuses a pass for which the spindle turns otherwise than for the first one of its thread: the
/// tool would begin at another angle of the spindle, as it lags by the speed.
fn refuse_other_turns(post: &mut Post) -> Result<()> {
    let control = &post.control;
    let above = |limit: &f64| match control.spindle.speed {
        Some(SpindleSpeed::Revolutions(speed)) => speed > *limit,
        _ => false,
    };
    let now = Turns {
        speed: control.spindle.speed,
        held: control.state.get(modal::SPEED_LIMIT).filter(above),
        clockwise: spindle::clockwise_in_motion(control),
        is_side: control.spindle.is_side,
    };
    let Some(passes) = &mut post.path.thread.passes else { return Ok(()) };
    match passes.turns {
        Some(before) if before != now => {
            let mut diag = PostCode::Thread.diag(
                "SPINDL or a text has changed how the spindle turns between the passes of a \
                 thread, which would not meet",
            );
            diag.hint = Some(
                "Cut all passes of a thread at one speed, and give THREAD anew for another thread."
                    .into(),
            );
            Err(diag)
        }
        _ => {
            passes.turns = Some(now);
            Ok(())
        }
    }
}
