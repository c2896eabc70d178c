//! The interpreter of FIL alone: compiler and virtual machine.
//!
//! **Goal.** A program that runs FIL for an end of its own, without a machine tool and without a
//! post, depends on this crate and on no other of the workspace. Records and CL text are in
//! [`cl`], diagnostics in [`diag`], trees of FIL text in [`syntax`].
//!
//! **Model.** [`load`] reads FIL files into a [`Module`]: register bytecode with every name
//! resolved. An [`Interpreter`] runs its global area once and then a section for each CL record
//! that has one. It does no I/O: everything outside goes through [`Host`].
//!
//! **Quick start.** A whole program is `examples/interpret.rs`.
//!
//! ```
//! use fil_vm::cl::Vocabulary;
//! use fil_vm::diag::Diag;
//! use fil_vm::{FilFile, LoadOptions, load};
//!
//! let mut words = Vocabulary::new();
//! let file = FilFile { name: "tool.fil", text: "CIMFIL/ON,LOADTL\nSTOP\nCIMFIL/OFF\nFINI\n" };
//! let loaded = load(&[file], &mut words, LoadOptions::default());
//! assert_eq!(loaded.unwrap().module.section_keys().collect::<Vec<_>>(), ["LOADTL"]);
//! let wrong = FilFile { name: "wrong.fil", text: "A=(1+\nFINI\n" };
//! let diags: Vec<Diag> = load(&[wrong], &mut words, LoadOptions::default()).err().unwrap();
//! assert!(diags[0].is_error());
//! ```
//!
//! **Limits.** No I/O and no clock but those of the host; time and memory of a script by
//! [`Limits`] (steps, bytes, calls). Numbers are `f64` without a unit: what they count in is the
//! script's affair.
//!
//! **What is API.** These pages. What [`cl`], [`diag`] and [`syntax`] give on is of inner crates, and may
//! change in any version.

mod allow;
mod arithmetic;
pub mod builtins;
mod compile;
mod constant;
pub mod debug;
mod disassemble;
pub mod errors;
mod functions;
mod host;
pub mod library;
mod lint;
mod machine;
mod matcher;
mod module;
mod moment;
mod open_blocks;
mod ops;
mod output;
pub mod postf;
pub mod resolve;
pub mod statements;
mod texts;
mod totals;
mod value;

pub use fil_cl as cl;
pub use fil_diag as diag;
pub use fil_syntax as syntax;

pub use allow::is_allowable;
pub use compile::{Analysis, FilFile, Included, LoadOptions, Loaded, Loader, analyze, load};
pub use disassemble::disassemble;
pub use functions::{Argument, Functions, Returned};
pub use host::{CommonKind, FileMode, Files, Host, Site};
pub use lint::{MachineFacts, StoringInCommon};
pub use machine::{Held, Interpreter, Limits, Outcome, StackFrame, Values, View};
pub use module::{File, Module, SectionId};
pub use moment::Moment;
pub use output::{Edits, OutputMacro, REPOSITION, REPOSITION_GIVEN};
pub use postf::{Compat, PostfOp, SectionMode};
pub use totals::{TotalsOf, TotalsText, TotalsWord};
pub use value::{EMPTY, Value};

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
