//! `filpost test --mutate`: small changes of the posts that no case notices.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use filpost::Error;
use filpost::case::{Mutant, Programs, mutants};
use filpost::coverage::Coverage;
use rayon::prelude::*;

use super::{Done, coverage, settings_of};
use crate::output;

/// How a change ended.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    /// Some case failed.
    Noticed,
    /// All cases passed that run its line.
    Unnoticed,
    /// No case runs its line.
    NeverRun,
}

/// A case that passed, and what of its files has run.
struct Passed<'d> {
    done: &'d Done,
    coverage: Coverage,
}

/// A FIL file by its name, with its text and the cases that read it.
type Files<'d> = BTreeMap<(String, Arc<str>), Vec<usize>>;

/// Makes each change alone, runs the cases that it could make fail, and tells of those that
/// none notices. Cases that fail without any change are left out.
///
/// # Errors
/// Standard output that can't be written.
pub fn tell(done: &[Done], programs: &Programs) -> Result<(), Error> {
    let mut passed: Vec<Passed> = Vec::new();
    let mut files = Files::new();
    for done in done.iter().filter(|done| done.outcome.failure.is_none()) {
        let Ok(program) = programs.get(&done.case) else { continue };
        let mut coverage = Coverage::default();
        coverage.add(&program, &done.recorder);
        for file in program.fil_texts() {
            files.entry(file).or_default().push(passed.len());
        }
        passed.push(Passed { done, coverage });
    }
    let mut text = String::new();
    let mut counts = [0usize; 3];
    for ((name, fil), cases) in &files {
        let all = mutants(name, fil);
        let cases: Vec<&Passed> = cases.iter().map(|index| &passed[*index]).collect();
        let ends: Vec<End> =
            all.par_iter().map(|mutant| end_of(mutant, name, fil, &cases)).collect();
        for (mutant, end) in all.iter().zip(ends) {
            counts[end as usize] += 1;
            let why = match end {
                End::Noticed => continue,
                End::Unnoticed => "no case notices it",
                End::NeverRun => "no case runs the line",
            };
            // Writing to a text can't fail.
            let _ = writeln!(text, "{name}:{}: {}: {why}", mutant.line, mutant.what);
        }
    }
    settings(done, programs, &mut counts, &mut text);
    let [noticed, unnoticed, never] = counts;
    let _ = writeln!(
        text,
        "changes: {noticed} noticed, {unnoticed} not noticed, {never} in lines that no case runs"
    );
    output::print(text.as_bytes())
}

fn end_of(mutant: &Mutant, name: &str, fil: &str, cases: &[&Passed]) -> End {
    let runs =
        |case: &&&Passed| mutant.drops_section || case.coverage.has_run(name, mutant.statement);
    let mut cases = cases.iter().filter(runs).peekable();
    if cases.peek().is_none() {
        return End::NeverRun;
    }
    let changed = mutant.applied(fil);
    let notices =
        |case: &&Passed| case.done.case.outcome_with_text(name, changed.clone()).failure.is_some();
    if cases.any(notices) { End::Noticed } else { End::Unnoticed }
}

fn settings(done: &[Done], programs: &Programs, counts: &mut [usize; 3], text: &mut String) {
    let unnoticed = coverage::unnoticed_settings(done, programs);
    let passed = done.iter().filter(|done| done.outcome.failure.is_none());
    let mut all: Vec<(String, &str)> = passed
        .flat_map(|done| settings_of(done, programs))
        .map(|(from, row)| (from, row.name))
        .collect();
    all.sort_unstable();
    all.dedup();
    counts[End::Noticed as usize] += all.len() - unnoticed.len();
    counts[End::Unnoticed as usize] += unnoticed.len();
    for (machine, setting) in &unnoticed {
        let _ = writeln!(text, "{machine}: {setting} is set to its default: no case notices it");
    }
}
