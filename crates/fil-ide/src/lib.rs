//! What an editor of FIL, `machine.toml` and CL files needs, over the same parser, names
//! and tables as a run: no protocol and no I/O.
//!
//! [`Script`] is the analysis of a FIL file with the files it includes. Places of an
//! editor are lines and UTF-16 units ([`Position`]); everything inside counts bytes.
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
