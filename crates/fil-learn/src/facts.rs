//! What the proven programs have that ours lack, as hints for candidates.

use std::collections::BTreeMap;

use crate::align;
use crate::score::Cut;
use crate::trial::{Bench, State};
use crate::words::{Block, hash};

/// Most numbers of each kind that are tried.
const MOST_NUMBERS: usize = 40;

/// Hints from the words of the programs.
#[derive(Debug, Default)]
pub(crate) struct Facts {
    /// Numbers of G and M words that the proven programs have more often than ours.
    pub codes_missing: Vec<f64>,
    /// All numbers of their G and M words.
    pub codes: Vec<f64>,
    /// Numbers of G and M words that our programs have more often.
    pub codes_in_excess: Vec<f64>,
    /// Letters that the proven programs have more often.
    pub letters_missing: Vec<u8>,
    /// Numbers in words that the proven programs have more often.
    pub numbers: Vec<f64>,
    /// Differences and ratios of words that belong together, proven against ours.
    pub differences: Vec<f64>,
    pub ratios: Vec<f64>,
}

impl Facts {
    pub fn new(bench: &Bench<'_>, state: &State) -> Facts {
        let mut counts: BTreeMap<(u8, String), i64> = BTreeMap::new();
        let mut letters: BTreeMap<u8, i64> = BTreeMap::new();
        let mut aligned: BTreeMap<(bool, i64), usize> = BTreeMap::new();
        let mut facts = Facts::default();
        for (own, pair) in state.programs.iter().zip(&bench.pairs) {
            for (cut, sign) in [(Some(&pair.proven), 1), (own.as_ref(), -1)] {
                for word in cut.into_iter().flat_map(|cut| &cut.blocks).flat_map(|b| &b.words) {
                    if word.letter != 0 {
                        *counts.entry((word.letter, word.digits().into())).or_default() += sign;
                        *letters.entry(word.letter).or_default() += sign;
                    }
                }
            }
            for block in &pair.proven.blocks {
                let codes = block.words.iter().filter(|word| b"GM".contains(&word.letter));
                facts.codes.extend(codes.filter_map(|word| word.value()));
            }
            if let Some(own) = own {
                compare(own, &pair.proven, &mut aligned);
            }
        }
        for ((letter, digits), count) in &counts {
            let Ok(value) = digits.parse::<f64>() else { continue };
            let is_code = b"GM".contains(letter);
            let list = match (*count > 0, is_code) {
                (true, true) => &mut facts.codes_missing,
                (true, false) => &mut facts.numbers,
                (false, true) if *count < 0 => &mut facts.codes_in_excess,
                _ => continue,
            };
            list.push(value);
        }
        facts.letters_missing =
            letters.into_iter().filter(|(_, count)| *count > 0).map(|(letter, _)| letter).collect();
        let mut common: Vec<((bool, i64), usize)> =
            aligned.into_iter().filter(|(_, count)| *count > 1).collect();
        common.sort_by_key(|(key, count)| (std::cmp::Reverse(*count), *key));
        for ((is_ratio, scaled), _) in common.into_iter().take(MOST_NUMBERS) {
            let value = scaled as f64 / SCALE;
            if is_ratio { facts.ratios.push(value) } else { facts.differences.push(value) }
        }
        for numbers in [
            &mut facts.codes,
            &mut facts.codes_missing,
            &mut facts.codes_in_excess,
            &mut facts.numbers,
        ] {
            numbers.sort_by(f64::total_cmp);
            numbers.dedup();
        }
        facts.numbers.truncate(4 * MOST_NUMBERS);
        facts
    }
}

/// Differences and ratios are counted to six decimals.
const SCALE: f64 = 1e6;

/// Counts differences and ratios of words in blocks of the same letters.
fn compare(own: &Cut, proven: &Cut, aligned: &mut BTreeMap<(bool, i64), usize>) {
    let shapes = |cut: &Cut| cut.blocks.iter().map(shape).collect::<Vec<u64>>();
    for (i, j) in align::matches(&shapes(own), &shapes(proven)) {
        for (a, b) in own.blocks[i].words.iter().zip(&proven.blocks[j].words) {
            let (Some(a), Some(b)) = (a.value(), b.value()) else { continue };
            if a == b {
                continue;
            }
            let mut note = |is_ratio: bool, value: f64| {
                let scaled = (value * SCALE).round();
                if scaled.abs() < 1e15 {
                    *aligned.entry((is_ratio, scaled as i64)).or_default() += 1;
                }
            };
            note(false, b - a);
            if a != 0.0 {
                note(true, b / a);
            }
        }
    }
}

/// The letters of a block, as a hash.
fn shape(block: &Block) -> u64 {
    hash(&block.words.iter().map(|word| word.letter).collect::<Vec<u8>>())
}
