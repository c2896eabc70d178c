//! Which of the positions that bring the tool along its axis the rotary axes take at a RAPID
//! behind which the motions are known: those from which they meet fewest limits and poles, the
//! travel of X, Y and Z too. Else, and of several such, the nearest. Where the tool lies along the
//! pole the first axis may stand anywhere: there it may stand where the first tilt behind it wants
//! it, so that the tool tilts without a swing.

use fil_machine::axes::AxisSet;
use fil_machine::axis_chain::AxisChain;
use fil_machine::locations as loc;
use fil_machine::tables::MachineTables;
use nalgebra::{Point3, Vector3};

use super::pole::{off_its_plane, spelled};
use super::position;
use crate::errors::PostCode;
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// A motion that comes behind a RAPID, as its record gives it.
#[derive(Clone, Copy, Debug)]
pub struct Coming {
    /// Its point, mm or inch; `None` for a step from the one before.
    pub point: Option<[f64; 3]>,
    /// Its tool axis; `None` for one that keeps the axis before it.
    pub axis: Option<[f64; 3]>,
}

/// The same in the part of the machine: after TRANS.
type Ahead = (Option<Point3<f64>>, Vector3<f64>);

/// Positions of the rotary axes, behind how many limits and poles are met from there.
type Tried = (u32, [f64; 2]);

/// Chooses the positions for a rapid motion: its own solution is the nearest to them.
#[cold]
pub(super) fn choose(post: &mut Post, target: Target, kind: MotionKind) {
    let coming = std::mem::take(&mut post.path.ahead.motions);
    if !matches!(kind, MotionKind::Rapid(_)) || post.control.tables.mills() {
        return;
    }
    let (point, axis) = position::transformed(post, target);
    let last = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    // The first of them is the motion at hand.
    let mut own = target.axis;
    let behind = coming.into_iter().skip(1).map(|next| {
        own = next.axis.map_or(own, Vector3::from);
        let given = Point3::from(next.point.unwrap_or_default());
        let (point, axis) =
            position::transformed(post, Target { point: given, axis: own, word: 0 });
        (next.point.map(|_| point), axis)
    });
    let ahead: Vec<Ahead> = std::iter::once((Some(point), axis)).chain(behind).collect();
    let tables = &post.control.tables;
    let lean = post.control.commons.dbl_opt(loc::ROTARY_AXIS_TOLERANCE).unwrap_or(0.0);
    let way = |to: &[f64; 2]| (to[0] - last[0]).abs() + (to[1] - last[1]).abs();
    let all = candidates(tables.chain(), axis, &ahead, last).into_iter();
    let all: Vec<Tried> = all.map(|to| (met(tables, to, &ahead, lean), to)).collect();
    let tried = all.iter();
    let best = tried.min_by(|(met, a), (other, b)| met.cmp(other).then(way(a).total_cmp(&way(b))));
    if let Some((_, to)) = best.copied() {
        post.path.turning.chosen = Some(to);
        if post.control.commons.read(loc::REPOS_OPTIMISE_TRACE) {
            tell(post, &all, to, ahead.len());
        }
    }
}

/// The positions for a tool axis; along the pole those from which the tool tilts to the first axis
/// behind it that leaves the pole, too.
fn candidates(
    chain: &AxisChain,
    axis: Vector3<f64>,
    ahead: &[Ahead],
    last: [f64; 2],
) -> Vec<[f64; 2]> {
    let mut all = chain.positions(axis, last);
    let tilted = ahead.iter().map(|(_, next)| *next).find(|next| !chain.is_pole(*next));
    let Some(tilted) = tilted.filter(|_| chain.is_pole(axis)) else { return all };
    let seconds: Vec<f64> = all.iter().map(|at| at[1]).collect();
    for tilt in chain.positions(tilted, last) {
        all.extend(seconds.iter().map(|second| [tilt[0], *second]));
    }
    all
}

/// Says what was tried for a RAPID, and what was taken.
fn tell(post: &mut Post, all: &[Tried], taken: [f64; 2], motions: usize) {
    let from = all.iter().map(|(met, to)| format!("{met} from {}", spelled(*to)));
    let message = format!(
        "in {motions} motions the rotary axes meet limits and poles: {}; {} is taken",
        from.collect::<Vec<_>>().join(", "),
        spelled(taken)
    );
    post.warn(PostCode::LookAhead, message);
}

/// How many limits and poles the motions meet from a position of the rotary axes.
fn met(tables: &MachineTables, from: [f64; 2], ahead: &[Ahead], lean: f64) -> u32 {
    let chain = tables.chain();
    let mut at = from;
    let mut met = 0;
    for (point, axis) in ahead {
        let Some(next) = chain.nearest_anywhere(*axis, at) else { break };
        if chain.goes(at, next) {
            let far = (next[0] - at[0]).abs().max((next[1] - at[1]).abs()) > lean;
            met += u32::from(lean > 0.0 && far && off_its_plane(chain, at, next) > lean);
            at = next;
        } else {
            met += 1;
            let Ok(other) = chain.solve(*axis, at) else { break };
            at = other;
        }
        met += u32::from(point.is_some_and(|point| is_outside(tables, point, at)));
    }
    met
}

/// X, Y or Z would have to go past its travel.
fn is_outside(tables: &MachineTables, point: Point3<f64>, angles: [f64; 2]) -> bool {
    let at = tables.chain().linear(point, angles);
    tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], AxisSet::LINEAR).is_err()
}
