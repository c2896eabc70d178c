//! `filpost post`

use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use filpost::listing::Listing;
use filpost::{Diag, Error, HeldFiles, Post, Report, files, select};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::PostArgs;
use crate::errors::CommandCode;
use crate::output::{self, Target};
use crate::setup::{self, Named};
use crate::{Status, summary};

/// CL files from this size on get a progress bar, in bytes.
const PROGRESS: u64 = 4 << 20;

/// Posts a CL file.
///
/// # Errors
/// What is wrong with the input, the post or the output.
pub fn run(args: &PostArgs) -> Result<Status, Error> {
    let start = Instant::now();
    let mut input = output::open(&args.cl)?;
    let named = named(args, &mut input)?;
    let target = Target::new(args.output.as_deref());
    refuse_over_input(args, &named.inputs)?;
    let (title, note) = (named.title.clone(), named.note.clone());
    let (mut post, listing) = build(args, named)?;
    if let Some(note) = note {
        output::say(&format!("note: {note}"));
    }
    let report = target.write(|writer| {
        let (report, held) = drive(&mut post, input, writer)?;
        if let Some((path, listing)) = listing {
            listing.finish().map_err(|error| files::cant_write(&path, &error))?;
        }
        summary::warnings(post.warnings().iter().chain(&report.warnings));
        deny(args.deny_warnings, post.warnings().len() + report.warnings.len())?;
        // Last of all: from here on only the program itself can fail to appear.
        held.keep()?;
        Ok(report)
    })?;
    for (section, count) in &report.swallowed {
        let records = summary::counted(*count, "record");
        output::say(&format!("note: {records} taken by the section {section} had no effect"));
    }
    for path in &report.script_files {
        output::say(&format!("note: FIL has changed {}", path.display()));
    }
    let warnings = post.warnings().len() + report.warnings.len();
    output::say(&summary::line(&title, &report, warnings, start.elapsed()));
    Ok(Status::Done)
}

fn named(args: &PostArgs, input: &mut File) -> Result<Named, Error> {
    let beside = args.cl.parent().map(Path::to_path_buf).unwrap_or_default();
    let folders: Vec<PathBuf> =
        std::iter::once(beside).chain(args.post_path.iter().cloned()).collect();
    let name = output::input_name(&args.cl);
    let named = setup::for_run(&args.chosen, &args.fil, &args.reading, &folders, || {
        select::machin(&mut *input, &name)
    });
    input.rewind().map_err(|error| files::cant_read(&args.cl, &error))?;
    named
}

type OpenListing = Option<(PathBuf, Listing<BufWriter<File>>)>;

fn build(args: &PostArgs, named: Named) -> Result<(Post, OpenListing), Error> {
    let options = setup::cl_options(args.reading.encoding.as_deref())?;
    let builder = setup::granted(named.builder, &args.grants);
    let mut builder = builder.cl_name(&output::input_name(&args.cl)).cl_options(options);
    let mut listing = None;
    if let Some(path) = &args.listing {
        let file = File::create(path).map_err(|error| files::cant_write(path, &error))?;
        let open = Listing::new(BufWriter::new(file));
        builder = builder.observe(open.observer());
        listing = Some((path.clone(), open));
    }
    Ok((builder.build()?, listing))
}

/// Runs the post, with a progress bar for a large file on a terminal.
fn drive(
    post: &mut Post,
    input: File,
    output: &mut dyn Write,
) -> Result<(Report, HeldFiles), Error> {
    let length = input.metadata().map_or(0, |found| found.len());
    if length < PROGRESS || !io::stderr().is_terminal() {
        return post.run_held(input, output);
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {bytes_per_sec}  {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(length).with_style(style);
    let result = post.run_held(Watched { input, bar: bar.clone() }, output);
    bar.finish_and_clear();
    result
}

/// An input that moves a progress bar.
struct Watched {
    input: File,
    bar: ProgressBar,
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.input.read(buffer)?;
        self.bar.inc(count as u64);
        Ok(count)
    }
}

impl Seek for Watched {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        let position = self.input.seek(to)?;
        self.bar.set_position(position);
        Ok(position)
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

/// Refuses an output that is one of the inputs, or the other output.
fn refuse_over_input(args: &PostArgs, inputs: &[PathBuf]) -> Result<(), Error> {
    let real = |path: &Path| path.canonicalize().ok().filter(|path| path.is_file());
    let mut taken: Vec<PathBuf> = inputs.iter().filter_map(|path| real(path)).collect();
    taken.extend(real(&args.cl));
    for path in args.output.iter().chain(&args.listing) {
        let file = real(path).unwrap_or_else(|| path.clone());
        if taken.contains(&file) {
            let message = format!("{} is read or written by this run already", path.display());
            return Err(Error::Run(Box::new(Diag::new(CommandCode::OverInput, message))));
        }
        if !is_device(path) {
            taken.push(file);
        }
    }
    Ok(())
}

fn is_device(path: &Path) -> bool {
    path.as_os_str() == "-" || path.metadata().is_ok_and(|found| !found.is_file())
}
