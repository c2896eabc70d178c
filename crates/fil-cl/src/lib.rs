//! CL records: vocabulary, streaming reader, writer.

pub mod errors;
mod fault;
pub mod layout;
pub mod reader;
pub mod record;
pub mod vocabulary;
pub mod words;
pub mod writer;

pub use errors::ClCode;
pub use layout::ShapeError;
pub use reader::{Dialect, Options, Reader};
pub use record::{Circle, Record, Word, WordView};
pub use vocabulary::{Vocabulary, WordId};
pub use writer::Writer;
