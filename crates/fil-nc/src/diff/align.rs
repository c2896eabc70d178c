//! Which block of one program stands for which block of the other.

use similar::{Algorithm, DiffOp, capture_diff_slices_by_key};

use super::Options;
use super::pair;
use super::program::{Line, Program};

/// Largest table of a place where nothing is equal; a larger one is paired in
/// the order of its blocks.
const LARGEST_TABLE: usize = 250_000;

/// Cost of a block that stands alone; two blocks that share less than
/// `1 - 2 * ALONE` of their words stay alone.
const ALONE: f64 = 0.45;

/// Pairs of indices, in order.
pub(super) fn align(
    first: &Program,
    second: &Program,
    options: &Options,
) -> Vec<[Option<usize>; 2]> {
    let (one, two) = (&first.lines, &second.lines);
    let mut pairs = Vec::with_capacity(one.len().max(two.len()));
    for op in capture_diff_slices_by_key(Algorithm::Myers, one, two, |line| line.token) {
        match op {
            DiffOp::Equal { old_index, new_index, len } => {
                pairs.extend((0..len).map(|at| [Some(old_index + at), Some(new_index + at)]));
            }
            DiffOp::Delete { old_index, old_len, .. } => {
                pairs.extend((old_index..old_index + old_len).map(|at| [Some(at), None]));
            }
            DiffOp::Insert { new_index, new_len, .. } => {
                pairs.extend((new_index..new_index + new_len).map(|at| [None, Some(at)]));
            }
            DiffOp::Replace { old_index, old_len, new_index, new_len } => {
                let (old, new) = (&one[old_index..][..old_len], &two[new_index..][..new_len]);
                let replaced = if old_len * new_len <= LARGEST_TABLE {
                    by_likeness(old, new, options)
                } else {
                    in_order(old_len, new_len)
                };
                pairs.extend(replaced.into_iter().map(|[old, new]| {
                    [old.map(|at| at + old_index), new.map(|at| at + new_index)]
                }));
            }
        }
    }
    pairs
}

fn in_order(old: usize, new: usize) -> Vec<[Option<usize>; 2]> {
    (0..old.max(new))
        .map(|at| [Some(at).filter(|at| *at < old), Some(at).filter(|at| *at < new)])
        .collect()
}

/// The cheapest pairing of two short runs of blocks (Needleman and Wunsch): a
/// pair costs the share of words that differ.
fn by_likeness(old: &[Line], new: &[Line], options: &Options) -> Vec<[Option<usize>; 2]> {
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
