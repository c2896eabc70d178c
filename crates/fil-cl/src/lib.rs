//! CL records: vocabulary, streaming reader, writer.

pub mod record;
pub mod vocabulary;

pub use record::{Record, Word};
pub use vocabulary::WordId;
