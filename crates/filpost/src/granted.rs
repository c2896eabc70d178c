//! What a script is granted of the world outside: clock, commands, files.

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use fil_vm::Moment;

use crate::script_files::{Folders, ScriptFiles};

/// Where DATEF and TIMEF get their moment from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Clock {
    /// Always the same, so that the same input gives the same bytes.
    Fixed(Moment),
    /// The system's clock, in UTC, read once a run.
    System,
}

impl Clock {
    /// The clock that a text names: `system`, or a moment such as `2026-01-31T12:00:00`.
    pub fn named(text: &str) -> Option<Clock> {
        if text == "system" {
            return Some(Clock::System);
        }
        Moment::parse(text).map(Clock::Fixed)
    }
}

/// Runs the command of SPAWNF and gives its status.
pub(crate) type Spawn = Box<dyn Fn(&str) -> Result<f64, String> + Send + Sync>;

/// What one run has been granted.
pub(crate) struct Granted {
    clock: Option<Clock>,
    /// The moment of this run, once it was asked for.
    now: Option<Moment>,
    /// The script's files; `None` where no folder is granted.
    pub files: Option<ScriptFiles>,
}

impl Granted {
    /// The grants of a run.
    pub fn new(clock: Option<Clock>, folders: Option<Arc<Folders>>) -> Self {
        Granted { clock, now: None, files: folders.map(ScriptFiles::new) }
    }

    /// The moment of the run; `None` without a clock.
    pub fn now(&mut self) -> Option<Moment> {
        if self.now.is_none() {
            self.now = match self.clock? {
                Clock::Fixed(moment) => Some(moment),
                Clock::System => {
                    let since = SystemTime::now().duration_since(UNIX_EPOCH).ok()?;
                    Moment::from_unix(since.as_secs())
                }
            };
        }
        self.now
    }
}
