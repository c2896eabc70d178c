//! The corpus as it comes from a checkout on Windows: lines end with CR LF. All posts and
//! all refusals are the same.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use filpost::case::{Case, Verdict, find};
use filpost_tests::root;
use rayon::prelude::*;

/// Where the cases and what they name lie.
const FOLDERS: [&str; 2] = ["corpus", "fil-scripts"];

/// Copies a folder with CR LF at the ends of lines, except of the files that are `kept`.
fn copy(from: &Path, to: &Path, kept: &HashSet<PathBuf>) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").map(|entry| entry.expect("an entry")) {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &target, kept);
            continue;
        }
        let bytes = fs::read(&path).expect("a file");
        let is_text = std::str::from_utf8(&bytes).is_ok_and(|text| !text.contains('\r'));
        if is_text && !kept.contains(&path) {
            fs::write(&target, String::from_utf8_lossy(&bytes).replace('\n', "\r\n"))
        } else {
            fs::write(&target, bytes)
        }
        .expect("a copy");
    }
}

/// The files that a case compares.
fn expected(case: &Case) -> impl Iterator<Item = PathBuf> {
    case.file.expect.iter().chain(&case.file.listing).map(|name| case.folder.join(name))
}

#[test]
fn the_corpus_with_lines_of_windows_is_the_same() {
    let place = tempfile::tempdir().expect("a folder");
    let cases = find(&root().join("corpus")).expect("the corpus");
    let kept: HashSet<PathBuf> = cases.iter().flat_map(expected).collect();
    for folder in FOLDERS {
        copy(&root().join(folder), &place.path().join(folder), &kept);
    }
    let copies = find(&place.path().join("corpus")).expect("the copy");
    assert_eq!(copies.len(), cases.len());
    let failed: Vec<String> = copies
        .par_iter()
        .filter_map(|case| match case.check(false) {
            Verdict::Passed => None,
            Verdict::Failed(why) | Verdict::Updated(why) => {
                Some(format!("{}: {why}", case.folder.display()))
            }
        })
        .collect();
    assert!(failed.is_empty(), "{} of {}:\n{}", failed.len(), copies.len(), failed.join("\n"));
}
