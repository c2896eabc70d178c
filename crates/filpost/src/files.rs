//! Files: read whole, and written so that they appear under their names only when
//! all went well.

use std::io;
use std::path::{Path, PathBuf};

use fil_diag::Diag;

use crate::error::{Error, RunCode};
use crate::file_names;
#[cfg(feature = "files")]
use crate::pending::{NewFile, PendingFiles};

#[cfg(feature = "files")]
pub use crate::pending::give_up;

/// The files of a post in a folder: its `machine.toml`, and `post.fil` or, where there is none,
/// all files that end with `.fil`, by name.
///
/// # Errors
/// E0701 for a folder that can't be read.
pub fn of_post(folder: &Path) -> Result<(PathBuf, Vec<PathBuf>), Error> {
    let main = folder.join("post.fil");
    let fil = if main.is_file() { vec![main] } else { fil_of(folder)? };
    Ok((folder.join("machine.toml"), fil))
}

fn fil_of(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder).map_err(|error| cant_read(folder, &error))?;
    let is_fil = |path: &PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        ending.is_some_and(|ending| ending.eq_ignore_ascii_case("fil")) && path.is_file()
    };
    let mut fil: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(is_fil).collect();
    fil.sort();
    Ok(fil)
}

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

/// Refuses the name of a file, or of a folder to be, that it can't have on Windows.
/// Elsewhere any name of the user's choice is good.
///
/// # Errors
/// E0720
pub fn refuse_name(path: &Path, windows: bool) -> Result<(), Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match file_names::fault(&name).filter(|_| windows) {
        None => Ok(()),
        Some(fault) => {
            let message = format!("{}: {fault}", path.display());
            Err(Error::setup(Diag::new(RunCode::FileName, message)))
        }
    }
}

/// Refuses to write a file that a run reads.
///
/// # Errors
/// E0702
pub fn refuse_over<'p>(
    output: &Path,
    mut inputs: impl Iterator<Item = &'p Path>,
) -> Result<(), Error> {
    let real = real_path(output);
    if inputs.any(|input| real_path(input) == real) { Err(taken(output)) } else { Ok(()) }
}

/// E0702 for a file that has another part in the run.
pub(crate) fn taken(path: &Path) -> Error {
    cant_write(path, &io::Error::other("this run reads or writes it itself"))
}

/// A real path as a user writes it: Windows puts `\\?\` before the ones it finds.
pub fn plain(real: PathBuf) -> PathBuf {
    let text = real.to_string_lossy();
    match text.strip_prefix(r"\\?\") {
        Some(share) if share.starts_with(r"UNC\") => format!(r"\\{}", &share[4..]).into(),
        // A drive; what else there is has no other name.
        Some(drive) if drive.as_bytes().get(1) == Some(&b':') => drive.into(),
        _ => real,
    }
}

/// E0701 for a file and the reason.
pub fn cant_read(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantRead, format!("{}: {error}", path.display())))
}

/// E0702 for a file and the reason.
pub fn cant_write(path: &Path, error: &io::Error) -> Error {
    Error::setup(Diag::new(RunCode::CantWrite, format!("{}: {error}", path.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn real_paths_of_windows_are_shown_as_users_write_them() {
        let shown = |path: &str| plain(path.into()).display().to_string();
        assert_eq!(shown(r"\\?\C:\posts\a.fil"), r"C:\posts\a.fil");
        assert_eq!(shown(r"\\?\UNC\server\share\a.fil"), r"\\server\share\a.fil");
        assert_eq!(shown(r"\\?\Volume{1}\a.fil"), r"\\?\Volume{1}\a.fil");
        assert_eq!(shown("/posts/a.fil"), "/posts/a.fil");
    }

    #[test]
    fn names_of_devices_are_refused_where_they_are_devices() {
        let code = |path: &str, windows| {
            refuse_name(Path::new(path), windows).err().map(|error| error.diags()[0].code.name())
        };
        for path in ["out/COM1.NC", "nul.nc", "out/part.", "out/a:b.nc"] {
            assert_eq!(code(path, true).as_deref(), Some("E0720"), "{path}");
            assert_eq!(code(path, false), None, "{path}");
        }
        for path in ["out/part.nc", "../part.nc", "con/part.nc"] {
            assert_eq!(code(path, true), None, "{path}");
        }
    }
}
