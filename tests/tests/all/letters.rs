//! One character of a CL file is changed: the program, a warning, a message or the refusal
//! must be another, or the character means nothing.

use std::collections::{BTreeMap, HashMap};
use std::env;

use filpost_tests::counts::corpus::{Part, parts};
use filpost_tests::counts::letter::{excuse, mutants};
use filpost_tests::counts::walk;
use rayon::prelude::*;

/// Statements of one form that are tried in the normal run, and in a whole one.
const SAMPLE: [usize; 2] = [1, 5];

/// One of so many characters is tried in the normal run.
const STEP: usize = 5;

/// What was tried and what was not noticed.
#[derive(Default)]
struct Tally {
    tried: usize,
    excused: BTreeMap<&'static str, usize>,
    /// Changes that nothing notices: how often, and the first one.
    quiet: BTreeMap<String, (usize, String)>,
}

/// FILPOST_LETTERS=all tries every character, and more statements of each form.
fn all() -> bool {
    env::var("FILPOST_LETTERS").is_ok_and(|value| value == "all")
}

/// Tries the statements of a file; `seen` counts those of one form.
fn try_part(part: &Part, seen: &mut HashMap<String, usize>, tally: &mut Tally) {
    let most = SAMPLE[usize::from(all())];
    walk::each(
        part,
        seen,
        |_, count| count <= most,
        |window, machine, setting| {
            let statement = &setting.all[setting.at];
            let first = (statement.line + setting.at) % STEP;
            let step = if all() { 1 } else { STEP };
            let chosen = mutants(&statement.text).into_iter().skip(if all() { 0 } else { first });
            let chosen: Vec<_> = chosen.step_by(step).collect();
            tally.tried += chosen.len();
            let not_noticed: Vec<_> = chosen
                .into_par_iter()
                .filter(|mutant| !window.notices(machine, &mutant.text))
                .collect();
            for mutant in not_noticed {
                match excuse(&setting, &mutant) {
                    Some(reason) => *tally.excused.entry(reason).or_default() += 1,
                    None if statement.is_text() && window.is_ignored() => {
                        *tally.excused.entry("the post says that it ignores it").or_default() += 1;
                    }
                    None => {
                        let kind = format!("{} {:?} at {}", statement.major, mutant.was, mutant.at);
                        let place = format!(
                            "{} line {}:\n    {}\n    {}",
                            part.name, statement.line, statement.text, mutant.text
                        );
                        tally.quiet.entry(kind).or_insert((0, place)).0 += 1;
                    }
                }
            }
        },
    );
}

#[test]
fn changed_characters_are_noticed() {
    let (mut tally, mut seen) = (Tally::default(), HashMap::new());
    for part in parts() {
        try_part(&part, &mut seen, &mut tally);
    }
    println!("{} changes tried; without effect:", tally.tried);
    for (reason, count) in &tally.excused {
        println!("{count:>8}  {reason}");
    }
    for (kind, (count, place)) in &tally.quiet {
        println!("{count} times: {kind}, first in {place}");
    }
    assert!(tally.quiet.is_empty(), "{} kinds of changes are not noticed", tally.quiet.len());
    assert!(tally.tried > 1000, "too few changes to prove anything");
}
