//! The names of the files in a map.

use std::path::{Component, Path, absolute};

/// How a map calls the files of its run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// The CL file.
    pub cl: String,
    /// The NC program.
    pub nc: String,
    /// The FIL files, in the order they were loaded.
    pub fil: Vec<String>,
}

impl Names {
    /// The name of a file as seen from the folder of the map, with slashes: so
    /// that a map does not depend on where a project lies. A file on another
    /// drive goes by its plain name.
    pub fn from_folder(folder: &Path, file: &Path) -> String {
        relative(folder, file)
            .or_else(|| file.file_name().map(|name| name.to_string_lossy().into_owned()))
            .unwrap_or_else(|| file.display().to_string())
    }
}

fn relative(folder: &Path, file: &Path) -> Option<String> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (folder, file) = (tidy(here)?, tidy(file)?);
    let shared = folder.iter().zip(&file).take_while(|(one, other)| one == other).count();
    // Another drive has no path from here.
    if shared == 0 {
        return None;
    }
    let up = std::iter::repeat_n("..", folder.len() - shared);
    let down = file[shared..].iter().map(|part| part.0.as_str());
    Some(up.chain(down).collect::<Vec<_>>().join("/"))
}

/// The parts of the absolute path without `.` and `..`, and whether each is a
/// folder or file (and not the root or a drive).
fn tidy(path: &Path) -> Option<Vec<(String, bool)>> {
    let mut parts = Vec::new();
    for part in absolute(path).ok()?.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                parts.pop();
            }
            other => {
                let name = other.as_os_str().to_str()?.to_string();
                parts.push((name, matches!(other, Component::Normal(_))));
            }
        }
    }
    Some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_tell_where_a_project_lies() {
        let name = |folder: &str, file: &str| Names::from_folder(Path::new(folder), file.as_ref());
        assert_eq!(name("", "part.ncl"), "part.ncl");
        assert_eq!(name("out", "cl/part one.ncl"), "../cl/part one.ncl");
        assert_eq!(name("a/b", "a/./b/../part.ncl"), "../part.ncl");
        if cfg!(unix) {
            assert_eq!(name("/home/me/out", "/srv/cl/part.ncl"), "../../../srv/cl/part.ncl");
            assert_eq!(name("/home/me/out", "/home/me/cl/part.ncl"), "../cl/part.ncl");
        }
    }
}
