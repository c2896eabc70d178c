//! How time and memory of posting grow: with the length of the CL file, with the
//! length of a section, with the number of sections; and the start of the command:
//! `cargo bench -p filpost-tests --bench growth`.
//!
//! `FILPOST_BENCH_MB` sets the size of the longest CL file (100). With
//! `-- --gigabyte` the peak memory on a CL file of 1 GB is measured too.

mod children;

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use filpost_tests::cl_file;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Lengths of the CL files, in percent of the longest.
const PERCENTS: [u64; 4] = [10, 25, 50, 100];

const POST: &str = "linuxcnc-mill";

/// The best of this many runs counts.
const REPEATS: usize = 5;

/// Peak memory that is promised, in KiB.
const MOST_MEMORY: u64 = 32 * 1024;

/// A CL file made for the bench.
struct ClFile {
    path: PathBuf,
    points: u64,
}

impl ClFile {
    fn new(folder: &Path, megabytes: u64) -> io::Result<Self> {
        let path = folder.join(format!("part-{megabytes}.ncl"));
        let points = cl_file::write(&path, megabytes * 1_000_000)?;
        Ok(ClFile { path, points })
    }

    /// Size in megabytes.
    fn megabytes(&self) -> io::Result<f64> {
        Ok(std::fs::metadata(&self.path)?.len() as f64 / 1e6)
    }

    /// Nanoseconds a GOTO.
    fn each(&self, seconds: f64) -> f64 {
        seconds * 1e9 / self.points as f64
    }
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, run, cl, nc] = arguments.as_slice()
        && run == children::MEMORY_RUN
    {
        post(None, Path::new(cl), Path::new(nc))?;
        println!("{}", children::own_peak().unwrap_or_default());
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    let megabytes: u64 = match std::env::var("FILPOST_BENCH_MB") {
        Ok(text) => text.parse()?,
        Err(_) => 100,
    };
    lengths(folder, megabytes)?;
    let small = ClFile::new(folder, megabytes.div_ceil(10))?;
    operations(&small, folder)?;
    sections(&small, folder)?;
    start_up(folder)?;
    if arguments.iter().any(|argument| argument == "--gigabyte") {
        gigabyte(folder)?;
    }
    Ok(())
}

/// Posts a file with a FIL text or none; the time in seconds.
fn post(fil: Option<&str>, cl: &Path, nc: &Path) -> Outcome<f64> {
    let start = Instant::now();
    let mut builder = filpost::Program::builder().generic(POST);
    if let Some(fil) = fil {
        builder = builder.fil("bench.fil", fil);
    }
    let post = builder.build().map_err(|error| format!("{error:?}"))?;
    post.post_files(cl, nc).map_err(|error| format!("{error:?}"))?;
    Ok(start.elapsed().as_secs_f64())
}

/// Best time of posting a file, in seconds.
fn best_time(fil: Option<&str>, cl: &Path, nc: &Path) -> Outcome<f64> {
    let mut best = f64::INFINITY;
    for _ in 0..REPEATS {
        best = best.min(post(fil, cl, nc)?);
    }
    Ok(best)
}

/// Time and peak memory by the length of the file.
fn lengths(folder: &Path, megabytes: u64) -> Outcome<()> {
    let nc = folder.join("lengths.ngc");
    let mut most = 0;
    println!(
        "{:<12} {:>8} {:>10} {:>17}",
        "CL file, MB", "seconds", "ns a GOTO", "peak memory, MiB"
    );
    for percent in PERCENTS {
        let file = ClFile::new(folder, (megabytes * percent).div_ceil(100))?;
        let time = best_time(None, &file.path, &nc)?;
        let peak = children::peak_memory(&file.path, &nc)?;
        let (megabytes, memory) = (file.megabytes()?, peak as f64 / 1024.0);
        println!("{megabytes:<12.0} {time:>8.3} {:>10.0} {memory:>17.1}", file.each(time));
        most = most.max(peak);
        std::fs::remove_file(&file.path)?;
    }
    memory_verdict("the library", most);
    Ok(())
}

fn memory_verdict(program: &str, peak: u64) {
    if peak == 0 {
        println!("peak memory of {program}: skipped, this system has no /proc");
    } else {
        let what = format!("peak memory of {program} in MiB, below 32");
        verdict(&what, peak as f64 / 1024.0, peak < MOST_MEMORY);
    }
}

/// Time by the number of operations in the section.
fn operations(file: &ClFile, folder: &Path) -> Outcome<()> {
    let nc = folder.join("operations.ngc");
    println!("\n{:<12} {:>8} {:>10}", "operations", "seconds", "ns a GOTO");
    for operations in [0, 10, 20, 40, 80, 160] {
        let time = best_time(Some(&section_of(operations)), &file.path, &nc)?;
        println!("{operations:<12} {time:>8.3} {:>10.0}", file.each(time));
    }
    Ok(())
}

/// A section of that many additions, and POSTF(13).
fn section_of(operations: usize) -> String {
    let mut fil = String::from("SUM=0\nCIMFIL/ON,GOTO\n");
    for operation in 1..=operations {
        let _ = writeln!(fil, "SUM=SUM+{operation}");
    }
    fil + "DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"
}

/// Time by the number of sections, of which one takes the GOTO records.
fn sections(file: &ClFile, folder: &Path) -> Outcome<()> {
    let nc = folder.join("sections.ngc");
    println!("\n{:<12} {:>8} {:>10}", "sections", "seconds", "ns a GOTO");
    for sections in [0, 1, 10, 100, 1000] {
        let fil = (sections > 0).then(|| many_sections(sections));
        let time = best_time(fil.as_deref(), &file.path, &nc)?;
        println!("{sections:<12} {time:>8.3} {:>10.0}", file.each(time));
    }
    Ok(())
}

/// Sections by type and subtype, none of which is a GOTO's, and the last by
/// type 5000, which all GOTO records are of: the longest search there is.
fn many_sections(sections: usize) -> String {
    let mut fil = String::new();
    for subtype in 1..sections {
        let allowed = "$$ filpost: allow E0228";
        let _ = write!(fil, "CIMFIL/ON,2000,{subtype} {allowed}\nDMY=POSTF(13)\nCIMFIL/OFF\n");
    }
    fil + "CIMFIL/ON,5000\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"
}

/// Start-up of the command.
fn start_up(folder: &Path) -> Outcome<()> {
    let Some(command) = children::command() else {
        println!(
            "\nstart-up: skipped, `cargo build --profile dist -p filpost-cli` makes the command"
        );
        return Ok(());
    };
    let cl = folder.join("tiny.ncl");
    let nc = folder.join("tiny.ngc");
    std::fs::write(&cl, "PARTNO / 1\nUNITS / MM\nFEDRAT / 100, MMPM\nGOTO / 1, 2, 3\nFINI\n")?;
    let names = [&cl, &nc].map(|path| path.display().to_string());
    let version = children::start_up(&command, &["--version"])?;
    let tiny = children::start_up(&command, &["post", &names[0], "-p", POST, "-o", &names[1]])?;
    println!();
    verdict("ms for `filpost --version`, below 20", version * 1e3, version < 0.020);
    verdict("ms for `filpost post` of four records, below 20", tiny * 1e3, tiny < 0.020);
    Ok(())
}

/// Peak memory on a file of 1 GB, of the library and of the command.
fn gigabyte(folder: &Path) -> Outcome<()> {
    let file = ClFile::new(folder, 1000)?;
    let nc = folder.join("gigabyte.ngc");
    println!("\nCL file of {:.0} MB, {} GOTO", file.megabytes()?, file.points);
    memory_verdict("the library", children::peak_memory(&file.path, &nc)?);
    if let Some(command) = children::command() {
        let names = [&file.path, &nc].map(|path| path.display().to_string());
        let arguments = ["post", &names[0], "-p", POST, "-o", &names[1]];
        memory_verdict("the command", children::peak_of_command(&command, &arguments)?);
    }
    Ok(())
}

fn verdict(what: &str, value: f64, holds: bool) {
    println!("{what}: {value:.2}, {}", if holds { "holds" } else { "DOES NOT HOLD" });
}
