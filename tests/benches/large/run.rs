//! The command run, with what it took.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::Outcome;

/// Runs of a job of which the best counts; one that takes longer than [`LONG`] runs once.
const RUNS: usize = 3;

/// Seconds.
const LONG: f64 = 20.0;

/// What a run took.
#[derive(Clone, Copy)]
pub struct Run {
    pub seconds: f64,
    /// Peak memory, MiB; 0 where the system does not tell.
    pub memory: f64,
}

/// The best of several runs of the command.
pub fn best(command: &std::path::Path, arguments: &[&str]) -> Outcome<Run> {
    let mut best = once(command, arguments)?;
    for _ in 1..RUNS {
        if best.seconds > LONG {
            break;
        }
        let next = once(command, arguments)?;
        best.seconds = best.seconds.min(next.seconds);
        best.memory = best.memory.max(next.memory);
    }
    Ok(best)
}

/// Runs the command; a difference that is found is no failure, a run that is refused is one.
pub fn once(command: &std::path::Path, arguments: &[&str]) -> Outcome<Run> {
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
            Some(status) if status.success() => break,
            Some(status) if arguments[0] == "diff" && status.code() == Some(1) => break,
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
pub fn command() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let name = format!("filpost{}", std::env::consts::EXE_SUFFIX);
    let path = own.parent()?.parent()?.join(name);
    path.exists().then_some(path)
}
