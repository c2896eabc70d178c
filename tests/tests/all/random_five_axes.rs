//! Random programs of four and five axes on the shipped chains, in each form of output: the
//! post makes them, `fil-nc` follows them, and they do what the generator meant.
//!
//! `FILPOST_FIVE=20000` tries as many programs, `FILPOST_FIVE_FROM` begins at a seed.

use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::five_axes::machines::Machine;

/// Programs in the normal run.
const USUAL: u64 = 200;

/// Refusals that a random path may meet: limits, poles, what frames and tip control leave out,
/// arcs that run back from their neighbors.
const MAY_REFUSE: [&str; 10] =
    ["E0511", "E0523", "E0524", "E0527", "E0528", "E0538", "E0539", "E0560", "E0588", "E0589"];

fn try_seed(seed: u64) -> (Outcome, String) {
    let machine = Machine::of_forms(seed);
    let told = format!("seed {seed}, {}", machine.told());
    let post = machine.post().unwrap_or_else(|error| panic!("{told}: {error}"));
    let lines = machine.lines(&post).expect("a chain");
    tried(&post, &lines, &MAY_REFUSE, &told)
}

#[test]
fn random_programs_of_five_axes_do_what_they_ask_for() {
    let (count, agree, kinds) = try_seeds("FILPOST_FIVE", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 2 > count, "too few programs are posted to prove anything");
}
