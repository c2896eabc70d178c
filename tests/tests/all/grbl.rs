//! Programs of the ready post for GRBL, judged by GRBL's own reader of G-code: `gvalidate` of
//! grbl-sim, which `FILPOST_GVALIDATE` names. It prints `ok` or `error:N` for each line.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use filpost_tests::root;

/// The validator; where there is none, the reason is printed.
fn validator() -> Option<PathBuf> {
    let found = env::var_os("FILPOST_GVALIDATE").map(PathBuf::from);
    if found.is_none() {
        println!("skipped: FILPOST_GVALIDATE does not name gvalidate of grbl-sim");
    }
    found
}

/// Lines that it takes, and what it says of the others.
fn judged(validator: &Path, nc: &str) -> (usize, Vec<String>) {
    let mut file = tempfile::NamedTempFile::new().expect("a file");
    file.write_all(nc.as_bytes()).expect("written");
    let ran = Command::new(validator).arg(file.path()).output().expect("the validator runs");
    let said = String::from_utf8_lossy(&ran.stdout).into_owned();
    let wrong = said.lines().filter(|line| line.starts_with("error")).map(str::to_string);
    (said.lines().filter(|line| line.trim() == "ok").count(), wrong.collect())
}

/// Programs of the corpus for GRBL.
fn programs() -> Vec<(PathBuf, String)> {
    let cases = fs::read_dir(root().join("corpus/mills/grbl")).expect("the cases");
    let files = cases.map(|case| case.expect("an entry").path().join("expected.nc"));
    files.filter_map(|file| fs::read_to_string(&file).ok().map(|nc| (file, nc))).collect()
}

#[test]
fn grbl_takes_each_line_of_its_programs() {
    let programs = programs();
    assert!(programs.len() >= 8, "only {} programs", programs.len());
    let Some(validator) = validator() else { return };
    for (file, nc) in programs {
        let (taken, wrong) = judged(&validator, &nc);
        assert!(wrong.is_empty(), "{}: {wrong:?}\n{nc}", file.display());
        assert!(taken >= nc.lines().count(), "{}: {taken} lines taken", file.display());
    }
}

/// What GRBL refuses must be seen: a tool change, and a full circle that names no axis.
#[test]
fn grbl_refuses_what_it_has_not() {
    let Some(validator) = validator() else { return };
    for wrong in ["T1 M6\n", "G21 G90 G17\nG0 X0 Y0\nG2 I5 J0 F100\n"] {
        assert!(!judged(&validator, wrong).1.is_empty(), "{wrong} was taken");
    }
}
