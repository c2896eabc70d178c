//! `filpost post` with many CL files: on all cores, as if they were posted one
//! by one.

use std::collections::HashMap;
use std::io::{self, IsTerminal};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use filpost::{Diag, Error, files};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::{Grant, PostArgs};
use crate::errors::CommandCode;
use crate::job::{self, Job, Outcome};
use crate::posts::Posts;
use crate::{Status, output, post, refused, summary};

/// Endings of CL files in a folder, lower case.
const ENDINGS: &[&str] = &["ncl", "cl", "cls", "apt", "aptsource", "clf"];

/// Ending of the NC programs.
const NC: &str = "nc";

/// Posts many CL files.
///
/// # Errors
/// Files or folders that can't be used; with them nothing is posted.
pub fn run(args: &PostArgs) -> Result<Status, Error> {
    if let Some(message) = misused(args) {
        output::say(&format!("error: {message}"));
        return Ok(Status::Usage);
    }
    let start = Instant::now();
    let jobs = jobs(args)?;
    let bar = bar(&jobs);
    let mut rows = Vec::new();
    let mut refusals = Repeated::default();
    each(args, &jobs, &bar, |job, outcome| {
        if !refusals.has_told(&outcome) {
            bar.suspend(|| tell(job, &outcome));
        }
        rows.push(Row::new(job, &outcome));
    });
    bar.finish_and_clear();
    refusals.tell_rest();
    table(&rows, start.elapsed());
    Ok(rows.iter().map(|row| row.status).max_by_key(|status| *status as u8).unwrap_or(Status::Done))
}

/// Options that make sense for one CL file only.
fn misused(args: &PostArgs) -> Option<&'static str> {
    let stream = |path: &PathBuf| path.as_os_str() == "-";
    if args.cl.iter().any(stream) {
        Some("- is one CL file, it can't be one of several")
    } else if args.output.as_ref().is_some_and(stream) {
        Some("several programs need a folder, -o DIR")
    } else if args.listing.is_some() {
        Some("--listing names one file; post the CL files one by one for it")
    } else if matches!(args.audit, Some(Some(_))) {
        Some("--audit takes no name with several CL files")
    } else if args.profile.is_some() {
        Some("--profile takes the time of one run; post the CL files one by one for it")
    } else if matches!(args.map, Some(Some(_))) {
        Some("--map takes no name with several CL files: each map lies beside its program")
    } else if args.shard.is_some() && writes(args) {
        Some("--shard and --grant write=DIR: scripts of two parts could meet in one file")
    } else {
        None
    }
}

/// A job for each CL file of this part, in the order given; those of a folder by name.
fn jobs(args: &PostArgs) -> Result<Vec<Job>, Error> {
    let mut cl = Vec::new();
    for path in &args.cl {
        if path.is_dir() {
            cl.extend(newest(path)?);
        } else {
            cl.push(path.clone());
        }
    }
    let mut jobs: Vec<Job> = cl.into_iter().map(|cl| job(args, cl)).collect();
    // Of all of them: two parts would write one program.
    refuse_collisions(&jobs)?;
    if let Some(shard) = args.shard {
        let all = jobs.len();
        shard.keep(&mut jobs);
        let (number, of) = (shard.number, shard.of);
        output::say(&format!("part {number} of {of}: {} of {all} CL files", jobs.len()));
    }
    if let Some(folder) = &args.output {
        std::fs::create_dir_all(folder).map_err(|error| files::cant_write(folder, &error))?;
    }
    Ok(jobs)
}

fn job(args: &PostArgs, cl: PathBuf) -> Job {
    let folder = match &args.output {
        Some(folder) => folder.clone(),
        None => cl.parent().map(Path::to_path_buf).unwrap_or_default(),
    };
    let stem = ClName::of(&cl).map_or("program".to_string(), |name| name.stem);
    let output = folder.join(format!("{stem}.{NC}"));
    let map = args.map.as_ref().map(|_| post::beside(&output));
    Job { cl, output: Some(output), listing: None, map, audit: None }
}

/// The parts of the name of a CL file.
struct ClName {
    /// The name without the version: `op010.ncl` of `op010.ncl.2`.
    file: String,
    /// The version; 0 for none.
    version: u32,
    /// The name without ending: `op010`.
    stem: String,
    /// It ends as CL files do.
    is_cl: bool,
}

impl ClName {
    fn of(cl: &Path) -> Option<ClName> {
        let name = cl.file_name()?.to_string_lossy().into_owned();
        let versioned = name.rsplit_once('.').and_then(|(file, digits)| {
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
            Some((file.to_string(), digits.parse().ok().filter(|_| plain)?))
        });
        let (file, version) = versioned.unwrap_or((name, 0));
        let (stem, ending) = match file.rsplit_once('.') {
            Some((stem, ending)) if !stem.is_empty() => (stem.to_string(), ending),
            _ => (file.clone(), ""),
        };
        let is_cl = ENDINGS.contains(&ending.to_ascii_lowercase().as_str());
        Some(ClName { file, version, stem, is_cl })
    }
}

/// The CL files of a folder, sorted; of several versions the newest.
fn newest(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let cant = |error| files::cant_read(folder, &error);
    let mut found: HashMap<String, (u32, PathBuf)> = HashMap::new();
    let mut older = 0;
    for entry in std::fs::read_dir(folder).map_err(cant)? {
        let path = entry.map_err(cant)?.path();
        let Some(name) = ClName::of(&path).filter(|name| name.is_cl && path.is_file()) else {
            continue;
        };
        let version = name.version;
        match found.get_mut(&name.file) {
            Some(kept) => {
                older += 1;
                if kept.0 < version {
                    *kept = (version, path);
                }
            }
            None => {
                found.insert(name.file, (version, path));
            }
        }
    }
    if found.is_empty() {
        let message = format!("{} holds no file .{}", folder.display(), ENDINGS.join(", ."));
        return Err(Error::Run(Box::new(Diag::new(CommandCode::NoClFiles, message))));
    }
    if older > 0 {
        let versions = summary::counted(older, "older version");
        output::say(&format!("note: {versions} in {} left out", folder.display()));
    }
    let mut files: Vec<PathBuf> = found.into_values().map(|(_, path)| path).collect();
    files.sort();
    Ok(files)
}

/// Refuses programs of the same name, and one over a CL file.
fn refuse_collisions(jobs: &[Job]) -> Result<(), Error> {
    let read = jobs.iter().map(|job| (files::real_path(&job.cl), &*job.cl));
    let read: HashMap<PathBuf, &Path> = read.collect();
    let mut written: HashMap<PathBuf, &Path> = HashMap::new();
    for job in jobs {
        for path in job.output.iter().chain(&job.map) {
            // Case is no difference on many disks.
            let real = files::real_path(path);
            let name = PathBuf::from(real.to_string_lossy().to_lowercase());
            let other = written.insert(name, &job.cl).or(read.get(&real).copied());
            if let Some(other) = other {
                let (cl, other) = (job.cl.display(), other.display());
                let message =
                    format!("{} would be made from both {cl} and {other}", path.display());
                return Err(output::over_input(message));
            }
        }
    }
    Ok(())
}

/// Runs the jobs on all cores and hands the outcomes out in their order.
fn each(args: &PostArgs, jobs: &[Job], bar: &ProgressBar, mut take: impl FnMut(&Job, Ended)) {
    let next = AtomicUsize::new(0);
    let files = jobs.iter().flat_map(|job| [Some(&job.cl), job.output.as_ref(), job.map.as_ref()]);
    let posts = &Posts::with_taken(args, files.flatten().cloned().collect());
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..workers(args, jobs.len()) {
            let (send, next) = (send.clone(), &next);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(index) else { return };
                    let run = || job::run(posts, job, Some(bar));
                    let ended = catch_unwind(AssertUnwindSafe(run)).ok();
                    if send.send((index, ended)).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        let mut waiting = HashMap::new();
        let mut due = 0;
        for (index, ended) in receive {
            waiting.insert(index, ended);
            while let Some(ended) = waiting.remove(&due) {
                take(&jobs[due], ended);
                due += 1;
            }
        }
    });
}

/// How a job ended; `None` for an internal fault, which has been reported.
type Ended = Option<Outcome>;

/// Scripts that may write files could meet in one of them, so they run one
/// after the other.
fn workers(args: &PostArgs, jobs: usize) -> usize {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    if writes(args) { 1 } else { cores.min(jobs) }
}

fn writes(args: &PostArgs) -> bool {
    args.grants.grant.iter().any(|grant| matches!(grant, Grant::Write(_)))
}

/// A progress bar over all bytes, on a terminal.
fn bar(jobs: &[Job]) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let length = |job: &Job| job.cl.metadata().map_or(0, |found| found.len());
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {bytes_per_sec}  {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(jobs.iter().map(length).sum()).with_style(style)
}

/// Refusals that say the same of many files, as where the option file of all is missing: the
/// first ones are shown, the others counted.
#[derive(Default)]
struct Repeated {
    /// Code and message of each refusal, and how many files have it. In the order of the files.
    seen: Vec<(String, usize)>,
}

/// Files for which the same refusal is shown.
const MOST_ALIKE: usize = 3;

impl Repeated {
    /// Counts a refusal; true for one that enough files before have had, and that has no warnings.
    fn has_told(&mut self, ended: &Ended) -> bool {
        let Some(outcome) = ended.as_ref().filter(|outcome| outcome.warnings.is_empty()) else {
            return false;
        };
        let Err(error) = &outcome.result else { return false };
        let text = |diag: &Diag| format!("{} {}", diag.code.name(), diag.message);
        let text = error.diags().iter().map(text).collect::<Vec<_>>().join("; ");
        let at = self.seen.iter().position(|(seen, _)| *seen == text).unwrap_or_else(|| {
            self.seen.push((text, 0));
            self.seen.len() - 1
        });
        self.seen[at].1 += 1;
        self.seen[at].1 > MOST_ALIKE
    }

    /// A line for each refusal with files that were not shown.
    fn tell_rest(&self) {
        for (text, count) in self.seen.iter().filter(|(_, count)| *count > MOST_ALIKE) {
            let more = summary::counted((count - MOST_ALIKE) as u64, "more file");
            output::say(&format!("{text}: the same in {more}"));
        }
    }
}

/// Messages of a job, under its name.
fn tell(job: &Job, ended: &Ended) {
    let quiet = ended.as_ref().is_some_and(|outcome| {
        let result = outcome.result.as_ref();
        let silent = |report: &filpost::Report| {
            report.swallowed.is_empty() && report.script_files.is_empty()
        };
        outcome.note.is_none() && outcome.warnings.is_empty() && result.is_ok_and(silent)
    });
    if quiet {
        return;
    }
    output::say(&format!("{}:", job.cl.display()));
    let Some(outcome) = ended else { return };
    post::tell(job, outcome);
    if let Err(error) = &outcome.result {
        refused::tell(error);
    }
}

/// A row of the table at the end.
struct Row {
    cl: String,
    dialect: String,
    result: String,
    warnings: usize,
    time: Duration,
    /// The unit and the post.
    by: String,
    status: Status,
}

impl Row {
    fn new(job: &Job, ended: &Ended) -> Row {
        let cl = job.cl.display().to_string();
        let Some(outcome) = ended else {
            let result = "internal fault".to_string();
            let (time, dialect, by) = (Duration::ZERO, String::new(), String::new());
            return Row { cl, dialect, result, warnings: 0, time, by, status: Status::Fault };
        };
        let mut by = outcome.title.clone();
        if let Ok(Some((unit, source))) = outcome.result.as_ref().map(|report| report.unit) {
            by = format!("{unit} ({source}), {by}");
        }
        let (result, status) = match &outcome.result {
            Ok(report) => (summary::counted(report.blocks, "block"), Status::Done),
            Err(error) => {
                let code = error.diags().first().map_or(String::new(), |diag| diag.code.name());
                let more = error.refusals().map_or(0, |all| all.total().saturating_sub(1));
                let more = if more > 0 { format!(" + {more}") } else { String::new() };
                (format!("refused, {code}{more}"), Status::Failed)
            }
        };
        let dialect = outcome.result.as_ref().ok().and_then(|report| report.dialect);
        let dialect = dialect.map_or(String::new(), |found| found.dialect.to_string());
        let (warnings, time) = (outcome.warnings.len(), outcome.time);
        Row { cl, dialect, result, warnings, time, by, status }
    }
}

/// Files with the same refusal whose rows are all shown; of more, [`MOST_ALIKE`] rows and a count.
const MOST_ROWS_ALIKE: usize = 20;

/// The rows to show, and for each kind of refusal that many files have, how many are left out.
fn shown(rows: &[Row]) -> (Vec<&Row>, Vec<(&str, usize)>) {
    let is_refusal = |row: &Row| row.status == Status::Failed && row.warnings == 0;
    let alike =
        |result: &str| rows.iter().filter(|row| is_refusal(row) && row.result == result).count();
    let mut kinds: Vec<(&str, usize, usize)> = Vec::new();
    let mut shown = Vec::new();
    for row in rows {
        if !is_refusal(row) {
            shown.push(row);
            continue;
        }
        let at = kinds.iter().position(|(result, ..)| *result == row.result).unwrap_or_else(|| {
            kinds.push((&row.result, alike(&row.result), 0));
            kinds.len() - 1
        });
        let (_, all, count) = &mut kinds[at];
        *count += 1;
        if *all <= MOST_ROWS_ALIKE || *count <= MOST_ALIKE {
            shown.push(row);
        }
    }
    kinds.retain(|(_, all, _)| *all > MOST_ROWS_ALIKE);
    (shown, kinds.into_iter().map(|(result, all, _)| (result, all - MOST_ALIKE)).collect())
}

/// The table, and a line of sums.
fn table(rows: &[Row], time: Duration) {
    let (shown, more) = shown(rows);
    let widest = |of: fn(&Row) -> &str| rows.iter().map(|row| of(row).chars().count()).max();
    let name = widest(|row| &row.cl).unwrap_or(0);
    let result = widest(|row| &row.result).unwrap_or(0);
    let dialect = widest(|row| &row.dialect).unwrap_or(0);
    for row in shown {
        output::say(&format!(
            "{:name$}  {:dialect$}  {:>result$}  {:>12}  {:>8.2} s  {}",
            row.cl,
            row.dialect,
            row.result,
            summary::counted(row.warnings as u64, "warning"),
            row.time.as_secs_f64(),
            row.by,
        ));
    }
    for (result, count) in more {
        output::say(&format!("{}: {result}", summary::counted(count as u64, "more file")));
    }
    let failed = rows.iter().filter(|row| row.status != Status::Done).count();
    output::say(&format!(
        "{} posted, {failed} refused, {:.2} s",
        summary::counted((rows.len() - failed) as u64, "file"),
        time.as_secs_f64()
    ));
}
