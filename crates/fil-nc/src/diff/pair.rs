//! Two blocks that stand for each other, word by word.

use super::arc;
use super::language::same_statement;
use super::modal::{group, tenths};
use super::program::Line;
use super::{Difference, Options, What};
use crate::text::{Block, Number, Word};

/// Letters whose numbers are lengths or angles.
const MEASURES: &[u8] = b"XYZABCUVWIJKRQ";

/// Letters that mean something else without a point on many controls.
const POINTED: &[u8] = b"XYZABCUVWIJKRQF";

/// Letters that say where an arc's center is.
const CENTER: &[u8] = b"IJKR";

/// Words of equal value may differ by this much, from decimal to binary.
const EXACT: f64 = 1e-9;

/// What was found so far. Numbering and points are one difference each, however
/// many blocks they touch.
#[derive(Default)]
pub(super) struct Found {
    differences: Vec<Difference>,
    numbering: Option<usize>,
    points: [Option<usize>; 26],
}

impl Found {
    pub fn only(&mut self, lines: [Option<u32>; 2]) {
        self.differences.push(Difference { lines, what: What::Only, words: [None, None] });
    }

    pub fn finish(self) -> Vec<Difference> {
        self.differences
    }

    fn add(&mut self, pair: Pair<'_>, what: What, words: [Option<&Word>; 2]) {
        let lines = [Some(pair.one.block.line), Some(pair.two.block.line)];
        let words = words.map(|word| word.map(|word| word.range.clone()));
        self.differences.push(Difference { lines, what, words });
    }

    fn numbering(&mut self, pair: Pair<'_>) {
        if let Some(at) = self.numbering {
            if let What::Numbering(count, _) = &mut self.differences[at].what {
                *count += 1;
            }
            return;
        }
        self.numbering = Some(self.differences.len());
        let numbers = [pair.one.block.sequence_number(), pair.two.block.sequence_number()];
        self.add(pair, What::Numbering(1, numbers), pair.words(b'N', None));
    }

    fn points(&mut self, pair: Pair<'_>, letter: u8, words: [Option<&Word>; 2]) {
        let held = &mut self.points[usize::from(letter - b'A')];
        if let Some(at) = *held {
            if let What::Points(_, count) = &mut self.differences[at].what {
                *count += 1;
            }
            return;
        }
        *held = Some(self.differences.len());
        self.add(pair, What::Points(letter, 1), words);
    }
}

#[derive(Clone, Copy)]
struct Pair<'l> {
    one: &'l Line,
    two: &'l Line,
}

impl<'l> Pair<'l> {
    fn words(self, letter: u8, index: Option<u32>) -> [Option<&'l Word>; 2] {
        [self.one, self.two].map(|line| {
            let mut words = line.block.words.iter().rev();
            words.find(|word| word.letter == letter && word.index == index)
        })
    }

    /// Addresses that either block has, without G, M and N, each once.
    fn addresses(self) -> Vec<(u8, Option<u32>)> {
        let words = self.one.block.words.iter().chain(&self.two.block.words);
        let mut addresses: Vec<_> = words
            .filter(|word| !matches!(word.letter, b'G' | b'M' | b'N'))
            .map(|word| (word.letter, word.index))
            .collect();
        addresses.sort_unstable();
        addresses.dedup();
        addresses
    }

    /// What both blocks mean by an address; `None` where nothing is in force.
    fn values(self, letter: u8, index: Option<u32>, options: &Options) -> [Option<f64>; 2] {
        let [one, two] = self.words(letter, index);
        [(self.one, one), (self.two, two)].map(|(line, word)| match word {
            Some(word) => Some(word.number.value()),
            None if options.modal || index.is_some() || !line.after.keeps(letter) => None,
            None => line.after.in_force(letter),
        })
    }
}

/// Both blocks have the same words and comments, but for the sequence number.
pub(super) fn written_alike(one: &Line, two: &Line) -> bool {
    let (one, two) = (&one.block, &two.block);
    fn words(block: &Block) -> impl Iterator<Item = (u8, Option<u32>, Number)> {
        let words = block.words.iter().filter(|word| word.letter != b'N');
        words.map(|word| (word.letter, word.index, word.number))
    }
    (one.skip, one.tape_mark) == (two.skip, two.tape_mark)
        && words(one).eq(words(two))
        && one.comments == two.comments
        && one.statement == two.statement
}

/// Compares the sequence numbers of two blocks that are [`written_alike`] where the
/// same is in force.
pub(super) fn compare_numbers(one: &Line, two: &Line, found: &mut Found) {
    if one.block.sequence_number() != two.block.sequence_number() {
        found.numbering(Pair { one, two });
    }
}

/// Compares two blocks.
pub(super) fn compare(one: &Line, two: &Line, options: &Options, found: &mut Found) {
    let pair = Pair { one, two };
    let marks = [one, two].map(|line| line.block.tape_mark || line.block.skip);
    if marks[0] != marks[1] || one.block.skip != two.block.skip {
        found.add(pair, What::Mark(marks), [None, None]);
    }
    let comments = [one, two].map(|line| line.block.comments.join(" "));
    if comments[0] != comments[1] {
        found.add(pair, What::Comment(comments), [None, None]);
    }
    let statements = [one, two].map(|line| line.block.statement.clone().unwrap_or_default());
    if !same_statement(&statements[0], &statements[1], options.tolerance) {
        found.add(pair, What::Statement(statements), [None, None]);
    }
    compare_numbers(one, two, found);
    compare_functions(pair, b'G', options, found);
    compare_functions(pair, b'M', options, found);
    let arcs = arc::deviation(one, two, options);
    for (letter, index) in pair.addresses() {
        if arcs.is_some() && index.is_none() && CENTER.contains(&letter) {
            continue;
        }
        compare_address(pair, letter, index, options, found);
    }
    if let Some(deviation) = arcs.filter(|deviation| *deviation > options.tolerance + EXACT) {
        found.add(pair, What::Arc(deviation), [None, None]);
    }
}

fn compare_address(
    pair: Pair<'_>,
    letter: u8,
    index: Option<u32>,
    options: &Options,
    found: &mut Found,
) {
    let words = pair.words(letter, index);
    let values = pair.values(letter, index, options);
    if !equal(letter, values, options) {
        found.add(pair, What::Word(letter, values), words);
    } else if let [Some(one), Some(two)] = words
        && one.number.point != two.number.point
        && one.number.digits != 0
        && POINTED.contains(&letter)
        && !options.ignore.points
    {
        found.points(pair, letter, words);
    }
}

fn equal(letter: u8, values: [Option<f64>; 2], options: &Options) -> bool {
    match values {
        [Some(one), Some(two)] => {
            let measure = MEASURES.contains(&letter);
            let tolerance = if measure { options.tolerance } else { 0.0 };
            (one - two).abs() <= tolerance + EXACT
        }
        [one, two] => one == two,
    }
}

/// Compares the preparatory or auxiliary functions of two blocks: those of a
/// modal group by what is in force, the others by what is written.
fn compare_functions(pair: Pair<'_>, letter: u8, options: &Options, found: &mut Found) {
    let mut groups_done = Vec::new();
    let mut lone: [Vec<&Word>; 2] = Default::default();
    for (side, line) in [pair.one, pair.two].into_iter().enumerate() {
        for word in line.block.words.iter().filter(|word| word.letter == letter) {
            match group(letter, tenths(word.number.value())).filter(|_| !options.modal) {
                None => lone[side].push(word),
                Some(group) if groups_done.contains(&group) => {}
                Some(group) => {
                    groups_done.push(group);
                    compare_group(pair, letter, group, found);
                }
            }
        }
    }
    let [mut one, mut two] = lone;
    one.retain(|word| take_equal(&mut two, word));
    for at in 0..one.len().max(two.len()) {
        let words = [one.get(at).copied(), two.get(at).copied()];
        let values = words.map(|word| word.map(|word| word.number.value()));
        found.add(pair, What::Function(letter, values), words);
    }
}

fn compare_group(pair: Pair<'_>, letter: u8, group_index: usize, found: &mut Found) {
    let codes = [pair.one, pair.two].map(|line| line.after.function(letter, group_index));
    if codes[0] == codes[1] {
        return;
    }
    let words = [pair.one, pair.two].map(|line| {
        let mut words = line.block.words.iter().rev();
        words.find(|word| {
            word.letter == letter && group(letter, tenths(word.number.value())) == Some(group_index)
        })
    });
    let codes = codes.map(|code| code.map(|tenths| tenths as f64 / 10.0));
    found.add(pair, What::Function(letter, codes), words);
}

/// Takes a word of equal value out of `words`; false when there was one.
fn take_equal(words: &mut Vec<&Word>, word: &Word) -> bool {
    let same =
        words.iter().position(|other| tenths(other.number.value()) == tenths(word.number.value()));
    same.map(|at| words.remove(at)).is_none()
}

/// How unlike two blocks are, 0 to 1: a word that one lacks counts in full,
/// another value half.
pub(super) fn unlike(one: &Line, two: &Line, options: &Options) -> f64 {
    let pair = Pair { one, two };
    let (mut total, mut cost) = (0.0, 0.0);
    for (letter, index) in pair.addresses() {
        let values = pair.values(letter, index, options);
        total += 1.0;
        cost += match values {
            _ if equal(letter, values, options) => 0.0,
            [Some(_), Some(_)] => 0.5,
            _ => 1.0,
        };
    }
    let mut found = Found::default();
    compare_functions(pair, b'G', options, &mut found);
    compare_functions(pair, b'M', options, &mut found);
    total += functions(one).max(functions(two)) as f64;
    cost += found.differences.len() as f64;
    if one.block.tape_mark != two.block.tape_mark {
        return 1.0;
    }
    let comments = [one, two].map(|line| !line.block.comments.is_empty());
    if comments[0] || comments[1] {
        total += 1.0;
        cost += match comments {
            [true, true] if one.block.comments == two.block.comments => 0.0,
            [true, true] => 0.5,
            _ => 1.0,
        };
    }
    if one.block.statement.is_some() || two.block.statement.is_some() {
        total += 2.0;
        cost += if one.block.statement == two.block.statement { 0.0 } else { 1.5 };
    }
    if total > 0.0 { (cost / total).min(1.0) } else { 0.0 }
}

fn functions(line: &Line) -> usize {
    line.block.words.iter().filter(|word| matches!(word.letter, b'G' | b'M')).count()
}
