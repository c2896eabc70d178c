//! FIL text to tree: lexer (logos), grammar (lalrpop), diagnostics as plain data.
//!
//! [`parse`] never fails: it returns a tree of what could be read and a list of
//! diagnostics. [`decode`] makes text of a file's bytes, [`print`](print::print)
//! writes a tree back as FIL text, [`format()`] gives a text its canonical layout.
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
