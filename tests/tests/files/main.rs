//! Tests that are files: each file of the corpus, of a suite or of the how-to pages is a
//! test of its own. `cargo test -p filpost-tests --test files words/` runs those of a suite.

mod audit;
mod cases;
mod corpus;
mod diff;
mod howto;
mod lints;
mod motions;
mod stock;
mod words;

use libtest_mimic::Arguments;

fn main() {
    let suites = [
        audit::trials,
        cases::trials,
        corpus::trials,
        diff::trials,
        howto::trials,
        lints::trials,
        motions::trials,
        stock::trials,
        words::trials,
    ];
    let trials = suites.iter().flat_map(|suite| suite()).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
