//! NC programs of `tests/nc/`: what stands in a first line
//! `(error: E0901 at 3:4)` must be said of them, nothing without such a line.

use std::path::{Path, PathBuf};

use filpost::Diag;

use crate::root;

/// The programs, by name.
///
/// # Panics
/// When the folder is not there.
pub fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("tests/nc")).expect("tests/nc is there");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

/// What the first line of a program says it is refused with.
///
/// # Panics
/// When the file can't be read.
pub fn listed(path: &Path) -> Option<String> {
    let bytes = std::fs::read(path).expect("a program");
    let text = String::from_utf8_lossy(&bytes);
    let listed = text.lines().next()?.strip_prefix("(error: ")?.strip_suffix(')')?;
    Some(listed.to_string())
}

/// The first thing that is refused in a program.
pub fn refusal(name: &str, text: &str) -> Option<Diag> {
    let mut lines = text.lines().zip(1..);
    let refused = lines
        .find_map(|(line, number)| fil_nc::text::read_block(line.as_bytes(), name, number).err());
    refused.map(|diag| *diag)
}

/// Checks a program against its first line.
///
/// # Errors
/// What is said of it instead.
pub fn run(path: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let said = refusal("out.nc", &text).map(|diag| {
        let place =
            diag.places.first().map(|place| format!(" at {}:{}", place.line, place.column()));
        format!("{}{}", diag.code.name(), place.unwrap_or_default())
    });
    if said == listed(path) { Ok(()) } else { Err(format!("{said:?}")) }
}
