//! The line a question is about, and the map that knows it.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use fil_diag::Diag;

use crate::error::{Error, RunCode};
use crate::map::MapReader;

/// A line of a file, or a place in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePosition {
    /// The file.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: u64,
    /// The column, from 1 and in characters.
    pub column: Option<u64>,
}

impl FilePosition {
    /// Reads `FILE:LINE` or `FILE:LINE:COLUMN`. The name may hold colons of its
    /// own: of two ways to read it that counts whose file is there. `None` when
    /// no line stands at the end.
    pub fn parse(text: &str) -> Option<FilePosition> {
        let (head, last) = numbered(text)?;
        let short = FilePosition { file: head.into(), line: last, column: None };
        let long = numbered(head).map(|(file, line)| FilePosition {
            file: file.into(),
            line,
            column: Some(last),
        });
        match long {
            Some(long) if long.file.exists() || !short.file.exists() => Some(long),
            _ => Some(short),
        }
    }
}

/// A name with a colon and a number after it.
fn numbered(text: &str) -> Option<(&str, u64)> {
    let (head, number) = text.rsplit_once(':')?;
    let digits = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    let number = number.parse().ok().filter(|_| digits && !head.is_empty())?;
    Some((head, number))
}

/// The map that knows a file: `FILE.map`, else the one map in the folder of the
/// file or in the current one that is of this file.
///
/// # Errors
/// E0710 when there is none, or more than one.
pub fn map_of(file: &Path) -> Result<PathBuf, Error> {
    let beside = PathBuf::from(format!("{}.map", file.display()));
    if beside.is_file() {
        return Ok(beside);
    }
    let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
    let mut maps = maps_in(&folder, file);
    if maps.is_empty() {
        maps = maps_in(Path::new(""), file);
    }
    match &maps[..] {
        [map] => Ok(map.clone()),
        [] => {
            Err(no_map(format!("there is no {} and no other map of this file", beside.display())))
        }
        several => {
            let names: Vec<String> = several.iter().map(|map| map.display().to_string()).collect();
            Err(no_map(format!("several maps are of {}: {}", file.display(), names.join(", "))))
        }
    }
}

fn no_map(message: String) -> Error {
    Error::setup(Diag::new(RunCode::NoMap, message))
}

/// The maps of a folder whose CL or FIL file is this one, sorted.
fn maps_in(folder: &Path, file: &Path) -> Vec<PathBuf> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let Ok(entries) = std::fs::read_dir(here) else { return Vec::new() };
    let names = entries.flatten().map(|entry| folder.join(entry.file_name()));
    let mut maps: Vec<PathBuf> =
        names.filter(|path| path.extension().is_some_and(|ending| ending == "map")).collect();
    maps.retain(|path| is_of(path, file));
    maps.sort();
    maps
}

/// True for a map that names this file.
fn is_of(map: &Path, file: &Path) -> bool {
    const BEGIN: &[u8] = b"{\"filpost-map\"";
    let mut begin = Vec::new();
    let opened = File::open(map).and_then(|f| f.take(BEGIN.len() as u64).read_to_end(&mut begin));
    if opened.is_err() || begin != BEGIN {
        return false;
    }
    let (Ok(reader), Ok(file)) = (MapReader::open(map), file.canonicalize()) else { return false };
    let folder = map.parent().unwrap_or(Path::new(""));
    let mut named = reader.fil().iter().chain([reader.cl(), reader.nc()]);
    named.any(|of| folder.join(&of.name).canonicalize().is_ok_and(|path| path == file))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<(String, u64, Option<u64>)> {
        let place = FilePosition::parse(text)?;
        Some((place.file.display().to_string(), place.line, place.column))
    }

    #[test]
    fn places_are_read_from_the_end() {
        let place = |file: &str, line, column| Some((file.to_string(), line, column));
        assert_eq!(read("part.tap:12"), place("part.tap", 12, None));
        assert_eq!(read("part.tap:12:3"), place("part.tap", 12, Some(3)));
        assert_eq!(read("C:\\nc\\part 1.tap:12"), place("C:\\nc\\part 1.tap", 12, None));
        assert_eq!(read("C:\\nc\\part.tap:12:3"), place("C:\\nc\\part.tap", 12, Some(3)));
        assert_eq!(read("a:b:7"), place("a:b", 7, None));
        for none in ["part.tap", "part.tap:", "part.tap:x", ":3", "", "C:\\part.tap", "a:-1"] {
            assert_eq!(read(none), None, "{none}");
        }
    }

    #[test]
    fn of_two_readings_the_one_with_a_file_counts() {
        let folder = tempfile::TempDir::new().unwrap();
        let odd = folder.path().join("part:12");
        if std::fs::write(&odd, "").is_err() {
            println!("skipped: no colons in names here");
            return;
        }
        let text = format!("{}:3", odd.display());
        assert_eq!(read(&text), Some((odd.display().to_string(), 3, None)));
    }
}
