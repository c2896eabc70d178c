//! The debug adapter: a run of filpost behind the debug adapter protocol, over standard input
//! and output.
//!
//! **Goal.** A run of a post in a debugger: breakpoints in FIL and in the CL file, steps forward and
//! back, variables, commons, the blocks as they come.
//!
//! **Model.** [`serve_stdio`] is what `filpost dap` runs; [`serve`] takes any input and output.
//! [`look`] is for hosts without threads, such as a page: it runs a program in memory to one place and tells
//! what there is to see. Lines and columns count from 1.
//!
//! **Quick start.** In a program that is started by an editor:
//!
//! ```no_run
//! fn main() -> Result<(), String> {
//!     filpost_dap::serve_stdio()
//! }
//! ```
//!
//! **Limits.** One run a session. A step back runs the program again from its start, so it takes the
//! time of the way there.
//!
//! One thread reads the client's requests, another one runs the program. While the run stands
//! still, the requests that look at it go to its own thread, as only that one holds its state.
//! Going back is a new run from the start to the place: a run with the same input does the
//! same.
//!
//! A tool of [filpost](https://crates.io/crates/filpost), without an API of its own: its items may
//! change in any version.

// What only the protocol uses is left out by the linker of a page.
#![cfg_attr(not(feature = "files"), allow(dead_code))]

mod breakpoints;
mod edits;
mod hook;
mod inspect;
#[cfg(feature = "files")]
mod launch;
mod once;
mod places;
#[cfg(feature = "files")]
mod session;
mod shared;
#[cfg(feature = "files")]
mod wire;

#[cfg(feature = "files")]
use std::io::{BufRead, Write};

pub use once::look;
#[cfg(feature = "files")]
pub use session::Session;

/// Serves one client over standard input and output until it disconnects.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
#[cfg(feature = "files")]
pub fn serve_stdio() -> Result<(), String> {
    serve(std::io::stdin().lock(), std::io::stdout())
}

/// Serves one client over a connection until it disconnects.
///
/// # Errors
/// What went wrong with the connection, in a sentence.
#[cfg(feature = "files")]
pub fn serve(mut input: impl BufRead, output: impl Write + Send + 'static) -> Result<(), String> {
    let mut session = Session::new(Box::new(output));
    while let Some(request) = wire::read(&mut input)? {
        if !session.request(&request) {
            break;
        }
    }
    session.end();
    Ok(())
}
