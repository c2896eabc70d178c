//! FIL, `machine.toml` and CL files in an editor.
//!
//! **Goal.** What an editor of FIL, `machine.toml` and CL files needs, over the same parser, names
//! and tables as a run.
//!
//! **Model.** [`Script`] is the analysis of a FIL file with the files it includes; [`machine`] and
//! [`cl_file`] are that of the other two.
//!
//! **Quick start.**
//!
//! ```
//! use fil_ide::{Position, Text, machine};
//!
//! let text = Text::new("[program]\nend_code = 2\n");
//! let hover = machine::hover(&text, Position { line: 1, character: 2 });
//! assert!(hover.is_some());
//! ```
//!
//! **Limits.** Places of an editor are lines and UTF-16 units, both from 0 ([`Position`]);
//! everything inside counts bytes. No protocol and no I/O: `filpost-lsp` is the server.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

mod actions;
pub mod cl_file;
mod complete;
mod context;
mod fold;
mod hover;
mod inlay;
pub mod machine;
mod navigate;
mod positions;
pub mod repairs;
mod script;
mod signature;
mod symbols;
mod tables;
mod text;
mod tokens;

pub use actions::Fix;
pub use complete::{Item, ItemKind};
pub use fold::Fold;
pub use inlay::Inlay;
pub use navigate::{Edit, Place};
pub use script::{Finding, Script};
pub use signature::Signature;
pub use symbols::{Outline, OutlineKind};
pub use text::{Position, Range, Text};
pub use tokens::{TOKEN_TYPES, Token};

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
