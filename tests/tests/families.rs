//! Random CL programs posted for controls of other families, read back and verified:
//! nothing may be found, or the post must have refused them.
//!
//! `FILPOST_FAMILIES=FIRST..LAST` runs more seeds than the sample of each test run.

use std::collections::BTreeMap;
use std::ops::Range;

use filpost_tests::posting::{self, Job, Machine};
use filpost_tests::random::make::program;
use filpost_tests::random::verdict::cl_text;

/// Posts whose language the judge has read longest, with three and with four decimals.
const PLAIN: [&str; 2] = ["linuxcnc-mill", "fanuc-mill"];

/// A peck is written as a level or a length of three decimals, and may be off by as much.
const HALF_A_DIGIT: &str = "by 0.0005 ";

/// Preparatory functions of the generator that these controls don't have, and comments.
const FOREIGN: [&str; 3] = ["INSERT (", "PREFUN / 98", "PREFUN / 99"];

/// Seeds of a usual run.
const SAMPLE: Range<u64> = 0..40;

fn seeds() -> Range<u64> {
    let asked = std::env::var("FILPOST_FAMILIES").ok();
    let range = asked.as_deref().and_then(|text| {
        let (first, last) = text.split_once("..")?;
        Some(first.parse().ok()?..last.parse().ok()?)
    });
    range.unwrap_or(SAMPLE)
}

/// Posts and verifies the programs of the seeds; gives how many agree, and the refusals.
fn verified(ready: &str) -> (u64, BTreeMap<String, u64>) {
    let (mut agree, mut refused) = (0, BTreeMap::new());
    let mut found = Vec::new();
    for seed in seeds() {
        let cl = cl_text(&program(seed));
        let of = |name: &str| Job {
            machine: Machine::Ready(name.to_string()),
            cl: cl.clone(),
            ..Job::default()
        };
        // What the judge finds in any language says nothing about this one, and a comment
        // in brackets is none in these.
        let finds = |name: &&str| posting::verify(&of(name)).is_ok_and(|found| !found.is_empty());
        let is_foreign = FOREIGN.iter().any(|text| cl.contains(text));
        if is_foreign || PLAIN.iter().any(finds) {
            *refused.entry("not compared".to_string()).or_default() += 1;
            continue;
        }
        let job = of(ready);
        match posting::verify(&job) {
            // A function that the generator takes from other controls.
            Ok(findings) if findings.iter().any(|finding| finding.starts_with("E0904")) => {
                *refused.entry("foreign function".to_string()).or_default() += 1;
            }
            Ok(findings) if findings.iter().all(|finding| finding.contains(HALF_A_DIGIT)) => {
                agree += 1;
            }
            Ok(findings) => found.push(format!("seed {seed}: {}", findings.join("\n  "))),
            Err(code) => *refused.entry(code).or_default() += 1,
        }
    }
    assert!(found.is_empty(), "{} of {ready}\n{}", found.len(), found.join("\n"));
    (agree, refused)
}

fn check(ready: &str) {
    let (agree, refused) = verified(ready);
    eprintln!("{ready}: {agree} agree, refused: {refused:?}");
    let all = seeds().count() as u64;
    assert!(agree * 8 >= all, "only {agree} of {all} agree: {refused:?}");
}

#[test]
fn random_programs_agree_on_a_sinumerik() {
    check("sinumerik-840d");
}

#[test]
fn random_programs_agree_in_klartext() {
    check("heidenhain-tnc640");
}

#[test]
fn a_changed_program_is_noticed() {
    let cl = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 500, CLW\nFEDRAT / 100, MMPM\nRAPID\n\
              GOTO / 0, 0, 50\nGOTO / 0, 0, 0\nCYCLE / DRILL, DEPTH, 5, MMPM, 50, CLEAR, 1\n\
              GOTO / 10, 0, 0\nCYCLE / OFF\nFINI\n";
    let changes = [
        ("sinumerik-840d", "CYCLE81(1,0,1,-5)", "CYCLE81(1,0,1,-6)"),
        ("sinumerik-840d", "D1", "D2"),
        ("heidenhain-tnc640", "Q201=-5", "Q201=-6"),
    ];
    for (ready, from, to) in changes {
        let job = Job {
            machine: Machine::Ready(ready.to_string()),
            cl: cl.to_string(),
            ..Job::default()
        };
        let nc = posting::post(&job).map_err(|refused| refused.message).expect("a program").nc;
        assert!(nc.contains(from), "{nc}");
        let found = posting::verify_nc(&job, &nc.replace(from, to)).expect("a program");
        assert!(!found.is_empty(), "{ready}: {to}");
    }
}
