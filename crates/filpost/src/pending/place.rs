//! A file by its folder, which is held open, and its name in there.

use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use cap_std::ambient_authority;
use cap_std::fs::Dir;

/// A file in a folder that is held open: a link that is put in the way later leads
/// nowhere out of it.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(super) folder: Arc<Dir>,
    pub(super) name: PathBuf,
    path: PathBuf,
}

impl Place {
    /// A file of any folder, whose name is not a link.
    pub fn ambient(path: &Path) -> io::Result<Self> {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let parent = parent.unwrap_or(Path::new("."));
        let folder = Dir::open_ambient_dir(parent, ambient_authority())?;
        let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        Ok(Place { folder: Arc::new(folder), name: name.into(), path: path.to_path_buf() })
    }

    /// A file in or below a folder, whose path is for messages. Links are followed, as
    /// long as they stay below the folder.
    ///
    /// # Errors
    /// [`escapes`] tells those of a name that leads out.
    pub fn below(folder: &Arc<Dir>, at: &Path, name: &Path) -> io::Result<Self> {
        let plain = name.components().all(|part| matches!(part, Component::Normal(_)));
        let Some(file) = name.file_name().filter(|_| plain) else {
            return Err(io::ErrorKind::InvalidInput.into());
        };
        let name = match folder.canonicalize(name) {
            Ok(real) => real,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if folder.symlink_metadata(name).is_ok_and(|found| found.is_symlink()) {
                    return Err(io::Error::new(io::ErrorKind::NotFound, "a link to nothing"));
                }
                match name.parent().filter(|parent| !parent.as_os_str().is_empty()) {
                    Some(parent) => folder.canonicalize(parent)?.join(file),
                    None => file.into(),
                }
            }
            Err(error) => return Err(error),
        };
        let path = at.join(&name);
        Ok(Place { folder: folder.clone(), name, path })
    }

    /// Its path, for messages and to tell files apart.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What lies there now; a link is followed.
    pub fn metadata(&self) -> io::Result<cap_std::fs::Metadata> {
        self.folder.metadata(&self.name)
    }

    /// Something has the name, were it a link to nothing.
    ///
    /// # Errors
    /// The way there leads out of the folder now.
    pub fn is_taken(&self) -> io::Result<bool> {
        match self.folder.symlink_metadata(&self.name) {
            Ok(_) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// All bytes of the file.
    pub fn read(&self) -> io::Result<Vec<u8>> {
        self.folder.read(&self.name)
    }

    /// Another name in the same folder.
    pub(super) fn sibling(&self, name: &str) -> PathBuf {
        self.name.with_file_name(name)
    }
}

/// The error is that of a name which leads out of its folder.
pub(crate) fn escapes(error: &io::Error) -> bool {
    let refused = error.kind() == io::ErrorKind::PermissionDenied;
    error.kind() == io::ErrorKind::InvalidInput || refused && error.raw_os_error().is_none()
}
