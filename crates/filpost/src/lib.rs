//! filpost: CL file and FIL macros in, NC program out.
//!
//! ```
//! let cl = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
//!           FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let mut post = filpost::Post::builder().ready("fanuc-mill").build()?;
//! let mut nc = Vec::new();
//! let report = post.run(cl.as_bytes(), &mut nc)?;
//! assert_eq!(report.blocks, 8);
//! assert!(String::from_utf8(nc)?.contains("G1 G43 X1. Y2. Z3. F200. H1"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Post::builder`] takes a machine (a ready post, a `machine.toml`, an option
//! file), FIL files, limits, functions of the embedding program and observers;
//! [`Post::run`] goes from a reader to a writer, [`Post::records`] gives the
//! blocks one by one with the CL record and the FIL lines that made them.
#![deny(missing_docs)]

mod blocks;
mod builder;
pub mod case;
pub mod check;
mod compat;
mod engine;
mod error;
pub mod files;
mod granted;
pub mod includes;
pub mod listing;
pub mod map;
mod observe;
mod outside;
pub mod plot;
pub mod ready;
mod report;
mod script_files;
pub mod select;
mod source;
mod statement;
pub mod trace;
pub mod verify;

pub use blocks::{Block, Blocks};
pub use builder::{Builder, Post};
pub use compat::{operation_name, read_compat};
pub use error::{Error, RunCode, all_codes};
pub use granted::Clock;
pub use observe::{SectionEvent, WhatHappened};
pub use report::{Extents, Report};
pub use script_files::HeldFiles;
pub use statement::statement_text;

pub use fil_cl as cl;
pub use fil_diag::suggest;
pub use fil_diag::{Code, Diag, Place, Severity};
pub use fil_machine::{
    Commons, Kind, Letter, Unit, address, commons, files as settings, locations,
};
pub use fil_nc as nc;
pub use fil_post::{Cause, FilLine, Origin, Stack, dispatch, no_effect};
pub use fil_syntax as syntax;
pub use fil_vm::{Argument, Compat, Included, Limits, Moment, SectionMode};
pub use fil_vm::{builtins, postf, statements};

/// The example of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
