//! Files of FILEF, TEXT/READ and WRITE/ where the crate is built without the feature `files`:
//! no folder can be granted, so no value of these types exists, and scripts that ask for
//! a file are refused (E0321).

use std::path::PathBuf;
use std::sync::Arc;

use crate::pending::PendingFiles;

/// The folders granted: none can be.
#[derive(Debug)]
pub(crate) enum Folders {}

/// The files of one run: no run has any.
#[derive(Debug)]
pub(crate) enum ScriptFiles {}

impl ScriptFiles {
    pub fn new(folders: Arc<Folders>) -> Self {
        match *folders {}
    }

    pub fn into_parts(self) -> (PendingFiles, Vec<PathBuf>) {
        match self {}
    }
}
