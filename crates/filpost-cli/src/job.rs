//! One CL file on its way to one NC program.

use std::fs::File;
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use filpost::cl::reader::Options;
use filpost::debug::SharedDebugger;
use filpost::listing::Listing;
use filpost::map::Names;
use filpost::profile::Profile;
use filpost::{Diag, Error, PendingFiles, Program, Report, files, select};
use indicatif::ProgressBar;

use crate::args::PostArgs;
use crate::audit::{self, Both, Copies};
use crate::errors::CommandCode;
use crate::output::{self, Target, over_input};
use crate::posts::{Built, Posts};
use crate::profile;
use crate::setup::{self, From};
use crate::summary;

/// A CL file and where its results go.
#[derive(Clone, Debug)]
pub struct Job {
    /// The CL file; `-` is standard input.
    pub cl: PathBuf,
    /// The NC file; standard output when `None` or `-`.
    pub output: Option<PathBuf>,
    /// The listing.
    pub listing: Option<PathBuf>,
    /// The line map.
    pub map: Option<PathBuf>,
    /// The audit as JSON.
    pub audit: Option<PathBuf>,
}

impl Job {
    /// The NC file, where one lies there already; whoever reads it may take it for the one that
    /// was asked for.
    pub fn earlier_program(&self) -> Option<&Path> {
        self.output.as_deref().filter(|nc| nc.is_file() && *nc != self.cl)
    }
}

/// How a job ended.
#[derive(Debug)]
pub struct Outcome {
    /// What the summary calls the post.
    pub title: String,
    /// Something the user should know about the choice of the post.
    pub note: Option<String>,
    /// All warnings.
    pub warnings: Vec<Diag>,
    /// The run's report, or why there is no program.
    pub result: Result<Report, Error>,
    /// What `--audit` found, in print.
    pub audit: Vec<String>,
    /// How long it took.
    pub time: Duration,
}

/// Posts a CL file; `bar` moves on by the bytes read.
pub fn run(posts: &Posts<'_>, job: &Job, bar: Option<&ProgressBar>) -> Outcome {
    let start = Instant::now();
    let mut outcome = Outcome {
        title: String::new(),
        note: None,
        warnings: Vec::new(),
        result: Ok(Report::default()),
        audit: Vec::new(),
        time: Duration::ZERO,
    };
    outcome.result = post(posts, job, bar, &mut outcome);
    outcome.time = start.elapsed();
    outcome
}

fn post(
    posts: &Posts<'_>,
    job: &Job,
    bar: Option<&ProgressBar>,
    outcome: &mut Outcome,
) -> Result<Report, Error> {
    let mut input = output::open(&job.cl)?;
    let args = posts.args();
    let (built, from) = built(posts, job, &mut input)?;
    let picture = args.profile.as_ref().and_then(Option::as_ref);
    let mut inputs = built.inputs;
    inputs.extend(built.program.fil_files().into_iter().map(PathBuf::from));
    inputs.push(job.cl.clone());
    refuse_over_input(job, picture, &inputs)?;
    (outcome.title, outcome.note) = (built.title, built.note);
    let program = built.program;
    let options = options(args)?;
    let stage = |path: &PathBuf| Target::new(Some(path)).stage();
    let mut nc = Target::new(job.output.as_deref()).stage()?;
    let mut map = job.map.as_ref().map(stage).transpose()?;
    let mut listing = job.listing.as_ref().map(stage).transpose()?.map(Listing::new);
    let mut flames = picture.map(stage).transpose()?;
    let profile = args.profile.is_some().then(Arc::<Mutex<Profile>>::default);
    let mut copies = args.audit.is_some().then(Copies::new).transpose()?;
    let again = input.try_clone().map_err(|error| files::cant_read(&job.cl, &error))?;
    let name = output::input_name(&job.cl);
    let start = || audit::run_of(&program, &name, options, args.units.units);

    let mut run = start();
    if let Some(listing) = &mut listing {
        run = run.observe(listing.observer());
    }
    if let Some(profile) = &profile {
        let debugger: SharedDebugger = profile.clone();
        run = run.debug(&debugger);
    }
    let input = Watched { input, bar, at: 0, furthest: 0 };
    let seen = || names(&program, job, job.map.as_deref().unwrap_or(Path::new("")));
    let (report, pending) = match (&mut map, copies.as_mut().map(Copies::writers)) {
        (Some(map), None) => run.run_mapped(input, &mut nc, &seen(), map)?,
        (None, None) => run.run_pending(input, &mut nc)?,
        (Some(map), Some((nc_copy, map_copy))) => {
            run.run_mapped(input, Both(&mut nc, nc_copy), &seen(), &mut Both(map, map_copy))?
        }
        (None, Some((nc_copy, map))) => {
            run.run_mapped(input, Both(&mut nc, nc_copy), &seen(), map)?
        }
    };
    let listing = match (listing, &job.listing) {
        (Some(listing), Some(path)) => {
            Some(listing.finish().map_err(|error| files::cant_write(path, &error))?)
        }
        _ => None,
    };
    setup::confirm(&from, || Ok(report.machines.clone()), &name)?;
    let warnings = program.warnings().iter().chain(&report.warnings);
    outcome.warnings = warnings.cloned().collect();
    deny(args.deny_warnings, outcome.warnings.len())?;
    if !report.script_reads.is_empty() {
        let reads = report.script_reads.iter().map(PathBuf::as_path);
        output::refuse_over(outputs(job, picture), reads)?;
    }
    refuse_scripts(job, posts.taken(), &inputs, &pending)?;
    if let Some(copies) = copies {
        let (found, lines) = copies.audit(start(), again, (&name, &seen().nc), &program)?;
        outcome.audit = lines;
        if let Some(path) = &job.audit {
            let text = format!("{:#}\n", filpost::audit::as_json(&found));
            Target::new(Some(path)).write(|out| {
                out.write_all(text.as_bytes()).map_err(|error| files::cant_write(path, &error))
            })?;
        }
        audit::deny(&found, args.reading.levels.denies_audit)?;
    }
    let profile =
        profile.as_ref().map(|profile| profile.lock().unwrap_or_else(PoisonError::into_inner));
    if let (Some(flames), Some(profile), Some(path)) = (&mut flames, &profile, picture) {
        let svg = profile.flame_graph(&program);
        flames.write_all(svg.as_bytes()).map_err(|error| files::cant_write(path, &error))?;
    }
    output::commit([Some(nc), map, listing, flames].into_iter().flatten(), pending)?;
    if let Some(profile) = profile {
        profile::tell(&profile, &program);
    }
    Ok(report)
}

/// Where the results of a job go.
fn outputs<'p>(job: &'p Job, picture: Option<&'p PathBuf>) -> impl Iterator<Item = &'p Path> {
    let others =
        job.listing.iter().chain(&job.map).chain(&job.audit).chain(picture).map(PathBuf::as_path);
    [output::named(job.output.as_deref())].into_iter().chain(others)
}

/// Refuses a script that would write over a file that this run, or another one of the
/// command, reads or writes.
fn refuse_scripts(
    job: &Job,
    others: &[PathBuf],
    inputs: &[PathBuf],
    pending: &PendingFiles,
) -> Result<(), Error> {
    let taken = || inputs.iter().chain(others).map(PathBuf::as_path).chain(outputs(job, None));
    pending.paths().try_for_each(|path| output::refuse_over([path], taken()))
}

/// The post of the job, and where it comes from; afterwards the input stands at its
/// start again.
fn built(posts: &Posts<'_>, job: &Job, input: &mut File) -> Result<(Built, From), Error> {
    let args = posts.args();
    let folders = select::beside_first(&job.cl, &args.post_path);
    let name = output::input_name(&job.cl);
    let options = options(args)?;
    let from = setup::from(&args.chosen, &folders, || select::asked(&mut *input, &name, options))?;
    input.rewind().map_err(|error| files::cant_read(&job.cl, &error))?;
    Ok((posts.get(from.clone())?, from))
}

fn options(args: &PostArgs) -> Result<Options, Error> {
    setup::cl_options(args.reading.encoding.as_deref(), &args.cl_reading, args.raw)
}

/// How the map calls the files: as they are seen from its folder.
fn names(program: &Program, job: &Job, map: &Path) -> Names {
    let folder = map.parent().unwrap_or(Path::new(""));
    let seen = |path: &Path| Names::from_folder(folder, path);
    let stream = |path: &Path| path.as_os_str() == "-";
    let cl = if stream(&job.cl) { output::input_name(&job.cl) } else { seen(&job.cl) };
    let nc = match &job.output {
        Some(path) if !stream(path) => seen(path),
        _ => output::STANDARD_OUTPUT.to_string(),
    };
    Names { cl, nc, fil: program.fil_files().iter().map(|name| seen(Path::new(name))).collect() }
}

/// An input that moves a progress bar.
struct Watched<'b> {
    input: File,
    bar: Option<&'b ProgressBar>,
    at: u64,
    furthest: u64,
}

impl Read for Watched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(buffer)?;
        self.at += count as u64;
        if let Some(bar) = self.bar.filter(|_| self.at > self.furthest) {
            bar.inc(self.at - self.furthest);
            self.furthest = self.at;
        }
        Ok(count)
    }
}

impl Seek for Watched<'_> {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.at = self.input.seek(to)?;
        Ok(self.at)
    }
}

/// The error of `--deny-warnings`.
fn deny(denied: bool, warnings: usize) -> Result<(), Error> {
    if !denied || warnings == 0 {
        return Ok(());
    }
    let message = summary::counted(warnings as u64, "warning");
    Err(Error::Run(Box::new(Diag::new(CommandCode::Denied, message))))
}

/// Refuses an output that is one of the inputs, or another output. A map never
/// overwrites a file that is not a map.
fn refuse_over_input(
    job: &Job,
    picture: Option<&PathBuf>,
    inputs: &[PathBuf],
) -> Result<(), Error> {
    output::refuse_over(outputs(job, picture), inputs.iter().map(PathBuf::as_path))?;
    match &job.map {
        Some(map) if map.is_file() && !is_map(map) => Err(over_input(format!(
            "{} is there and is no line map; --map takes the name after it for that of the map",
            map.display()
        ))),
        _ => Ok(()),
    }
}

/// True for an empty file and for one that begins as a map does.
fn is_map(path: &Path) -> bool {
    const BEGIN: &[u8] = b"{\"filpost-map\":";
    let mut begin = Vec::new();
    let read =
        File::open(path).and_then(|file| file.take(BEGIN.len() as u64).read_to_end(&mut begin));
    read.is_ok() && (begin.is_empty() || begin == BEGIN)
}
