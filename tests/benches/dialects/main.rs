//! How fast the texts of each dialect are read, beside those of Creo:
//! `cargo bench -p filpost-tests --bench dialects`.
//!
//! Two rates count: that of numbers, because a line of one system holds three and of another
//! six, and that of lines.
//!
//! `FILPOST_BENCH_MB` sets the size of the texts in megabytes of 30 bytes a line (50).

#[path = "../growth/children.rs"]
#[allow(dead_code, reason = "shared with another bench, which starts commands, too")]
mod children;
#[path = "../../../crates/fil-cl/examples/read_cl/dialect_text.rs"]
mod dialect_text;

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use filpost::cl::reader::{Options, Reader};
use filpost::cl::{ClDialect, Record, Vocabulary};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The dialects whose texts are measured.
const DIALECTS: [ClDialect; 8] = [
    ClDialect::Creo,
    ClDialect::Generic,
    ClDialect::Nx,
    ClDialect::Catia,
    ClDialect::SolidWorksCam,
    ClDialect::CamWorks,
    ClDialect::Ffcam,
    ClDialect::Ncl,
];

/// The best of this many runs counts.
const REPEATS: usize = 5;

/// Bytes of a line, about.
const LINE: u64 = 30;

/// Part of Creo's rate, in numbers and in lines, that each dialect must have.
const LEAST: f64 = 0.5;

/// Peak memory may grow by this many KiB from a tenth of the text to all of it.
const MOST_GROWTH: u64 = 512;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, run, cl, _] = arguments.as_slice()
        && run == children::MEMORY_RUN
    {
        read(Path::new(cl))?;
        println!("{}", children::own_peak().unwrap_or_default());
        return Ok(());
    }
    let megabytes: u64 =
        std::env::var("FILPOST_BENCH_MB").ok().and_then(|text| text.parse().ok()).unwrap_or(50);
    let lines = megabytes * 1_000_000 / LINE;
    let folder = tempfile::tempdir()?;
    println!(
        "| dialect | M numbers a second | of Creo's | M lines a second | of Creo's | peak memory, MiB | \
         verdict |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut good = true;
    for dialect in DIALECTS {
        // Each time anew, so that both are measured on the same machine at the same hour.
        let creo = measure(folder.path(), ClDialect::Creo, lines)?;
        let found = match dialect {
            ClDialect::Creo => creo,
            other => measure(folder.path(), other, lines)?,
        };
        let ratio = found.rate / creo.rate;
        let flat = found.peaks[1] <= found.peaks[0] + MOST_GROWTH;
        let by_lines = found.lines / creo.lines;
        let kept = ratio.min(by_lines) >= LEAST && flat;
        good &= kept;
        println!(
            "| {dialect} | {:.1} | {ratio:.2} | {:.1} | {by_lines:.2} | {:.1} | {} |",
            found.rate / 1e6,
            found.lines / 1e6,
            found.peaks[1] as f64 / 1024.0,
            if kept { "kept" } else { "BROKEN" },
        );
    }
    if good { Ok(()) } else { Err("a dialect is read too slowly, or its memory grows".into()) }
}

/// What reading a dialect takes.
#[derive(Clone, Copy)]
struct Found {
    /// Numbers a second.
    rate: f64,
    /// Lines a second.
    lines: f64,
    /// Peak memory in KiB for a tenth of the text and for all of it.
    peaks: [u64; 2],
}

fn measure(folder: &Path, dialect: ClDialect, lines: u64) -> Outcome<Found> {
    let (short, _) = make(folder, dialect, lines / 10)?;
    let (long, count) = make(folder, dialect, lines)?;
    let mut best = f64::MAX;
    for _ in 0..REPEATS {
        let start = Instant::now();
        read(&long)?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    let peaks = [children::peak_memory(&short, &short)?, children::peak_memory(&long, &long)?];
    let numbers = numbers(&std::fs::read(&long)?);
    std::fs::remove_file(long)?;
    Ok(Found { rate: numbers as f64 / best, lines: count as f64 / best, peaks })
}

/// How many numbers a text holds.
fn numbers(text: &[u8]) -> usize {
    let goes_on = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'_');
    let first = usize::from(text.first().is_some_and(u8::is_ascii_digit));
    first + text.windows(2).filter(|pair| !goes_on(pair[0]) && pair[1].is_ascii_digit()).count()
}

fn make(folder: &Path, dialect: ClDialect, lines: u64) -> Outcome<(PathBuf, u64)> {
    let path = folder.join(format!("{dialect}-{lines}.cl"));
    let mut output = BufWriter::new(File::create(&path)?);
    let count = dialect_text::write(dialect, lines, &mut output)?;
    output.flush()?;
    Ok((path, count))
}

/// Reads a text to its end, by the dialect that it is recognized as.
fn read(path: &Path) -> Outcome<()> {
    let name = path.display().to_string();
    let mut reader = Reader::new(File::open(path)?, &name, Options::default());
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocabulary, &mut record)? {}
    let found = reader.recognized().dialect;
    if !name.contains(found.name()) {
        return Err(format!("{name} was read as {found}").into());
    }
    Ok(())
}
