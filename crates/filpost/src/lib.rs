//! filpost: CL file and FIL macros in, NC program out.
//!
//! ```
//! let cl = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
//!           FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let program = filpost::Program::builder().ready("fanuc-mill").build()?;
//! let mut nc = Vec::new();
//! let report = program.run(cl.as_bytes(), &mut nc)?;
//! assert_eq!(report.blocks, 18);
//! assert!(String::from_utf8(nc)?.contains("G1 G43 X1. Y2. Z3. F200. H1"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Program::builder`] takes a machine (a ready post, a `machine.toml`, an option
//! file), FIL files, limits and functions of the embedding program. A [`Program`]
//! never changes and is shared by threads. [`Program::run`] takes a CL stream to a
//! writer, [`Program::blocks`] gives the blocks one by one with the CL record and
//! the FIL lines that made them, and [`Program::start`] begins a [`Run`] with options:
//! observers, a [`CancelToken`], the name of the CL file.
#![deny(missing_docs)]

mod allow;
pub mod audit;
mod blocks;
mod builder;
mod cancel;
#[cfg(feature = "files")]
pub mod case;
pub mod check;
mod coming;
mod compat;
mod coordinates;
pub mod coverage;
pub mod debug;
mod doubt;
mod editing;
mod engine;
mod error;
mod event;
pub mod explain;
pub mod file_names;
pub mod files;
mod finding;
mod granted;
pub mod includes;
pub mod listing;
mod machine;
pub mod map;
mod memory;
pub mod new_post;
mod outside;
mod overview;
mod passes;
#[cfg(feature = "files")]
mod pending;
#[cfg(not(feature = "files"))]
#[path = "pending/none.rs"]
mod pending;
pub mod plot;
pub mod profile;
mod program;
mod reach;
pub mod ready;
mod refusals;
mod report;
mod run;
#[cfg(feature = "files")]
mod script_files;
#[cfg(not(feature = "files"))]
#[path = "no_script_files.rs"]
mod script_files;
pub mod select;
pub mod simulate;
mod source;
mod spilled;
mod spool;
mod statement;
mod survey;
pub mod tally;
pub mod trace;
mod undecided;
mod units;
pub mod verify;
pub mod word_pages;
mod written;

pub use allow::{LevelOf, allowable, level_line, level_named};
pub use blocks::{Block, Blocks, WordOrigin};
pub use builder::Builder;
pub use cancel::CancelToken;
pub use compat::{CompatFile, operation_name, read_compat};
pub use error::{Error, RunCode, all_codes};
pub use event::{Event, LineEditor, RunEnd};
pub use finding::Finding;
pub use granted::Clock;
#[cfg(feature = "files")]
pub use pending::NewFile;
pub use pending::PendingFiles;
pub use program::Program;
pub use refusals::{MOST_KINDS, Refusals};
pub use report::{Extents, Report};
pub use run::Run;
pub use statement::statement_text;
pub use units::{UnitSource, unit_named};

pub use fil_cl as cl;
pub use fil_diag::suggest;
pub use fil_diag::{Code, CodeKind, Diag, Level, LevelProfile, Levels, Severity, TextSpan};
pub use fil_machine::post_options::{OptionKind, OptionValue, PostOption};
pub use fil_machine::{
    Commons, FunctionCode, Kind, Letter, Unit, address, chain_drawing, chains, commons, effects,
    files as settings, functions, locations, stored, tape_style, user_blocks,
};
pub use fil_nc as nc;
pub use fil_post::{Cause, FilLine, Origin, Stack, dispatch, no_effect};
pub use fil_stock as stock;
pub use fil_syntax as syntax;
pub use fil_text::{CodePage, shown};
pub use fil_vm::{
    Analysis, Argument, CommonKind, Compat, Included, Limits, Moment, Returned, SectionMode,
};
pub use fil_vm::{builtins, is_allowable, postf, resolve, statements};

/// The example of the page about embedding, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/embedding.md")]
struct Embedding;

/// The examples of the crate's own README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadme;
