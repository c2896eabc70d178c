//! `filpost post`

use std::ffi::OsString;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use filpost::{Code, Diag, Error};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::PostArgs;
use crate::errors::CommandCode;
use crate::job::{self, Job, Outcome};
use crate::posts::Posts;
use crate::{Status, batch, each_tool, output, summary};

/// CL files from this size on get a progress bar, in bytes.
const PROGRESS: u64 = 4 << 20;

/// Posts a CL file, or many.
///
/// # Errors
/// What is wrong with the input, the post or the output.
pub fn run(args: &PostArgs) -> Result<Status, Error> {
    match &args.cl[..] {
        [cl] if args.each_tool && cl.is_file() => each_tool::run(args, cl),
        _ if args.each_tool => {
            output::say("error: --each-tool takes one CL file");
            Ok(Status::Usage)
        }
        [cl] if !cl.is_dir() && args.shard.is_none() => one(args, cl),
        _ => batch::run(args),
    }
}

fn one(args: &PostArgs, cl: &Path) -> Result<Status, Error> {
    let map = match &args.map {
        Some(named) => match map_name(named.as_deref(), args.output.as_deref()) {
            Some(map) => Some(map),
            None => {
                output::say("error: --map needs a FILE when the program goes to standard output");
                return Ok(Status::Usage);
            }
        },
        None => None,
    };
    let job = Job {
        cl: cl.to_path_buf(),
        output: args.output.clone(),
        listing: args.listing.clone(),
        map,
        audit: args.audit.clone().flatten(),
    };
    carry_out(&Posts::new(args), &job)
}

/// Posts one CL file and tells of it.
///
/// # Errors
/// Why there is no program.
pub fn carry_out(posts: &Posts<'_>, job: &Job) -> Result<Status, Error> {
    let bar = bar(&job.cl);
    let outcome = job::run(posts, job, bar.as_ref());
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    tell(job, &outcome);
    let report = outcome.result?;
    let warnings = outcome.warnings.len();
    output::say(&summary::line(&outcome.title, &report, warnings, outcome.time));
    Ok(Status::Done)
}

/// What `--map` names: OUT.map without a FILE; `None` when there is no OUT.
fn map_name(named: Option<&Path>, output: Option<&Path>) -> Option<PathBuf> {
    match named {
        Some(named) => Some(named.to_path_buf()),
        None => output.filter(|path| path.as_os_str() != "-").map(beside),
    }
}

/// The map of an NC file: its name with `.map` after it.
pub fn beside(nc: &Path) -> PathBuf {
    let mut name = OsString::from(nc);
    name.push(".map");
    name.into()
}

/// Warnings and notes of a run; of a refused one the program that an earlier run has left.
pub fn tell(job: &Job, outcome: &Outcome) {
    if let Some(note) = &outcome.note {
        output::say(&format!("note: {note}"));
    }
    summary::warnings(&outcome.warnings);
    outcome.audit.iter().for_each(|line| output::say(line));
    let report = match &outcome.result {
        Ok(report) => report,
        Err(error) => return tell_earlier(job, error),
    };
    for (section, count) in &report.swallowed {
        let records = summary::counted(*count, "record");
        let them = if *count == 1 { "it" } else { "them" };
        output::say(&format!(
            "note: section {section} took {records} and wrote nothing for {them}"
        ));
    }
    for path in &report.script_files {
        output::say(&format!("note: FIL has changed {}", path.display()));
    }
}

/// Names the program that lies where the refused one would, so that nobody takes it for that.
fn tell_earlier(job: &Job, error: &Error) {
    let over_input = |diag: &Diag| diag.code == <&Code>::from(CommandCode::OverInput);
    if let Some(nc) = job.earlier_program().filter(|_| !error.diags().iter().any(over_input)) {
        output::say(&format!("note: {} is of an earlier run", nc.display()));
    }
}

/// A progress bar for a large file on a terminal.
fn bar(cl: &Path) -> Option<ProgressBar> {
    let length = cl.metadata().map_or(0, |found| found.len());
    if length < PROGRESS || !io::stderr().is_terminal() {
        return None;
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {bytes_per_sec}  {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    Some(ProgressBar::new(length).with_style(style))
}
