//! Random programs of lathes and mill-turn machines in which anything may stand between the
//! statements, on the ready posts with any of their settings changed: the post refuses them, or
//! `fil-nc` finds nothing.
//!
//! `FILPOST_TURN_MIXED=20000` tries as many programs, `FILPOST_TURN_MIXED_FROM` begins at a seed.

use std::env;

use filpost::Program;
use filpost::locations::{Location, TABLE};
use filpost_tests::counts::settings::trials;
use filpost_tests::five_axes::judge::{Outcome, judge, shrunk, tell, text};
use filpost_tests::five_axes::numbers::Random;
use filpost_tests::turning::mixed::program;
use rayon::prelude::*;

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

fn settings(random: &mut Random) -> Vec<String> {
    let rows: Vec<&Location> = TABLE
        .iter()
        .filter(|row| row.used && !LEFT_OUT.contains(&row.name))
        .filter(|row| GROUPS.iter().any(|group| row.name.starts_with(&format!("{group}."))))
        .collect();
    let of_turning = |row: &&&Location| {
        ["lathe.", "thread.", "mill_turn.", "turret.", "spindle."]
            .iter()
            .any(|group| row.name.starts_with(group))
    };
    let turning: Vec<&Location> = rows.iter().filter(of_turning).copied().collect();
    (0..random.below(3))
        .map(|_| {
            let rows = if random.happens(0.5) { &turning } else { &rows };
            let tried = trials(rows[random.below(rows.len())]);
            tried[random.below(tried.len())].text.clone()
        })
        .collect()
}

fn try_seed(seed: u64) -> (Outcome, String) {
    let mut random = Random::of_seed(seed);
    let ready = POSTS[random.below(POSTS.len())];
    let set = settings(&mut random);
    let start = Program::builder().ready(ready);
    let Ok(post) = set.iter().fold(start, |builder, setting| builder.set(setting)).build() else {
        return (Outcome::Refused("machine".to_string()), String::new());
    };
    let lines = program(ready, seed, &mut random);
    let (outcome, _) = judge(&post, &lines, &MAY_REFUSE);
    let Outcome::Differs(kind, _) = &outcome else { return (outcome, String::new()) };
    let small = shrunk(&post, &lines, kind, &MAY_REFUSE);
    let (again, nc) = judge(&post, &small, &MAY_REFUSE);
    let told = format!("{ready} {}", set.join(" "));
    (outcome, format!("seed {seed}, {told}: {again:?}\n{}---\n{nc}", text(&small)))
}

#[test]
fn random_turning_programs_that_mix_everything_are_right_or_refused() {
    let number = |name| env::var(name).ok().and_then(|n| n.parse::<u64>().ok());
    let count = number("FILPOST_TURN_MIXED").unwrap_or(USUAL);
    let from = number("FILPOST_TURN_MIXED_FROM").unwrap_or(0);
    let tried: Vec<_> = (from..from + count).into_par_iter().map(try_seed).collect();
    let (agree, kinds) = tell(tried);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 8 > count, "too few programs are posted to prove anything");
}
