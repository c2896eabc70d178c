//! Posts learned from proven programs.
//!
//! **Goal.** The settings with which filpost writes the same programs as a proven post.
//!
//! **Model.** A [`Task`] has pairs of a CL file and the NC program that ran on the machine.
//! [`learn`] changes settings of ready posts, posts the CL files, and compares with the proven
//! programs. The result is a [`Learned`]: a machine, the lines that prove each of its settings,
//! what no pair decides, and the lines that still differ.
//!
//! **Quick start.**
//!
//! ```
//! use fil_learn::{Bases, Pair, Task};
//!
//! let cl = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let nc = "%\nO7\nG21\nG17 G90 G94\nG54\nT1 M6\nG1 G43 X1. Y2. Z3. F200. H1\nM2\n%\n";
//! let pair = Pair::new("part.ncl", cl.as_bytes(), "part.nc", nc.as_bytes());
//! let bases = Bases::Ready(vec!["fanuc-mill".into()]);
//! let learned = fil_learn::learn(&Task::new(vec![pair], bases))?;
//! assert!(learned.machine_toml().contains("program.rewind_code = 2"));
//! # Ok::<(), filpost::Error>(())
//! ```
//!
//! **Limits.** The same input gives the same result, whatever the number of threads. It learns
//! settings, no FIL, and no more than its pairs show; it opens no file.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.
#![deny(missing_docs)]

mod align;
mod bases;
mod candidates;
mod change;
mod check;
mod facts;
mod learned;
mod myers;
mod noted;
mod positions;
mod proof;
mod readings;
mod report;
mod score;
mod search;
mod task;
mod texts;
mod trial;
mod undecided;
mod words;

pub use bases::Bases;
pub use check::Checked;
pub use learned::{Learned, LearnedPair};
pub use proof::Proof;
pub use task::{Pair, Progress, Task};

use filpost::Error;

/// Finds the settings of the post that wrote the proven programs of a task.
///
/// # Errors
/// No base can be built, or every base refuses every CL file.
pub fn learn(task: &Task<'_>) -> Result<Learned, Error> {
    search::learn(task)
}

/// Checks a post that was learned with further pairs. The base of the task is the post.
///
/// # Errors
/// A base that can't be built.
pub fn check(task: &Task<'_>) -> Result<Checked, Error> {
    check::check(task)
}

/// The example of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
