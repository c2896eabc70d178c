//! Straight motions that would leave the travel of X, Y or Z, on a machine with rotary axes
//! whose settings say what is done there: other positions of the rotary axes for the same tool
//! axis, or a warning.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::tables::MachineTables;
use nalgebra::Point3;

use super::{linear, reposition, rotary};
use crate::errors::PostCode;
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// Places between the ends at which the axes are looked at.
const SAMPLES: u32 = 32;

/// Halvings of the part in which an axis comes to the end of its travel.
const HALVINGS: u32 = 40;

/// A straight way of the tip while the rotary axes go evenly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its ends in the part, behind TRANS.
    pub line: [Point3<f64>; 2],
    /// The rotary axes there, degrees.
    pub turn: [[f64; 2]; 2],
}

impl Way {
    /// Where the rotary axes stand at a share of the way, degrees.
    pub fn angles(&self, share: f64) -> [f64; 2] {
        let [from, to] = self.turn;
        [0, 1].map(|n| from[n] + (to[n] - from[n]) * share)
    }

    /// Which axes are outside of their travel at a share of the way.
    fn exceeded_at(&self, tables: &MachineTables, share: f64) -> AxisSet {
        let at = self.axes_at(tables, share);
        tables.exceeded([at.x, at.y, at.z])
    }

    /// Where X, Y and Z of the machine stand at a share of the way.
    fn axes_at(&self, tables: &MachineTables, share: f64) -> Point3<f64> {
        let [from, to] = self.line;
        tables.chain().linear(from + (to - from) * share, self.angles(share))
    }

    /// Which axes leave their travel on the way; where it begins they stand already.
    fn exceeded(&self, tables: &MachineTables) -> AxisSet {
        shares().map(|share| self.exceeded_at(tables, share)).fold(AxisSet::NONE, AxisSet::or)
    }

    /// Where an axis stands last outside of its travel, in words.
    fn told(&self, tables: &MachineTables, number: usize) -> Option<String> {
        let axis = AxisSet::of(number);
        let outside = |share: &f64| !self.exceeded_at(tables, *share).and(axis).is_empty();
        let share = shares().filter(outside).last()?;
        let at = self.axes_at(tables, share);
        Some(tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], axis).err()?.message)
    }

    /// No axis leaves its travel, from the beginning on.
    pub fn is_inside(&self, tables: &MachineTables) -> bool {
        self.exceeded_at(tables, 0.0).is_empty() && self.exceeded(tables).is_empty()
    }

    /// The share of the way at which the first axis comes to the end of its travel.
    pub fn share_inside(&self, tables: &MachineTables) -> f64 {
        let leaves = |share: &f64| !self.exceeded_at(tables, *share).is_empty();
        let Some(mut outside) = shares().find(leaves) else { return 1.0 };
        let mut inside = outside - 1.0 / f64::from(SAMPLES);
        for _ in 0..HALVINGS {
            let middle = (inside + outside) / 2.0;
            if leaves(&middle) { outside = middle } else { inside = middle }
        }
        inside
    }
}

fn shares() -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(|number| f64::from(number) / f64::from(SAMPLES))
}

/// Makes a straight motion of a machine whose settings say what it does where X, Y or Z would
/// leave its travel.
///
/// # Errors
/// As a straight motion; no other positions keep within the travel.
#[cold]
pub(super) fn carry_out(post: &mut Post, target: Target, kind: MotionKind) -> Result<()> {
    let Some(way) = way_of(post, target, kind) else { return linear::go(post, target, kind) };
    let rules = post.control.tables.travel_rules;
    let exceeded = way.exceeded(&post.control.tables);
    let in_frame = post.control.tables.frame_output && !post.writes_tip();
    if !exceeded.and(rules.reposition).is_empty() && !in_frame {
        match kind {
            MotionKind::Rapid(_) => choose(post, target, &way),
            _ if reposition::at_travel(post, &way, target)? => return Ok(()),
            _ => {}
        }
        return linear::go(post, target, kind);
    }
    let warned = exceeded.and(rules.warn);
    if warned.is_empty() {
        return linear::go(post, target, kind);
    }
    for number in warned.numbers() {
        if let Some(told) = way.told(&post.control.tables, number) {
            post.warn(PostCode::BeyondTravel, told);
        }
    }
    let bounds = post.control.tables.unbound(warned);
    let made = linear::go(post, target, kind);
    post.control.tables.bound_again(bounds);
    made
}

/// The way of a motion: as if rotary axes had no limits, since those have settings of their own;
/// of a rapid motion its end, to which the axes need not go evenly. `None` for a motion
/// that turns past a limit, for a thread, and for a tool axis out of reach.
fn way_of(post: &Post, target: Target, kind: MotionKind) -> Option<Way> {
    let (to, axis) = rotary::transformed(post, target);
    let chain = post.control.tables.chain();
    let stands = post.path.rotary.unwrap_or_else(|| rotary::on_tape(post));
    match kind {
        MotionKind::Rapid(_) => {
            let angles = chain.solve(axis, post.path.turning.chosen.unwrap_or(stands)).ok()?;
            Some(Way { line: [to; 2], turn: [angles; 2] })
        }
        MotionKind::Feed => {
            let angles =
                chain.nearest_anywhere(axis, stands).filter(|at| chain.goes(stands, *at))?;
            let from = post.path.point.map(|point| Target { point, ..target });
            let from = from.map_or(to, |from| rotary::transformed(post, from).0);
            Some(Way { line: [from, to], turn: [stands, angles] })
        }
        MotionKind::Thread(_) => None,
    }
}

/// Chooses for a rapid motion the nearest positions that keep X, Y and Z within their travel.
fn choose(post: &mut Post, target: Target, way: &Way) {
    let (point, axis) = rotary::transformed(post, target);
    let tables = &post.control.tables;
    let stands = post.path.rotary.unwrap_or_else(|| rotary::on_tape(post));
    let far = |to: &[f64; 2]| (to[0] - stands[0]).abs() + (to[1] - stands[1]).abs();
    let fits = |to: &[f64; 2]| Way { line: [point; 2], turn: [*to; 2] }.is_inside(tables);
    let others = tables.chain().positions(axis, way.turn[1]).into_iter().filter(fits);
    if let Some(to) = others.min_by(|a, b| far(a).total_cmp(&far(b))) {
        post.path.turning.chosen = Some(to);
    }
}
