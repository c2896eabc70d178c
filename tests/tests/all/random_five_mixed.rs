//! Random programs of four and five axes in which anything may stand between the motions, on the
//! ready posts with any of their settings changed: the post refuses them, or `fil-nc` finds
//! nothing and the tool comes to each point that the generator meant.
//!
//! `FILPOST_MIXED=20000` tries as many programs, `FILPOST_MIXED_FROM` begins at a seed.

use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::five_axes::machines::Machine;

/// Programs in the normal run.
const USUAL: u64 = 200;

fn try_seed(seed: u64) -> (Outcome, String) {
    let machine = Machine::mixed(seed);
    let told = format!("seed {seed}, {}", machine.told());
    let none = || (Outcome::Refused("machine".to_string()), String::new());
    let Ok(post) = machine.post() else { return none() };
    let Some(lines) = machine.lines(&post) else { return none() };
    tried(&post, &lines, &["E05", "E0902", "E0904", "E0905"], &told)
}

#[test]
fn random_programs_that_mix_everything_do_what_they_ask_for_or_are_refused() {
    let (count, agree, kinds) = try_seeds("FILPOST_MIXED", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 4 > count, "too few programs are posted to prove anything");
}
