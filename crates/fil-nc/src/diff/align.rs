//! Which block of one program stands for which block of the other.

use std::ops::Range;

use fil_diag::Diag;
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

/// Blocks that follow each other, as pairs or alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// Index of the first block in each program; `None` where it has none.
    pub at: [Option<usize>; 2],
    pub count: usize,
}

/// Runs of blocks, in order.
///
/// # Errors
/// E0915
pub(super) fn align(
    first: &Program,
    second: &Program,
    options: &Options,
) -> Result<Vec<Run>, Box<Diag>> {
    let (one, two) = (first.tokens(), second.tokens());
    let mut input = InternedInput::default();
    input.update_before(one.iter().copied());
    input.update_after(two.iter().copied());
    let mut changes = Diff::compute(Algorithm::Myers, &input);
    changes.postprocess_no_heuristic(&input);
    drop(input);
    let (mut runs, mut old_at, mut new_at) = (Vec::new(), 0, 0);
    for hunk in changes.hunks() {
        let old = hunk.before.start as usize..hunk.before.end as usize;
        let new = hunk.after.start as usize..hunk.after.end as usize;
        add(&mut runs, [Some(old_at), Some(new_at)], old.start - old_at);
        (old_at, new_at) = (old.end, new.end);
        if old.len() * new.len() <= LARGEST_TABLE && !old.is_empty() && !new.is_empty() {
            by_likeness(Likeness::new(first, second, old, new, options)?, &mut runs);
        } else {
            in_order(old, new, &mut runs);
        }
    }
    add(&mut runs, [Some(old_at), Some(new_at)], one.len() - old_at);
    Ok(runs)
}

/// Adds a run, to the last one where it goes on with it.
fn add(runs: &mut Vec<Run>, at: [Option<usize>; 2], count: usize) {
    match runs.last_mut() {
        _ if count == 0 => {}
        Some(last) if last.at.map(|at| at.map(|at| at + last.count)) == at => last.count += count,
        _ => runs.push(Run { at, count }),
    }
}

fn in_order(old: Range<usize>, new: Range<usize>, runs: &mut Vec<Run>) {
    let both = old.len().min(new.len());
    add(runs, [Some(old.start), Some(new.start)], both);
    add(runs, [Some(old.start + both), None], old.len() - both);
    add(runs, [None, Some(new.start + both)], new.len() - both);
}

/// How unlike each block of one place is to each block of the other, 0 to 1.
struct Likeness {
    old: Range<usize>,
    new: Range<usize>,
    /// A row for each old block.
    unlike: Vec<f64>,
}

impl Likeness {
    /// Compares each with each. Only the blocks of the shorter side are held in memory.
    fn new(
        first: &Program,
        second: &Program,
        old: Range<usize>,
        new: Range<usize>,
        options: &Options,
    ) -> Result<Self, Box<Diag>> {
        let mut unlike = vec![0.0; old.len() * new.len()];
        let width = new.len();
        if old.len() <= new.len() {
            let held = blocks(first, old.clone())?;
            let mut cursor = second.cursor(new.start);
            for j in 0..new.len() {
                let two = cursor.block(new.start + j)?;
                for (i, one) in held.iter().enumerate() {
                    unlike[i * width + j] = pair::unlike(one, two, options);
                }
            }
        } else {
            let held = blocks(second, new.clone())?;
            let mut cursor = first.cursor(old.start);
            for i in 0..old.len() {
                let one = cursor.block(old.start + i)?;
                for (j, two) in held.iter().enumerate() {
                    unlike[i * width + j] = pair::unlike(one, two, options);
                }
            }
        }
        Ok(Likeness { old, new, unlike })
    }

    fn unlike(&self, i: usize, j: usize) -> f64 {
        self.unlike[i * self.new.len() + j]
    }
}

fn blocks(program: &Program, range: Range<usize>) -> Result<Vec<Line>, Box<Diag>> {
    let mut cursor = program.cursor(range.start);
    range.map(|at| cursor.block(at).cloned()).collect()
}

/// The cheapest pairing of two short runs of blocks (Needleman and Wunsch): a
/// pair costs the share of words that differ.
fn by_likeness(likeness: Likeness, runs: &mut Vec<Run>) {
    let (old, new) = (likeness.old.len(), likeness.new.len());
    let width = new + 1;
    let mut cost = vec![0.0; (old + 1) * width];
    for i in (0..=old).rev() {
        for j in (0..=new).rev() {
            cost[i * width + j] = match (i < old, j < new) {
                (false, false) => 0.0,
                (false, true) => cost[i * width + j + 1] + ALONE,
                (true, false) => cost[(i + 1) * width + j] + ALONE,
                (true, true) => {
                    let pair = cost[(i + 1) * width + j + 1] + likeness.unlike(i, j);
                    let alone = cost[i * width + j + 1].min(cost[(i + 1) * width + j]) + ALONE;
                    pair.min(alone)
                }
            };
        }
    }
    let (mut i, mut j) = (0, 0);
    while i < old || j < new {
        let here = cost[i * width + j];
        let at = [likeness.old.start + i, likeness.new.start + j];
        let both = i < old && j < new;
        if both && here == cost[(i + 1) * width + j + 1] + likeness.unlike(i, j) {
            add(runs, at.map(Some), 1);
            (i, j) = (i + 1, j + 1);
        } else if i < old && here == cost[(i + 1) * width + j] + ALONE {
            add(runs, [Some(at[0]), None], 1);
            i += 1;
        } else {
            add(runs, [None, Some(at[1])], 1);
            j += 1;
        }
    }
}
