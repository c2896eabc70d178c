//! The blocks of two runs beside each other, record by record.

use std::cmp::Ordering;
use std::io::{Read, Seek};

use super::made::{Blocks, Made};
use crate::error::Error;

/// Pairs of blocks that are looked at for one record; more blocks are taken as they come.
const MOST_PAIRS: usize = 1 << 16;

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
    loop {
        let order = match (reference.record(), program.record()) {
            (None, None) => return Ok(()),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(one), Some(two)) => one.cmp(&two),
        };
        let left = if order.is_gt() { Vec::new() } else { reference.of_record()? };
        let right = if order.is_lt() { Vec::new() } else { program.of_record()? };
        take(program, &pairs(&left, &right));
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
    let best = best(left, right);
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        let here = best[i][j];
        if i < left.len() && best[i + 1][j] == here {
            pairs.push(Pair::LeftOut(&left[i]));
            i += 1;
        } else if j < right.len() && best[i][j + 1] == here {
            pairs.push(Pair::Added(&right[j]));
            j += 1;
        } else {
            pairs.push(pair(&left[i], &right[j]));
            (i, j) = (i + 1, j + 1);
        }
    }
    pairs
}

fn pair<'b>(left: &'b Made, right: &'b Made) -> Pair<'b> {
    if left.is_as(right) { Pair::Same(left, right) } else { Pair::Changed(left, right) }
}

/// What the rest from each place on counts at best.
fn best(left: &[Made], right: &[Made]) -> Vec<Vec<u32>> {
    let mut best = vec![vec![0; right.len() + 1]; left.len() + 1];
    for i in (0..left.len()).rev() {
        for j in (0..right.len()).rev() {
            let both = match likeness(&left[i], &right[j]) {
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
