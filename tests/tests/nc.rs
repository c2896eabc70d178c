//! One test for each NC program of `tests/nc/`, whose first line says whether it
//! is refused, and where.

use std::process::ExitCode;

use filpost_tests::nc;
use libtest_mimic::{Arguments, Failed, Trial};

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let trial = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Trial::test(name, move || nc::run(&path).map_err(Failed::from))
    };
    libtest_mimic::run(&arguments, nc::files().into_iter().map(trial).collect()).exit_code()
}
