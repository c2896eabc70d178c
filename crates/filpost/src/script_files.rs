//! Files of FILEF, TEXT/READ and WRITE/: in granted folders only, and what is
//! written appears only when the whole run went well.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cap_std::ambient_authority;
use cap_std::fs::Dir;
use fil_diag::Diag;
use fil_vm::errors::RunCode as VmCode;
use fil_vm::{FileMode, Files};

use crate::error::{Error, RunCode};
use crate::pending::{NewFile, PendingFiles, Place, escapes};
use crate::{file_names, files};

/// Largest file a script reads, in bytes; it is held in memory.
const LARGEST: u64 = 64 << 20;

/// The folders granted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Folders {
    /// Where scripts read.
    pub read: Option<Folder>,
    /// Where scripts write and delete.
    pub write: Option<Folder>,
}

/// A folder that is held open from the moment it was granted: no name, no `..` and no
/// link leads out of it, whenever it was put there.
#[derive(Clone, Debug)]
pub(crate) struct Folder {
    held: Arc<Dir>,
    /// Its real path, for messages.
    path: PathBuf,
}

impl Folder {
    /// Opens a folder.
    ///
    /// # Errors
    /// E0701 for what is no folder.
    pub fn open(folder: &Path) -> Result<Folder, Error> {
        let cant = |error: io::Error| files::cant_read(folder, &error);
        let path = folder.canonicalize().map_err(cant)?;
        if !path.is_dir() {
            return Err(cant(io::ErrorKind::NotADirectory.into()));
        }
        let held = Dir::open_ambient_dir(&path, ambient_authority()).map_err(cant)?;
        Ok(Folder { held: Arc::new(held), path: files::plain(path) })
    }

    /// The file of a name: one that is there, or could be. On no system has a file of a
    /// script a name that it can't have on another, and capital letters and small ones
    /// are the same in it.
    fn place(&self, name: &str) -> Result<Place, Box<Diag>> {
        let outside =
            |why: &str| Box::new(Diag::new(RunCode::OutsideFolder, format!("'{name}' {why}")));
        // Scripts of Windows name their folders with a backslash.
        let wanted = name.replace('\\', "/");
        if wanted.contains([':', '\0']) {
            return Err(outside("is no name of a file in the folder"));
        }
        if let Some(fault) = wanted.split('/').find_map(file_names::fault) {
            return Err(Box::new(Diag::new(RunCode::FileName, format!("'{name}': {fault}"))));
        }
        let wanted = self.as_on_disk(name, Path::new(&wanted))?;
        Place::below(&self.held, &self.path, &wanted).map_err(|error| match error {
            error if error.kind() == io::ErrorKind::InvalidInput => {
                outside("is no name of a file in the folder")
            }
            error if escapes(&error) => outside("leads out of the folder"),
            error if self.is_dangling(&wanted) => outside(&format!("is {error}")),
            error => cant_read(&self.path.join(&wanted), &error),
        })
    }

    /// The name of the file as its folder has it, where the letters differ by case alone.
    fn as_on_disk(&self, name: &str, wanted: &Path) -> Result<PathBuf, Box<Diag>> {
        let Some(file) = wanted.file_name().and_then(|file| file.to_str()) else {
            return Ok(wanted.into());
        };
        if self.held.symlink_metadata(wanted).is_ok() {
            return Ok(wanted.into());
        }
        let folder = wanted.parent().filter(|folder| !folder.as_os_str().is_empty());
        let Ok(entries) = self.held.read_dir(folder.unwrap_or(Path::new("."))) else {
            return Ok(wanted.into());
        };
        let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
        let mut alike = names.filter(|found| file_names::alike(found, file));
        match (alike.next(), alike.next()) {
            (Some(found), None) => Ok(wanted.with_file_name(found)),
            (Some(one), Some(other)) => {
                let message = format!("'{name}' could be {one} and {other}");
                Err(Box::new(Diag::new(RunCode::FileName, message)))
            }
            _ => Ok(wanted.into()),
        }
    }

    fn is_dangling(&self, name: &Path) -> bool {
        self.held.symlink_metadata(name).is_ok_and(|found| found.is_symlink())
    }
}

/// A file that is open.
#[derive(Debug)]
enum Unit {
    Read { path: PathBuf, text: String, at: usize },
    Write { path: PathBuf },
}

impl Unit {
    fn path(&self) -> &Path {
        match self {
            Unit::Read { path, .. } | Unit::Write { path } => path,
        }
    }
}

/// The files of one run.
#[derive(Debug)]
pub(crate) struct ScriptFiles {
    folders: Arc<Folders>,
    units: [Option<Unit>; 2],
    pending: PendingFiles,
    reads: Vec<PathBuf>,
}

impl ScriptFiles {
    /// No file is open and none is written.
    pub fn new(folders: Arc<Folders>) -> Self {
        ScriptFiles {
            folders,
            units: [None, None],
            pending: PendingFiles::default(),
            reads: Vec::new(),
        }
    }

    /// What the script has written, at the end of its run, and the files that it has read.
    pub fn into_parts(self) -> (PendingFiles, Vec<PathBuf>) {
        (self.pending, self.reads)
    }

    /// The file of a name; what the script has written itself is there already.
    fn place(&self, folder: &Folder, name: &str) -> Result<Place, Box<Diag>> {
        let place = folder.place(name)?;
        if place.metadata().is_ok() {
            return Ok(place);
        }
        Ok(self.pending.alike(place.path()).cloned().unwrap_or(place))
    }

    fn open_to_read(&mut self, name: &str) -> Result<Option<Unit>, Box<Diag>> {
        let folder = self.folders.read.as_ref().ok_or_else(|| not_granted("read"))?;
        let place = self.place(folder, name)?;
        self.refuse_open(place.path())?;
        let Some(bytes) = self.content(&place)? else { return Ok(None) };
        let (text, _) = fil_syntax::decode(&bytes, None).map_err(Box::new)?;
        let path = place.path().to_path_buf();
        if !self.reads.contains(&path) {
            self.reads.push(path.clone());
        }
        Ok(Some(Unit::Read { path, text: text.into_owned(), at: 0 }))
    }

    fn open_to_write(&mut self, name: &str, append: bool) -> Result<Unit, Box<Diag>> {
        let place = self.writable(name)?;
        let path = place.path().to_path_buf();
        let cant = |error: io::Error| cant_write(&path, &error);
        let old = if append { self.content(&place)? } else { None };
        let mut output = NewFile::at(place).map_err(cant)?;
        if let Some(old) = old {
            output.write_all(&old).map_err(cant)?;
            if old.last().is_some_and(|byte| *byte != b'\n') {
                output.write_all(b"\n").map_err(cant)?;
            }
        }
        self.pending.add(output);
        Ok(Unit::Write { path })
    }

    /// A file that may be written or deleted.
    fn writable(&self, name: &str) -> Result<Place, Box<Diag>> {
        let folder = self.folders.write.as_ref().ok_or_else(|| not_granted("write"))?;
        let place = self.place(folder, name)?;
        self.refuse_open(place.path())?;
        match place.metadata() {
            Ok(found) if !found.is_file() || found.permissions().readonly() => {
                Err(cant_write(place.path(), &io::ErrorKind::PermissionDenied.into()))
            }
            _ => Ok(place),
        }
    }

    /// The bytes of a file as the script sees it: what it has written itself, else
    /// what is on the disk; `None` where there is no such file.
    fn content(&mut self, place: &Place) -> Result<Option<Vec<u8>>, Box<Diag>> {
        let cant = |error: io::Error| cant_read(place.path(), &error);
        match self.pending.find(place.path()) {
            Some(None) => return Ok(None),
            Some(Some(written)) => return written.content().map(Some).map_err(cant),
            None => {}
        }
        let found = match place.metadata() {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(cant(error)),
        };
        if !found.is_file() || found.len() > LARGEST {
            let message = format!("no plain file of up to {LARGEST} bytes");
            return Err(cant(io::Error::other(message)));
        }
        place.read().map(Some).map_err(cant)
    }

    /// Refuses a file that the other unit has open: what it reads could change.
    fn refuse_open(&self, path: &Path) -> Result<(), Box<Diag>> {
        if self.units.iter().flatten().any(|unit| unit.path() == path) {
            let message = format!("{} is open already", path.display());
            return Err(Box::new(Diag::new(VmCode::FileUse, message)));
        }
        Ok(())
    }
}

impl Files for ScriptFiles {
    fn open(&mut self, unit: usize, mode: FileMode, name: &str) -> Result<bool, Box<Diag>> {
        let opened = match mode {
            FileMode::Read => self.open_to_read(name)?,
            FileMode::Write => Some(self.open_to_write(name, false)?),
            FileMode::Append => Some(self.open_to_write(name, true)?),
        };
        self.units[unit] = opened;
        Ok(self.units[unit].is_some())
    }

    fn close(&mut self, unit: usize) -> Result<(), Box<Diag>> {
        self.units[unit] = None;
        Ok(())
    }

    fn rewind(&mut self, unit: usize) -> Result<(), Box<Diag>> {
        if let Some(Unit::Read { at, .. }) = &mut self.units[unit] {
            *at = 0;
        }
        Ok(())
    }

    fn delete(&mut self, name: &str) -> Result<bool, Box<Diag>> {
        let place = self.writable(name)?;
        let there = match self.pending.find(place.path()) {
            Some(change) => change.is_some(),
            None => place.metadata().is_ok(),
        };
        if there {
            self.pending.delete(place);
        }
        Ok(there)
    }

    fn at_end(&mut self, unit: usize) -> Result<bool, Box<Diag>> {
        Ok(match &self.units[unit] {
            Some(Unit::Read { text, at, .. }) => *at == text.len(),
            _ => true,
        })
    }

    fn read_line(&mut self, unit: usize) -> Result<Option<String>, Box<Diag>> {
        let Some(Unit::Read { text, at, .. }) = &mut self.units[unit] else { return Ok(None) };
        let rest = &text[*at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let length = rest.find('\n').map_or(rest.len(), |end| end + 1);
        *at += length;
        let line = rest[..length].trim_end_matches('\n').trim_end_matches('\r');
        Ok(Some(line.to_string()))
    }

    fn write_line(&mut self, unit: usize, line: &str) -> Result<(), Box<Diag>> {
        let Some(Unit::Write { path }) = &self.units[unit] else { return Ok(()) };
        let Some(Some(output)) = self.pending.find(path) else { return Ok(()) };
        let done = output.write_all(line.as_bytes()).and_then(|()| output.write_all(b"\n"));
        done.map_err(|error| cant_write(path, &error))
    }
}

fn not_granted(what: &str) -> Box<Diag> {
    Box::new(Diag::new(VmCode::FilesNotGranted, format!("no folder is granted to {what}")))
}

fn cant_read(path: &Path, error: &io::Error) -> Box<Diag> {
    Box::new(Diag::new(RunCode::CantRead, format!("{}: {error}", path.display())))
}

fn cant_write(path: &Path, error: &io::Error) -> Box<Diag> {
    Box::new(Diag::new(RunCode::CantWrite, format!("{}: {error}", path.display())))
}
