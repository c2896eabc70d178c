//! INCLUD from files: relative to the including file, and never out of the
//! folders of the FIL files a post is made of.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use fil_vm::Included;

use crate::{file_names, files};

/// Gives INCLUD the files that lie in the folder of one of the FIL files, or
/// below there. A name counts from the folder of the file the INCLUD stands in;
/// a link or a `..` must not lead out. FIL files are known by their path as
/// `display` shows it, which is the name they must have in the builder.
pub fn beside(
    fil: &[PathBuf],
    encoding: Option<&str>,
) -> impl FnMut(&str, &str) -> Result<Included, String> + Send + 'static {
    beside_either(fil, &[], encoding)
}

#[doc(hidden)]
/// The same, and files that are not beside the including file are looked for beside
/// `others`, the option file for one.
pub fn beside_either(
    fil: &[PathBuf],
    others: &[PathBuf],
    encoding: Option<&str>,
) -> impl FnMut(&str, &str) -> Result<Included, String> + Send + 'static {
    let mut known = Known { encoding: encoding.map(String::from), ..Known::default() };
    for path in fil {
        known.add_root(path);
    }
    for path in others {
        known.others.extend(folder_of(path).canonicalize().map(files::plain));
    }
    known.folders.extend(known.others.iter().flat_map(|folder| folder.canonicalize()));
    move |from, name| known.include(from, name)
}

fn folder_of(path: &Path) -> &Path {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// A file that is there; the letters of its own name may differ in case, as files of
/// Windows do.
fn found(path: &Path) -> Option<PathBuf> {
    if path.is_file() {
        return Some(path.to_path_buf());
    }
    let wanted = path.file_name()?.to_str()?;
    let alike = |entry: std::fs::DirEntry| {
        let fits = entry.file_name().to_str().is_some_and(|name| name.eq_ignore_ascii_case(wanted));
        fits.then(|| entry.path()).filter(|path| path.is_file())
    };
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder_of(path)).ok()?.flatten().filter_map(alike).collect();
    // Two that differ by case alone leave the choice open.
    if files.len() == 1 { files.pop() } else { None }
}

/// The files a post has been read from so far.
#[derive(Default)]
struct Known {
    encoding: Option<String>,
    /// Real folders that may be read.
    folders: Vec<PathBuf>,
    /// Folders where files are looked for that are not beside the including one.
    others: Vec<PathBuf>,
    /// From the name of a file to its path as given.
    paths: HashMap<String, PathBuf>,
    /// From a real path to the name of the file.
    names: HashMap<PathBuf, String>,
}

impl Known {
    fn add_root(&mut self, path: &Path) {
        let name = path.display().to_string();
        self.paths.insert(name.clone(), path.to_path_buf());
        self.folders.extend(folder_of(path).canonicalize());
        if let Ok(real) = path.canonicalize() {
            self.names.insert(real, name);
        }
    }

    fn include(&mut self, from: &str, name: &str) -> Result<Included, String> {
        let from = self.paths.get(from).ok_or("its file is not known")?;
        // FIL files of Windows name their folders with a backslash.
        let wanted = name.replace('\\', "/");
        if Path::new(&wanted).has_root() || wanted.contains(':') {
            return Err("only a name relative to the including file can be included".into());
        }
        if let Some(fault) = wanted.split('/').find_map(file_names::fault) {
            return Err(fault.to_string());
        }
        let beside = from.parent().unwrap_or(Path::new("")).join(&wanted);
        let mut places =
            std::iter::once(beside).chain(self.others.iter().map(|other| other.join(&wanted)));
        let path = places
            .find_map(|path| found(&path))
            .ok_or("there is no such file beside the including file")?;
        let real = path.canonicalize().map_err(|error| error.to_string())?;
        if !self.folders.iter().any(|folder| real.starts_with(folder)) {
            return Err("it lies outside of the folder of the FIL file".into());
        }
        let text = files::read_text(&real, self.encoding.as_deref()).map_err(|error| {
            error.diags().iter().map(|diag| diag.message.clone()).collect::<Vec<_>>().join("; ")
        })?;
        let shown = path.display().to_string();
        let name = self.names.entry(real).or_insert(shown).clone();
        self.paths.insert(name.clone(), path);
        Ok(Included { name, text })
    }
}
