//! How time and memory of what reads long programs grow, as the command does it from file
//! to file: `cargo bench -p filpost-tests --bench large`.
//!
//! CL files of 10 and of 100 MB; with `-- --gigabyte` one of 1 GB too, which needs 3 GB
//! in the folder for temporary files. What is promised is promised of 1.5 million blocks.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use filpost_tests::cl_file;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Blocks of the program of which limits are promised.
const BLOCKS: f64 = 1.5e6;

/// Blocks that are moved from one place of a program to another.
const MOVED: usize = 1000;

/// Places at which a block is changed.
const EDITS: usize = 10;

/// What a run took.
struct Run {
    seconds: f64,
    /// Peak memory, MiB; 0 where the system does not tell.
    memory: f64,
}

/// A command with what is promised of it at 1.5 million blocks.
struct Job<'n> {
    name: &'static str,
    arguments: Vec<&'n str>,
    /// Most seconds.
    seconds: Option<f64>,
    /// Most MiB.
    memory: Option<f64>,
}

fn main() -> Outcome<()> {
    let Some(command) = command() else {
        println!("skipped: `cargo build --profile dist -p filpost-cli` makes the command");
        return Ok(());
    };
    let folder = tempfile::tempdir()?;
    let mut sizes = vec![10, 100];
    if std::env::args().any(|argument| argument == "--gigabyte") {
        sizes.push(1000);
    }
    println!("{:<8} {:>10} {:<26} {:>8} {:>6}", "CL, MB", "blocks", "run", "seconds", "MiB");
    for megabytes in sizes {
        size(&command, folder.path(), megabytes)?;
    }
    Ok(())
}

fn size(command: &Path, folder: &Path, megabytes: u64) -> Outcome<()> {
    let paths = ["part.ncl", "out.nc", "same.nc", "edited.nc", "moved.nc", "out.html"];
    let paths = paths.map(|name| folder.join(name));
    let [cl, nc, same, edited, moved, page] = &paths;
    cl_file::write(cl, megabytes * 1_000_000)?;
    let names = paths.each_ref().map(|path| path.display().to_string());
    let names = names.each_ref().map(String::as_str);
    let post = Job {
        name: "post --map",
        arguments: vec!["post", names[0], "-p", "linuxcnc-mill", "-o", names[1], "--map"],
        seconds: None,
        memory: Some(32.0),
    };
    let posted = run(command, &post.arguments)?;
    let blocks = BufReader::new(File::open(nc)?).lines().count();
    let share = blocks as f64 / BLOCKS;
    report(megabytes, blocks, &post, &posted);
    std::fs::copy(nc, same)?;
    edit(nc, edited, blocks)?;
    shift(nc, moved, blocks)?;
    let last = format!("{}:{}", names[1], blocks * 9 / 10);
    let of_cl = format!("{}:{}", names[0], blocks * 9 / 10);
    let machine = ["-p", "linuxcnc-mill"];
    let jobs = [
        Job {
            name: "diff, equal",
            arguments: vec!["diff", names[1], names[2]],
            seconds: Some(2.0),
            memory: Some(64.0),
        },
        Job {
            name: "diff, ten edits",
            arguments: vec!["diff", names[1], names[3]],
            seconds: Some(4.0),
            memory: Some(256.0),
        },
        Job {
            name: "diff, 1,000 blocks moved",
            arguments: vec!["diff", names[1], names[4]],
            seconds: Some(4.0),
            memory: Some(256.0),
        },
        Job {
            name: "trace, a block",
            arguments: vec!["trace", &last],
            seconds: Some(0.1),
            memory: None,
        },
        Job {
            name: "trace, a record",
            arguments: vec!["trace", &of_cl],
            seconds: None,
            memory: None,
        },
        Job {
            name: "verify",
            arguments: vec!["verify", names[0], names[1], machine[0], machine[1]],
            seconds: None,
            memory: None,
        },
        Job {
            name: "plot",
            arguments: vec!["plot", names[1], machine[0], machine[1], "-o", names[5]],
            seconds: None,
            memory: None,
        },
    ];
    for mut job in jobs {
        // What a run reads is what it takes time for.
        job.seconds = job.seconds.map(|seconds| seconds * share.max(0.1));
        job.memory = job.memory.map(|memory| memory * share.max(1.0));
        let ran = run(command, &job.arguments)?;
        report(megabytes, blocks, &job, &ran);
    }
    let page = std::fs::metadata(page)?.len() as f64 / 1e6;
    println!("         page of the plot: {page:.1} MB");
    paths.iter().try_for_each(std::fs::remove_file)?;
    Ok(())
}

fn report(megabytes: u64, blocks: usize, job: &Job<'_>, ran: &Run) {
    let mut verdicts = Vec::new();
    if let Some(most) = job.seconds {
        verdicts.push(format!("at most {most:.2} s {}", word(ran.seconds <= most)));
    }
    if let Some(most) = job.memory {
        verdicts.push(format!("at most {most:.0} MiB {}", word(ran.memory <= most)));
    }
    println!(
        "{megabytes:<8} {blocks:>10} {:<26} {:>8.3} {:>6.0}  {}",
        job.name,
        ran.seconds,
        ran.memory,
        verdicts.join(", ")
    );
}

fn word(holds: bool) -> &'static str {
    if holds { "holds" } else { "DOES NOT HOLD" }
}

/// Changes a block in ten places; the others stay letter by letter.
fn edit(nc: &Path, edited: &Path, blocks: usize) -> io::Result<()> {
    let mut output = BufWriter::new(File::create(edited)?);
    for (number, line) in BufReader::new(File::open(nc)?).lines().enumerate() {
        let line = line?;
        match number % (blocks / EDITS) == blocks / EDITS / 2 {
            true => writeln!(output, "{line} M8")?,
            false => writeln!(output, "{line}")?,
        }
    }
    output.flush()
}

/// Moves blocks from the first fifth of a program to the last.
fn shift(nc: &Path, moved: &Path, blocks: usize) -> io::Result<()> {
    let mut output = BufWriter::new(File::create(moved)?);
    let (from, to) = (blocks / 5, blocks / 5 * 4);
    let mut held = Vec::with_capacity(MOVED);
    for (number, line) in BufReader::new(File::open(nc)?).lines().enumerate() {
        let line = line?;
        if (from..from + MOVED).contains(&number) {
            held.push(line);
            continue;
        }
        writeln!(output, "{line}")?;
        if number == to {
            held.iter().try_for_each(|line| writeln!(output, "{line}"))?;
        }
    }
    output.flush()
}

/// Runs the command; a difference that is found is no failure.
fn run(command: &Path, arguments: &[&str]) -> Outcome<Run> {
    let start = Instant::now();
    let mut run = Command::new(command);
    run.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = run.spawn()?;
    let id = child.id().to_string();
    let mut memory = 0.0f64;
    loop {
        memory = memory.max(peak(&id).unwrap_or_default());
        match child.try_wait()? {
            None => std::thread::sleep(Duration::from_millis(2)),
            Some(status) if matches!(status.code(), Some(0 | 1)) => break,
            Some(status) => return Err(format!("filpost {arguments:?} ended with {status}").into()),
        }
    }
    Ok(Run { seconds: start.elapsed().as_secs_f64(), memory })
}

/// Peak memory of a process so far, MiB.
fn peak(process: &str) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}

/// The `filpost` command of the same build, when it has been built.
fn command() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let name = format!("filpost{}", std::env::consts::EXE_SUFFIX);
    let path = own.parent()?.parent()?.join(name);
    path.exists().then_some(path)
}
