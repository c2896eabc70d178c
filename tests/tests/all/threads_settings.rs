//! Whole threads in both units with the settings that the ready posts of lathes come with, and
//! with odd ones: the back-check, which expands the cycles by itself, must find nothing.

use filpost::Program;
use filpost_tests::programs::Dice;
use rayon::prelude::*;

use crate::threads::{nc_of, said_against, seeds};

/// The posts and settings on top of them.
const MACHINES: [(&str, &[&str]); 13] = [
    ("fanuc-lathe", &[]),
    ("fanuc-lathe", &["thread.least_depth=0.113", "thread.springs=0"]),
    ("fanuc-lathe", &["thread.cycle=1", "thread.cycle_code=92", "thread.least_depth=0.3"]),
    ("fanuc-lathe", &["thread.cycle=0", "thread.clearance=0.7"]),
    ("fanuc-lathe", &["thread.chamfer=0.1", "lathe.diameter=0"]),
    ("haas-lathe", &[]),
    ("okuma-lathe", &[]),
    ("okuma-lathe", &["thread.cycle=6", "thread.springs=0"]),
    ("linuxcnc-lathe", &[]),
    ("linuxcnc-lathe", &["thread.least_depth=0", "lathe.diameter=0", "lathe.diameter_code=none"]),
    ("sinumerik-lathe", &[]),
    ("fanuc-mill-turn", &["thread.springs=3"]),
    ("sinumerik-mill-turn", &["thread.cycle=5", "thread.cycle_code=97"]),
];

/// Threads an inch of the common series.
const SERIES: [&str; 14] =
    ["4", "5", "6", "7", "8", "10", "11", "11.5", "12", "13", "14", "16", "18", "20"];

/// A thread, inside, outside or across a face.
fn thread(seed: u64) -> String {
    let mut dice = Dice::from_seed(seed ^ 0x7412);
    let inches = dice.once_in(2);
    let (unit, scale) = if inches { ("INCHES", 25.4) } else { ("MM", 1.0) };
    let digits = if inches { 10_000.0 } else { 1000.0 };
    let exact = |mm: f64| (mm / scale * digits).round() / digits;
    let x = exact(dice.between(12.0, 40.0));
    let lean = if dice.once_in(3) { exact(dice.between(-1.5, 1.5)) } else { 0.0 };
    let (z1, z2) = (exact(dice.between(2.0, 8.0)), exact(-dice.between(8.0, 40.0)));
    let depth = exact(dice.between(0.3, 2.5));
    let first = exact(dice.between(0.1, 0.9) * depth * scale).max(2.0 / digits);
    let lead = match (inches, dice.once_in(2)) {
        (true, true) => format!("TPI, {}", dice.pick(&SERIES)),
        (true, false) => format!("IPR, {}", exact(dice.between(1.0, 5.0))),
        (false, true) => format!("TPI, {}", dice.pick(&SERIES)),
        (false, false) => format!("MMPR, {}", exact(dice.between(0.5, 4.0))),
    };
    let springs =
        if dice.once_in(4) { String::new() } else { format!("LAST, {}, ", dice.below(4)) };
    let angle = dice.pick(&["0", "29", "30", "55", "60", "80", "47.5"]).to_string();
    let clear = exact(dice.between(0.8, 4.0));
    let starts = if dice.once_in(3) { 2 + dice.below(3) } else { 1 };
    let (side, from, to, at) = match dice.below(5) {
        0 => {
            // From the rim to the middle of a face.
            let (rim, middle) = (exact(40.0), exact(25.0));
            ("FACE", [rim, 0.0], [middle, exact(dice.between(-1.0, 1.0))], [rim, exact(9.0)])
        }
        1 | 2 => ("IN", [x, z1], [x + lean, z2], [exact(1.0), z1]),
        _ => ("OUT", [x, z1], [x + lean, z2], [x.max(x + lean) + exact(7.0), z1]),
    };
    let [[x1, z1], [x2, z2], [ax, az]] = [from, to, at];
    format!(
        "UNITS / {unit}\nLOADTL / 3\nSPINDL / RPM, 400, CLW\nRAPID\nGOTO / {ax:.4}, 0, {az:.4}\n\
         THREAD / AUTO, {x1:.4}, 0, {z1:.4}, TO, {x2:.4}, 0, {z2:.4}, {lead}, DEEP, {first}, \
         {springs}TYPE, 0, {depth}, {angle}, FEDTO, {clear}, {side}, TIMES, {starts}\nRAPID\n\
         GOTO / {ax:.4}, 0, {az:.4}\nFINI\n"
    )
}

#[test]
fn threads_with_the_settings_of_the_posts_agree() {
    for (ready, settings) in MACHINES {
        let start = Program::builder().generic(ready);
        let post = settings.iter().fold(start, |one, setting| one.set(setting)).build().unwrap();
        let said = |seed: u64| {
            let cl = thread(seed);
            // A lead that F can't hold, inches on an Okuma and its threads that no cycle says, a
            // chamfer longer than its way out.
            let refusals = ["E0512", "E0715", "E0507", "E0585"];
            let nc = match nc_of(&post, &cl) {
                Ok(nc) => nc,
                Err(said) if refusals.iter().any(|code| said.contains(code)) => return None,
                Err(said) => return Some(format!("seed {seed}: {said}\n{cl}")),
            };
            let said = said_against(&post, &cl, &nc);
            Some(if said.is_empty() { said } else { format!("seed {seed}: {said}\n{cl}{nc}") })
        };
        let all: Vec<String> = seeds().into_par_iter().filter_map(said).collect();
        let wrong: Vec<&String> = all.iter().filter(|said| !said.is_empty()).collect();
        println!("{ready} {settings:?}: {} threads, {} with findings", all.len(), wrong.len());
        assert!(wrong.is_empty(), "{ready} {settings:?}: {}", wrong[0]);
        assert!(all.len() * 5 > seeds().count(), "{ready}: too few are posted");
    }
}
