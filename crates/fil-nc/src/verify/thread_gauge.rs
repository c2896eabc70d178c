//! A whole thread as a gauge: how deep beside its crest, and how far along it, a place lies, and
//! where its passes must.

use fil_machine::modes::INCH;
use nalgebra::Point3;

use super::expected_step::WholeThread;
use super::say::short;
use crate::motion::Position;

/// Most passes of one thread.
const MOST_PASSES: usize = 10_000;

/// What rounding may change of a first depth or a taper, last digits: a half, and a little.
pub(super) const ROUNDED: f64 = 0.6;

/// What is wrong with a thread: the line of the program, 0 for none, and what it is.
pub(super) type Found<T> = Result<T, (u32, String)>;

/// A pass: the start it belongs to and its depth.
pub(super) struct Pass {
    pub(super) start: u32,
    /// X and Z where it begins and ends.
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) depth: f64,
    pub(super) line: u32,
    pub(super) in_cycle: bool,
}

/// A thread with what is measured along and across it.
pub(super) struct Gauge<'t> {
    pub(super) thread: &'t WholeThread,
    /// 0 or 2: the axis it runs along.
    pub(super) axis: usize,
    /// Its direction along that axis.
    pub(super) towards: f64,
    pub(super) length: f64,
    pub(super) slope: f64,
    /// Way before the end on which a pass leaves the thread at 45 degrees, mm.
    pub(super) leaves: f64,
    /// Height above the begin of the crest at which the tool goes back, mm.
    pub(super) clear: f64,
    /// What the last digits of both axes may do, generously, mm.
    pub(super) slack: f64,
    /// What the last digit may do across and along the thread, mm.
    pub(super) digits: [f64; 2],
    /// The smallest step of the control, mm.
    pub(super) step: f64,
}

impl Gauge<'_> {
    /// Way along the thread from the begin of the crest, mm.
    pub(super) fn along(&self, at: &Position) -> f64 {
        (at.linear[self.axis] - self.thread.crest[0][self.axis]) * self.towards
    }

    /// Depth below the crest, or its prolongation, mm.
    pub(super) fn depth(&self, at: &Position) -> f64 {
        let [begin, end] = self.thread.crest;
        let share = self.along(at) / self.length;
        let crest = begin + (end - begin) * share;
        -(Point3::from(at.linear) - crest).dot(&self.thread.out)
    }

    /// A way from the other side of the crest of a bore or an outside thread crosses it, or what
    /// lies behind it, elsewhere than before the part.
    pub(super) fn goes_through_the_wall(&self, from: &Position, to: &Position) -> bool {
        let [begin, end] = [from, to].map(|at| self.depth(at));
        if self.axis != 2 || begin <= self.slack || end > self.slack {
            return false;
        }
        let share = (begin / (begin - end)).min(1.0);
        let along = self.along(from) + (self.along(to) - self.along(from)) * share;
        along > self.slack
    }

    /// The tool stands at the level at which it goes back.
    pub(super) fn is_clear(&self, at: &Position) -> bool {
        let height = (Point3::from(at.linear) - self.thread.crest[0]).dot(&self.thread.out);
        (height - self.clear).abs() <= self.digits[0]
    }

    /// The tool stands where a start begins, clear of it.
    pub(super) fn is_at_a_start(&self, at: &Position) -> bool {
        let pitch = self.thread.lead / f64::from(self.thread.starts);
        let early = -self.along(at) / pitch;
        let is_start = (0.0..f64::from(self.thread.starts)).contains(&(early.round() + 0.0));
        self.is_clear(at) && is_start && (early - early.round()).abs() * pitch <= self.digits[1]
    }

    /// Refuses a pass that does not lie where its depth wants it.
    pub(super) fn lies_at(&self, pass: &Pass, depth: f64, divided: bool) -> Found<()> {
        let WholeThread { crest: [begin, end], out, lead, starts, first, .. } = *self.thread;
        let along = depth * self.slope - lead / f64::from(starts) * f64::from(pass.start);
        let from = begin + (end - begin) * (along / self.length) - out * depth;
        let to = end - out * depth - (end - begin) * (self.leaves / self.length);
        let at_root = depth >= self.thread.depth - 1e-9;
        // A cycle says its taper, and one of all passes their depths, by words of their own,
        // and each is rounded.
        let rounded = ROUNDED * self.step;
        let of_words = if divided { rounded * (1.0 + depth / first) } else { 0.0 };
        let of_taper = if pass.in_cycle { rounded } else { 0.0 };
        let [across, lengthwise] = self.digits;
        let near = |found: [f64; 2], wanted: Point3<f64>, more: [f64; 2]| {
            let off = [found[0] - wanted.x, found[1] - wanted.z];
            let [of_axis, of_depth] = if self.axis == 2 { [off[1], off[0]] } else { off };
            of_depth.abs() <= across + more[0] && of_axis.abs() <= lengthwise + more[1]
        };
        let lag = if divided && !at_root { self.thread.depth * self.slope } else { 0.0 };
        let begins = near(pass.from, from, [of_words + of_taper, of_words * self.slope]);
        // Where it begins to leave the thread it lies on the taper.
        let of_corner = if self.leaves > 0.0 { of_taper } else { 0.0 };
        let ends = near(pass.to, to, [if at_root { 0.0 } else { of_words } + of_corner, lag]);
        if begins && ends {
            return Ok(());
        }
        let ([x, z], wanted) = if begins { (pass.to, to) } else { (pass.from, from) };
        let what = if begins { "ends" } else { "begins" };
        let [x, z, wx, wz] = [x, z, wanted.x, wanted.z].map(short);
        Err((pass.line, format!("a pass {what} at X{x} Z{z}, it should be at X{wx} Z{wz}")))
    }

    /// Depth of each pass to the root, by the law that is laid down.
    pub(super) fn rough(&self, least: f64) -> Vec<f64> {
        let WholeThread { depth, first, passes, .. } = *self.thread;
        if let Some(passes) = passes {
            let share = |pass: u32| (f64::from(pass) / f64::from(passes)).sqrt();
            return (1..=passes).map(|pass| depth * share(pass)).collect();
        }
        let mut depths: Vec<f64> = Vec::new();
        let mut reached = 0.0;
        // A pass so near the root, in the unit of the program, is the one at the root.
        let nothing = if self.step > 1e-3 { 1e-6 * INCH } else { 1e-6 };
        while reached < depth - nothing && depths.len() < MOST_PASSES {
            let next = first * ((depths.len() + 1) as f64).sqrt();
            reached = next.max(reached + least).min(depth);
            depths.push(reached);
        }
        depths
    }
}
