//! What rotary axes cost beside three axes, a GOTO of the CL file: four and five axes, with
//! and without the division of motions that turn the machine, and under tool-tip control:
//! `cargo bench -p filpost-tests --bench axes`.
//!
//! `FILPOST_BENCH_POINTS` sets the number of points of each CL file (200,000). With
//! `FILPOST_BENCH_ROW` only the row of that name is run, once, for a counter of instructions.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// The best of this many runs counts.
const REPEATS: usize = 5;

/// Points of each CL file.
const POINTS: u32 = 200_000;

/// Radius of the cylinder and of the cone that the points lie on, mm.
const RADIUS: f64 = 30.0;

/// A machine and what its part asks for.
struct Row {
    name: &'static str,
    post: &'static str,
    settings: &'static [&'static str],
    /// Point and tool axis number `n`.
    target: fn(u32) -> [f64; 6],
}

const UNDIVIDED: &[&str] = &["rotary.tolerance=0"];

const ROWS: &[Row] = &[
    Row { name: "three axes", post: "fanuc-mill", settings: &[], target: flat },
    Row { name: "four axes, undivided", post: "fanuc-mill-a", settings: UNDIVIDED, target: round },
    Row { name: "four axes", post: "fanuc-mill-a", settings: &[], target: round },
    Row { name: "five axes, undivided", post: "haas-trunnion", settings: UNDIVIDED, target: cone },
    Row { name: "five axes", post: "haas-trunnion", settings: &[], target: cone },
    Row { name: "five axes, divided", post: "haas-trunnion", settings: &[], target: coarse_cone },
    Row { name: "five axes, G43.4", post: "fanuc-5x-tables", settings: &[], target: cone },
];

fn main() -> Outcome<()> {
    let points = match std::env::var("FILPOST_BENCH_POINTS") {
        Ok(text) => text.parse()?,
        Err(_) => POINTS,
    };
    let folder = tempfile::tempdir()?;
    println!("| of what | ns a GOTO | times three axes | blocks a GOTO |\n|---|---|---|---|");
    let mut three = None;
    let mut four = None;
    let only = std::env::var("FILPOST_BENCH_ROW").ok();
    let repeats = if only.is_none() { REPEATS } else { 1 };
    for row in ROWS.iter().filter(|row| only.as_ref().is_none_or(|name| name == row.name)) {
        let cl = folder.path().join("part.ncl");
        fs::write(&cl, part(row, points)?)?;
        let (each, blocks) = post(row, (points, repeats), &cl)?;
        let times = each / *three.get_or_insert(each);
        if row.name == "four axes, undivided" {
            four = Some(times);
        }
        println!("| {} | {each:.0} | {times:.2} | {blocks:.2} |", row.name);
    }
    if let (Some(times), None) = (four, only) {
        let verdict = if times <= 2.0 { "holds" } else { "FAILS" };
        println!("\nfour axes at no less than half the rate of three, block for block: {verdict}");
    }
    Ok(())
}

/// Nanoseconds and blocks a GOTO, the best of several runs.
fn post(row: &Row, (points, repeats): (u32, usize), cl: &Path) -> Outcome<(f64, f64)> {
    let mut builder = filpost::Program::builder().generic(row.post);
    for setting in row.settings {
        builder = builder.set(setting);
    }
    let program = builder.build().map_err(|error| format!("{}: {error:?}", row.name))?;
    let nc = cl.with_extension("nc");
    let mut best = f64::INFINITY;
    for _ in 0..repeats {
        let start = Instant::now();
        program.post_files(cl, &nc).map_err(|error| format!("{}: {error:?}", row.name))?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    let blocks = fs::read(&nc)?.iter().filter(|byte| **byte == b'\n').count();
    Ok((best * 1e9 / f64::from(points), blocks as f64 / f64::from(points)))
}

fn part(row: &Row, points: u32) -> Outcome<String> {
    let mut text = String::from(
        "PARTNO / AXES\nUNITS / MM\nMULTAX / ON\nLOADTL / 1\nSPINDL / RPM, 8000.0, CLW\n\
         FEDRAT / 1200.0, MMPM\n",
    );
    for n in 0..points {
        let target = (row.target)(n);
        let values = target.map(|value| format!("{value:.9}")).join(", ");
        writeln!(text, "{}GOTO / {values}", if n == 0 { "RAPID\n" } else { "" })?;
    }
    text.push_str("FINI\n");
    Ok(text)
}

/// Rows of points in which X, Y and Z change.
fn flat(n: u32) -> [f64; 6] {
    let (x, y) = (f64::from(n % 60) * 0.731, f64::from(n / 60 % 900) * 0.25);
    [x, y, 8.0 * (x * 0.05).sin() * (y * 0.07).cos() - 10.0, 0.0, 0.0, 1.0]
}

/// To and fro over a half cylinder about X, half a degree a step.
fn round(n: u32) -> [f64; 6] {
    let (step, row) = (n % 360, n / 360);
    let angle = f64::from(if row % 2 == 0 { step } else { 359 - step }) * 0.5 - 90.0;
    let (sine, cosine) = angle.to_radians().sin_cos();
    let wave = RADIUS + (f64::from(n) * 0.05).sin();
    [f64::from(row % 500) * 0.1, wave * sine, wave * cosine, 0.0, sine, cosine]
}

/// To and fro round a cone with the tool leaning 20 degrees outward, half a degree a step.
fn cone(n: u32) -> [f64; 6] {
    on_cone(n, 720)
}

/// The same with six degrees a step, in which the tip leaves its line.
fn coarse_cone(n: u32) -> [f64; 6] {
    on_cone(n, 60)
}

fn on_cone(n: u32, steps: u32) -> [f64; 6] {
    let (step, row) = (n % steps, n / steps);
    let share = f64::from(if row % 2 == 0 { step } else { steps - 1 - step }) / f64::from(steps);
    let angle = 360.0 * share;
    let (sine, cosine) = angle.to_radians().sin_cos();
    let (lean, up) = 20f64.to_radians().sin_cos();
    let wave = RADIUS + (f64::from(n) * 0.05).sin();
    [wave * cosine, wave * sine, f64::from(row % 500) * -0.1, lean * cosine, lean * sine, up]
}
