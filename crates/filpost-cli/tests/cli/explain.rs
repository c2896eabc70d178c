//! `filpost explain`

use crate::support::Folder;

#[test]
fn subjects_are_explained() {
    let place = Folder::new();
    for (subject, expected) in [
        ("E0501", "value does not fit its address"),
        ("W0753", "CL file without records"),
        ("E0801", "--deny-warnings"),
        ("POSTF 13", "processes the current record"),
        ("POSTF(7,n)", "Word n of the current record"),
        ("POSTF 99", "not published"),
        ("DBLCOM 486", "scale.x"),
        ("INTCOM 24", "letter X"),
        ("rapid.split", "INTCOM 1870"),
        ("CYCLE", "major word"),
        ("SQRTF", "quare root"),
        ("grbl", "GRBL"),
    ] {
        let ran = place.run(&["explain", subject]);
        assert_eq!(ran.status, 0, "{subject}: {ran:?}");
        assert!(ran.out.contains(expected), "{subject}: {}", ran.out);
    }
    let unknown = place.run(&["explain", "CYCEL"]);
    assert_eq!((unknown.status, unknown.out.as_str()), (2, ""));
    assert!(unknown.err.contains("did you mean `CYCLE`?"), "{}", unknown.err);
}

#[test]
fn every_code_is_explained() {
    let place = Folder::new();
    for code in filpost::all_codes() {
        let ran = place.run(&["explain", &code.name()]);
        assert!(ran.status == 0 && ran.out.contains(code.reason), "{}: {ran:?}", code.name());
    }
}
