//! How time and memory of what reads long programs grow, as the command does it from file
//! to file: `cargo bench -p filpost-tests --bench large`.
//!
//! CL files of 10 and of 100 MB; with `-- --gigabyte` one of 1 GB too, which needs 4 GB
//! in the folder for temporary files. What is promised is promised of 1.5 million blocks.
//! Pages of a plot are opened in chromium, where it is there. At the end the table of
//! `docs/performance.md` is printed as it stands there.

mod page;
mod programs;
mod run;
mod table;

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use filpost_tests::cl_file;
use run::Run;
use table::Table;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Blocks of the program of which limits are promised.
const BLOCKS: f64 = 1.5e6;

/// Seconds that no run needs to be shorter than.
const START: f64 = 0.05;

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
    let Some(command) = run::command() else {
        println!("skipped: `cargo build --profile dist -p filpost-cli` makes the command");
        return Ok(());
    };
    let folder = tempfile::tempdir()?;
    let mut sizes = vec![10, 100];
    if std::env::args().any(|argument| argument == "--gigabyte") {
        sizes.push(1000);
    }
    println!("{:<8} {:>10} {:<26} {:>8} {:>6}", "CL, MB", "blocks", "run", "seconds", "MiB");
    let mut table = Table::default();
    for megabytes in sizes {
        size(&command, folder.path(), megabytes, &mut table)?;
    }
    print!("\n{table}");
    Ok(())
}

fn size(command: &Path, folder: &Path, megabytes: u64, table: &mut Table) -> Outcome<()> {
    let paths = ["part.ncl", "out.nc", "same.nc", "edited.nc", "moved.nc", "out.html", "out.lst"];
    let paths = paths.map(|name| folder.join(name));
    let [cl, nc, same, edited, moved, html, _] = &paths;
    cl_file::write(cl, megabytes * 1_000_000)?;
    let names = paths.each_ref().map(|path| path.display().to_string());
    let names = names.each_ref().map(String::as_str);
    let post = vec!["post", names[0], "-p", "linuxcnc-mill", "-o", names[1]];
    let plain = run::best(command, &post)?;
    let mapped = run::best(command, &[&post[..], &["--map"]].concat())?;
    let blocks = BufReader::new(File::open(nc)?).lines().count();
    table.size(megabytes, blocks);
    let memory = Some(32.0);
    for (name, ran) in [("post", &plain), ("post --map", &mapped)] {
        let job = Job { name, arguments: Vec::new(), seconds: None, memory };
        report(megabytes, blocks, &job, ran);
        table.ran(name, ran);
    }
    std::fs::copy(nc, same)?;
    programs::edit(nc, edited, blocks)?;
    programs::shift(nc, moved, blocks)?;
    let late = blocks * 9 / 10;
    let asked = [format!("{}:{late}", names[1]), format!("{}:{late}", names[0])];
    let share = blocks as f64 / BLOCKS;
    for mut job in jobs(&names, &asked, plain.seconds / share) {
        if job.name == "plot --cl" && share > page::MOST {
            continue;
        }
        // What a run reads is what it takes time for; a start takes its time too.
        job.seconds = job.seconds.map(|seconds| (seconds * share).max(START));
        job.memory = job.memory.map(|memory| memory * share.max(1.0));
        let ran = run::best(command, &job.arguments)?;
        report(megabytes, blocks, &job, &ran);
        table.ran(job.name, &ran);
        if job.name.starts_with("plot") {
            page::report(html, share)?;
            table.page(job.name, std::fs::metadata(html)?.len());
        }
    }
    paths.iter().try_for_each(std::fs::remove_file)?;
    Ok(())
}

/// What is run on the files of these names: CL file, program, the same program, an edited one,
/// one with blocks moved, the page, the listing. `asked` are a line of the program and one of the CL file,
/// `post` the seconds of posting 1.5 million blocks.
fn jobs<'n>(names: &[&'n str; 7], asked: &'n [String; 2], post: f64) -> Vec<Job<'n>> {
    let [cl, nc, same, edited, moved, html, listing] = *names;
    let machine = ["-p", "linuxcnc-mill"];
    let job = |name, arguments: &[&'n str], seconds, memory| Job {
        name,
        arguments: [arguments, &machine[..]].concat(),
        seconds,
        memory,
    };
    let plain = |name, arguments: &[&'n str], seconds, memory| Job {
        name,
        arguments: arguments.to_vec(),
        seconds,
        memory,
    };
    vec![
        plain("diff, equal", &["diff", nc, same], Some(2.0), Some(64.0)),
        plain("diff, ten edits", &["diff", nc, edited], Some(4.0), Some(256.0)),
        plain("diff, 1,000 blocks moved", &["diff", nc, moved], Some(4.0), Some(256.0)),
        plain("trace, a block", &["trace", &asked[0]], Some(0.1), None),
        plain("trace, a record", &["trace", &asked[1]], None, None),
        job("verify", &["verify", cl, nc], Some(3.0 * post), Some(64.0)),
        job(
            "post --listing",
            &["post", cl, "-o", same, "--listing", listing],
            Some(3.0 * post),
            Some(32.0),
        ),
        job("plot", &["plot", nc, "-o", html], Some(6.0 * post), Some(128.0)),
        job("plot --cl", &["plot", nc, "--cl", cl, "-o", html], None, None),
    ]
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
