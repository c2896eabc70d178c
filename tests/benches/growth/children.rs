//! Runs in processes of their own: peak memory and start-up time.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Tells this program, started again, to post a file and show its peak memory.
pub const MEMORY_RUN: &str = "--memory-run";

/// Runs of the command, for the mean of its start-up time.
const STARTS: u32 = 20;

/// Peak memory in KiB of a process that posts a file.
///
/// # Errors
/// The process can't be run, or it failed.
pub fn peak_memory(cl: &Path, nc: &Path) -> io::Result<u64> {
    let program = std::env::current_exe()?;
    let output = Command::new(program).arg(MEMORY_RUN).arg(cl).arg(nc).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let peak = text.trim().parse();
    peak.map_err(|_| io::Error::other(String::from_utf8_lossy(&output.stderr).into_owned()))
}

/// Peak memory of this process in KiB; `None` where the system does not tell.
pub fn own_peak() -> Option<u64> {
    peak_of("self")
}

/// Peak memory in KiB of a run of the command. It is asked again and again while
/// the command runs; 0 where the system does not tell.
///
/// # Errors
/// The command can't be run, or it failed.
pub fn peak_of_command(command: &Path, arguments: &[&str]) -> io::Result<u64> {
    let mut run = Command::new(command);
    run.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = run.spawn()?;
    let id = child.id().to_string();
    let mut peak = 0;
    loop {
        peak = peak_of(&id).unwrap_or(0).max(peak);
        match child.try_wait()? {
            None => std::thread::sleep(Duration::from_millis(10)),
            Some(status) if status.success() => return Ok(peak),
            Some(status) => return Err(io::Error::other(format!("filpost ended with {status}"))),
        }
    }
}

fn peak_of(process: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

/// The `filpost` command of the same build, when it has been built.
pub fn command() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let name = format!("filpost{}", std::env::consts::EXE_SUFFIX);
    let path = own.parent()?.parent()?.join(name);
    path.exists().then_some(path)
}

/// Mean seconds from start to end of the command.
///
/// # Errors
/// The command can't be run, or it failed.
pub fn start_up(command: &Path, arguments: &[&str]) -> io::Result<f64> {
    let start = Instant::now();
    for _ in 0..STARTS {
        let mut run = Command::new(command);
        run.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        if !run.status()?.success() {
            return Err(io::Error::other(format!("filpost {} failed", arguments.join(" "))));
        }
    }
    Ok(start.elapsed().as_secs_f64() / f64::from(STARTS))
}
