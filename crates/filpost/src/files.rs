//! Files: read whole, and written so that they appear under their names only when
//! all went well.

use std::io;
use std::path::{Path, PathBuf};

use fil_diag::Diag;

use crate::error::{Error, RunCode};
#[cfg(feature = "files")]
use crate::pending::{NewFile, PendingFiles};

#[cfg(feature = "files")]
pub use crate::pending::give_up;

/// Reads a whole file.
///
/// # Errors
/// E0701 with the file's name.
pub fn read(path: &Path) -> Result<Vec<u8>, Error> {
    std::fs::read(path).map_err(|error| cant_read(path, &error))
}

/// Reads a text file, in UTF-8 or a code page (guessed unless named).
///
/// # Errors
/// E0701 with the file's name; an unknown or wrong encoding.
pub fn read_text(path: &Path, encoding: Option<&str>) -> Result<String, Error> {
    let bytes = read(path)?;
    let (text, _) = fil_syntax::decode(&bytes, encoding).map_err(Error::setup)?;
    Ok(text.into_owned())
}

/// Writes a file through a neighbour that takes its name at the end.
///
/// # Errors
/// What `write` returns; E0702 for the file itself.
#[cfg(feature = "files")]
pub fn write_whole<T>(
    path: &Path,
    write: impl FnOnce(&mut NewFile) -> Result<T, Error>,
) -> Result<T, Error> {
    let mut file = NewFile::create(path)?;
    let result = write(&mut file)?;
    let mut pending = PendingFiles::default();
    pending.add(file);
    pending.commit()?;
    Ok(result)
}

/// The real path of a file, of its folder where there is no such file yet.
pub fn real_path(path: &Path) -> PathBuf {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    let beside = || Some(parent.canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(beside).unwrap_or_else(|| path.to_path_buf())
}

/// E0701 for a file and the reason.
pub fn cant_read(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantRead, format!("{}: {error}", path.display())))
}

/// E0702 for a file and the reason.
pub fn cant_write(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantWrite, format!("{}: {error}", path.display())))
}
