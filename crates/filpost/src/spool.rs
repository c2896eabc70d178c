//! Bytes that are written once and read again: in memory up to a bound, then in a nameless
//! file. Without the feature `files` all of them stay in memory.

use fil_nc::source::Source;

#[cfg(feature = "files")]
pub(crate) use tempfile::SpooledTempFile as Spool;

/// Bytes in memory.
#[cfg(not(feature = "files"))]
pub(crate) type Spool = std::io::Cursor<Vec<u8>>;

/// An empty one that keeps up to `in_memory` bytes out of a file.
#[cfg(feature = "files")]
pub(crate) fn spool(in_memory: usize) -> Spool {
    Spool::new(in_memory)
}

/// An empty one.
#[cfg(not(feature = "files"))]
pub(crate) fn spool(_in_memory: usize) -> Spool {
    Spool::default()
}

/// What was written, as the text of a program.
pub(crate) fn into_source(spool: Spool) -> Source<'static> {
    #[cfg(feature = "files")]
    match spool.into_inner() {
        tempfile::SpooledData::InMemory(text) => Source::owned(text.into_inner()),
        tempfile::SpooledData::OnDisk(file) => Source::file(file),
    }
    #[cfg(not(feature = "files"))]
    Source::owned(spool.into_inner())
}
