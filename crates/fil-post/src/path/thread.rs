//! A whole thread: the control's cycle, or its passes as single motions.
//!
//! Each pass goes parallel to the crest, square to it deeper than the one before by a chip
//! of the same area, so that pass i of n lies at the root of i/n of the depth. With an angle
//! of the profile the tool goes in along the flank that it leaves behind. The threads of several starts begin
//! one pitch farther away from the part each.

use fil_diag::Result;
use fil_machine::locations::{self as loc, ThreadCycle, ThreadLeadAlong};
use fil_machine::modes::INCH;
use nalgebra::Vector3;

use super::{carry_out as carry, rotary};
use crate::control::family;
use crate::control::word_address::spindle;
use crate::control_state::Compensation;
use crate::errors::PostCode;
use crate::operation::{
    Lead, MotionKind, Operation, SpindleSpeed, Target, Thread, ThreadPasses, ThreadSide,
};
use crate::post::Post;

/// Most passes of one thread.
const MOST_PASSES: usize = 1000;

/// Most threads beside each other.
pub const MOST_STARTS: u32 = 100;

/// Lengths below this count as zero, mm or inch.
const NOTHING: f64 = 1e-6;

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
    let Some(mut awaited) = post.path.awaited_thread.take() else {
        return carry(post, Operation::Linear(target, MotionKind::Thread(lead)));
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
            let side = side_of(&awaited, start)?;
            let clearance = clearance_of(&awaited, start, side);
            let crest = [start, target];
            let thread = Thread { crest, side, clearance, ..awaited.thread };
            carry(post, Operation::Thread(Box::new(thread)))?;
        }
    }
    post.path.awaited_thread = Some(awaited);
    Ok(())
}

/// Refuses what comes between OP/THREAD and its two points.
///
/// # Errors
/// One of them is missing.
pub fn refuse_awaited(post: &Post) -> Result<()> {
    match &post.path.awaited_thread {
        Some(awaited) if !awaited.is_cut => {
            PostCode::Thread.err("two GOTO must follow OP/THREAD with DEPTH and CUTS at once")
        }
        _ => Ok(()),
    }
}

/// Ends a thread.
///
/// # Errors
/// As [`refuse_awaited`].
pub fn end(post: &mut Post) -> Result<()> {
    refuse_awaited(post)?;
    post.path.thread = None;
    post.path.awaited_thread = None;
    Ok(())
}

/// The side that the tool comes from.
fn side_of(awaited: &Awaited, start: Target) -> Result<ThreadSide> {
    let from = awaited.from.map(|from| from.point);
    let by = |axis: usize| from.map(|from| from[axis].abs() - start.point[axis].abs());
    let along_z = from.map(|from| from.z - start.point.z);
    match (awaited.on_face, by(0), along_z) {
        (false, Some(by), _) if by > NOTHING => Ok(ThreadSide::Outside),
        (false, Some(by), _) if by < -NOTHING => Ok(ThreadSide::Inside),
        (true, _, Some(by)) if by > NOTHING => Ok(ThreadSide::Before),
        (true, _, Some(by)) if by < -NOTHING => Ok(ThreadSide::Behind),
        _ => PostCode::Thread
            .err("the tool stands neither outside nor inside of the crest before OP/THREAD"),
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
    let shape = Shape::of(post, thread)?;
    let divides = !matches!(
        cycle_of(post, thread, &shape),
        ThreadCycle::SinglePasses | ThreadCycle::CycleOfOnePass
    );
    // A cycle that divides the thread begins clear of its start, a pass where it begins itself.
    let begin = |start: u32| match shape.depths.first() {
        Some(first) if !divides => shape.above(start, *first),
        _ => shape.shifted(start),
    };
    approach(post, &shape, begin(0))?;
    for start in 0..thread.starts {
        to(post, begin(start), MotionKind::Rapid(thread.lead.cause))?;
        if !family::thread_cycle(post, thread, &shape, start)? {
            passes(post, thread, &shape, start)?;
        }
    }
    to(post, shape.shifted(thread.starts - 1), MotionKind::Rapid(thread.lead.cause))
}

/// What must hold while a thread is cut.
fn check_machine(post: &mut Post) -> Result<()> {
    if post.path.cycle.is_some() {
        return PostCode::InCycle.err("a thread in an active cycle; CYCLE/OFF must come before it");
    }
    let compensated =
        post.control.compensation_asked() != Compensation::Off || post.control.state.compensates();
    if compensated {
        return PostCode::Thread
            .err("a thread in cutter compensation; CUTCOM/OFF must come before it");
    }
    if post.path.transformation.as_ref().is_some_and(|trans| !trans.is_rigid()) {
        return PostCode::Thread.err("TRANS changes the lengths of the thread");
    }
    check_speed(post)
}

/// The lead as the machine counts it: along the longer axis, or along the path.
///
/// # Errors
/// The machine counts along the path, and where it begins is not known.
pub fn counted_lead(post: &Post, lead: Lead, target: Target) -> Result<Lead> {
    if post.control.commons.read(loc::THREAD_LEAD_ALONG) == ThreadLeadAlong::TheLongerAxis {
        return Ok(lead);
    }
    let Some(from) = post.path.point else {
        return PostCode::Thread.err("where the pass begins is not known");
    };
    let way = target.point - from;
    let longest = way.amax();
    let share = if longest < NOTHING { 1.0 } else { way.norm() / longest };
    Ok(Lead { value: lead.value * share, ..lead })
}

/// Refuses a thread at surface speed, as each pass would begin at another angle of the
/// spindle, and one with the spindle standing.
///
/// # Errors
/// The last SPINDL gave one, or stopped the spindle.
pub fn check_speed(post: &Post) -> Result<()> {
    if spindle::stands(&post.control) {
        return PostCode::Thread.err("the spindle stands; SPINDL before the thread turns it");
    }
    match post.control.speed {
        Some(SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_)) => PostCode::Thread
            .err("the spindle turns at constant surface speed, so that the passes would not meet"),
        _ => Ok(()),
    }
}

/// A thread with its directions, in the frame of the CL file.
pub struct Shape {
    /// Where the crest begins and ends.
    pub crest: [Target; 2],
    /// Unit vector to the clear side.
    out: Vector3<f64>,
    /// Along the axis of the thread, from its start to its end, with the slant of the crest:
    /// as long as 1 along that axis.
    slant: Vector3<f64>,
    /// Tangent of half the angle of the profile.
    flank: f64,
    /// Pitch.
    pitch: f64,
    /// Distance of the clear level from the crest at its start: the crest may rise.
    clearance: f64,
    /// Depth of each pass.
    pub depths: Vec<f64>,
}

impl Shape {
    fn of(post: &Post, thread: &Thread) -> Result<Shape> {
        let [start, end] = thread.crest.map(|target| target.point);
        if (end - start).norm() < NOTHING {
            return PostCode::Thread.err("the crest begins where it ends");
        }
        if start.y.abs() > NOTHING || end.y.abs() > NOTHING {
            return PostCode::Thread.err("a point of the thread lies outside the plane of X and Z");
        }
        let on_face = matches!(thread.side, ThreadSide::Before | ThreadSide::Behind);
        let way = end - start;
        let along = if on_face { way.x } else { way.z };
        let across = if on_face { way.z } else { way.x };
        if across.abs() > along.abs() {
            return PostCode::Thread
                .err("the crest leans more than 45 degrees from the axis of the thread");
        }
        // Behind the axis of the spindle outside is the way of -X.
        let half = if start.x + end.x < 0.0 { -1.0 } else { 1.0 };
        let out = match thread.side {
            ThreadSide::Outside => Vector3::x() * half,
            ThreadSide::Inside => -Vector3::x() * half,
            ThreadSide::Before => Vector3::z(),
            ThreadSide::Behind => -Vector3::z(),
        };
        check_values(thread)?;
        check_axis(thread)?;
        let depths = depths(post, thread)?;
        Ok(Shape {
            crest: thread.crest,
            out,
            slant: way / along.abs(),
            flank: libm::tan((thread.angle / 2.0).to_radians()),
            pitch: thread.lead.value / f64::from(thread.starts),
            clearance: thread.clearance + way.dot(&out).max(0.0),
            depths,
        })
    }

    /// A point beside the crest.
    fn beside(&self, target: Target, by: Vector3<f64>) -> Target {
        Target { point: target.point + by, word: 0, ..target }
    }

    /// Clear of the crest where a start begins.
    pub fn shifted(&self, start: u32) -> Target {
        let away = self.slant.component_mul(&self.axis_mask()) * -self.away(start);
        self.beside(self.crest[0], away + self.out * self.clearance)
    }

    /// How much farther away from the part a start begins than the first.
    fn away(&self, start: u32) -> f64 {
        self.pitch * f64::from(start)
    }

    /// Where the crest of a start begins.
    pub fn crest_of(&self, start: u32) -> Target {
        self.begin(start, 0.0)
    }

    /// Where a pass of this depth begins.
    fn begin(&self, start: u32, depth: f64) -> Target {
        let along = depth * self.flank - self.away(start);
        self.beside(self.crest[0], self.slant * along - self.out * depth)
    }

    /// A point beside the thread, moved to the clear level.
    fn clear_of(&self, target: Target) -> Target {
        let up = (self.shifted(0).point - target.point).dot(&self.out);
        self.beside(target, self.out * up)
    }

    /// Where a pass of this depth begins, moved to the clear level.
    pub fn above(&self, start: u32, depth: f64) -> Target {
        self.clear_of(self.begin(start, depth))
    }

    /// The end of the crest moved to the side by this much: down to the root, up to the
    /// clear level.
    pub fn end(&self, out: f64) -> Target {
        self.beside(self.crest[1], self.out * out)
    }

    /// The depth below the clear level, as a vector to it.
    pub fn out(&self) -> Vector3<f64> {
        self.out
    }

    /// How much the radius at the start exceeds that at the end.
    pub fn leans(&self) -> bool {
        (self.slant - self.slant.component_mul(&self.axis_mask())).amax() > NOTHING
    }

    /// 1 along the axis of the thread.
    fn axis_mask(&self) -> Vector3<f64> {
        if self.is_on_face() { Vector3::x() } else { Vector3::z() }
    }

    /// The thread runs across a face.
    pub fn is_on_face(&self) -> bool {
        self.out.z != 0.0
    }
}

/// Refuses values that make no thread.
fn check_values(thread: &Thread) -> Result<()> {
    let positive = |value: f64, what: &str| {
        let right = value.is_finite() && value > 0.0;
        if right { Ok(()) } else { PostCode::Thread.err(format!("{what} of {value}")) }
    };
    positive(thread.lead.value, "a lead")?;
    positive(thread.depth, "a depth")?;
    positive(thread.clearance, "a clearance")?;
    match thread.passes {
        ThreadPasses::First(first) => positive(first, "a first pass")?,
        ThreadPasses::Count(count) => positive(f64::from(count), "a number of passes")?,
    }
    if !(0.0..170.0).contains(&thread.angle) {
        return PostCode::Thread.err(format!("an angle of the profile of {}", thread.angle));
    }
    if !(1..=MOST_STARTS).contains(&thread.starts) {
        return PostCode::Thread.err(format!("{} starts", thread.starts));
    }
    Ok(())
}

/// Refuses a thread or a clear level that lies beyond the axis of the spindle.
fn check_axis(thread: &Thread) -> Result<()> {
    let radii = thread.crest.map(|target| target.point.x.abs());
    let crosses = thread.crest[0].point.x * thread.crest[1].point.x < 0.0;
    let least = radii[0].min(radii[1]);
    let lean = (radii[0] - radii[1]).abs();
    let beyond = match thread.side {
        ThreadSide::Outside => thread.depth >= least || crosses,
        ThreadSide::Inside => thread.clearance + lean > radii[0].max(radii[1]) || crosses,
        ThreadSide::Before | ThreadSide::Behind => crosses,
    };
    if beyond {
        return PostCode::Thread.err("the thread, or the way back from it, lies beyond the axis");
    }
    Ok(())
}

/// The depth of each pass.
///
/// # Errors
/// More passes than a thread can have.
fn depths(post: &Post, thread: &Thread) -> Result<Vec<f64>> {
    let mut depths = match thread.passes {
        ThreadPasses::Count(count) => {
            let share = |pass: u32| (f64::from(pass) / f64::from(count)).sqrt();
            let most = count.min(MOST_PASSES as u32 + 1);
            (1..=most).map(|pass| thread.depth * share(pass)).collect()
        }
        ThreadPasses::First(first) => by_first(thread.depth, first, least_depth(post)),
    };
    depths.extend((0..thread.springs.min(MOST_PASSES as u32)).map(|_| thread.depth));
    if depths.len() > MOST_PASSES {
        return PostCode::Thread.err(format!("more than {MOST_PASSES} passes"));
    }
    Ok(depths)
}

/// Passes of equal chips until the depth is reached.
fn by_first(depth: f64, first: f64, least: f64) -> Vec<f64> {
    let mut depths: Vec<f64> = Vec::new();
    let mut reached = 0.0;
    while reached < depth - NOTHING && depths.len() <= MOST_PASSES {
        let next = first * ((depths.len() + 1) as f64).sqrt();
        reached = next.max(reached + least).min(depth);
        depths.push(reached);
    }
    if let Some(last) = depths.last_mut().filter(|last| (depth - **last).abs() < NOTHING) {
        *last = depth;
    }
    depths
}

/// What each pass goes deeper at least, mm or inch.
pub fn least_depth(post: &Post) -> f64 {
    let least = post.control.commons.dbl_opt(loc::THREAD_LEAST_DEPTH).unwrap_or(0.0).max(0.0);
    if post.control.is_metric() { least } else { least / INCH }
}

/// Brings the tool clear of the crest, along the axis first where it stands clear of it,
/// else out first.
fn approach(post: &mut Post, shape: &Shape, goal: Target) -> Result<()> {
    let Some(from) = post.path.point else { return Ok(()) };
    let out = shape.out();
    let clear = (from - goal.point).dot(&out) >= -NOTHING;
    let along = (goal.point - from) - out * (goal.point - from).dot(&out);
    let corner = if clear { from + along } else { goal.point - along };
    if (corner - from).norm() < NOTHING || (corner - goal.point).norm() < NOTHING {
        return Ok(());
    }
    let cause = post.control.block.cause;
    to(post, Target { point: corner, ..goal }, MotionKind::Rapid(cause))
}

/// The passes of one start as single motions.
fn passes(post: &mut Post, thread: &Thread, shape: &Shape, start: u32) -> Result<()> {
    let rapid = MotionKind::Rapid(thread.lead.cause);
    for depth in &shape.depths {
        to(post, shape.above(start, *depth), rapid)?;
        to(post, shape.begin(start, *depth), rapid)?;
        to(post, shape.end(-depth), MotionKind::Thread(thread.lead))?;
        to(post, shape.clear_of(shape.end(0.0)), rapid)?;
    }
    Ok(())
}

/// Brings the tool to where a pass begins, clear of it.
///
/// # Errors
/// As a rapid motion.
pub fn go_above(post: &mut Post, thread: &Thread, at: Target) -> Result<()> {
    to(post, at, MotionKind::Rapid(thread.lead.cause))
}

fn to(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    carry(post, Operation::Linear(target, kind))
}

/// True when the machine's cycle can say all of the thread; else it is written as single
/// passes.
pub fn cycle_of(post: &Post, thread: &Thread, shape: &Shape) -> ThreadCycle {
    let cycle = post.control.commons.read(loc::THREAD_CYCLE);
    let straight = thread.angle == 0.0;
    let fits = match cycle {
        ThreadCycle::SinglePasses => true,
        _ if shape.is_on_face() => false,
        ThreadCycle::CycleOfOnePass => straight || !shape.leans(),
        ThreadCycle::CycleOfAllPassesInTwoBlocks => {
            let angles = [0.0, 29.0, 30.0, 55.0, 60.0, 80.0];
            angles.contains(&thread.angle) && (straight || !shape.leans()) && is_by_first(thread)
        }
        // It has no word for the passes at full depth.
        ThreadCycle::CycleOfAllPassesInOneBlock => {
            (straight || !shape.leans()) && is_by_first(thread) && thread.springs <= 1
        }
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => !shape.leans() && is_by_first(thread),
    };
    if fits { cycle } else { ThreadCycle::SinglePasses }
}

/// The cycles of all passes count them from the depth of the first.
fn is_by_first(thread: &Thread) -> bool {
    matches!(thread.passes, ThreadPasses::First(_))
}

/// Positions of X and Z of the machine for a target.
///
/// # Errors
/// A frame in which the thread does not lie in the plane of X and Z.
pub fn on_machine(post: &mut Post, target: Target) -> Result<[f64; 2]> {
    let position = rotary::position_of(post, target)?;
    for (number, along) in position.into_iter().take(3).enumerate() {
        post.control.tables.axis(number).check(along)?;
    }
    Ok([position[0], position[2]])
}
