//! CL files and FIL macros in, NC programs out: a post-processor inside a program of your own.
//!
//! # Goal
//!
//! A CAM system writes a CL file (APT, in the words of NCL): where the tool goes, and post words
//! such as `SPINDL` and `CYCLE`. A machine wants blocks in the language of its control. filpost
//! makes the second of the first, for a machine that is described by settings, and runs FIL, the
//! macro language of G-POST, in between.
//!
//! # Quick start
//!
//! ```
//! use filpost::Program;
//!
//! let cl = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
//!           FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let program = Program::builder().ready("fanuc-mill").build()?;
//! let posted = program.post(cl)?;
//! assert!(posted.text().contains("G1 G43 X1. Y2. Z3. F200. H1"));
//! assert_eq!(posted.report().blocks, 20);
//! # Ok::<(), filpost::Error>(())
//! ```
//!
//! # Model
//!
//! - A [`Builder`] takes a machine (a [ready post](ready), a `machine.toml`, an option file), FIL
//!   files, limits and functions of your own. It makes a [`Program`], which never changes: clones
//!   share it, in as many threads as you like.
//! - A [`Run`] is one CL file through a program, with a name for messages, a unit, observers and a
//!   [`CancelToken`].
//! - [`Run::post`] gives a [`Posted`]: the whole NC program with a [`Report`], and on request its
//!   [`Block`]s, each with the CL record, the FIL lines and the words that made it.
//!   [`Run::post_files`] goes from file to file. The methods named `stream` write while they post;
//!   after an error half a program has been written. [`Run::blocks`] hands out block by block.
//! - [`Run::verify`] compares an NC program with the CL file that it should come from,
//!   [`Run::post_audited`] says what scripts changed in it, and [`Program::simulate`] cuts stock
//!   with it.
//! - [`Error`] holds [`Diag`]s: code, sentence, places, hint. All that is wrong with a machine, with
//!   FIL files or with a CL file is told at once.
//!
//! Points of a CL file are in its own unit (millimeters or inches, [`Report::unit`]) and in the
//! coordinates of the part; angles are in degrees, feeds per minute or per revolution as `FEDRAT`
//! says. What a setting of a machine counts in is said in the
//! [table of settings](https://github.com/filpost/filpost/blob/main/docs/machine.md).
//!
//! # Limits
//!
//! - An NC program moves a machine: what can't be done is an error, and what may not be meant has
//!   a [`Level`] that the author of a post sets. After an error there is no program.
//! - A script has [`Limits`] (loops, texts, arrays, bytes of output) and reaches no file, clock or
//!   command that the builder does not grant.
//! - Memory does not grow with the CL file where the program is streamed.
//! - The post reads CL text, no CAD models; it knows the words, cycles and controls that
//!   [compat.md](https://github.com/filpost/filpost/blob/main/docs/compat.md) grades.
//!
//! # What is API
//!
//! What these pages show. Other items of this crate, and the crates `fil-…` under it, are for the
//! tools of the workspace: they change in any version. [`mod@records`], [`mod@simulate`] and
//! [`mod@verify`] name all that the API takes from them.
#![deny(missing_docs)]

mod allow;
pub mod audit;
mod behind_tool;
mod blocks;
mod builder;
mod cancel;
#[cfg(feature = "files")]
#[doc(hidden)]
pub mod case;
#[doc(hidden)]
pub mod check;
mod coming;
mod compat;
mod coordinates;
#[doc(hidden)]
pub mod coverage;
#[doc(hidden)]
pub mod debug;
mod doubt;
mod editing;
mod engine;
mod error;
mod event;
#[doc(hidden)]
pub mod explain;
#[doc(hidden)]
pub mod file_names;
#[doc(hidden)]
pub mod files;
mod finding;
mod granted;
pub mod includes;
#[doc(hidden)]
pub mod listing;
mod machine;
#[doc(hidden)]
pub mod map;
mod memory;
#[doc(hidden)]
pub mod new_post;
mod outside;
mod overview;
mod passes;
#[cfg(feature = "files")]
mod pending;
#[cfg(not(feature = "files"))]
#[path = "pending/none.rs"]
mod pending;
#[doc(hidden)]
pub mod plot;
mod posted;
#[doc(hidden)]
pub mod profile;
mod program;
mod reach;
pub mod ready;
pub mod records;
mod refusals;
mod report;
mod run;
#[cfg(feature = "files")]
mod script_files;
#[cfg(not(feature = "files"))]
#[path = "no_script_files.rs"]
mod script_files;
#[doc(hidden)]
pub mod select;
pub mod simulate;
mod source;
mod spilled;
mod spool;
mod statement;
mod survey;
#[doc(hidden)]
pub mod tally;
#[doc(hidden)]
pub mod tool_files;
#[doc(hidden)]
pub mod trace;
mod undecided;
mod units;
pub mod verify;
#[doc(hidden)]
pub mod word_pages;
mod written;

pub use allow::LevelOf;
pub use blocks::{Block, Blocks, WordOrigin};
pub use builder::Builder;
pub use cancel::CancelToken;
pub use compat::{CompatFile, read_compat};
pub use error::{Error, all_codes};
pub use event::{Event, RunEnd};
pub use finding::Finding;
pub use granted::Clock;
pub use posted::Posted;
pub use program::Program;
pub use refusals::{MOST_KINDS, Refusals};
pub use report::{Extents, Report};
pub use run::Run;
pub use select::Machin;
pub use units::UnitSource;

#[doc(inline)]
pub use fil_diag::{Code, CodeKind, Diag, Level, LevelProfile, Levels, Severity, TextSpan};
#[doc(inline)]
pub use fil_machine::Unit;
#[doc(inline)]
pub use fil_machine::post_options::{OptionKind, OptionValue, PostOption};
#[doc(inline)]
pub use fil_post::{FilLine, Origin};
#[doc(inline)]
pub use fil_text::CodePage;
#[doc(inline)]
pub use fil_vm::{Argument, Included, Limits, Moment, Returned};

// For the tools of the workspace, which are made and released with this crate: no API. They name
// inner things through this crate, so that each links one copy of them with the same features.
#[doc(hidden)]
pub use allow::{allowable, level_line, level_named, levels_named};
#[doc(hidden)]
pub use compat::operation_name;
#[doc(hidden)]
pub use error::{RunCode, are_unique_beside};
#[doc(hidden)]
pub use event::LineEditor;
#[cfg(feature = "files")]
#[doc(hidden)]
pub use pending::NewFile;
#[doc(hidden)]
pub use pending::PendingFiles;
#[doc(hidden)]
pub use statement::statement_text;
#[doc(hidden)]
pub use units::unit_named;

#[doc(hidden)]
pub use fil_cl as cl;
#[doc(hidden)]
pub use fil_diag::suggest;
#[doc(hidden)]
pub use fil_machine::{
    Commons, FunctionCode, Kind, Letter, address, chain_drawing, chains, commons, effects,
    files as settings, functions, locations, reads, simulate_settings, stored, tape_style,
    user_blocks,
};
#[doc(hidden)]
pub use fil_nc as nc;
#[doc(hidden)]
pub use fil_post::{Cause, Stack, dispatch, no_effect};
#[doc(hidden)]
pub use fil_stock as stock;
#[doc(hidden)]
pub use fil_syntax as syntax;
#[doc(hidden)]
pub use fil_text::shown;
#[doc(hidden)]
pub use fil_vm::{Analysis, CommonKind, Compat, SectionMode};
#[doc(hidden)]
pub use fil_vm::{builtins, is_allowable, postf, resolve, statements};

/// The example of the page about embedding, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/embedding.md")]
struct Embedding;

/// The examples of the crate's own README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadme;
