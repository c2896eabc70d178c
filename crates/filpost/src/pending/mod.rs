//! Files that wait until all has gone well, and then take their names together.

mod new_file;
mod place;
mod undo;
mod unfinished;

use std::path::{Path, PathBuf};

pub use new_file::NewFile;
pub(crate) use place::{Place, escapes};
pub use unfinished::give_up;

use crate::error::Error;
use crate::file_names::alike;
use crate::files::real_path;
use undo::Undo;

/// What becomes of a file when the run went well.
#[derive(Debug)]
enum Change {
    /// It gets the content of the neighbour.
    Written(NewFile),
    /// It goes away.
    Deleted(Place),
}

impl Change {
    fn place(&self) -> &Place {
        match self {
            Change::Written(file) => file.place(),
            Change::Deleted(place) => place,
        }
    }
}

/// Files that are written or deleted, not yet under their names. Dropping this leaves
/// everything as it was.
#[derive(Debug, Default)]
pub struct PendingFiles {
    changes: Vec<Change>,
}

impl PendingFiles {
    /// The files that will be written or deleted, in order.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.changes.iter().map(|change| change.place().path())
    }

    /// Adds a file, in place of what was to become of one of its name.
    pub fn add(&mut self, file: NewFile) {
        self.set(Change::Written(file));
    }

    /// Gives the files their names and deletes those that are to go: all of them or none.
    ///
    /// # Errors
    /// E0702 for a file that can't be written or deleted; all is then as it was.
    pub fn commit(self) -> Result<(), Error> {
        self.commit_then(|| Ok(()))
    }

    /// The same with a last step, such as writing to a stream; when it fails, all files
    /// are as they were.
    ///
    /// # Errors
    /// E0702 for a file that can't be written or deleted; what `last` returns.
    pub fn commit_then(mut self, last: impl FnOnce() -> Result<(), Error>) -> Result<(), Error> {
        for change in &mut self.changes {
            if let Change::Written(file) = change {
                file.complete()?;
            }
        }
        let mut undo = Undo::default();
        for change in self.changes {
            match change {
                Change::Written(file) => undo.put(file)?,
                Change::Deleted(place) => undo.delete(place)?,
            }
        }
        last()?;
        undo.forget();
        Ok(())
    }

    pub(crate) fn delete(&mut self, place: Place) {
        self.set(Change::Deleted(place));
    }

    fn set(&mut self, change: Change) {
        self.changes.retain(|known| known.place().path() != change.place().path());
        self.changes.push(change);
    }

    /// What is to become of a file: its new content, or `Some(None)` when it goes away.
    pub(crate) fn find(&mut self, path: &Path) -> Option<Option<&mut NewFile>> {
        let change = self.changes.iter_mut().find(|known| known.place().path() == path)?;
        Some(match change {
            Change::Written(file) => Some(file),
            Change::Deleted(_) => None,
        })
    }

    /// The file whose path differs from this one by case alone, or not at all.
    pub(crate) fn alike(&self, path: &Path) -> Option<&Place> {
        let path = path.to_string_lossy();
        let mut places = self.changes.iter().map(Change::place);
        places.find(|known| alike(&known.path().to_string_lossy(), &path))
    }

    /// Refuses a file of a script that the run reads or writes itself.
    ///
    /// # Errors
    /// E0702
    pub(crate) fn refuse(&self, taken: &[&Path]) -> Result<(), Error> {
        let taken: Vec<PathBuf> = taken.iter().map(|path| real_path(path)).collect();
        match self.paths().find(|path| taken.contains(&real_path(path))) {
            None => Ok(()),
            Some(path) => Err(crate::files::taken(path)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Write;

    use tempfile::TempDir;

    use super::*;

    fn folder() -> TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("old"), "old").unwrap();
        fs::write(folder.path().join("gone"), "gone").unwrap();
        folder
    }

    fn new(folder: &TempDir, name: &str) -> NewFile {
        let mut file = NewFile::create(&folder.path().join(name)).unwrap();
        file.write_all(b"new").unwrap();
        file
    }

    /// The files of a folder with their texts.
    fn content(folder: &TempDir) -> Vec<(String, String)> {
        let entries = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap());
        let mut content: Vec<_> = entries
            .map(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                (name, fs::read_to_string(entry.path()).unwrap())
            })
            .collect();
        content.sort();
        content
    }

    fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect()
    }

    fn pending(folder: &TempDir) -> PendingFiles {
        let mut pending = PendingFiles::default();
        pending.add(new(folder, "old"));
        pending.add(new(folder, "fresh"));
        pending.delete(Place::ambient(&folder.path().join("gone")).unwrap());
        pending
    }

    #[test]
    fn files_take_their_names_together() {
        let folder = folder();
        pending(&folder).commit().unwrap();
        assert_eq!(content(&folder), pairs(&[("fresh", "new"), ("old", "new")]));
    }

    #[test]
    fn files_that_are_dropped_leave_nothing() {
        let folder = folder();
        drop(pending(&folder));
        assert_eq!(content(&folder), pairs(&[("gone", "gone"), ("old", "old")]));
    }

    #[test]
    fn a_last_step_that_fails_brings_all_back() {
        let folder = folder();
        let failed = || Err(crate::files::cant_write(Path::new("x"), &std::io::Error::other("no")));
        assert!(pending(&folder).commit_then(failed).is_err());
        assert_eq!(content(&folder), pairs(&[("gone", "gone"), ("old", "old")]));
    }

    #[test]
    fn a_file_that_cant_take_its_name_brings_all_back() {
        let (one, two) = (folder(), folder());
        let mut pending = pending(&one);
        pending.add(new(&two, "fresh"));
        // Somebody takes the file in the making away.
        let made = fs::read_dir(two.path()).unwrap().map(|entry| entry.unwrap().path());
        let made = made.filter(|path| path.extension().is_some_and(|ending| ending == "tmp"));
        made.for_each(|path| fs::remove_file(path).unwrap());
        assert!(pending.commit().is_err());
        for folder in [one, two] {
            assert_eq!(content(&folder), pairs(&[("gone", "gone"), ("old", "old")]));
        }
    }

    #[test]
    fn the_last_of_two_changes_of_a_file_counts() {
        let folder = folder();
        let mut pending = pending(&folder);
        pending.delete(Place::ambient(&folder.path().join("old")).unwrap());
        pending.add(new(&folder, "gone"));
        pending.commit().unwrap();
        assert_eq!(content(&folder), pairs(&[("fresh", "new"), ("gone", "new")]));
    }
}
