//! The lint suite: a FIL file whose header comment lists what `filpost check`
//! must say of it, each finding with its line.
//!
//! ```text
//! $$ lint: W0231 at 7      a finding
//! $$ post: fanuc-mill      the machine; without it there is none
//! $$ strict                extensions of filpost are refused
//! ```

use std::path::{Path, PathBuf};

use filpost::check::{self, Options};
use filpost::{Diag, Program, files};

/// Compares the findings of a file with its header, which must list them all.
///
/// # Errors
/// Findings that are not listed, or listed ones that are not there.
pub fn run(path: &Path) -> Result<(), String> {
    let text = files::read_text(path, None).map_err(|error| error.to_string())?;
    let mut expected = listed(&text);
    let header = |key: &str| text.lines().find_map(|line| line.strip_prefix(key));
    let post = header("$$ post: ").map(|name| Program::builder().generic(name.trim()).build());
    let post = post.transpose().map_err(|error| error.to_string())?;
    let options = Options {
        strict: header("$$ strict").is_some(),
        machine: post.as_ref().map(Program::commons),
        ..Options::default()
    };
    let diags = check::check(&[("a.fil", &text)], options);
    let mut found = found(&diags);
    expected.sort();
    found.sort();
    if found == expected {
        return Ok(());
    }
    let said: Vec<String> = diags.iter().map(Diag::to_string).collect();
    Err(format!("listed: {expected:?}\nfound:  {found:?}\n{}", said.join("\n")))
}

/// The findings a header lists, `W0231 at 7`.
pub fn listed(text: &str) -> Vec<String> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("$$ lint: "));
    lines.map(|line| line.trim().to_string()).collect()
}

/// Findings as a header lists them.
pub fn found(diags: &[Diag]) -> Vec<String> {
    diags
        .iter()
        .map(|diag| {
            let line = diag.spans.first().map_or(0, |place| place.line);
            format!("{} at {line}", diag.code.name())
        })
        .collect()
}

/// The FIL files of a folder and of those below, by name.
pub fn fil_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        let entries = std::fs::read_dir(&folder).expect("the folder is there");
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "fil") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
