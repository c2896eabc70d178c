//! The syntax of FIL.
//!
//! **Goal.** FIL text to tree, and back.
//!
//! **Model.** [`parse`] never fails: it gives a tree of what could be read and a list of
//! diagnostics. [`decode`] makes text of a file's bytes, [`print`](print::print) writes a tree
//! back as FIL text, [`format()`] gives a text its canonical layout. The lexer is made by logos,
//! the grammar by lalrpop; `structure.rs` nests the flat lines.
//!
//! **Quick start.**
//!
//! ```
//! let parsed = fil_syntax::parse("feed.fil", "CIMFIL/ON,FEDRAT\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n");
//! assert!(parsed.diags.is_empty());
//!
//! let parsed = fil_syntax::parse("feed.fil", "A=(1+\nFINI\n");
//! assert!(parsed.diags.iter().any(|diag| diag.is_error()));
//! ```
//!
//! **Limits.** Places are bytes of the text, lines count from 1. Nothing is evaluated, and no name
//! is resolved: that is `fil-vm`.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

mod adapter;
#[cfg(feature = "code-pages")]
mod encoding;
#[cfg(not(feature = "code-pages"))]
#[path = "encoding_utf8.rs"]
mod encoding;
mod errors;
mod expr;
mod flat;
mod format;
mod frame;
mod free_text;
mod habits;
mod message;
mod parse;
pub mod print;
mod reader;
mod shapes;
mod structure;
mod token;
pub mod tree;
pub mod walk;

/// Made from `grammar.lalrpop` by `FILPOST_UPDATE=1 cargo test -p filpost-grammar`.
#[rustfmt::skip]
#[allow(clippy::all, missing_docs, unused, rustdoc::all)]
mod grammar;
/// Made from `lexer.logos`, in the same way.
#[rustfmt::skip]
#[allow(clippy::all, unused)]
mod lexer;

pub use encoding::decode;
pub use errors::SyntaxCode;
pub use format::format;
#[cfg(feature = "code-pages")]
pub use format::format_bytes;
pub use parse::{Parsed, parse};
pub use token::is_statement_word;

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
