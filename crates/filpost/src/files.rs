//! Files: read whole, and written so that they appear under their names only when
//! all went well.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use fil_diag::Diag;
use tempfile::NamedTempFile;

use crate::error::{Error, RunCode};

/// Buffer between the post and the file; blocks that come in pieces of this
/// size pass it by.
const BUFFER: usize = 64 * 1024;

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
pub fn write_whole<T>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> Result<T, Error>,
) -> Result<T, Error> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    if path.is_dir() {
        return Err(cant_write(path, &io::Error::from(io::ErrorKind::IsADirectory)));
    }
    if std::fs::metadata(path).is_ok_and(|found| found.permissions().readonly()) {
        return Err(cant_write(path, &io::Error::from(io::ErrorKind::PermissionDenied)));
    }
    if !folder.is_dir() {
        let reason = format!("there is no folder {}", folder.display());
        return Err(cant_write(path, &io::Error::other(reason)));
    }
    let mut beside = NamedTempFile::new_in(folder).map_err(|error| cant_write(path, &error))?;
    let mut output = BufWriter::with_capacity(BUFFER, beside.as_file_mut());
    let result = write(&mut output)?;
    output.flush().map_err(|error| cant_write(path, &error))?;
    drop(output);
    keep_rights(path, beside.as_file())?;
    beside.persist(path).map_err(|error| cant_write(path, &error.error))?;
    Ok(result)
}

/// The new file gets the rights of the old one of that name, or those of any
/// new file.
pub(crate) fn keep_rights(path: &Path, file: &File) -> Result<(), Error> {
    let rights = match std::fs::metadata(path) {
        Ok(old) => old.permissions(),
        Err(_) => new_file_rights(),
    };
    file.set_permissions(rights).map_err(|error| cant_write(path, &error))
}

#[cfg(unix)]
fn new_file_rights() -> std::fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    std::fs::Permissions::from_mode(0o644)
}

#[cfg(not(unix))]
fn new_file_rights() -> std::fs::Permissions {
    let here = std::env::temp_dir();
    std::fs::metadata(here).expect("the folder of temporary files exists").permissions()
}

/// E0701 for a file and the reason.
pub fn cant_read(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantRead, format!("{}: {error}", path.display())))
}

/// E0702 for a file and the reason.
pub fn cant_write(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantWrite, format!("{}: {error}", path.display())))
}
