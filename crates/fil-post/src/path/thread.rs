//! A whole thread: the control's cycle, or its passes as single motions.
//!
//! Each pass goes parallel to the crest, square to it deeper than the one before by a chip
//! of the same area, so that pass i of n lies at the root of i/n of the depth. With an angle
//! of the profile the tool goes in along the flank that it leaves behind. The threads of several starts begin
//! one pitch farther away from the part each.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ThreadCycle, ThreadLeadAlong};
use nalgebra::Point3;

use super::{carry_out as carry, rotary, scaled_lead};
use crate::control::needs::Act;
use crate::control::word_address::spindle::{self, counted};
use crate::control::{family, thread_cycle, word_address};
use crate::control_state::{Place, modal};
use crate::errors::PostCode;
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Lead, MotionKind, Operation, SpindleSpeed, Target, Thread, ThreadSide};
use crate::post::Post;

/// The axes that a thread runs along, X and Z.
pub const AXES: [usize; 2] = [0, 2];

/// Lengths below this count as zero, mm or inch.
const NOTHING: f64 = 1e-6;

/// A lead for threads that follow, and what it gains in each turn, mm or inch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pitch {
    pub lead: Lead,
    pub change: f64,
}

/// A thread of which each feed motion is a pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passes {
    pub lead: Lead,
    /// What the lead gains in each turn, mm or inch; below zero it loses.
    pub change: f64,
    /// How the spindle turned in the first pass.
    pub turns: Option<Turns>,
}

impl Passes {
    /// The passes of a thread that is new.
    pub fn new(lead: Lead, change: f64) -> Passes {
        Passes { lead, change, turns: None }
    }
}

/// How the spindle turns: its speed as SPINDL asked for it, and clockwise or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turns {
    speed: Option<SpindleSpeed>,
    /// The highest speed, where the control holds this one to it.
    held: Option<f64>,
    clockwise: Option<bool>,
    /// It is the second spindle of the lathe.
    is_side: bool,
}

/// OP/THREAD with depth and passes: what it asks for, and the points that have come.
#[derive(Clone, Debug)]
pub struct Awaited {
    /// The thread, but for its points and its side.
    pub thread: Thread,
    /// The thread runs across a face.
    pub on_face: bool,
    /// Where the tool stood before.
    pub from: Option<Target>,
    /// Where the crest begins.
    pub start: Option<Target>,
    /// Both points have come.
    pub is_cut: bool,
}

/// Takes a point of a thread that waits for it; a motion of any other thread is one pass.
///
/// # Errors
/// A third point; and as [`carry_out`].
#[cold]
pub fn point(post: &mut Post, target: Target, lead: Lead) -> Result<()> {
    check_speed(post)?;
    post.require(Act::Thread)?;
    refuse_other_turns(post)?;
    let Some(mut awaited) = post.path.thread.awaited.take() else {
        if stands_at(post).is_none() {
            return PostCode::Thread.err("where the pass begins is not known");
        }
        refuse_blocks_between(post)?;
        carry(post, Operation::Linear(target, MotionKind::Thread(lead)))?;
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
            let side = side_of(&awaited, start, post.control.spindle.is_side)?;
            let clearance = clearance_of(&awaited, start, side);
            let crest = [start, target];
            let thread = Thread { crest, side, clearance, ..awaited.thread };
            carry(post, Operation::Thread(Box::new(thread)))?;
        }
    }
    post.path.thread.awaited = Some(awaited);
    Ok(())
}

/// Refuses blocks between two motions of one pass: the tool would stand in its groove while the
/// spindle turns on, and the second motion would begin at another angle of it (a control takes
/// a threading block that follows another one at once without waiting for its marker). A THREAD
/// between them that changes the lead is no way out of the groove.
fn refuse_blocks_between(post: &Post) -> Result<()> {
    let Some((end, count)) = post.path.thread.pass_end else { return Ok(()) };
    if count == post.control.tape.count || stands_at(post) != Some(end) {
        return Ok(());
    }
    PostCode::Thread.err_with(
        "blocks stand between two motions of one pass, in which the tool would wait in its groove",
        "Put what stands between (STOP, COOLNT, SPINDL, DELAY, a text) before the pass or behind \
         it, or retract with RAPID before the next pass.",
    )
}

/// Refuses what comes between OP/THREAD and its two points.
///
/// # Errors
/// One of them is missing.
pub fn refuse_awaited(post: &Post) -> Result<()> {
    match &post.path.thread.awaited {
        Some(awaited) if !awaited.is_cut => {
            PostCode::Thread.err("two GOTO must follow OP/THREAD with DEPTH and CUTS at once")
        }
        _ => Ok(()),
    }
}

/// The point of the CL file at which the tool stands: a thread begins from there, on the side
/// where that lies. `None` where a tool change, a frame, FROM or a text came between.
pub fn stands_at(post: &Post) -> Option<Point3<f64>> {
    let is_known = |number: &usize| matches!(post.control.place(*number), Place::At(_));
    post.path.stands_at().filter(|_| AXES.iter().all(is_known))
}

/// Ends a thread.
///
/// # Errors
/// As [`refuse_awaited`].
pub fn end(post: &mut Post) -> Result<()> {
    refuse_awaited(post)?;
    post.path.thread.passes = None;
    post.path.thread.awaited = None;
    Ok(())
}

/// The side that the tool comes from. The face of a part in the main spindle looks to +Z; that of
/// one in the second spindle (`of_side`) may look to -Z.
fn side_of(awaited: &Awaited, start: Target, of_side: bool) -> Result<ThreadSide> {
    let from = awaited.from.map(|from| from.point);
    let by = |axis: usize| from.map(|from| from[axis].abs() - start.point[axis].abs());
    let along_z = from.map(|from| from.z - start.point.z);
    match (awaited.on_face, by(0), along_z) {
        (false, Some(by), _) if by > NOTHING => Ok(ThreadSide::Outside),
        (false, Some(by), _) if by < -NOTHING => Ok(ThreadSide::Inside),
        (true, _, Some(by)) if by > NOTHING => Ok(ThreadSide::Before),
        (true, _, Some(by)) if by < -NOTHING && of_side => Ok(ThreadSide::Behind),
        _ => PostCode::Thread.err(
            "the tool stands neither outside nor inside of the crest before OP/THREAD, nor before \
             its face",
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
        if family::has_thread_cycle(&post.control, cycle) {
            by_cycle(post, thread, shape, cycle, start)?;
        } else {
            passes(post, thread, shape, start)?;
        }
    }
    to(post, shape.shifted(thread.starts - 1), MotionKind::Rapid(thread.lead.cause))
}

/// What must hold while a thread is cut.
fn check_machine(post: &mut Post) -> Result<()> {
    post.require(Act::Thread)?;
    if post.path.transformation.as_ref().is_some_and(|trans| !trans.is_rigid()) {
        return PostCode::Thread.err("TRANS changes the lengths of the thread");
    }
    scaled_lead::refuse(&post.control, &AXES, PostCode::Thread)?;
    check_speed(post)
}

/// What the lead gains in each turn of a pass to a point, as the machine counts it, which
/// counts the lead itself as `counted`.
///
/// # Errors
/// The lead comes to nothing before the end, or the pass goes on from another one.
pub fn counted_change(post: &Post, lead: Lead, counted: &Lead, target: Target) -> Result<f64> {
    let change = post.path.thread.passes.map_or(0.0, |passes| passes.change);
    if change == 0.0 {
        return Ok(0.0);
    }
    let Some(from) = stands_at(post) else {
        return PostCode::Thread.err("where the pass begins is not known");
    };
    if post.control.state.goes_on_in_varying_lead(&post.control.commons) {
        return PostCode::Thread.err(
            "a thread of varying lead goes on behind its first motion, and with which lead is \
             not known",
        );
    }
    // In n turns the tool goes n leads and n(n - 1)/2 changes: the square of the lead changes
    // by twice the change times the way.
    let way = (target.point - from).amax();
    if lead.value * lead.value + 2.0 * change * way <= 0.0 {
        return PostCode::Thread.err("the lead comes to nothing before the end of the thread");
    }
    Ok(change * (counted.value / lead.value))
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

/// The lead as the machine counts it: along the longer axis, or along the path.
///
/// # Errors
/// The machine counts along the path, and where it begins is not known.
pub fn counted_lead(post: &Post, lead: Lead, target: Target) -> Result<Lead> {
    if post.control.commons.read(loc::THREAD_LEAD_ALONG) == ThreadLeadAlong::TheLongerAxis {
        return Ok(lead);
    }
    let Some(from) = stands_at(post) else {
        return PostCode::Thread.err("where the pass begins is not known");
    };
    let way = target.point - from;
    let longest = way.amax();
    let share = if longest < NOTHING { 1.0 } else { way.norm() / longest };
    Ok(Lead { value: lead.value * share, ..lead })
}

/// Refuses a thread at surface speed, as each pass would begin at another angle of the
/// spindle, and one with the spindle standing, which the control would wait for, or cut
/// without.
///
/// # Errors
/// The last SPINDL gave one, or stopped the spindle; nothing has turned it.
pub fn check_speed(post: &Post) -> Result<()> {
    if counted::is_unknown(&post.control) {
        return PostCode::Thread.err(counted::WHICH);
    }
    if !spindle::may_turn(&post.control) {
        let usual = "the spindle stands; SPINDL before the thread turns it";
        return PostCode::Thread.err(spindle::why_it_stands(&post.control, usual));
    }
    if spindle::may_stand_behind_change(&post.control) {
        return PostCode::Thread
            .err("the tool change may have stopped the spindle; SPINDL behind it turns it again");
    }
    if spindle::is_of_surface(&post.control) {
        return PostCode::Thread
            .err("the spindle turns at constant surface speed, so that the passes would not meet");
    }
    Ok(())
}

/// Brings the tool clear of the crest, along the axis first where it stands clear of it,
/// else out first.
fn approach(post: &mut Post, shape: &Shape, goal: Target) -> Result<()> {
    let Some(from) = stands_at(post) else { return Ok(()) };
    let out = shape.out();
    let clear = (from - goal.point).dot(&out) >= -NOTHING;
    refuse_through_the_wall(shape, from)?;
    let along = (goal.point - from) - out * (goal.point - from).dot(&out);
    let corner = if clear { from + along } else { goal.point - along };
    if (corner - from).norm() < NOTHING || (corner - goal.point).norm() < NOTHING {
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
    let is_beyond = (from - start).dot(&out).max((from - end).dot(&out)) < -NOTHING;
    let is_before = (from.z - start.z) * (start.z - end.z) >= 0.0;
    if shape.is_on_face() || !is_beyond || is_before {
        return Ok(());
    }
    PostCode::Thread.err_with(
        "the tool stands on the other side of the thread's wall, and would go through the part",
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
    family::thread_cycle(&mut post.control, thread, shape, cycle, &ends)?;
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
    carry(post, Operation::Linear(target, kind))
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
