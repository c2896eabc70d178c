//! Which of the positions that bring the tool along its axis the rotary axes take at a RAPID
//! behind which the tool axes are known: those from which the motions meet fewest limits and
//! poles. Else, and of several such, the nearest.

use fil_machine::axis_chain::AxisChain;
use fil_machine::locations as loc;
use nalgebra::Vector3;

use super::rotary;
use super::turning::off_its_plane;
use crate::operation::{MotionKind, Target};
use crate::post::Post;

/// Chooses the positions for a rapid motion: its own solution is the nearest to them.
#[cold]
pub(super) fn choose(post: &mut Post, target: Target, kind: MotionKind) {
    let coming = std::mem::take(&mut post.path.coming);
    if !matches!(kind, MotionKind::Rapid(_)) || post.control.tables.mills() {
        return;
    }
    let (_, axis) = rotary::transformed(post, target);
    let last = post.path.rotary.unwrap_or_else(|| rotary::on_tape(post));
    // The first of them is the motion at hand.
    let mut own = target.axis;
    let axes: Vec<Vector3<f64>> = coming
        .into_iter()
        .skip(1)
        .map(|given| {
            own = given.map_or(own, Vector3::from);
            post.path.transformation.as_ref().map_or(own, |trans| trans.axis(own))
        })
        .collect();
    let chain = post.control.tables.chain();
    let lean = post.control.commons.dbl_opt(loc::ROTARY_AXIS_TOLERANCE).unwrap_or(0.0);
    let way = |to: &[f64; 2]| (to[0] - last[0]).abs() + (to[1] - last[1]).abs();
    let all = chain.positions(axis, last).into_iter().map(|to| (met(chain, to, &axes, lean), to));
    let best = all.min_by(|(met, a), (other, b)| met.cmp(other).then(way(a).total_cmp(&way(b))));
    if let Some((_, to)) = best {
        post.path.chosen = Some(to);
    }
}

/// How many limits and poles the motions along these tool axes meet from a position.
fn met(chain: &AxisChain, from: [f64; 2], axes: &[Vector3<f64>], lean: f64) -> u32 {
    let mut at = from;
    let mut met = 0;
    for axis in axes {
        let Some(next) = chain.nearest_anywhere(*axis, at) else { break };
        if chain.reaches(next) {
            let far = (next[0] - at[0]).abs().max((next[1] - at[1]).abs()) > lean;
            met += u32::from(lean > 0.0 && far && off_its_plane(chain, at, next) > lean);
            at = next;
            continue;
        }
        met += 1;
        let Ok(other) = chain.solve(*axis, at) else { break };
        at = other;
    }
    met
}
