//! One test for each case folder below `corpus/` and for each FIL file of
//! `tests/language/`. `FILPOST_UPDATE=1` writes the expected NC programs anew.

use std::path::{Path, PathBuf};

use filpost::case::{self, Case, Verdict};
use filpost_tests::{language, root};
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let corpus = root().join("corpus");
    let cases = case::find(&corpus).unwrap_or_else(|error| panic!("{error}"));
    let update = std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1");
    let mut trials: Vec<Trial> =
        cases.into_iter().map(|case| case_trial(&corpus, case, update)).collect();
    trials.extend(language_files().into_iter().map(language_trial));
    trials
}

fn case_trial(corpus: &Path, case: Case, update: bool) -> Trial {
    let folder = case.folder.strip_prefix(corpus).unwrap_or(&case.folder);
    let name = folder.to_string_lossy().replace('\\', "/");
    Trial::test(format!("corpus/{name}"), move || match case.check(update) {
        Verdict::Passed => Ok(()),
        Verdict::Failed(text) => Err(Failed::from(text)),
        Verdict::Updated(text) => {
            eprintln!("{text}");
            Ok(())
        }
    })
}

/// The tests of the language suite; the files below `with/` are loaded by them.
fn language_files() -> Vec<PathBuf> {
    let folder = root().join("tests/language");
    let entries = std::fs::read_dir(&folder).expect("the language suite is there");
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "fil"))
        .collect();
    files.sort();
    files
}

fn language_trial(path: PathBuf) -> Trial {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Trial::test(format!("language/{stem}"), move || language::run(&path).map_err(Failed::from))
}
