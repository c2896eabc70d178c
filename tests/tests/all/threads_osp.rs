//! G71 of an OSP: an expander of this file, which knows the cycle from its manuals, turns it into
//! passes, and these must be those that the same thread has by G33.

use std::collections::BTreeMap;

use filpost::Program;
use filpost_tests::programs::Dice;

use crate::threads::{nc_of, said_against, seeds};

/// One pass: diameter, where it begins and ends in Z, lead.
type Pass = [f64; 4];

/// A digit of D, a diameter, by which it may be larger: for a pass times the root of its number.
const DIGIT: f64 = 0.001;

/// What rounding does to X of G33.
const ROUNDED: f64 = 0.0006;

/// The words of a block.
fn words(line: &str) -> BTreeMap<char, f64> {
    let word = |word: &str| Some((word.chars().next()?, word.get(1..)?.parse().ok()?));
    line.split(' ').filter_map(word).collect()
}

/// The passes of a program, and how many blocks of G71 it has.
fn passes(nc: &str) -> (Vec<Pass>, usize) {
    let (mut at, mut cuts, mut cycles) = ([0.0; 2], Vec::new(), 0);
    for line in nc.lines() {
        let words = words(line);
        let get = |letter: char| words.get(&letter).copied();
        let to = [get('X').unwrap_or(at[0]), get('Z').unwrap_or(at[1])];
        let lead = get('F').unwrap_or(0.0) / get('J').unwrap_or(1.0);
        match get('G') {
            Some(33.0) => cuts.push([to[0], at[1], to[1], lead]),
            Some(71.0) => {
                cycles += 1;
                assert!(line.ends_with(" M32 M75"), "{line}");
                let (first, height) = (get('D').unwrap(), get('H').unwrap());
                let into = (to[0] - at[0]).signum();
                let crest = to[0] - into * height;
                let mut depth = 0.0;
                let mut number = 0.0;
                while depth < height {
                    number += 1.0;
                    depth = (first * f64::sqrt(number) + 1e-9).min(height);
                    cuts.push([crest + into * depth, at[1], to[1], lead]);
                }
            }
            _ => at = to,
        }
    }
    (cuts, cycles)
}

fn post_of(cycle: u32) -> Program {
    let cycle = format!("thread.cycle={cycle}");
    let settings = ["thread.least_depth=0", &cycle];
    let start = Program::builder().generic("okuma-lathe");
    settings.iter().fold(start, |post, setting| post.set(setting)).build().unwrap()
}

/// A thread that G71 can say: straight in, along the axis, nothing behind the root.
fn thread(seed: u64) -> String {
    let mut dice = Dice::from_seed(seed ^ 0x71);
    let micron = |value: f64| (value * 1000.0).round() / 1000.0;
    let outside = dice.once_in(2);
    let (x, depth) = (micron(dice.between(10.0, 40.0)), micron(dice.between(0.3, 2.5)));
    let clear = if outside { x + 4.0 } else { x - 4.0 };
    let (begin, end) = (micron(dice.between(2.0, 8.0)), micron(dice.between(8.0, 40.0)));
    let lead = match dice.once_in(3) {
        true => format!("TPI, {}", 4 + dice.below(33)),
        false => format!("MMPR, {}", 0.5 + 0.25 * dice.below(10) as f64),
    };
    let starts = 1 + dice.below(3);
    let head = format!(
        "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 400, CLW\nRAPID\nGOTO / {clear}, 0, {begin}\n"
    );
    let rest = format!("RAPID\nGOTO / {clear}, 0, 20\nFINI\n");
    if dice.once_in(2) {
        let cuts = 1 + dice.below(14);
        return format!(
            "{head}OP / THREAD, TURN, DEPTH, {depth}, {lead}, MULTRD, {starts}, CUTS, {cuts}, FINCUT, \
             0\nGOTO / {x}, 0, {begin}\nGOTO / {x}, 0, -{end}\n{rest}"
        );
    }
    let first = micron(dice.between(0.1, 1.2) * depth);
    let side = if outside { "OUT" } else { "IN" };
    format!(
        "{head}THREAD / AUTO, {x}, 0, {begin}, TO, {x}, 0, -{end}, {lead}, DEEP, {first}, LAST, 0, \
         TYPE, 0, {depth}, 0, FEDTO, 2, {side}, TIMES, {starts}\n{rest}"
    )
}

#[test]
fn g71_of_an_osp_cuts_what_g33_cuts() {
    let [by_passes, by_cycle] = [1, 6].map(post_of);
    let mut by_g71 = 0;
    for seed in seeds() {
        let cl = thread(seed);
        let [one_each, all] = [&by_passes, &by_cycle].map(|post| nc_of(post, &cl).unwrap());
        let ((wanted, _), (found, cycles)) = (passes(&one_each), passes(&all));
        by_g71 += usize::from(cycles > 0);
        assert_eq!(wanted.len(), found.len(), "seed {seed}: {cl}{all}");
        for (number, (wanted, found)) in wanted.iter().zip(&found).enumerate() {
            let off = (wanted[0] - found[0]).abs();
            let lead = (wanted[3] - found[3]).abs() <= 1e-9;
            let same = off <= DIGIT * ((number + 1) as f64).sqrt() + ROUNDED
                && wanted[1..3] == found[1..3];
            assert!(same && lead, "seed {seed}: {found:?}, wanted {wanted:?}\n{cl}{all}{one_each}");
        }
        assert_eq!(said_against(&by_cycle, &cl, &all), "", "{cl}{all}");
    }
    assert!(by_g71 * 10 > seeds().count() * 9, "{by_g71} threads by G71");
}

/// A number of another size in any word of G71, another infeed or pattern, and a word of a kind that
/// changes the passes.
#[test]
fn a_wrong_word_of_g71_is_found() {
    let post = post_of(6);
    let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 500, CLW\nRAPID\nGOTO / 25, 0, 2\nTHREAD / AUTO, \
              20, 0, 2, TO, 20, 0, -16, TPI, 36, DEEP, 0.3, LAST, 0, TYPE, 0, 0.5, 0, FEDTO, 2, \
              OUT\nRAPID\nGOTO / 25, 0, 2\nFINI\n";
    let nc = nc_of(&post, cl).unwrap();
    let block = "G71 X39. Z-16. D0.6 H1. F6.35 J9 M32 M75";
    assert!(nc.contains(block), "{nc}");
    assert_eq!(said_against(&post, cl, &nc), "");
    let other_flank = nc.replace("M32", "M34");
    assert_eq!(said_against(&post, cl, &other_flank), "", "straight in both ways");
    for (old, new, said) in [
        ("X39.", "X38.99", "the root is at"),
        ("X39.", "X39.01", "the root is not reached"),
        ("Z-16.", "Z-16.01", "before the end"),
        ("Z-16.", "Z-15.99", "before the end"),
        ("D0.6", "D0.61", "other depths"),
        ("D0.6", "D0.59", "other depths"),
        ("D0.6", "D0.", "its height and the depth of its first pass"),
        ("D0.6 ", "", "its first depth"),
        ("H1.", "H1.01", "other depths"),
        ("H1.", "H0.99", "other depths"),
        ("H1. ", "", "its height"),
        ("F6.35", "F6.36", "the lead is"),
        ("J9", "J8", "the lead is"),
        (" J9", "", "the lead is"),
        ("M32", "M33", "M33"),
        ("M32 ", "", "one M word of its infeed"),
        ("M32", "M32 M34", "one M word of its infeed"),
        ("M75", "M73", "M73 and M74"),
        ("M75", "M74", "M73 and M74"),
        (" M75", "", "one of its pattern"),
        ("F6.35", "U0.1 F6.35", "two words of one axis"),
        ("F6.35", "I0.5 F6.35", "I"),
        ("M22\n", "M23\n", "depends on a parameter"),
        ("M22\n", "M24\n", "no block sets"),
    ] {
        assert!(nc.contains(old), "{old}");
        let wrong = said_against(&post, cl, &nc.replacen(old, new, 1));
        assert!(wrong.contains(said), "{old} to {new}: {wrong}");
    }
    // From another place, and from the other side.
    for (old, new) in [("X44.", "X43."), ("X44.", "X30."), ("Z2.", "Z2.1"), ("Z2.", "Z1.")] {
        let wrong = said_against(&post, cl, &nc.replacen(old, new, 1));
        assert!(!wrong.is_empty(), "{old} to {new}");
    }
}
