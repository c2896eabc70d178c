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
        ("G83", "cycle.deep_code"),
        ("G83", "deep-hole peck drilling"),
        ("preload", "option of ready posts"),
        ("m08", "Standard code for coolant"),
        ("retract", "home.retract_z"),
        ("trunnion", "haas-trunnion"),
        ("tool length offset", "TLO (G43 H, G49)"),
        ("sub-spindles", "SPINDL with SIDE"),
        ("block delete", "OPSKIP"),
        ("feedrate", "FEDRAT"),
        ("cutter comp", "CUTCOM"),
        ("H", "offset number"),
        ("G43 H1", "the tool length offset"),
        ("tool direction zero", "tool.axis_k"),
        ("stopped spindle", "E0534"),
        ("verify", "filpost verify --help"),
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

#[test]
fn no_markdown_is_printed() {
    let place = Folder::new();
    for subject in ["haas-mill", "fanuc-mill-turn", "CYCLE", "SPINDL", "THREAD", "tapping", "TLO"] {
        let ran = place.run(&["explain", subject]);
        for sign in ["](", "```", "|---", "\n#"] {
            assert!(!ran.out.contains(sign), "{subject}: `{sign}` in {}", ran.out);
        }
    }
}

#[test]
fn every_ready_post_is_listed_and_every_command_has_a_manual_page() {
    let place = Folder::new();
    let listed = place.run(&["posts"]);
    for post in filpost::ready::READY {
        assert!(listed.out.contains(&format!("{} ", post.name)), "{}", post.name);
    }
    let page = place.run(&["man", "post"]);
    assert!(page.status == 0 && page.out.contains("listing"), "{page:?}");
    assert_eq!(place.run(&["man", "pots"]).status, 2);
    let completions = place.run(&["completions", "bash"]);
    for name in ["haas-trunnion", "rapid.split", "E0536"] {
        assert!(completions.out.contains(name), "{name}");
    }
}
