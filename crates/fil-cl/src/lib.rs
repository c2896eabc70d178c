//! CL records: vocabulary, streaming reader, writer.
//!
//! **Goal.** CL files, the tool paths that CAM systems write as text, as records with numbered
//! words.
//!
//! **Model.** A [`Reader`] takes text of any of the [`ClDialect`]s and gives [`Record`]s, one
//! after the other; a [`Vocabulary`] has the words; a [`Writer`] makes text of records. Words of a
//! record count from 1, as FIL counts them.
//!
//! **Quick start.**
//!
//! ```
//! use fil_cl::{Options, Reader, Record, Vocabulary};
//!
//! let text = "FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
//! let mut reader = Reader::new(text.as_bytes(), "part.ncl", Options::default());
//! let (mut words, mut record, mut ends) = (Vocabulary::new(), Record::default(), Vec::new());
//! while reader.read(&mut words, &mut record)? {
//!     ends.extend(record.point());
//! }
//! assert_eq!(ends, [[1.0, 2.0, 3.0]]);
//! # Ok::<(), Box<fil_diag::Diag>>(())
//! ```
//!
//! **Limits.** Points are in the unit of the file, angles in degrees, in the coordinates of the
//! part. Memory does not grow with the file. An arc, a word or a unit that could be read in two
//! ways is refused.
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
pub mod operation_sign;
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
