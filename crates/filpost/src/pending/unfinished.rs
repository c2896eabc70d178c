//! What is to be undone when the process is told to stop: files in the making go away,
//! files that were replaced come back.

use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use cap_std::fs::Dir;

/// A step back.
#[derive(Clone, Debug)]
pub(super) enum Action {
    /// The file goes away.
    Remove { folder: Arc<Dir>, name: PathBuf },
    /// The file gets its name again.
    Restore { folder: Arc<Dir>, from: PathBuf, name: PathBuf },
}

impl Action {
    /// Nobody can be told of a step that fails.
    fn run(&self) {
        match self {
            Action::Remove { folder, name } => drop(folder.remove_file(name)),
            Action::Restore { folder, from, name } => {
                let _ = folder.rename(from, folder, name);
                // Two names of one file are left as they are by that.
                let _ = folder.remove_file(from);
            }
        }
    }
}

/// The steps to be taken, the last one first, by their numbers.
#[derive(Default)]
struct Steps {
    steps: Vec<(u64, Action)>,
    next: u64,
}

static STEPS: Mutex<Steps> = Mutex::new(Steps { steps: Vec::new(), next: 0 });

fn steps() -> MutexGuard<'static, Steps> {
    STEPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A step that is noted.
#[derive(Debug)]
pub(super) struct Ticket(u64);

impl Ticket {
    /// Takes the step now.
    pub fn run(self) {
        let mut steps = steps();
        if let Some(action) = take(&mut steps, self.0) {
            action.run();
        }
    }

    /// There is nothing to go back on any more.
    pub fn forget(self) {
        take(&mut steps(), self.0);
    }
}

fn take(steps: &mut Steps, number: u64) -> Option<Action> {
    let at = steps.steps.iter().position(|(known, _)| *known == number)?;
    Some(steps.steps.remove(at).1)
}

/// Does something and notes how to undo it, with no stop in between.
pub(super) fn with<T>(
    action: Action,
    work: impl FnOnce() -> io::Result<T>,
) -> io::Result<(T, Ticket)> {
    let mut steps = steps();
    let done = work()?;
    let number = steps.next;
    steps.next += 1;
    steps.steps.push((number, action));
    Ok((done, Ticket(number)))
}

/// The same in place of another step.
pub(super) fn instead<T>(
    ticket: Option<Ticket>,
    action: Action,
    work: impl FnOnce() -> io::Result<T>,
) -> io::Result<(T, Ticket)> {
    let mut steps = steps();
    let done = work()?;
    if let Some(ticket) = ticket {
        take(&mut steps, ticket.0);
    }
    let number = steps.next;
    steps.next += 1;
    steps.steps.push((number, action));
    Ok((done, Ticket(number)))
}

/// Leaves all files as they were before the runs that are under way: for a process that
/// is told to stop, and must end right after. No file can be begun any more; whoever
/// tries waits for the end of the process.
pub fn give_up() {
    let mut steps = steps();
    for (_, action) in steps.steps.drain(..).rev() {
        action.run();
    }
    std::mem::forget(steps);
}
