//! The FIL machine beside other languages, on one loop of ten million passes.
//!
//! The others are started as commands, which say when the loop starts and ends,
//! so that their start-up does not count and one clock times all.

use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::Outcome;
use crate::race::{self, Lap, Racer, Results};

/// Passes of the loop.
pub const PASSES: f64 = 1e7;
/// The language that is to be as fast as the others.
pub const FIL: &str = "FIL";
/// The interpreter that FIL is to be as fast as.
pub const LUA: &str = "Lua 5.4";
/// The interpreter that FIL is to come near to.
pub const LUAJIT: &str = "LuaJIT's interpreter";

const LOOP: &str = include_str!("loops/loop.fil");

/// The two numbers that a run ends with, and its time.
type Run = (Vec<f64>, f64);

/// Runs the loop in all languages and compares what they computed.
///
/// # Errors
/// A language fails, or its results are others.
pub fn run_all() -> Outcome<Results> {
    let script =
        |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/speed/loops").join(name);
    let (lua, python) = (script("loop.lua"), script("loop.py"));
    let (expected, _) = fil()?;
    race::race(vec![
        Racer::new(FIL, || checked(fil()?, &expected)),
        Racer::new(LUA, || other(Command::new("lua5.4").arg(&lua), &expected)),
        Racer::new(LUAJIT, || other(Command::new("luajit").arg("-joff").arg(&lua), &expected)),
        Racer::new("Rhai", || rhai(&expected)),
        Racer::new("Python", || other(Command::new("python3").arg(&python), &expected)),
    ])
}

/// The time of a run with the right results.
fn checked((results, seconds): Run, expected: &[f64]) -> Outcome<Lap> {
    if results != expected {
        return Err(format!("the results are {results:?}, not {expected:?}").into());
    }
    Ok(Lap::Seconds(seconds))
}

/// Runs the loop as the global area of a FIL file, and a record so that the
/// results come out.
fn fil() -> Outcome<Run> {
    let builder = filpost::Program::builder().generic("linuxcnc-mill").fil("loop.fil", LOOP);
    let post = builder.build().map_err(|error| format!("{error:?}"))?;
    let mut nc = Vec::new();
    let cl = "FROM / 0, 0, 0\nFINI\n";
    let start = Instant::now();
    post.stream(cl.as_bytes(), &mut nc).map_err(|error| format!("{error:?}"))?;
    let seconds = start.elapsed().as_secs_f64();
    let nc = String::from_utf8(nc)?;
    let comments = nc.lines().filter_map(|line| {
        let comment = line.split_once('(')?.1.split_once(')')?.0;
        comment.trim().parse().ok()
    });
    Ok((comments.collect(), seconds))
}

/// Runs the loop in another language.
fn other(command: &mut Command, expected: &[f64]) -> Outcome<Lap> {
    let mut child = match command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn() {
        Ok(child) => child,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(race::absent(command)),
        Err(error) => return Err(error.into()),
    };
    let mut lines = BufReader::new(child.stdout.take().ok_or("no output")?).lines();
    lines.next().transpose()?;
    let start = Instant::now();
    let results = lines.next().transpose()?.unwrap_or_default();
    let seconds = start.elapsed().as_secs_f64();
    if !child.wait()?.success() {
        return Err(format!("{command:?} failed").into());
    }
    let numbers: Result<_, _> = results.split_whitespace().map(str::parse).collect();
    checked((numbers?, seconds), expected)
}

/// Rhai is a library; a program outside of the workspace holds it.
fn rhai(expected: &[f64]) -> Outcome<Lap> {
    let built = std::env::var_os("FILPOST_RHAI").map(PathBuf::from);
    let program = built.filter(|program| program.is_file());
    match program {
        Some(program) => other(&mut Command::new(program), expected),
        None => Ok(Lap::Skipped("FILPOST_RHAI names no program (.ci/speed builds it)".to_string())),
    }
}
