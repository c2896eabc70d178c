//! `filpost test`

use crate::support::{Folder, NC, Ran, SMALL};

#[test]
fn cases_are_run_and_brought_up_to_date() {
    let case = "cl = 'part.ncl'\nready = 'fanuc-mill'\noptions.style = 'plain'\nexpect = 'part.tap'\norigin = 'own'\n";
    let place = Folder::new().with("part.ncl", SMALL).with("case.toml", case).with("part.tap", NC);
    let last = |ran: &Ran| ran.out.lines().last().unwrap_or("").to_string();
    let good = place.run(&["test"]);
    assert_eq!((good.status, last(&good).as_str()), (0, "1 passed, 0 failed"));
    let place = place.with("part.tap", NC.replace("S900", "S800"));
    let bad = place.run(&["test", "."]);
    assert_eq!((bad.status, last(&bad).as_str()), (1, "0 passed, 1 failed"));
    assert!(bad.out.contains("-N30 S800 M3\n+N30 S900 M3"), "{}", bad.out);
    let update = place.run(&["test", ".", "--update"]);
    assert_eq!((update.status, last(&update).as_str()), (0, "1 passed, 0 failed"));
    assert!(update.out.contains("+N30 S900 M3"), "{}", update.out);
    assert_eq!(place.text("part.tap").as_deref(), Some(NC));
}

#[test]
fn a_test_run_without_cases_fails() {
    let ran = Folder::new().run(&["test"]);
    assert!(ran.status == 1 && ran.err.contains("E0803"), "{ran:?}");
}
