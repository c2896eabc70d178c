//! Where the passes of a whole thread lie: its directions, levels and depths.

use fil_diag::Result;
use nalgebra::Vector3;

use super::{Target, Thread, ThreadPasses, ThreadSide};
use crate::errors::PostCode;

/// Most threads beside each other.
pub const MOST_STARTS: u32 = 100;

/// Most passes of one thread.
const MOST_PASSES: usize = 1000;

/// Lengths below this count as zero, mm or inch.
const NOTHING: f64 = 1e-6;

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
    /// Distance of the clear level from the crest where the first start begins.
    clearance: f64,
    /// Way before the end on which each pass leaves the thread at 45 degrees.
    leaves: f64,
    /// Depth of each pass.
    pub depths: Vec<f64>,
}

impl Shape {
    /// The shape of a thread whose passes each go deeper by `least` (mm or inch) or more, and leave
    /// it on a way of `chamfer` leads.
    ///
    /// # Errors
    /// Values that make none.
    pub fn of(thread: &Thread, least: f64, chamfer: f64) -> Result<Shape> {
        let [start, end] = thread.crest.map(|target| target.point);
        if (end - start).norm() < NOTHING {
            return PostCode::Thread.err("the crest starts and ends at the same point");
        }
        if start.y.abs() > NOTHING || end.y.abs() > NOTHING {
            return PostCode::Thread.err("a point of the thread lies outside the plane of X and Z");
        }
        let on_face = matches!(thread.side, ThreadSide::Before | ThreadSide::Behind);
        let way = end - start;
        let along = if on_face { way.x } else { way.z };
        let across = if on_face { way.z } else { way.x };
        if across.abs() > along.abs() + NOTHING {
            return PostCode::Thread
                .err("the crest is more than 45 degrees off the axis of the thread");
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
        let slant = way / along.abs();
        let pitch = thread.lead.value / f64::from(thread.starts);
        let farthest = slant * (pitch * f64::from(thread.starts - 1));
        // The crest may rise to its end, or to where the last start begins.
        let rises = way.dot(&out).max(-farthest.dot(&out)).max(0.0);
        let clearance = thread.clearance + rises;
        check_axis(thread, clearance)?;
        let depths = depths(thread, least)?;
        let leaves = chamfer * thread.lead.value;
        let above_end = clearance - way.dot(&out);
        let highest = leaves - depths.first().copied().unwrap_or(0.0);
        if leaves > along.abs() - NOTHING || highest > above_end {
            return PostCode::Thread.err(format!(
                "a run-out of {leaves:.4} at 45 degrees (thread.chamfer) is longer than the thread, or goes beyond its clearance plane"
            ));
        }
        Ok(Shape {
            leaves,
            crest: thread.crest,
            out,
            slant,
            flank: libm::tan((thread.angle / 2.0).to_radians()),
            pitch,
            clearance,
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
    pub fn begin(&self, start: u32, depth: f64) -> Target {
        let along = depth * self.flank - self.away(start);
        self.beside(self.crest[0], self.slant * along - self.out * depth)
    }

    /// A point beside the thread, moved to the clear level.
    pub fn clear_of(&self, target: Target) -> Target {
        let up = (self.shifted(0).point - target.point).dot(&self.out);
        self.beside(target, self.out * up)
    }

    /// Where a pass of this depth begins, moved to the clear level.
    pub fn above(&self, start: u32, depth: f64) -> Target {
        self.clear_of(self.begin(start, depth))
    }

    /// Where a pass ends, with the crest moved to the side by this much, or begins to leave the
    /// thread.
    pub fn end(&self, out: f64) -> Target {
        self.beside(self.crest[1], self.out * out - self.slant * self.leaves)
    }

    /// Where a pass of this depth has left the thread at 45 degrees; `None` where it goes to the
    /// end.
    pub fn left(&self, depth: f64) -> Option<Target> {
        let along = self.slant.component_mul(&self.axis_mask());
        let way = (along + self.out) * self.leaves;
        (self.leaves > 0.0).then(|| self.beside(self.end(-depth), way))
    }

    /// The way out in tenths of the lead; `None` for one that they can't say.
    pub fn chamfer_in_tenths(&self, thread: &Thread) -> Option<u32> {
        let tenths = self.leaves / thread.lead.value * 10.0;
        let whole = (tenths - tenths.round()).abs() < 1e-6 && tenths < 99.5;
        whole.then(|| tenths.round() as u32)
    }

    /// The way out along the thread; 0 where each pass goes to the end.
    pub fn leaves(&self) -> f64 {
        self.leaves
    }

    /// The way out is as long as the thread is deep, so that 45 degrees rise by its full height.
    pub fn leaves_by_its_height(&self, thread: &Thread) -> bool {
        (self.leaves - thread.depth).abs() < NOTHING
    }

    /// Pass i of n lies at the root of i/n of the depth, in front of those at full depth.
    pub fn divides_evenly(&self, thread: &Thread) -> bool {
        let count = self.cuts(thread).len() as f64;
        self.cuts_lie_at(thread, |pass| thread.depth * (pass / count).sqrt())
    }

    /// Pass i lies at the root of i times the first depth, the last one at the full depth: what
    /// cycles without a least depth do.
    pub fn follows_roots(&self, thread: &Thread) -> bool {
        let ThreadPasses::First(first) = thread.passes else { return false };
        self.cuts_lie_at(thread, |pass| (first * pass.sqrt()).min(thread.depth))
    }

    /// Pass i lies at the root of i times the depth of the first, the last one at the full depth.
    pub fn goes_by_roots(&self, thread: &Thread) -> bool {
        let first = self.cuts(thread).first().copied().unwrap_or(thread.depth);
        self.cuts_lie_at(thread, |pass| (first * pass.sqrt()).min(thread.depth))
    }

    /// Each pass that goes deeper lies at the depth that a law has for its number, from 1.
    fn cuts_lie_at(&self, thread: &Thread, law: impl Fn(f64) -> f64) -> bool {
        let mut cuts = self.cuts(thread).iter().zip(1_u32..);
        cuts.all(|(depth, pass)| (depth - law(f64::from(pass))).abs() < NOTHING)
    }

    /// The depths of the passes that go deeper.
    pub fn cuts(&self, thread: &Thread) -> &[f64] {
        let springs = (thread.springs as usize).min(self.depths.len());
        &self.depths[..self.depths.len() - springs]
    }

    /// The end of the crest moved down to a depth, wherever a pass begins to leave the thread.
    pub fn root_end(&self, depth: f64) -> Target {
        self.beside(self.crest[1], -self.out * depth)
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
fn check_axis(thread: &Thread, clearance: f64) -> Result<()> {
    let radii = thread.crest.map(|target| target.point.x.abs());
    let crosses = thread.crest[0].point.x * thread.crest[1].point.x < 0.0;
    let least = radii[0].min(radii[1]);
    let beyond = match thread.side {
        ThreadSide::Outside => thread.depth >= least || crosses,
        ThreadSide::Inside => clearance > radii[0] || crosses,
        ThreadSide::Before | ThreadSide::Behind => crosses,
    };
    if beyond {
        return PostCode::Thread.err("the thread or its return move is beyond the center line");
    }
    Ok(())
}

/// The depth of each pass.
///
/// # Errors
/// More passes than a thread can have.
fn depths(thread: &Thread, least: f64) -> Result<Vec<f64>> {
    let mut depths = match thread.passes {
        ThreadPasses::Count(count) => {
            let share = |pass: u32| (f64::from(pass) / f64::from(count)).sqrt();
            let most = count.min(MOST_PASSES as u32 + 1);
            (1..=most).map(|pass| thread.depth * share(pass)).collect()
        }
        ThreadPasses::First(first) => by_first(thread.depth, first, least),
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

/// Where one start of a thread lies in the machine, X and Z, X as a radius.
pub struct Ends {
    /// Clear of the crest, where the tool begins.
    pub begin: [f64; 2],
    /// Where its crest begins and ends.
    pub crest: [[f64; 2]; 2],
    /// The end of the crest, moved down to the full depth.
    pub root: [f64; 2],
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Each pass goes deeper than the one before, by no more chip than the first, and the last
        /// one to the depth.
        #[test]
        fn passes_by_the_first_take_equal_chips(
            depth in 0.1..5.0, share in 0.04..1.2, least in 0.0..0.05,
        ) {
            let first = depth * share;
            let depths = by_first(depth, first, least);
            prop_assert_eq!(*depths.last().unwrap(), depth);
            prop_assert!((depths[0] - f64::max(first, least).min(depth)).abs() < 1e-12);
            for (at, pair) in depths.windows(2).enumerate() {
                let [before, now] = [pair[0], pair[1]];
                prop_assert!(now > before);
                // A chip is as large as the difference of two squares: the flanks open evenly.
                let chip = now * now - before * before;
                let by_least = now - before <= least + NOTHING;
                prop_assert!(chip <= first * first + 1e-5 || by_least, "pass {at}: {chip}");
            }
        }
    }

    #[test]
    fn a_first_pass_deeper_than_the_thread_is_the_only_one() {
        assert_eq!(by_first(0.5, 0.8, 0.0), [0.5]);
        // By hand: the roots of 1, 2 and 3 times 0.4, then the depth.
        let passes = by_first(0.75, 0.4, 0.0);
        let by_hand = [0.4, 0.565_685_424_949_238, 0.692_820_323_027_551, 0.75];
        assert!(passes.iter().zip(by_hand).all(|(pass, by_hand)| (pass - by_hand).abs() < 1e-12));
        assert_eq!(passes.len(), by_hand.len());
    }
}
