//! The machine agrees with a second reading of FIL on random programs.

use std::collections::BTreeMap;

use filpost_tests::duel::{Agreed, fight, fight_over, reduce};
use filpost_tests::programs::{Dice, case};
use filpost_tests::sample;

/// Runs the programs of these seeds and counts how they ended.
fn tournament(seeds: std::ops::Range<u64>) -> BTreeMap<Agreed, u64> {
    let mut ends = BTreeMap::new();
    for seed in seeds {
        let made = case(&mut Dice::from_seed(seed));
        match fight(&made) {
            Ok(agreed) => *ends.entry(agreed).or_insert(0) += 1,
            Err(_) => {
                let (small, told) = reduce(&made);
                panic!("seed {seed}: {told}\n--- FIL\n{}--- CL\n{}", small.fil, small.cl);
            }
        }
    }
    println!("{ends:?}");
    ends
}

/// Most programs must run to their end, or the comparison would say little.
fn mostly_done(ends: &BTreeMap<Agreed, u64>) {
    let all: u64 = ends.values().sum();
    let done = ends.get(&Agreed::Done).copied().unwrap_or(0);
    let refused: u64 =
        ends.iter().filter(|(end, _)| matches!(end, Agreed::Refused(_))).map(|(_, n)| n).sum();
    // EMPTY and words where a number is needed stop many of them.
    assert!(done * 5 > all * 2, "{ends:?}");
    assert!(refused * 50 < all, "{ends:?}");
}

#[test]
fn machine_and_oracle_agree() {
    mostly_done(&tournament(0..sample::of(2_000) as u64));
}

/// One sign changed for one of the two must show. Many programs never run the
/// changed line, or do not use what it makes, so not every change can.
#[test]
fn a_difference_is_found() {
    let changes = [(".EQ.", ".NE."), (".LT.", ".GT."), ("POSTF(13)", "POSTF(20)")];
    let signs = [("+", "-"), ("*", "+"), ("=0\n", "=1\n")];
    for (from, to) in changes.into_iter().chain(signs) {
        let (mut made, mut found) = (0, 0);
        for seed in 0..sample::of(400) as u64 {
            let case = case(&mut Dice::from_seed(seed));
            if fight(&case) == Ok(Agreed::Done) && case.fil.contains(from) {
                made += 1;
                found += u32::from(fight_over(&case, &case.fil.replace(from, to)).is_err());
            }
        }
        println!("{from:?} as {to:?}: {found} of {made} found");
        assert!(made > 10 && found * 3 > made, "{from:?} as {to:?}: {found} of {made}");
    }
}

/// FILPOST_ORACLE=first,count chooses other seeds than the first 100,000.
#[test]
#[ignore = "takes minutes"]
fn machine_and_oracle_agree_for_long() {
    let chosen = std::env::var("FILPOST_ORACLE").unwrap_or_else(|_| "2000,100000".into());
    let (first, count) = chosen.split_once(',').expect("FILPOST_ORACLE=first,count");
    let first: u64 = first.parse().expect("first seed");
    let count: u64 = count.parse().expect("number of seeds");
    mostly_done(&tournament(first..first + count));
}
