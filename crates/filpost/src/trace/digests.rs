//! The digests of the files of a question, each made once.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::thread;

use crate::error::Error;
use crate::files;
use crate::map::Digest;

/// Digests by path.
#[derive(Default)]
pub(super) struct Digests(BTreeMap<PathBuf, Digest>);

impl Digests {
    /// Makes those of the files that are there, side by side. What can't be read is said
    /// when it is asked for.
    pub fn of_all(paths: impl Iterator<Item = PathBuf>) -> Digests {
        let mut paths: Vec<PathBuf> = paths.filter(|path| path.is_file()).collect();
        paths.sort();
        paths.dedup();
        let made = thread::scope(|scope| {
            let threads: Vec<_> = paths.iter().map(|path| scope.spawn(|| digest(path))).collect();
            let made = threads.into_iter().map(|thread| thread.join().ok()?.ok());
            made.collect::<Vec<_>>()
        });
        Digests(
            paths.into_iter().zip(made).filter_map(|(path, made)| Some((path, made?))).collect(),
        )
    }

    /// The digest of a file.
    ///
    /// # Errors
    /// E0701
    pub fn of(&mut self, path: &Path) -> Result<Digest, Error> {
        if let Some(digest) = self.0.get(path) {
            return Ok(digest.clone());
        }
        let digest = digest(path)?;
        self.0.insert(path.to_path_buf(), digest.clone());
        Ok(digest)
    }
}

fn digest(path: &Path) -> Result<Digest, Error> {
    let cant = |error| files::cant_read(path, &error);
    Digest::of_reader(File::open(path).map_err(cant)?).map_err(cant)
}
