//! One test for each case of `tests/cases/`.

use filpost_tests::cases;
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let trial = |case: cases::Case| {
        Trial::test(format!("cases/{}", case.name), move || case.check().map_err(Failed::from))
    };
    cases::all().into_iter().map(trial).collect()
}
