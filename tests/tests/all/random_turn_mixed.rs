//! Random programs of lathes and mill-turn machines in which anything may stand between the
//! statements, on the ready posts with any of their settings changed: the post refuses them, or
//! `fil-nc` finds nothing.
//!
//! `FILPOST_TURN_MIXED=20000` tries as many programs, `FILPOST_TURN_MIXED_FROM` begins at a seed.

use filpost::Program;
use filpost_tests::counts::settings::drawn;
use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::five_axes::numbers::Random;
use filpost_tests::turning::mixed::program;

/// Programs in the normal run.
const USUAL: u64 = 200;

const POSTS: [&str; 7] = [
    "fanuc-lathe",
    "haas-lathe",
    "okuma-lathe",
    "linuxcnc-lathe",
    "sinumerik-lathe",
    "fanuc-mill-turn",
    "sinumerik-mill-turn",
];

/// Groups of settings that are changed.
const GROUPS: [&str; 18] = [
    "lathe",
    "thread",
    "mill_turn",
    "turret",
    "rapid",
    "linear",
    "circle",
    "feed",
    "home",
    "limits",
    "motion",
    "cycle",
    "dwell",
    "spindle",
    "tool",
    "fixture",
    "cutcom",
    "coolant",
];

/// What makes any program wrong, or leaves to the control what it means.
const LEFT_OUT: [&str; 10] = [
    "circle.plane",
    "motion.same_tolerance",
    "feed.mode",
    "dwell.code",
    "dwell.address",
    "dwell.upm_factor",
    "limits.c_min",
    "limits.c_max",
    "spindle.cw_code",
    "spindle.ccw_code",
];

/// Refusals that a mixed program may well meet.
const MAY_REFUSE: [&str; 9] =
    ["E05", "E0902", "E0904", "E0905", "E0907", "E0911", "E0607", "E0609", "E0715"];

/// Half of the settings begin so.
const FOCUS: [&str; 5] = ["lathe.", "thread.", "mill_turn.", "turret.", "spindle."];

fn try_seed(seed: u64) -> (Outcome, String) {
    let mut random = Random::of_seed(seed);
    let ready = POSTS[random.below(POSTS.len())];
    let set = drawn(&mut random, 3, (&GROUPS, &LEFT_OUT), &FOCUS);
    let start = Program::builder().ready(ready);
    let Ok(post) = set.iter().fold(start, |builder, setting| builder.set(setting)).build() else {
        return (Outcome::Refused("machine".to_string()), String::new());
    };
    let lines = program(ready, seed, &mut random);
    let told = format!("seed {seed}, {ready} {}", set.join(" "));
    tried(&post, &lines, &MAY_REFUSE, &told)
}

#[test]
fn random_turning_programs_that_mix_everything_are_right_or_refused() {
    let (count, agree, kinds) = try_seeds("FILPOST_TURN_MIXED", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 8 > count, "too few programs are posted to prove anything");
}
