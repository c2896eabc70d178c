//! Stopping a run from outside.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::RunCode;

/// Stops runs: clones share one switch, which any thread may set.
///
/// A run looks at the switch before each record, and FIL after some ten thousand
/// passes of a loop, so also a loop without end stops within milliseconds. The
/// run ends with E0711, and nothing of its output may be used.
///
/// ```
/// use filpost::{CancelToken, Program};
///
/// let forever = "LA) XX=1\nJUMPTO/LA\nFINI\n";
/// let program = Program::builder().ready("fanuc-mill").fil("loop.fil", forever).build()?;
/// let token = CancelToken::new();
/// let stop = token.clone();
/// let run = std::thread::spawn(move || {
///     program.start().cancel(&token).stream("FINI\n".as_bytes(), Vec::new())
/// });
/// stop.cancel();
/// let error = run.join().expect("no panic").expect_err("cancelled");
/// assert!(error.is_cancelled());
/// # Ok::<(), filpost::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken {
    cancelled: Arc<AtomicBool>,
}

impl CancelToken {
    /// A switch that is not set.
    pub fn new() -> Self {
        CancelToken::default()
    }

    /// Stops all runs that have this token or a clone of it, also those that
    /// start later.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// True after [`CancelToken::cancel`].
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// # Errors
    /// E0711 when the switch is set.
    pub(crate) fn check(&self) -> fil_diag::Result<()> {
        if self.is_cancelled() {
            return RunCode::Cancelled.err("the program around this run has stopped it");
        }
        Ok(())
    }
}
