//! The referee of refactorings: all programs that the repository can make, with several posts,
//! each kept as one line: posted or refused, a hash of the NC program, the codes of errors and
//! warnings with their CL lines, and what `filpost verify` finds in the program.

mod base;
mod inputs;
mod outcome;
mod random;
mod record;
mod sums;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use rayon::prelude::*;

use inputs::Input;
use record::{Key, Record};

/// Programs of each random suite, where nothing else is asked for.
const SEEDS: u64 = 100;

/// The ready posts that each CL file goes through.
const POSTS: [&str; 9] = [
    "fanuc-lathe",
    "fanuc-mill",
    "fanuc-mill-turn",
    "haas-trunnion-tcpc",
    "heidenhain-tnc640",
    "linuxcnc-5x",
    "okuma-mill",
    "sinumerik-5x",
    "sinumerik-840d",
];

/// Tells what a change does to the programs that the post makes.
///
/// Posts each CL file of corpus/ and tests/words/ as its case or header says and with several
/// ready posts, the tests of tests/language/, and random programs. Without `--base`, `--against`
/// and `--record` it compares with the hashes in tests/shadow.txt. Exit status: 0 nothing
/// differs, 1 something does, 2 it could not be done.
#[derive(clap::Args)]
pub struct Args {
    /// Write the hashes of this run to tests/shadow.txt
    #[arg(long, conflicts_with_all = ["base", "against", "record", "post", "suite", "seeds"])]
    update: bool,
    /// Build this revision too, and list what differs from it
    #[arg(long, value_name = "REV", conflicts_with = "against")]
    base: Option<String>,
    /// List what differs from a record file
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Write the record file of this run: one line for each program
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Programs of each random suite
    #[arg(long, value_name = "N")]
    seeds: Option<u64>,
    /// Only this ready post, or `own` for the machine that a case, a header or a seed names;
    /// may be repeated
    #[arg(long, value_name = "NAME")]
    post: Vec<String>,
    /// Only this suite: corpus, words, language, random-mill …; may be repeated
    #[arg(long, value_name = "NAME")]
    suite: Vec<String>,
    /// Programs that are made at the same time
    #[arg(long, value_name = "N", default_value_t = 2)]
    jobs: usize,
    /// Take CL files, cases and tests from this checkout in place of the own one
    #[arg(long, value_name = "FOLDER", hide = true)]
    inputs: Option<PathBuf>,
    /// Take the random programs from this file in place of making them
    #[arg(long, value_name = "FILE", hide = true)]
    programs: Option<PathBuf>,
}

/// Runs `cargo xtask shadow`.
///
/// # Errors
/// Why it could not be done.
pub fn command(args: &Args) -> Result<ExitCode, String> {
    // Before anything is run, since a revision may be one that can't be built.
    let base = args.base.as_deref().map(base::build).transpose()?;
    let records = run(args)?;
    if let Some(file) = &args.record {
        write(file, &record::write(&records))?;
    }
    let before = match (&base, &args.against) {
        (Some(base), _) => base.run(args)?,
        (None, Some(file)) => record::read(&text_of(file)?)?,
        (None, None) if args.record.is_some() => return Ok(ExitCode::SUCCESS),
        (None, None) => return committed(args, &records),
    };
    let chosen = before.into_iter().filter(|(key, _)| args.takes(key)).collect();
    let differences = record::differences(&chosen, &records);
    for difference in &differences {
        println!("{difference}");
    }
    println!("{} of {} programs differ", differences.len(), records.len());
    Ok(if differences.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

impl Args {
    /// The run is asked for one of these suites and posts.
    fn takes(&self, key: &Key) -> bool {
        let of = |chosen: &[String], name: &str| {
            chosen.is_empty() || chosen.iter().any(|chosen| chosen == name)
        };
        of(&self.post, &key.post) && of(&self.suite, &key.suite)
    }
}

/// Compares with the hashes in the repository, or writes them.
fn committed(args: &Args, records: &BTreeMap<Key, Record>) -> Result<ExitCode, String> {
    let file = filpost_tests::root().join("tests/shadow.txt");
    let found = sums::of(records);
    if args.update {
        write(&file, &sums::write(&found))?;
        println!("{} programs, hashes written to tests/shadow.txt", records.len());
        return Ok(ExitCode::SUCCESS);
    }
    let mut known = sums::read(&text_of(&file)?)?;
    // What this run leaves out is no difference.
    known.retain(|place, _| found.contains_key(place) || args.is_whole());
    let told = sums::differences(&known, &found);
    for line in &told {
        println!("{line}");
    }
    println!("{} programs, {} of {} hashes differ", records.len(), told.len(), found.len());
    if told.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    println!(
        "`cargo xtask shadow --base main` lists the programs; where each difference is meant, \
         `cargo xtask shadow --update` writes the hashes anew"
    );
    Ok(ExitCode::FAILURE)
}

impl Args {
    /// Nothing is left out.
    fn is_whole(&self) -> bool {
        self.post.is_empty() && self.suite.is_empty()
    }
}

/// Makes all programs that are asked for.
fn run(args: &Args) -> Result<BTreeMap<Key, Record>, String> {
    let root = args.inputs.as_deref().unwrap_or(filpost_tests::root());
    let programs = match &args.programs {
        Some(file) => random::read(&text_of(file)?)?,
        None => random::programs(args.seeds.unwrap_or(SEEDS)),
    };
    let inputs: Vec<(Key, Input)> =
        inputs::all(root, programs)?.into_iter().filter(|(key, _)| args.takes(key)).collect();
    if inputs.is_empty() {
        return Err("there is no such suite or post".into());
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.jobs)
        .stack_size(8 << 20)
        .build()
        .map_err(|error| error.to_string())?;
    // A program that panics is one line of the record.
    std::panic::set_hook(Box::new(|_| {}));
    let posts = inputs::Posts::default();
    let run = |(key, input): (Key, Input)| {
        let record = outcome::of(&input, &posts);
        (key, record)
    };
    let records: BTreeMap<Key, Record> = pool.install(|| inputs.into_par_iter().map(run).collect());
    drop(std::panic::take_hook());
    for key in records.iter().filter(|(_, record)| record.has_panicked()).map(|(key, _)| key) {
        eprintln!("panicked: {key}");
    }
    Ok(records)
}

fn text_of(file: &Path) -> Result<String, String> {
    fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text).map_err(|error| format!("{}: {error}", file.display()))
}
