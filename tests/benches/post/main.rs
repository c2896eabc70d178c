//! Speed and memory of posting, file to file:
//! `cargo bench -p filpost-tests --bench post`.
//!
//! `FILPOST_BENCH_MB` sets the size of the CL file (200).

mod agree;
mod children;
mod cl_file;
mod handwritten;

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use filpost::files::post_file;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Lengths of the CL files, in percent of the longest.
const PERCENTS: [u64; 4] = [10, 25, 50, 100];

const POST: &str = "linuxcnc-mill";

/// Each way is timed this often, in turn; the best time counts.
const REPEATS: usize = 5;

/// Twenty operations on each GOTO, then the post's own work.
const SECTION: &str = "
LX=0
LY=0
LZ=0
PATH=0
COUNT=0
MINZ=0
MAXZ=0
SUMX=0
CIMFIL/ON,GOTO
XX=POSTF(7,6)
YY=POSTF(7,7)
ZZ=POSTF(7,8)
DX=XX-LX
DY=YY-LY
DZ=ZZ-LZ
DD=DX*DX+DY*DY+DZ*DZ
PATH=PATH+DD
COUNT=COUNT+1
IF(ZZ.LT.MINZ)MINZ=ZZ
IF(ZZ.GT.MAXZ)MAXZ=ZZ
SUMX=SUMX+XX*0.001
LX=XX
LY=YY
LZ=ZZ
DMY=POSTF(13)
CIMFIL/OFF
FINI
";

/// A CL file made for the bench.
struct ClFile {
    path: PathBuf,
    points: u64,
}

impl ClFile {
    /// Size in megabytes.
    fn megabytes(&self) -> io::Result<f64> {
        Ok(std::fs::metadata(&self.path)?.len() as f64 / 1e6)
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
    let megabytes = match std::env::var("FILPOST_BENCH_MB") {
        Ok(text) => text.parse()?,
        Err(_) => 200,
    };
    let mut files = Vec::new();
    for percent in PERCENTS {
        let path = folder.path().join(format!("part-{percent}.ncl"));
        let points = cl_file::write(&path, megabytes * 10_000 * percent)?;
        files.push(ClFile { path, points });
    }
    let (Some(small), Some(large)) = (files.first(), files.last()) else { return Ok(()) };
    println!("CL file of {megabytes} MB, {} GOTO; best of {REPEATS}\n", large.points);
    speed(large, folder.path())?;
    lengths(&files, folder.path())?;
    sections(small, folder.path())?;
    start_up(folder.path())
}

/// Posts a file with a FIL text or none; the time in seconds.
fn post(fil: Option<&str>, cl: &Path, nc: &Path) -> Outcome<f64> {
    let start = Instant::now();
    let mut builder = filpost::Post::builder().ready(POST);
    if let Some(fil) = fil {
        builder = builder.fil("bench.fil", fil);
    }
    let mut post = builder.build().map_err(|error| format!("{error:?}"))?;
    post_file(&mut post, cl, nc).map_err(|error| format!("{error:?}"))?;
    Ok(start.elapsed().as_secs_f64())
}

/// The hand-written translator, the post, and the post with a section.
fn speed(file: &ClFile, folder: &Path) -> Outcome<()> {
    let cl = &file.path;
    let [by_hand, plain, section]: [PathBuf; 3] =
        ["by_hand.ngc", "plain.ngc", "section.ngc"].map(|name| folder.join(name));
    let mut best = [f64::INFINITY; 3];
    for _ in 0..REPEATS {
        let start = Instant::now();
        handwritten::translate(cl, &by_hand)?;
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        best[1] = best[1].min(post(None, cl, &plain)?);
        best[2] = best[2].min(post(Some(SECTION), cl, &section)?);
    }
    let moves = agree::same_moves(&by_hand, &plain)?;
    agree::same_moves(&plain, &section)?;
    println!("The three programs agree in all {moves} moves.\n");
    println!("{:<34} {:>8} {:>8} {:>10}", "way", "seconds", "MB/s", "GOTO/s");
    let megabytes = file.megabytes()?;
    for (way, time) in
        ["written by hand", "filpost", "filpost, 20 operations a GOTO"].into_iter().zip(best)
    {
        let rate = file.points as f64 / time;
        println!("{way:<34} {time:>8.3} {:>8.0} {rate:>10.0}", megabytes / time);
    }
    println!();
    verdict("rate against the hand-written translator", best[0] / best[1], best[1] < 2.0 * best[0]);
    verdict("time with the section against without", best[2] / best[1], best[2] < 2.0 * best[1]);
    Ok(())
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
fn lengths(files: &[ClFile], folder: &Path) -> Outcome<()> {
    let nc = folder.join("lengths.ngc");
    let mut most = 0;
    println!(
        "\n{:<12} {:>8} {:>12} {:>16}",
        "CL file, MB", "seconds", "ns a GOTO", "peak memory, MiB"
    );
    for file in files {
        let time = best_time(None, &file.path, &nc)?;
        let peak = children::peak_memory(&file.path, &nc)?;
        let each = time * 1e9 / file.points as f64;
        let (megabytes, memory) = (file.megabytes()?, peak as f64 / 1024.0);
        println!("{megabytes:<12.0} {time:>8.3} {each:>12.0} {memory:>16.1}");
        most = most.max(peak);
    }
    if most == 0 {
        println!("peak memory: skipped, this system has no /proc/self/status");
        return Ok(());
    }
    verdict("peak memory in MiB, below 32", most as f64 / 1024.0, most < 32 * 1024);
    Ok(())
}

/// Time by the number of operations in the section.
fn sections(file: &ClFile, folder: &Path) -> Outcome<()> {
    let nc = folder.join("sections.ngc");
    let cl = &file.path;
    println!("\n{:<12} {:>8} {:>12}", "operations", "seconds", "ns a GOTO");
    for operations in [0, 10, 20, 40, 80, 160] {
        let time = best_time(Some(&section_of(operations)), cl, &nc)?;
        let each = time * 1e9 / file.points as f64;
        println!("{operations:<12} {time:>8.3} {each:>12.0}");
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

/// Start-up of the command.
fn start_up(folder: &Path) -> Outcome<()> {
    let Some(command) = children::command() else {
        println!("\nstart-up: skipped, `cargo build --release -p filpost-cli` makes the command");
        return Ok(());
    };
    let cl = folder.join("tiny.ncl");
    let nc = folder.join("tiny.ngc");
    std::fs::write(&cl, "PARTNO / 1\nFEDRAT / 100, MMPM\nGOTO / 1, 2, 3\nFINI\n")?;
    let names = [&cl, &nc].map(|path| path.display().to_string());
    let version = children::start_up(&command, &["--version"])?;
    let tiny = children::start_up(&command, &["post", &names[0], "-p", POST, "-o", &names[1]])?;
    println!();
    verdict("ms for `filpost --version`", version * 1e3, version < 0.020);
    verdict("ms for `filpost post` of three records", tiny * 1e3, tiny < 0.020);
    Ok(())
}

fn verdict(what: &str, value: f64, holds: bool) {
    println!("{what}: {value:.2}, {}", if holds { "holds" } else { "DOES NOT HOLD" });
}
