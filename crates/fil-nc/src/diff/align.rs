//! Which block of one program stands for which block of the other.

use imara_diff::{Algorithm, Diff, InternedInput};

use super::Options;
use super::pair;
use super::program::{Line, Program};

/// Largest table of a place where nothing is equal; a larger one is paired in
/// the order of its blocks.
const LARGEST_TABLE: usize = 250_000;

/// Cost of a block that stands alone; two blocks that share less than
/// `1 - 2 * ALONE` of their words stay alone.
const ALONE: f64 = 0.45;

/// A pair of blocks, or one alone.
type Pair = [Option<usize>; 2];

/// Pairs of indices, in order.
pub(super) fn align(first: &Program, second: &Program, options: &Options) -> Vec<Pair> {
    let (one, two) = (&first.lines, &second.lines);
    let mut input = InternedInput::default();
    input.update_before(one.iter().map(|line| line.token));
    input.update_after(two.iter().map(|line| line.token));
    let mut changes = Diff::compute(Algorithm::Myers, &input);
    changes.postprocess_no_heuristic(&input);
    let mut pairs = Vec::with_capacity(one.len().max(two.len()));
    let (mut old_at, mut new_at) = (0, 0);
    for hunk in changes.hunks() {
        let old = hunk.before.start as usize..hunk.before.end as usize;
        let new = hunk.after.start as usize..hunk.after.end as usize;
        pairs.extend((old_at..old.start).zip(new_at..).map(|(old, new)| [Some(old), Some(new)]));
        (old_at, new_at) = (old.end, new.end);
        pairs.extend(
            replaced(&one[old.clone()], &two[new.clone()], options)
                .into_iter()
                .map(|pair| [pair[0].map(|at| at + old.start), pair[1].map(|at| at + new.start)]),
        );
    }
    pairs.extend((old_at..one.len()).zip(new_at..).map(|(old, new)| [Some(old), Some(new)]));
    pairs
}

/// Pairs two runs of blocks of which none is the same.
fn replaced(old: &[Line], new: &[Line], options: &Options) -> Vec<Pair> {
    if old.len() * new.len() <= LARGEST_TABLE {
        by_likeness(old, new, options)
    } else {
        in_order(old.len(), new.len())
    }
}

fn in_order(old: usize, new: usize) -> Vec<Pair> {
    (0..old.max(new))
        .map(|at| [Some(at).filter(|at| *at < old), Some(at).filter(|at| *at < new)])
        .collect()
}

/// The cheapest pairing of two short runs of blocks (Needleman and Wunsch): a
/// pair costs the share of words that differ.
fn by_likeness(old: &[Line], new: &[Line], options: &Options) -> Vec<Pair> {
    let width = new.len() + 1;
    let mut cost = vec![0.0; (old.len() + 1) * width];
    for i in (0..=old.len()).rev() {
        for j in (0..=new.len()).rev() {
            cost[i * width + j] = match (old.get(i), new.get(j)) {
                (None, None) => 0.0,
                (None, Some(_)) => cost[i * width + j + 1] + ALONE,
                (Some(_), None) => cost[(i + 1) * width + j] + ALONE,
                (Some(one), Some(two)) => {
                    let pair = cost[(i + 1) * width + j + 1] + pair::unlike(one, two, options);
                    let alone = cost[i * width + j + 1].min(cost[(i + 1) * width + j]) + ALONE;
                    pair.min(alone)
                }
            };
        }
    }
    let (mut i, mut j, mut pairs) = (0, 0, Vec::new());
    while i < old.len() || j < new.len() {
        let here = cost[i * width + j];
        let both = i < old.len() && j < new.len();
        if both && here == cost[(i + 1) * width + j + 1] + pair::unlike(&old[i], &new[j], options) {
            pairs.push([Some(i), Some(j)]);
            (i, j) = (i + 1, j + 1);
        } else if i < old.len() && here == cost[(i + 1) * width + j] + ALONE {
            pairs.push([Some(i), None]);
            i += 1;
        } else {
            pairs.push([None, Some(j)]);
            j += 1;
        }
    }
    pairs
}
