//! Programs that do the same job, timed in turn.

use std::process::{Command, Stdio};
use std::time::Instant;

use crate::Outcome;

/// Each program runs this often, in turn; the best time counts.
const REPEATS: usize = 5;

/// A program that takes longer than this many seconds runs once.
const LONG: f64 = 2.0;

/// How one program did.
#[derive(Clone, Debug)]
pub enum Lap {
    /// Its time.
    Seconds(f64),
    /// Why it did not run.
    Skipped(String),
}

impl Lap {
    /// The time, where there is one.
    pub fn seconds(&self) -> Option<f64> {
        match self {
            Lap::Seconds(seconds) => Some(*seconds),
            Lap::Skipped(_) => None,
        }
    }
}

/// One of the programs.
pub struct Racer<'a> {
    /// Its name in the table.
    pub name: &'static str,
    run: Box<dyn FnMut() -> Outcome<Lap> + 'a>,
    best: Option<Lap>,
}

impl<'a> Racer<'a> {
    /// A program by what runs it once.
    pub fn new(name: &'static str, run: impl FnMut() -> Outcome<Lap> + 'a) -> Self {
        Racer { name, run: Box::new(run), best: None }
    }

    /// True when another run can tell more.
    fn runs_again(&self) -> bool {
        match self.best {
            None => true,
            Some(Lap::Seconds(seconds)) => seconds < LONG,
            Some(Lap::Skipped(_)) => false,
        }
    }

    fn run(&mut self) -> Outcome<()> {
        let lap = (self.run)().map_err(|error| format!("{}: {error}", self.name))?;
        let known = self.best.as_ref().and_then(Lap::seconds).unwrap_or(f64::INFINITY);
        if lap.seconds().is_none_or(|seconds| seconds < known) {
            self.best = Some(lap);
        }
        Ok(())
    }
}

/// The best time of each program of a job, the measure first.
pub struct Results(Vec<(&'static str, Lap)>);

impl Results {
    /// The time of a program, where it ran.
    pub fn seconds(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(other, _)| *other == name)?.1.seconds()
    }

    /// Names of the programs that ran and start with `prefix`.
    pub fn ran<'a>(&'a self, prefix: &'a str) -> impl Iterator<Item = &'static str> + 'a {
        let ran = self.0.iter().filter(|(_, lap)| lap.seconds().is_some());
        ran.map(|(name, _)| *name).filter(move |name| name.starts_with(prefix))
    }

    /// Prints the rows of the table: time, units of the job a second, and the
    /// time against that of the first program.
    pub fn print(&self, job: &str, size: f64, unit: &str) {
        let first = self.0.first().and_then(|(_, lap)| lap.seconds());
        for (index, (name, lap)) in self.0.iter().enumerate() {
            let job = if index == 0 { job } else { "" };
            match lap {
                Lap::Seconds(seconds) => {
                    let ratio = first.map_or(f64::NAN, |first| seconds / first);
                    let rate = size / seconds;
                    println!(
                        "{job:<24} {name:<32} {seconds:>8.3} {rate:>8.1} {unit:<4} {ratio:>7.2}"
                    );
                }
                Lap::Skipped(reason) => println!("{job:<24} {name:<32} skipped: {reason}"),
            }
        }
    }
}

/// Prints the head of the table.
pub fn print_head() {
    println!("{:<24} {:<32} {:>8} {:>13} {:>7}", "job", "program", "seconds", "a second", "ratio");
}

/// Runs all programs in turn.
///
/// # Errors
/// A program that fails.
pub fn race(mut racers: Vec<Racer<'_>>) -> Outcome<Results> {
    for _ in 0..REPEATS {
        for racer in racers.iter_mut().filter(|racer| racer.runs_again()) {
            racer.run()?;
        }
    }
    let best = racers.into_iter().filter_map(|racer| Some((racer.name, racer.best?)));
    Ok(Results(best.collect()))
}

/// The time of what needs nothing from outside.
///
/// # Errors
/// What it returns.
pub fn timed(run: impl FnOnce() -> Outcome<()>) -> Outcome<Lap> {
    let start = Instant::now();
    run()?;
    Ok(Lap::Seconds(start.elapsed().as_secs_f64()))
}

/// The time of a command from its start to its end; skipped where its program is
/// not installed.
///
/// # Errors
/// It can't be run, or it fails.
pub fn command(command: &mut Command) -> Outcome<Lap> {
    let start = Instant::now();
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    let seconds = start.elapsed().as_secs_f64();
    match status {
        Ok(status) if status.success() => Ok(Lap::Seconds(seconds)),
        Ok(status) => Err(format!("{command:?} ended with {status}").into()),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(absent(command)),
        Err(error) => Err(error.into()),
    }
}

/// The lap of a program that is not installed.
pub fn absent(command: &Command) -> Lap {
    Lap::Skipped(format!("no {} here", command.get_program().display()))
}
