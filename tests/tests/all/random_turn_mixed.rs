//! Random programs of lathes and mill-turn machines in which anything may stand between the
//! statements, on the ready posts with any of their settings changed: the post refuses them, or
//! `fil-nc` finds nothing.
//!
//! `FILPOST_TURN_MIXED=20000` tries as many programs, `FILPOST_TURN_MIXED_FROM` begins at a seed.

use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::turning::machines::Mixed;

/// Programs in the normal run.
const USUAL: u64 = 200;

/// Refusals that a mixed program may well meet.
const MAY_REFUSE: [&str; 9] =
    ["E05", "E0902", "E0904", "E0905", "E0907", "E0911", "E0607", "E0609", "E0715"];

fn try_seed(seed: u64) -> (Outcome, String) {
    let mixed = Mixed::of_seed(seed);
    let Ok(post) = mixed.post() else {
        return (Outcome::Refused("machine".to_string()), String::new());
    };
    let told = format!("seed {seed}, {} {}", mixed.ready, mixed.settings.join(" "));
    tried(&post, &mixed.lines, &MAY_REFUSE, &told)
}

#[test]
fn random_turning_programs_that_mix_everything_are_right_or_refused() {
    let (count, agree, kinds) = try_seeds("FILPOST_TURN_MIXED", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 8 > count, "too few programs are posted to prove anything");
}
