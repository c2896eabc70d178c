use filpost_tests::duel::{fight, reduce};
use filpost_tests::programs::{Dice, case};
fn main() {
    let a: Vec<u64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let mut seen = 0; let mut bad = 0; let mut ends = std::collections::BTreeMap::new();
    for seed in a[0]..a[1] {
        let made = case(&mut Dice::from_seed(seed));
        match fight(&made) {
            Ok(e) => {*ends.entry(e).or_insert(0) += 1; if format!("{e:?}").starts_with("Ref") && a.len()>3 {println!("{seed} {e:?}");}},
            Err(_) => { bad += 1; if seen < a[2] { seen += 1;
                let (small, told) = reduce(&made);
                println!("=== seed {seed}: {told}\n--- FIL\n{}--- CL\n{}", small.fil, small.cl);
            } }
        }
    }
    println!("bad {bad} {ends:?}");
}
