//! Which lines prove a setting: those that differ without it.

use crate::align;
use crate::change::{self, Key};
use crate::trial::{Bench, State};
use crate::words::numbered_lines as lines;

/// Lines that a proof names.
const NAMED: usize = 2;

/// Why a setting is as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The setting, as `machine.toml` has it.
    pub key: String,
    /// Its value, as `machine.toml` has it.
    pub value: String,
    /// What the base has.
    pub base: String,
    /// First lines that come out with it and not without: name of the program and line.
    pub lines: Vec<(String, usize)>,
    /// How many there are.
    pub count: usize,
    /// Without it a program is refused, or the settings contradict each other.
    pub refused: bool,
}

/// The proofs of all changes of a machine.
pub(crate) fn proofs(bench: &Bench<'_>, state: &State) -> Vec<(Key, Proof)> {
    let machine = &state.machine;
    let of = |(key, value): (&Key, &change::Value)| {
        let base = change::read(machine.base.commons(), *key);
        let mut proof = Proof {
            key: change::name(*key),
            value: change::shown(*key, value),
            base: change::shown(*key, &base),
            lines: Vec::new(),
            count: 0,
            refused: false,
        };
        match bench.state(machine.without(*key)) {
            Some(without) => compare(bench, state, &without, &mut proof),
            None => proof.refused = true,
        }
        (*key, proof)
    };
    machine.changes.iter().map(of).collect()
}

fn compare(bench: &Bench<'_>, state: &State, without: &State, proof: &mut Proof) {
    for (at, pair) in bench.pairs.iter().enumerate() {
        let Some(with) = &state.programs[at] else { continue };
        let proven = lines(&pair.proven.blocks);
        let right = align::matches(&lines(&with.blocks), &proven);
        let Some(other) = &without.programs[at] else {
            proof.refused = true;
            continue;
        };
        if other.bytes == with.bytes {
            continue;
        }
        let still = align::matches(&lines(&other.blocks), &proven);
        let mut gained: Vec<usize> = right.iter().map(|(_, j)| *j).collect();
        gained.retain(|j| !still.iter().any(|(_, right)| right == j));
        if gained.is_empty() {
            // Line ends, blanks, marks: the program as a whole.
            gained = vec![0];
        }
        proof.count += gained.len();
        let room = NAMED.saturating_sub(proof.lines.len());
        let named = gained.iter().take(room).map(|j| (pair.nc_name.clone(), j + 1));
        proof.lines.extend(named);
    }
}
