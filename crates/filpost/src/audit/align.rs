//! The blocks of two runs beside each other, record by record.

use std::cmp::Ordering;
use std::io::{Read, Seek};

use super::made::{Blocks, Made};
use crate::error::Error;

/// Pairs of blocks that are looked at for one record; more blocks are taken as they come.
const MOST_PAIRS: usize = 1 << 16;

/// Blocks that wait for the other program, and those of one record.
const MOST_WAITING: usize = 256;

/// What two equal blocks count, more than any two that are only alike.
const EQUAL: u32 = 1000;

/// A block of the reference, one of the program, or both.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pair<'b> {
    /// The same words.
    Same(&'b Made, &'b Made),
    /// One block with other words.
    Changed(&'b Made, &'b Made),
    /// The reference alone has it.
    LeftOut(&'b Made),
    /// The program alone has it.
    Added(&'b Made),
}

/// Goes along both and hands over the pairs of each record.
///
/// # Errors
/// Maps and programs that can't be read.
pub(super) fn records<A: Read + Seek, B: Read + Seek>(
    reference: &mut Blocks<'_, A>,
    program: &mut Blocks<'_, B>,
    mut take: impl FnMut(&Blocks<'_, B>, &[Pair<'_>]),
) -> Result<(), Error> {
    let mut waiting = Waiting::default();
    loop {
        let order = match (reference.record(), program.record()) {
            (None, None) => {
                waiting.hand_over(|pairs| take(program, pairs));
                return Ok(());
            }
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(one), Some(two)) => one.cmp(&two),
        };
        let left = if order.is_gt() { Vec::new() } else { reference.of_record()? };
        let right = if order.is_lt() { Vec::new() } else { program.of_record()? };
        let pairs = pairs(&left, &right);
        let alone = pairs.iter().take_while(|pair| pair.is_alone()).count();
        let waits = alone == pairs.len() && alone <= MOST_WAITING && !waiting.is_full();
        let joins = waits || waiting.has_some_of(&pairs[..alone]);
        let (first, rest) = pairs.split_at(if joins { alone } else { 0 });
        waiting.blocks.extend(first.iter().map(|pair| pair.alone()));
        if !waits {
            waiting.hand_over(|pairs| take(program, pairs));
            take(program, rest);
        }
    }
}

/// Blocks that one of the programs alone has at their records, since both have had one: the other
/// may have them at a record before or behind, as where a text brings the start of a program
/// forward.
#[derive(Default)]
struct Waiting {
    /// The blocks, and whether the program has them, or else the reference.
    blocks: Vec<(bool, Made)>,
}

impl Waiting {
    fn is_full(&self) -> bool {
        self.blocks.len() > MOST_WAITING
    }

    /// The other program has one of these blocks at a record before.
    fn has_some_of(&self, pairs: &[Pair<'_>]) -> bool {
        let is_other = |pair: &Pair<'_>, (is_added, made): &(bool, Made)| match pair {
            Pair::LeftOut(left) => *is_added && made.is_as(left),
            Pair::Added(added) => !*is_added && made.is_as(added),
            Pair::Same(..) | Pair::Changed(..) => false,
        };
        pairs.iter().any(|pair| self.blocks.iter().any(|block| is_other(pair, block)))
    }

    /// Hands them over, those of one record together, and equal ones as the same block.
    fn hand_over(&mut self, mut take: impl FnMut(&[Pair<'_>])) {
        let blocks = std::mem::take(&mut self.blocks);
        let of = |added: bool| {
            let blocks = blocks.iter().filter(move |(is_added, _)| *is_added == added);
            blocks.map(|(_, made)| made).collect::<Vec<_>>()
        };
        let (left, right) = (of(false), of(true));
        let same = |one: &Made, two: &Made| u32::from(one.is_as(two));
        let mut pairs = paired(&left, &right, same);
        let record = |pair: &Pair<'_>| pair.made().place;
        let stays = |pair: &Pair<'_>| !pair.is_alone();
        for between in pairs.split_mut(stays) {
            between.sort_by_key(record);
        }
        let together = |one: &Pair<'_>, two: &Pair<'_>| {
            one.is_alone() && two.is_alone() && record(one) == record(two)
        };
        pairs.chunk_by(together).for_each(&mut take);
    }
}

impl Pair<'_> {
    /// One of the programs alone has it.
    fn is_alone(&self) -> bool {
        matches!(self, Pair::LeftOut(_) | Pair::Added(_))
    }

    /// Whether the program has it, or else the reference, of a block that one of them alone has.
    fn alone(&self) -> (bool, Made) {
        (matches!(self, Pair::Added(_)), self.made().clone())
    }

    /// The block, that of the program where both have it.
    fn made(&self) -> &Made {
        match self {
            Pair::Same(_, made) | Pair::Changed(_, made) => made,
            Pair::LeftOut(made) | Pair::Added(made) => made,
        }
    }
}

/// The blocks of one record, paired so that most are equal, then most alike.
fn pairs<'b>(left: &'b [Made], right: &'b [Made]) -> Vec<Pair<'b>> {
    let start = left.iter().zip(right).take_while(|(one, two)| one.is_as(two)).count();
    let same = |(one, two): (&'b Made, &'b Made)| Pair::Same(one, two);
    let mut pairs: Vec<Pair<'b>> = left.iter().zip(right).take(start).map(same).collect();
    let (left, right) = (&left[start..], &right[start..]);
    if left.len() * right.len() > MOST_PAIRS {
        pairs.extend(left.iter().zip(right).map(|(one, two)| pair(one, two)));
        let both = left.len().min(right.len());
        pairs.extend(left[both..].iter().map(Pair::LeftOut));
        pairs.extend(right[both..].iter().map(Pair::Added));
        return pairs;
    }
    let [left, right] = [left, right].map(|made| made.iter().collect::<Vec<_>>());
    pairs.extend(paired(&left, &right, likeness));
    pairs
}

/// The same for any count of what two blocks have in common, 0 for nothing.
fn paired<'b>(
    left: &[&'b Made],
    right: &[&'b Made],
    likeness: impl Fn(&Made, &Made) -> u32,
) -> Vec<Pair<'b>> {
    let best = best(left, right, likeness);
    let mut pairs = Vec::new();
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        let here = best[i][j];
        if i < left.len() && best[i + 1][j] == here {
            pairs.push(Pair::LeftOut(left[i]));
            i += 1;
        } else if j < right.len() && best[i][j + 1] == here {
            pairs.push(Pair::Added(right[j]));
            j += 1;
        } else {
            pairs.push(pair(left[i], right[j]));
            (i, j) = (i + 1, j + 1);
        }
    }
    pairs
}

fn pair<'b>(left: &'b Made, right: &'b Made) -> Pair<'b> {
    if left.is_as(right) { Pair::Same(left, right) } else { Pair::Changed(left, right) }
}

/// What the rest from each place on counts at best.
fn best(left: &[&Made], right: &[&Made], likeness: impl Fn(&Made, &Made) -> u32) -> Vec<Vec<u32>> {
    let mut best = vec![vec![0; right.len() + 1]; left.len() + 1];
    for i in (0..left.len()).rev() {
        for j in (0..right.len()).rev() {
            let both = match likeness(left[i], right[j]) {
                0 => 0,
                likeness => likeness + best[i + 1][j + 1],
            };
            best[i][j] = both.max(best[i + 1][j]).max(best[i][j + 1]);
        }
    }
    best
}

/// How alike two blocks are; 0 for blocks that have nothing to do with each other. Functions of
/// other numbers are other functions.
fn likeness(left: &Made, right: &Made) -> u32 {
    if left.is_as(right) {
        return EQUAL;
    }
    let likeness = |word: &super::made::Word| {
        let same = right.words.iter().any(|other| other.text == word.text);
        let address = !"GMO_/".contains(word.letter) && right.has(&word.letter.to_string());
        u32::from(same) + u32::from(address)
    };
    left.words.iter().map(likeness).sum()
}
