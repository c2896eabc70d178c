//! `filpost watch`: posts a case at each save, and says what that changed in the NC program
//! and in the warnings.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use filpost::case::Case;
use filpost::nc::diff::{Options, compare, read, sentence};
use filpost::{Diag, Error};

use crate::args::WatchArgs;
use crate::summary::counted;
use crate::{Status, output, refused};

/// Between two looks at the files.
const PAUSE: Duration = Duration::from_millis(20);
/// Differences that are shown of one save.
const MOST: usize = 40;
/// Folders below that of the case, and below those of its FIL files, that are looked into.
const DEPTH: usize = 3;

/// Size and time of each file that may have a part in the case.
type Stamps = BTreeMap<PathBuf, (u64, Option<SystemTime>)>;

/// What came of the last save that could be posted.
struct Made {
    nc: Vec<u8>,
    warnings: BTreeSet<String>,
}

/// Posts a case, and again whenever one of its files changes, until it is stopped.
///
/// # Errors
/// Standard output that can't be written.
pub fn run(args: &WatchArgs) -> Result<Status, Error> {
    let mut last: Option<Made> = None;
    let mut seen = Stamps::new();
    let mut left = args.runs;
    while left != Some(0) {
        let now = stamps(&args.case);
        thread::sleep(PAUSE);
        // A file may be half written: what changes still is looked at once it rests.
        if now == seen || now != stamps(&args.case) {
            continue;
        }
        seen = now;
        left = left.map(|left| left - 1);
        post(&args.case, &mut last)?;
    }
    Ok(Status::Done)
}

/// Posts the case once and tells what is other than before.
fn post(folder: &Path, last: &mut Option<Made>) -> Result<(), Error> {
    let start = Instant::now();
    let made = Case::load(folder).and_then(|case| case.run());
    let time = format!("{:.0} ms", start.elapsed().as_secs_f64() * 1000.0);
    match made {
        Err(error) => {
            refused::tell(&error);
            print(&format!("refused, no program, {time}"))
        }
        Ok((nc, warnings)) => {
            let made = Made { nc, warnings: warnings.iter().map(Diag::to_string).collect() };
            let mut lines = match &last {
                None => first(&made),
                Some(before) => changes(before, &made).map_err(Error::Run)?,
            };
            lines.push(format!(
                "{}, {}, {time}",
                counted(made.nc.split(|byte| *byte == b'\n').count() as u64 - 1, "line"),
                counted(made.warnings.len() as u64, "warning"),
            ));
            *last = Some(made);
            print(&lines.join("\n"))
        }
    }
}

/// What is said of the first program: its warnings.
fn first(made: &Made) -> Vec<String> {
    made.warnings.iter().map(|warning| format!("warning {warning}")).collect()
}

/// Differences of the programs, warnings that came and that went.
fn changes(before: &Made, made: &Made) -> Result<Vec<String>, Box<Diag>> {
    let mut lines = Vec::new();
    if before.nc == made.nc {
        lines.push("the program is the same".to_string());
    } else {
        let options = Options::default();
        let [old, new] = [read(&before.nc, "before", &options)?, read(&made.nc, "now", &options)?];
        let found = compare(&old, &new, &options)?;
        let shown = found.differences.iter().take(MOST);
        lines.extend(shown.map(|difference| sentence(difference, &old, &new)));
        if found.differences.is_empty() {
            lines.push("the program is written otherwise and means the same".to_string());
        }
        if found.differences.len() > MOST {
            let more = (found.differences.len() - MOST) as u64;
            lines.push(format!("and {} more", counted(more, "difference")));
        }
    }
    let came = made.warnings.difference(&before.warnings);
    lines.extend(came.map(|warning| format!("new warning {warning}")));
    let gone = before.warnings.difference(&made.warnings);
    lines.extend(gone.map(|warning| format!("gone: {warning}")));
    Ok(lines)
}

fn print(text: &str) -> Result<(), Error> {
    output::print(format!("{}\n", text.trim_end()).as_bytes())
}

/// The files of the case: its folder, the files it names, and the folders of its FIL files
/// for what they include.
fn stamps(folder: &Path) -> Stamps {
    let mut found = Stamps::new();
    look_into(folder, DEPTH, &mut found);
    let Ok(case) = Case::load(folder) else { return found };
    let file = &case.file;
    let single =
        [Some(&file.cl), file.machine.as_ref(), file.option_file.as_ref(), file.compat.as_ref()];
    for name in single.into_iter().flatten() {
        stamp(&folder.join(name), &mut found);
    }
    for name in &file.fil {
        let path = folder.join(name);
        look_into(path.parent().unwrap_or(folder), DEPTH, &mut found);
    }
    found
}

fn look_into(folder: &Path, depth: usize, found: &mut Stamps) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if !path.is_dir() {
            stamp(&path, found);
        } else if depth > 1 {
            look_into(&path, depth - 1, found);
        }
    }
}

fn stamp(path: &Path, found: &mut Stamps) {
    if let Ok(data) = std::fs::metadata(path) {
        found.insert(path.to_path_buf(), (data.len(), data.modified().ok()));
    }
}
