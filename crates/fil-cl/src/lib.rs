//! CL records: vocabulary, streaming reader, writer.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

mod build;
mod convert;
pub mod dialect;
pub mod errors;
mod fault;
mod forms;
pub mod layout;
pub mod reader;
pub mod record;
pub mod vocabulary;
pub mod words;
pub mod writer;

pub use build::{Item, RecordBuilder};
pub use convert::{Converted, to_ncl};
pub use dialect::{ClDialect, Evidence, Recognized};
pub use errors::ClCode;
pub use forms::cycle::keyed_cycle;
pub use layout::ShapeError;
pub use reader::{Meaning, Options, Reader, SplineCounts};
pub use record::{Circle, Record, Word, WordView};
pub use vocabulary::{Vocabulary, WordId};
pub use writer::Writer;

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
