//! One test for each audit of `tests/audit/`.

use filpost_tests::audit::{check, files};
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let trial = |path: std::path::PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Trial::test(format!("audit/{name}"), move || check(&path).map_err(Failed::from))
    };
    files().into_iter().map(trial).collect()
}
