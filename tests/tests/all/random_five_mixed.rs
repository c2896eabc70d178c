//! Random programs of four and five axes in which anything may stand between the motions, on the
//! ready posts with any of their settings changed: the post refuses them, or `fil-nc` finds
//! nothing and the tool comes to each point that the generator meant.
//!
//! `FILPOST_MIXED=20000` tries as many programs, `FILPOST_MIXED_FROM` begins at a seed.

use fil_machine::axis_chain::AxisChain;
use fil_machine::chains::CHAINS;
use filpost::Program;
use filpost_tests::counts::settings::drawn;
use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::five_axes::maker::program;
use filpost_tests::five_axes::mixed::Family;
use filpost_tests::five_axes::numbers::Random;

/// Programs in the normal run.
const USUAL: u64 = 200;

const POSTS: [(&str, Family); 9] = [
    ("fanuc-mill-a", Family::WordAddress),
    ("fanuc-mill-b", Family::WordAddress),
    ("haas-trunnion", Family::WordAddress),
    ("haas-trunnion-tcpc", Family::WordAddress),
    ("fanuc-5x-tables", Family::WordAddress),
    ("fanuc-5x-head", Family::WordAddress),
    ("linuxcnc-5x", Family::WordAddress),
    ("heidenhain-5x", Family::Klartext),
    ("sinumerik-5x", Family::Sinumerik),
];

/// Groups of settings that are changed.
const GROUPS: [&str; 14] = [
    "rotary", "repos", "rapid", "linear", "circle", "feed", "home", "limits", "motion", "cycle",
    "dwell", "spindle", "tool", "fixture",
];

/// What makes any program wrong, or leaves to the control what it means.
const LEFT_OUT: [&str; 6] = [
    "motion.same_tolerance",
    "feed.mode",
    "dwell.code",
    "dwell.address",
    "dwell.upm_factor",
    "rotary.table_words",
];

/// A machine, with what makes it; `None` where the settings contradict each other.
fn machine(random: &mut Random) -> Option<(Program, Family, String)> {
    let (ready, family) = POSTS[random.below(POSTS.len())];
    let mut set = vec!["home.retract_z=400".to_string()];
    if random.happens(0.5) {
        let chain = CHAINS[random.below(CHAINS.len())].name;
        set.push(format!("chain=\"{chain}\""));
        if ["table-a", "table-b", "table-c", "head-b"].contains(&chain) {
            set.push("rotary.secondary_kind=0".to_string());
        }
    }
    for axis in ["primary", "secondary"] {
        for part in ["x", "y", "z"] {
            set.push(format!("rotary.{axis}_{part}={:.3}", random.between(-80.0, 80.0)));
        }
    }
    set.extend(drawn(random, 4, (&GROUPS, &LEFT_OUT), &["r"]));
    let start = Program::builder().ready(ready);
    let post = set.iter().fold(start, |builder, setting| builder.set(setting)).build().ok()?;
    Some((post, family, format!("{ready} {}", set.join(" "))))
}

fn try_seed(seed: u64) -> (Outcome, String) {
    let mut random = Random::of_seed(seed);
    let none = || (Outcome::Refused("machine".to_string()), String::new());
    let Some((post, family, told)) = machine(&mut random) else { return none() };
    let Ok(chain) = AxisChain::from_commons(post.commons()) else { return none() };
    let lines = program(&chain, random, Some(family));
    let may_refuse = ["E05", "E0902", "E0904", "E0905"];
    tried(&post, &lines, &may_refuse, &format!("seed {seed}, {told}"))
}

#[test]
fn random_programs_that_mix_everything_do_what_they_ask_for_or_are_refused() {
    let (count, agree, kinds) = try_seeds("FILPOST_MIXED", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 4 > count, "too few programs are posted to prove anything");
}
