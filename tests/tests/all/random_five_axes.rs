//! Random programs of four and five axes on the shipped chains, in each form of output: the
//! post makes them, `fil-nc` follows them, and they do what the generator meant.
//!
//! `FILPOST_FIVE=20000` tries as many programs, `FILPOST_FIVE_FROM` begins at a seed.

use fil_machine::axis_chain::AxisChain;
use fil_machine::chains::CHAINS;
use filpost::Program;
use filpost_tests::five_axes::judge::{Outcome, tried, try_seeds};
use filpost_tests::five_axes::maker::program;
use filpost_tests::five_axes::numbers::Random;

/// Programs in the normal run.
const USUAL: u64 = 200;

/// Refusals that a random path may meet: limits, poles, what frames and tip control leave out,
/// arcs that run back from their neighbors.
const MAY_REFUSE: [&str; 10] =
    ["E0511", "E0523", "E0524", "E0527", "E0528", "E0538", "E0539", "E0560", "E0588", "E0589"];

/// Ready posts and what makes them write one form.
const FORMS: [(&str, &[&str]); 12] = [
    ("fanuc-5x-tables", &["rotary.tip_output=0"]),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.feed=2"]),
    (
        "fanuc-5x-tables",
        &["rotary.tip_output=0", "repos.feed_method=1", "repos.retract_distance=80"],
    ),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.frame_output=1", "home.retract_z=300"]),
    ("fanuc-5x-tables", &[]),
    ("fanuc-5x-tables", &["rotary.tip_form=1", "rotary.tip_control=1"]),
    ("haas-trunnion-tcpc", &["repos.optimise=1"]),
    ("sinumerik-5x", &[]),
    ("sinumerik-5x", &["rotary.tip_form=1", "rotary.frame_output=0"]),
    ("sinumerik-5x", &["rotary.tip_output=0", "rotary.frame_output=0"]),
    ("heidenhain-5x", &[]),
    ("heidenhain-5x", &["rotary.tip_form=1", "rotary.frame_output=0", "rotary.tip_control=1"]),
];

fn post(chain: &str, (ready, settings): (&str, &[&str]), random: &mut Random) -> Program {
    let start = Program::builder().ready(ready).set(&format!("chain=\"{chain}\""));
    let start = start.set("home.retract_z=400");
    let one = ["table-a", "table-b", "table-c", "head-b"].contains(&chain);
    let start = if one { start.set("rotary.secondary_kind=0") } else { start };
    let mut builder = settings.iter().fold(start, |builder, setting| builder.set(setting));
    if chain == "table-c" {
        // Its tool lies along X, which no tilted frame of a control knows.
        builder = builder.set("rotary.frame_output=0");
    }
    for axis in ["primary", "secondary"] {
        for part in ["x", "y", "z"] {
            let at = random.between(-80.0, 80.0);
            builder = builder.set(&format!("rotary.{axis}_{part}={at:.3}"));
        }
    }
    builder.build().unwrap_or_else(|error| panic!("{chain} {ready}: {error}"))
}

fn try_seed(seed: u64) -> (Outcome, String) {
    let mut random = Random::of_seed(seed);
    let form = FORMS[random.below(FORMS.len())];
    let chain = CHAINS[random.below(CHAINS.len())].name;
    let post = post(chain, form, &mut random);
    let machine = AxisChain::from_commons(post.commons()).expect("a chain");
    let lines = program(&machine, random, None);
    tried(&post, &lines, &MAY_REFUSE, &format!("seed {seed}, {chain}, {form:?}"))
}

#[test]
fn random_programs_of_five_axes_do_what_they_ask_for() {
    let (count, agree, kinds) = try_seeds("FILPOST_FIVE", USUAL, try_seed);
    assert_eq!(kinds, 0, "kinds of differences");
    assert!(agree * 2 > count, "too few programs are posted to prove anything");
}
