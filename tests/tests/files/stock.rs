//! One test for each NC program of `tests/stock/`, whose head says what it is cut from and what is
//! found.

use filpost_tests::stock::{check, files};
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let trial = |path: std::path::PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Trial::test(format!("stock/{name}"), move || check(&path).map_err(Failed::from))
    };
    files().into_iter().map(trial).collect()
}
