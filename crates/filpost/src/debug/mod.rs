//! Looking into a run: the hook that the debugger, the coverage and the profile share.
//!
//! A program that is built with [`Builder::debug`](crate::Builder::debug) has bytecode that
//! stops at each statement and each outcome of a condition; any other program has nothing of
//! it and pays nothing. [`Run::debug`](crate::Run::debug) hands a run to a [`Debugger`], which
//! is called at each of these and at each CL record, in the thread of the run: while it does
//! not return, the run stands still, and a [`DebugState`] shows and sets what there is.
//!
//! ```
//! use std::sync::{Arc, Mutex};
//! use filpost::debug::{DebugEvent, DebugState, Debugger, SharedDebugger};
//! use filpost::{Diag, Program};
//!
//! /// Notes the lines that run.
//! #[derive(Default)]
//! struct Lines(Vec<u32>);
//!
//! impl Debugger for Lines {
//!     fn at(&mut self, event: DebugEvent<'_>, state: &mut DebugState<'_, '_>) -> Result<(), Box<Diag>> {
//!         if let (DebugEvent::Statement, Some((_, line))) = (event, state.fil.line()) {
//!             self.0.push(line);
//!         }
//!         Ok(())
//!     }
//! }
//!
//! let fil = "CIMFIL/ON,LOADTL\nTT=POSTF(7,4)\nIF(TT.GT.5)OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
//! let program = Program::builder().ready("fanuc-mill").fil("t.fil", fil).debug(true).build()?;
//! let lines = Arc::new(Mutex::new(Lines::default()));
//! let debugger: SharedDebugger = lines.clone();
//! let cl = "UNITS / MM\nLOADTL / 3\nFINI\n".as_bytes();
//! program.start().debug(&debugger).stream(cl, std::io::sink())?;
//! assert_eq!(lines.lock().unwrap().0, [2, 3, 4]);
//! # Ok::<(), filpost::Error>(())
//! ```

mod evaluate;
mod modes;
mod state;

use std::sync::{Arc, Mutex, PoisonError};

use fil_diag::Diag;

use crate::error::RunCode;

pub use evaluate::{evaluate, shown};
pub use fil_vm::debug::{BranchOutcome, CodePlace, Outline, OutlineBranch, OutlinePart};
pub use fil_vm::{Held, StackFrame, View};
pub use state::DebugState;
pub(crate) use state::World;

/// What a debugger is told of.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum DebugEvent<'a> {
    /// A CL record was read by the run; nothing has been done with it yet.
    Record,
    /// A record and all it has caused are over.
    RecordDone,
    /// A statement of FIL runs next.
    Statement,
    /// The global area, a section or a macro begins.
    Enter,
    /// It ends.
    Leave,
    /// An outcome of a condition has come, by its number in [`Outline::branches`].
    Branch(u16),
    /// The run is refused; it stands where the error is.
    Failed(&'a Diag),
}

/// Watches a run and may hold it.
pub trait Debugger: Send {
    /// Called at each event, in the thread of the run.
    ///
    /// # Errors
    /// An error ends the run with it; [`stopped`] makes the one of a cancelled run.
    fn at(
        &mut self,
        event: DebugEvent<'_>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>>;
}

/// A debugger that whoever started the run keeps in hand.
pub type SharedDebugger = Arc<Mutex<dyn Debugger>>;

/// The error that ends a run as a [`CancelToken`](crate::CancelToken) does.
pub fn stopped() -> Box<Diag> {
    RunCode::Cancelled.diag("the debugger has stopped the run")
}

/// Tells a debugger of an event.
pub(crate) fn tell(
    debugger: &SharedDebugger,
    event: DebugEvent<'_>,
    state: &mut DebugState<'_, '_>,
) -> Result<(), Box<Diag>> {
    debugger.lock().unwrap_or_else(PoisonError::into_inner).at(event, state)
}

/// The event of a step of the bytecode.
pub(crate) fn event(probe: fil_vm::debug::Probe<'_>) -> DebugEvent<'_> {
    use fil_vm::debug::Probe;
    match probe {
        Probe::Statement => DebugEvent::Statement,
        Probe::Enter => DebugEvent::Enter,
        Probe::Leave => DebugEvent::Leave,
        Probe::Branch(number) => DebugEvent::Branch(number),
        Probe::Failed(diag) => DebugEvent::Failed(diag),
    }
}
