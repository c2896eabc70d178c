//! The checker alone: NC programs read back.
//!
//! **Goal.** A program that judges, compares or draws NC programs, of whatever post, depends on
//! this crate and on no other of the workspace. Machines and their settings are in [`machine`], CL
//! text in [`cl`], diagnostics in [`diag`].
//!
//! **Model.** [`text`] cuts a program into blocks of words as its control reads them
//! ([`dialect`]); [`interpret`] moves the machine by them; [`motion`] is what the program does, as
//! plain data; [`verify`] compares that with a CL file, [`diff`] two programs, [`plot`] draws a
//! path. Nothing here shares a line with the post's output side: a fault of the writer must not
//! hide itself in the reader.
//!
//! **Quick start.** A whole program is `examples/check.rs`.
//!
//! ```
//! use fil_nc::machine::{Commons, Unit, locations::default_commons};
//! use fil_nc::verify::{Allowed, Check, Verdict, verify};
//! use fil_nc::interpret::{PassedOver, Running};
//! use fil_nc::{cl, dialect::Dialect, source::Source};
//!
//! let machine: Commons = default_commons();
//! let dialect = Dialect::new(&machine)?;
//! let nc = Source::memory(b"G21 G90 G94 G17\nM3 S900\nG1 X1. Y2. Z3. F200.\nM30\n");
//! let text = "UNITS / MM\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let report = verify(Check {
//!     cl: cl::Reader::new(text.as_bytes(), "part.ncl", cl::Options::default()),
//!     cl_name: "part.ncl",
//!     unit: Some(Unit::Mm),
//!     nc: &nc,
//!     nc_name: "part.nc",
//!     events: &mut Running::new(&nc, "part.nc", &dialect),
//!     passed: &PassedOver::default(),
//!     commons: &machine,
//!     allowed: Allowed::default(),
//!     skips_blocks: false,
//! })?;
//! assert_eq!(report.verdict(), Verdict::Agrees, "{:?}", report.findings);
//! # Ok::<(), Box<fil_nc::diag::Diag>>(())
//! ```
//!
//! **Limits.** Lengths in reports are in mm, angles in degrees, lines count from 1. What a reader
//! does not know of a control is an error or a place that is not verified, never a guess.
//!
//! **What is API.** These pages. What [`cl`], [`diag`] and [`machine`] give on is of inner crates, and may
//! change in any version.

pub use fil_cl as cl;
pub use fil_diag as diag;
pub use fil_machine as machine;

pub mod bend;
pub mod decimals;
pub mod dialect;
pub mod diff;
pub mod errors;
pub mod events;
pub mod forward;
pub mod interpret;
pub mod motion;
pub mod plot;
pub mod source;
pub mod text;
pub mod verify;
pub mod work_offsets;

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
