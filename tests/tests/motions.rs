//! One test for each NC program of `tests/motions/`, whose head says what it does.

use std::process::ExitCode;

use filpost_tests::motions::{check, files};
use libtest_mimic::{Arguments, Failed, Trial};

fn main() -> ExitCode {
    let trial = |path: std::path::PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Trial::test(name, move || check(&path).map_err(Failed::from))
    };
    libtest_mimic::run(&Arguments::from_args(), files().into_iter().map(trial).collect())
        .exit_code()
}
