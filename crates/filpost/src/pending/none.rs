//! Files of scripts where the crate is built without the feature `files`: there are none.

use std::path::Path;

use crate::error::Error;

/// Files that are written or deleted, not yet under their names. Built without the feature
/// `files` the crate writes none.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct PendingFiles {}

impl PendingFiles {
    /// The files that will be written or deleted: none.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        std::iter::empty()
    }

    /// Gives the files their names.
    ///
    /// # Errors
    /// None without files.
    pub fn commit(self) -> Result<(), Error> {
        Ok(())
    }
}
