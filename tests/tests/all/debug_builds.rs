//! A debug build of the bytecode does what any other does, and a debugger that looks on
//! changes nothing: each case of the corpus that has FIL ends the same way.

use std::sync::{Arc, Mutex, PoisonError};

use filpost::case::{self, Programs};
use filpost::coverage::{Coverage, Recorder};
use filpost::debug::SharedDebugger;
use filpost_tests::root;

#[test]
fn a_debug_build_writes_the_same_programs() {
    let (plain, debug) = (Programs::new(), Programs::for_debugging());
    let mut coverage = Coverage::default();
    let mut count = 0;
    for case in case::find(&root().join("corpus")).expect("the corpus is there") {
        if case.file.fil.is_empty() {
            continue;
        }
        let recorder = Arc::<Mutex<Recorder>>::default();
        let debugger: SharedDebugger = recorder.clone();
        let watched = case.outcome_debugged(&debug, &debugger);
        assert_eq!(case.outcome_with(&plain), watched, "{}", case.folder.display());
        if let Ok(program) = debug.get(&case) {
            coverage.add(&program, &recorder.lock().unwrap_or_else(PoisonError::into_inner));
            count += 1;
        }
    }
    assert!(count > 50, "only {count} cases have FIL");
    let screw = coverage.files().find(|(name, _)| name.ends_with("screw.fil"));
    let (_, screw) = screw.expect("the corpus runs the script of the paper");
    let share = screw.line_share();
    assert!(share.hit * 10 > share.all * 8, "{share} of the lines of screw.fil have run");
}
