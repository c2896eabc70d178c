//! Files of FILEF, TEXT/READ and WRITE/: in granted folders only, and what is
//! written appears only when the whole run went well.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use fil_diag::Diag;
use fil_vm::errors::RunCode as VmCode;
use fil_vm::{FileMode, Files};
use tempfile::NamedTempFile;

use crate::error::{Error, RunCode};
use crate::files;

/// Largest file a script reads, in bytes; it is held in memory.
const LARGEST: u64 = 64 << 20;

/// The folders granted, as real paths.
#[derive(Clone, Debug, Default)]
pub(crate) struct Folders {
    /// Where scripts read.
    pub read: Option<PathBuf>,
    /// Where scripts write and delete.
    pub write: Option<PathBuf>,
}

/// What becomes of a file when the run went well.
#[derive(Debug)]
enum Change {
    /// It gets the content of the neighbour.
    Written(BufWriter<NamedTempFile>),
    /// It goes away.
    Deleted,
}

/// Files a script has written or deleted, not yet under their names. Dropping
/// this leaves everything as it was.
#[derive(Debug, Default)]
pub struct PendingFiles {
    changes: Vec<(PathBuf, Change)>,
}

impl PendingFiles {
    /// The files that will be written or deleted, in order.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.changes.iter().map(|(path, _)| path.as_path())
    }

    /// Gives the files their names and deletes those that are to go.
    ///
    /// # Errors
    /// E0702 for a file that can't be written or deleted.
    pub fn commit(mut self) -> Result<(), Error> {
        for (path, change) in &mut self.changes {
            if let Change::Written(output) = change {
                output.flush().map_err(|error| files::cant_write(path, &error))?;
                files::keep_rights(path, output.get_ref().as_file())?;
            }
        }
        for (path, change) in self.changes {
            match change {
                Change::Written(output) => {
                    let (beside, _) = output.into_parts();
                    beside
                        .persist(&path)
                        .map_err(|error| files::cant_write(&path, &error.error))?;
                }
                Change::Deleted => match fs::remove_file(&path) {
                    Err(error) if error.kind() != io::ErrorKind::NotFound => {
                        return Err(files::cant_write(&path, &error));
                    }
                    _ => {}
                },
            }
        }
        Ok(())
    }

    fn find(&mut self, path: &Path) -> Option<&mut Change> {
        self.changes.iter_mut().find(|(known, _)| known == path).map(|(_, change)| change)
    }

    fn set(&mut self, path: PathBuf, change: Change) {
        self.changes.retain(|(known, _)| *known != path);
        self.changes.push((path, change));
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
}

impl ScriptFiles {
    /// No file is open and none is written.
    pub fn new(folders: Arc<Folders>) -> Self {
        ScriptFiles { folders, units: [None, None], pending: PendingFiles::default() }
    }

    /// What the script has written, at the end of its run.
    pub fn into_pending(self) -> PendingFiles {
        self.pending
    }

    fn open_to_read(&mut self, name: &str) -> Result<Option<Unit>, Box<Diag>> {
        let folder = self.folders.read.as_deref().ok_or_else(|| not_granted("read"))?;
        let path = resolve(folder, name)?;
        self.refuse_open(&path)?;
        let content = self.content(&path)?;
        content
            .map(|bytes| {
                let (text, _) = fil_syntax::decode(&bytes, None).map_err(Box::new)?;
                Ok(Unit::Read { path, text: text.into_owned(), at: 0 })
            })
            .transpose()
    }

    fn open_to_write(&mut self, name: &str, append: bool) -> Result<Unit, Box<Diag>> {
        let path = self.writable(name)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let cant = |error: io::Error| cant_write(&path, &error);
        let beside = NamedTempFile::new_in(folder).map_err(cant)?;
        let mut output = BufWriter::new(beside);
        if append && let Some(old) = self.content(&path)? {
            output.write_all(&old).map_err(cant)?;
            if old.last().is_some_and(|byte| *byte != b'\n') {
                output.write_all(b"\n").map_err(cant)?;
            }
        }
        self.pending.set(path.clone(), Change::Written(output));
        Ok(Unit::Write { path })
    }

    /// The path of a file that may be written or deleted.
    fn writable(&self, name: &str) -> Result<PathBuf, Box<Diag>> {
        let folder = self.folders.write.as_deref().ok_or_else(|| not_granted("write"))?;
        let path = resolve(folder, name)?;
        self.refuse_open(&path)?;
        match fs::metadata(&path) {
            Ok(found) if !found.is_file() || found.permissions().readonly() => {
                Err(cant_write(&path, &io::Error::from(io::ErrorKind::PermissionDenied)))
            }
            _ => Ok(path),
        }
    }

    /// The bytes of a file as the script sees it: what it has written itself, else
    /// what is on the disk; `None` where there is no such file.
    fn content(&mut self, path: &Path) -> Result<Option<Vec<u8>>, Box<Diag>> {
        let cant = |error: io::Error| cant_read(path, &error);
        let at = match self.pending.find(path) {
            Some(Change::Deleted) => return Ok(None),
            Some(Change::Written(output)) => {
                output.flush().map_err(cant)?;
                output.get_ref().path().to_path_buf()
            }
            None => path.to_path_buf(),
        };
        let found = match fs::metadata(&at) {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(cant(error)),
        };
        if !found.is_file() || found.len() > LARGEST {
            let message = format!("no plain file of up to {LARGEST} bytes");
            return Err(cant(io::Error::other(message)));
        }
        fs::read(&at).map(Some).map_err(cant)
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
        let path = self.writable(name)?;
        let there = match self.pending.find(&path) {
            Some(Change::Written(_)) => true,
            Some(Change::Deleted) => false,
            None => path.exists(),
        };
        if there {
            self.pending.set(path, Change::Deleted);
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
        let Some(Change::Written(output)) = self.pending.find(path) else { return Ok(()) };
        let done = output.write_all(line.as_bytes()).and_then(|()| output.write_all(b"\n"));
        done.map_err(|error| cant_write(path, &error))
    }
}

/// The real path of a name in a folder: the file, or the place where it would be.
/// Neither `..` nor a link leads out.
fn resolve(folder: &Path, name: &str) -> Result<PathBuf, Box<Diag>> {
    let outside =
        |why: &str| Box::new(Diag::new(RunCode::OutsideFolder, format!("'{name}' {why}")));
    // Scripts of Windows name their folders with a backslash.
    let wanted = name.replace('\\', "/");
    let relative = Path::new(&wanted);
    let plain = relative.components().all(|part| matches!(part, Component::Normal(_)));
    let Some(file) = relative.file_name().filter(|_| plain) else {
        return Err(outside("is no name of a file in the folder"));
    };
    if wanted.contains([':', '\0']) {
        return Err(outside("is no name of a file in the folder"));
    }
    let parent = folder.join(relative).parent().unwrap_or(folder).to_path_buf();
    let parent = parent.canonicalize().map_err(|error| cant_read(&parent, &error))?;
    let path = parent.join(file);
    let real = match path.canonicalize() {
        Ok(real) => real,
        Err(_) if path.is_symlink() => return Err(outside("is a link to nothing")),
        Err(_) => path,
    };
    if real.starts_with(folder) { Ok(real) } else { Err(outside("leads out of the folder")) }
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

/// The real path of a folder that is to be granted.
///
/// # Errors
/// E0701 for what is no folder.
pub(crate) fn real_folder(folder: &Path) -> Result<PathBuf, Error> {
    let real = folder.canonicalize().map_err(|error| files::cant_read(folder, &error))?;
    if real.is_dir() {
        Ok(real)
    } else {
        Err(files::cant_read(folder, &io::Error::from(io::ErrorKind::NotADirectory)))
    }
}
