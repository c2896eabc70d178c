//! Whether a page is open.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long the last page may be gone before the studio ends: a page that is loaded anew is
/// back within it.
const GRACE: Duration = Duration::from_secs(4);

/// Counts the open pages.
#[derive(Default)]
pub(crate) struct Presence {
    count: Mutex<Count>,
    changed: Condvar,
}

#[derive(Default)]
struct Count {
    open: usize,
    /// Pages that were ever opened.
    seen: usize,
}

impl Presence {
    fn count(&self) -> MutexGuard<'_, Count> {
        self.count.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A page is open.
    pub fn enter(&self) {
        let mut count = self.count();
        count.open += 1;
        count.seen += 1;
        self.changed.notify_all();
    }

    /// A page was closed.
    pub fn leave(&self) {
        let mut count = self.count();
        count.open = count.open.saturating_sub(1);
        self.changed.notify_all();
    }

    /// Waits until the last page is closed and none comes back. Before the first page it waits
    /// for that.
    pub fn wait_for_the_end(&self) {
        let mut count = self.count();
        loop {
            while count.seen == 0 || count.open > 0 {
                count = self.changed.wait(count).unwrap_or_else(PoisonError::into_inner);
            }
            let (later, waited) = self
                .changed
                .wait_timeout_while(count, GRACE, |count| count.open == 0)
                .unwrap_or_else(PoisonError::into_inner);
            if waited.timed_out() {
                return;
            }
            count = later;
        }
    }
}
