//! `filpost learn`

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

use fil_learn::{Bases, Learned, Pair, Task};
use filpost::{Error, files};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::{Chosen, LearnArgs};
use crate::{Status, new, output, setup};

/// Whether a search runs, and whether it was asked to end.
static SEARCH: AtomicU8 = AtomicU8::new(NONE);
const NONE: u8 = 0;
const RUNS: u8 = 1;
const ENDS: u8 = 2;

/// Asks a running search to end with the best machine so far; false where none runs, and at the
/// second time.
pub fn end_search() -> bool {
    SEARCH.compare_exchange(RUNS, ENDS, Ordering::Relaxed, Ordering::Relaxed).is_ok()
}

/// Learns a post from pairs, explains an edit, or checks a learned post.
///
/// # Errors
/// Files that can't be read or written; a base that can't be built or refuses every CL file.
pub fn run(args: &LearnArgs) -> Result<Status, Error> {
    if !args.pairs.len().is_multiple_of(2) {
        output::say("error: each CL file needs its NC program: CL NC [CL NC …]");
        return Ok(Status::Usage);
    }
    let pairs = pairs(&args.pairs)?;
    match &args.check {
        Some(post) => check(args, post, pairs),
        None => learn(args, pairs),
    }
}

fn pairs(paths: &[PathBuf]) -> Result<Vec<Pair>, Error> {
    let read = |path: &Path| std::fs::read(path).map_err(|error| files::cant_read(path, &error));
    let name = |path: &Path| path.display().to_string();
    let pair = |two: &[PathBuf]| match two {
        [cl, nc] => Ok(Pair::new(&name(cl), &read(cl)?, &name(nc), &read(nc)?)),
        _ => unreachable!("chunks of two"),
    };
    paths.chunks(2).map(pair).collect()
}

fn learn(args: &LearnArgs, pairs: Vec<Pair>) -> Result<Status, Error> {
    let is_given = args.edit || args.chosen.post.is_some() || args.chosen.machine.is_some();
    let bases = match is_given {
        true => given(args, &args.chosen, &args.fil)?,
        false if args.base.is_empty() => Bases::all(),
        false => Bases::Ready(args.base.clone()),
    };
    let bar = bar();
    let mut task = Task::new(pairs.clone(), bases).watch(|progress| {
        bar.set_message(format!(
            "{}: {} programs posted, distance {:.1}",
            progress.step, progress.runs, progress.distance
        ));
        SEARCH.load(Ordering::Relaxed) != ENDS
    });
    for key in &args.keep {
        task = task.keep(key);
    }
    if let Some(units) = args.units.units {
        task = task.units(units);
    }
    if let Some(threads) = args.threads {
        task = task.threads(threads);
    }
    let mut texts = Vec::new();
    for path in &args.fil {
        let text = files::read_text(path, args.reading.encoding.as_deref())?;
        if !is_given {
            task = task.fil(&path.display().to_string(), &text);
        }
        texts.push(text);
    }
    SEARCH.store(RUNS, Ordering::Relaxed);
    let learned = fil_learn::learn(&task);
    SEARCH.store(NONE, Ordering::Relaxed);
    bar.finish_and_clear();
    let learned = learned?;
    if args.json {
        output::print(format!("{:#}\n", learned.report_json()).as_bytes())?;
    } else {
        output::print(learned.report().as_bytes())?;
    }
    if learned.is_too_far() {
        output::say("less than half of the blocks match: no settings are written");
        return Ok(Status::Failed);
    }
    if let Some(folder) = &args.output {
        write(folder, &learned, &pairs, &texts)?;
        let folder = folder.display();
        output::say(&format!("Created {folder}. Next: filpost test {folder}"));
    }
    Ok(if learned.is_equal() { Status::Done } else { Status::Failed })
}

/// The post of -p or -m with its FIL as the base.
fn given(args: &LearnArgs, chosen: &Chosen, fil: &[PathBuf]) -> Result<Bases, Error> {
    let named = setup::for_run(chosen, fil, &args.reading, &setup::From::CommandLine)?;
    let title = named.title.clone();
    Ok(Bases::Given { title, program: named.builder.build()? })
}

/// A line of progress on a terminal.
fn bar() -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{spinner} {msg}");
    let bar = ProgressBar::new_spinner();
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Writes the folder of the post: settings, FIL, the pairs as cases, the report.
fn write(folder: &Path, learned: &Learned, pairs: &[Pair], fil: &[String]) -> Result<(), Error> {
    let mut content: Vec<(String, Vec<u8>)> = vec![
        ("machine.toml".into(), learned.machine_toml().into_bytes()),
        ("report.txt".into(), learned.report().into_bytes()),
        ("report.json".into(), format!("{:#}\n", learned.report_json()).into_bytes()),
    ];
    if !fil.is_empty() {
        content.push(("post.fil".into(), fil.concat().into_bytes()));
    }
    for (number, pair) in (1..).zip(pairs) {
        let cl = file_name(&pair.cl_name, "part.ncl");
        let stem = cl.split('.').next().unwrap_or("part");
        let case = format!("cases/{number:02}-{stem}");
        content.push((format!("{case}/case.toml"), case_toml(&cl, pair, fil).into_bytes()));
        content.push((format!("{case}/{cl}"), pair.cl.clone()));
        content.push((format!("{case}/expected.nc"), pair.nc.clone()));
    }
    new::make_folder(folder)?;
    let named: Vec<(&str, &[u8])> =
        content.iter().map(|(name, text)| (name.as_str(), text.as_slice())).collect();
    new::write_files(folder, &named)
}

fn case_toml(cl: &str, pair: &Pair, fil: &[String]) -> String {
    let fil = if fil.is_empty() { "" } else { "fil = [\"../../post.fil\"]\n" };
    format!(
        "# The proven program of a pair.\ncl = {cl:?}\nmachine = \"../../machine.toml\"\n\
         {fil}expect = \"expected.nc\"\norigin = {:?}\n",
        format!("proven program {}", pair.nc_name)
    )
}

fn file_name(path: &str, otherwise: &str) -> String {
    let name = Path::new(path).file_name().and_then(|name| name.to_str());
    name.unwrap_or(otherwise).to_string()
}

fn check(args: &LearnArgs, post: &str, pairs: Vec<Pair>) -> Result<Status, Error> {
    let chosen = Chosen { post: Some(post.into()), ..Chosen::default() };
    let Bases::Given { program, .. } = given(args, &chosen, &args.fil)? else {
        unreachable!("a given base")
    };
    let task = Task::new(pairs, Bases::Given { title: post.into(), program });
    let task = match args.units.units {
        Some(units) => task.units(units),
        None => task,
    };
    let checked = fil_learn::check(&task)?;
    output::print(checked.report().as_bytes())?;
    Ok(if checked.is_equal() { Status::Done } else { Status::Failed })
}
