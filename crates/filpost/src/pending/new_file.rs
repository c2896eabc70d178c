//! A file in the making: a neighbour of the file whose name it will take.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use cap_std::fs::{Dir, OpenOptions, Permissions};

use super::place::Place;
use super::unfinished::{self, Action, Ticket};
use crate::error::Error;
use crate::files::{self, cant_write};

/// Buffer between the post and the file; blocks that come in pieces of this
/// size pass it by.
const BUFFER: usize = 64 * 1024;

/// Names that are tried.
const TRIES: u32 = 1000;

/// A file that is written under another name until [`PendingFiles::commit`]. Dropping it
/// takes it away.
///
/// [`PendingFiles::commit`]: super::PendingFiles::commit
#[derive(Debug)]
pub struct NewFile {
    place: Place,
    beside: PathBuf,
    output: BufWriter<File>,
    /// The rights of the old file of that name.
    rights: Option<Permissions>,
    ticket: Option<Ticket>,
}

impl NewFile {
    /// Begins a file beside the one of this path.
    ///
    /// # Errors
    /// E0702 for a folder that is not there, a name that a folder has, a file that may
    /// not be written; E0720 on Windows for a name that a file can't have there.
    pub fn create(path: &Path) -> Result<NewFile, Error> {
        files::refuse_name(path, cfg!(windows))?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        if path.is_dir() {
            return Err(cant_write(path, &io::ErrorKind::IsADirectory.into()));
        }
        if !folder.is_dir() {
            let reason = format!("there is no folder {}", folder.display());
            return Err(cant_write(path, &io::Error::other(reason)));
        }
        let made = Place::ambient(path).and_then(NewFile::at);
        made.map_err(|error| cant_write(path, &error))
    }

    /// Begins a file beside the one of this name in or below a folder; no link leads out
    /// of it.
    ///
    /// # Errors
    /// E0702
    pub fn create_below(folder: &Path, name: &Path) -> Result<NewFile, Error> {
        let open = || {
            let held = Dir::open_ambient_dir(folder, cap_std::ambient_authority())?;
            Place::below(&Arc::new(held), folder, name).and_then(NewFile::at)
        };
        open().map_err(|error| cant_write(&folder.join(name), &error))
    }

    pub(crate) fn at(place: Place) -> io::Result<NewFile> {
        let rights = match place.metadata() {
            Ok(old) if old.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(old) if old.permissions().readonly() => {
                return Err(io::ErrorKind::PermissionDenied.into());
            }
            // A link or a device is replaced by a file of its own rights.
            Ok(old) => Some(old.permissions()).filter(|_| old.is_file()),
            Err(_) => None,
        };
        for _ in 0..TRIES {
            let beside = place.sibling(&free_name());
            let action = Action::Remove { folder: place.folder.clone(), name: beside.clone() };
            let mut options = OpenOptions::new();
            options.write(true).create_new(true);
            match unfinished::with(action, || place.folder.open_with(&beside, &options)) {
                Ok((file, ticket)) => {
                    let output = BufWriter::with_capacity(BUFFER, file.into_std());
                    return Ok(NewFile { place, beside, output, rights, ticket: Some(ticket) });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    pub(crate) fn place(&self) -> &Place {
        &self.place
    }

    /// What has been written so far.
    pub(crate) fn content(&mut self) -> io::Result<Vec<u8>> {
        self.output.flush()?;
        self.place.folder.read(&self.beside)
    }

    /// Writes out what is buffered. The file gets the rights of the old one of its name,
    /// or those of any new file.
    pub(super) fn complete(&mut self) -> Result<(), Error> {
        let mut write = || {
            self.output.flush()?;
            match self.rights.take() {
                Some(rights) => self.place.folder.set_permissions(&self.beside, rights),
                None => Ok(()),
            }
        };
        write().map_err(|error| cant_write(self.place.path(), &error))
    }

    /// Hands over where it lies; whoever takes it takes it away.
    pub(super) fn into_parts(mut self) -> (Place, PathBuf, Option<Ticket>) {
        (self.place.clone(), std::mem::take(&mut self.beside), self.ticket.take())
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.output.write(bytes)
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.output.write_all(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        if let Some(ticket) = self.ticket.take() {
            ticket.run();
        }
    }
}

/// A name that no other file has.
pub(super) fn free_name() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    format!(".filpost-{}-{count}.tmp", process::id())
}
