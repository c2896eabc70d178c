//! `filpost test`: regression cases, all at once, and what is reported of them.

mod coverage;
mod init;
mod junit;
mod mutate;
mod report;

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use filpost::case::{self, Case, Outcome, Programs};
use filpost::coverage::Recorder;
use filpost::debug::SharedDebugger;
use filpost::locations::{Location, TABLE};
use filpost::nc::source::Source;
use filpost::{Diag, Error, PendingFiles, files};
use indicatif::{ParallelProgressIterator, ProgressBar};
use rayon::prelude::*;

use crate::args::{Shard, TestArgs};
use crate::errors::CommandCode;
use crate::{Status, audit, output};

/// A case that was run.
struct Done {
    name: String,
    case: Case,
    outcome: Outcome,
    /// What of FIL has run, where that was looked at.
    recorder: Recorder,
    time: Duration,
    /// What its audit found, in print, where it was asked for.
    audit: Vec<String>,
}

/// Runs the regression cases below a folder, or makes a case.
///
/// # Errors
/// Cases that can't be read; a folder without any; reports that can't be
/// written.
pub fn run(args: &TestArgs) -> Result<Status, Error> {
    if let Some(folder) = &args.init {
        return init::run(folder, args);
    }
    let folder = args.dir.clone().unwrap_or_else(default_folder);
    let cases = cases(&folder, args.shard)?;
    let progress = if std::io::stderr().is_terminal() {
        ProgressBar::new(cases.len() as u64)
    } else {
        ProgressBar::hidden()
    };
    let inputs: Vec<PathBuf> = cases.iter().flat_map(Case::files).collect();
    output::refuse_over(reports(args), inputs.iter().map(PathBuf::as_path))?;
    let looks_on = args.coverage || args.mutate;
    let programs = if looks_on { Programs::for_debugging() } else { Programs::new() };
    let done: Vec<Done> = cases
        .into_par_iter()
        .progress_with(progress)
        .map(|case| run_case(&folder, case, &programs, looks_on))
        .map(|done| if args.audit { audited(done, &programs) } else { done })
        .collect();
    refuse_over_reads(args, &done, &programs)?;
    let mut written = PendingFiles::default();
    let failed = say(&done, args.update.then_some(&mut written))?;
    if let Some(path) = &args.html {
        written.add(output::new_file(path, report::html(&done).as_bytes())?);
    }
    if let Some(path) = &args.junit {
        written.add(output::new_file(path, junit::xml(&done).as_bytes())?);
    }
    if args.coverage {
        coverage::tell(&done, &programs, args, &mut written)?;
    }
    written.commit()?;
    if args.mutate {
        mutate::tell(&done, &programs)?;
    }
    Ok(if failed == 0 { Status::Done } else { Status::Failed })
}

/// The cases below a folder, or one part of them.
fn cases(folder: &Path, shard: Option<Shard>) -> Result<Vec<Case>, Error> {
    let mut cases = case::find(folder)?;
    if cases.is_empty() {
        let message = format!("{} holds no folder with a case.toml", folder.display());
        return Err(Error::Run(Box::new(Diag::new(CommandCode::NoCases, message))));
    }
    let Some(shard) = shard else { return Ok(cases) };
    let all = cases.len();
    shard.keep(&mut cases);
    let Shard { number, of } = shard;
    output::say(&format!("part {number} of {of}: {} of {all} cases", cases.len()));
    Ok(cases)
}

/// The files that are written besides expected ones.
fn reports(args: &TestArgs) -> impl Iterator<Item = &Path> {
    let reports = [&args.html, &args.junit, &args.coverage_html, &args.lcov];
    reports.into_iter().flatten().map(PathBuf::as_path)
}

/// Refuses a report, and an expected file to be updated, that a case has read: FIL that others
/// include, and files of scripts, are known when the cases have run.
fn refuse_over_reads(args: &TestArgs, done: &[Done], programs: &Programs) -> Result<(), Error> {
    let mut reads: Vec<PathBuf> = Vec::new();
    for Done { case, outcome, .. } in done {
        reads.extend(outcome.reads.iter().cloned());
        if let Ok(program) = programs.get(case) {
            reads.extend(case.inputs(&program));
        }
        // What the scripts of a refused run have read is not told.
        let granted = case.file.read.as_ref().filter(|_| outcome.reads.is_empty());
        let granted = granted.map(|name| files::real_path(&case.folder.join(name)));
        let below = |path: &&Path| {
            granted.as_ref().is_some_and(|folder| files::real_path(path).starts_with(folder))
        };
        reads.extend(reports(args).filter(below).map(Path::to_path_buf));
    }
    reads.sort_unstable();
    reads.dedup();
    let fresh = done.iter().filter(|_| args.update).flat_map(|done| &done.outcome.fresh);
    let written = reports(args).chain(fresh.map(|fresh| fresh.path.as_path()));
    output::refuse_over(written, reads.iter().map(PathBuf::as_path))
}

fn run_case(root: &Path, case: Case, programs: &Programs, looks_on: bool) -> Done {
    let start = Instant::now();
    let recorder = Arc::<Mutex<Recorder>>::default();
    let outcome = if looks_on {
        let debugger: SharedDebugger = recorder.clone();
        case.outcome_debugged(programs, &debugger)
    } else {
        case.outcome_with(programs)
    };
    let below = case.folder.strip_prefix(root).unwrap_or(&case.folder);
    let below = if below.as_os_str().is_empty() { &case.folder } else { below };
    let name = below.display().to_string().replace('\\', "/");
    let recorder = recorder.lock().unwrap_or_else(PoisonError::into_inner).clone();
    Done { name, case, outcome, recorder, time: start.elapsed(), audit: Vec::new() }
}

/// The same case with the audit of its program; a finding fails a case that has passed.
fn audited(mut done: Done, programs: &Programs) -> Done {
    if done.case.file.expect_error.is_some() {
        return done;
    }
    let audited = programs.get(&done.case).and_then(|program| {
        let (audit, nc) = done.case.audit(&program)?;
        let names = (done.case.file.cl.as_str(), done.name.as_str());
        let text = Source::memory(&nc);
        let lines = audit::lines(&audit, names, &text.in_page(program.nc_page()))?;
        Ok((lines, audit::deny(&audit, false).is_err()))
    });
    let (lines, fails) =
        audited.unwrap_or_else(|error: Error| (vec![format!("{}: {error}", done.name)], true));
    if fails && done.outcome.failure.is_none() {
        done.outcome.failure = Some(lines.join("\n"));
    } else {
        done.audit = lines;
    }
    done
}

/// Tells how each case ended, in the order of their folders; expected files are made anew among
/// those of `updated`.
fn say(done: &[Done], mut updated: Option<&mut PendingFiles>) -> Result<usize, Error> {
    let mut failed = 0;
    for Done { case, outcome, audit, .. } in done {
        if !audit.is_empty() {
            output::print(format!("{}\n", audit.join("\n")).as_bytes())?;
        }
        let Some(failure) = &outcome.failure else { continue };
        let fresh = updated.as_mut().filter(|_| !outcome.fresh.is_empty());
        let word = if fresh.is_some() { "UPDATED" } else { "FAILED" };
        output::print(
            format!("{word} {}\n{}\n", case.folder.display(), failure.trim_end()).as_bytes(),
        )?;
        match fresh {
            Some(updated) => outcome.update_with(updated)?,
            None => failed += 1,
        }
    }
    let passed = done.len() - failed;
    output::print(format!("{passed} passed, {failed} failed\n").as_bytes())?;
    Ok(failed)
}

/// The settings of a case that are not the default and act, with a name for where they come
/// from: cases with the same one have the same machine.
fn settings_of(done: &Done, programs: &Programs) -> Vec<(String, &'static Location)> {
    let Ok(program) = programs.get(&done.case) else { return Vec::new() };
    let commons = program.commons();
    let differs = |row: &&'static Location| {
        let value = commons.get(row.kind, u32::from(row.number));
        row.used && value.is_ok_and(|value| value != row.default_value())
    };
    let source = machine_of(&done.case);
    TABLE.iter().filter(differs).map(|row| (source.clone(), row)).collect()
}

/// Where the machine of a case comes from.
fn machine_of(case: &Case) -> String {
    let file = &case.file;
    let path = file.machine.as_ref().or(file.option_file.as_ref()).map(|name| {
        let path = case.folder.join(name);
        path.canonicalize().unwrap_or(path).display().to_string()
    });
    path.or_else(|| file.ready.clone()).unwrap_or_else(|| "the generic mill".to_string())
}

fn default_folder() -> PathBuf {
    let corpus = Path::new("corpus");
    if corpus.is_dir() { corpus.into() } else { ".".into() }
}
