//! `--allow CODE`

use crate::support::{Folder, SMALL};

/// Sends LOADTL on inside a block without its end.
const OPEN: &str = "CIMFIL/ON,LOADTL\nIF(POSTF(7,4).EQ.1)THEN\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

#[test]
fn a_block_open_around_the_record_is_refused_until_it_is_allowed() {
    let place = Folder::new().with("part.ncl", SMALL).with("post.fil", OPEN);
    let post = ["post", "part.ncl", "-f", "post.fil", "-o", "part.nc"];
    let refused = place.run(&post);
    assert!(refused.status == 1 && refused.err.contains("E0223"), "{refused:?}");
    assert_eq!(place.text("part.nc"), None);
    let allowed = place.run(&[&post[..], &["--allow", "E0223"]].concat());
    assert!(allowed.status == 0 && allowed.err.contains("W0150"), "{allowed:?}");
    assert!(place.text("part.nc").expect("a program").contains("T1 M6"));
    for (name, status) in [("check", 1), ("post", 1)] {
        let input = if name == "check" { vec!["post.fil"] } else { post[1..].to_vec() };
        let ran = place.run(&[&[name][..], &input, &["--allow", "W0150"]].concat());
        assert_eq!(ran.status, status, "{ran:?}");
    }
    let check = ["check", "post.fil", "--allow", "e0223", "--allow", "W0150", "--allow", "W0220"];
    let checked = place.run(&check);
    assert_eq!((checked.status, checked.err.trim()), (0, "1 file: 0 errors, 0 warnings"));
}

#[test]
fn an_allowed_warning_is_none_to_deny() {
    let fil = "SIMFIL/ON,COOLNT\nAA=NOSUCH\nCIMFIL/OFF\nFINI\n";
    let cl = SMALL.replace("FINI", "COOLNT / ON\nFINI");
    let place = Folder::new().with("part.ncl", cl).with("post.fil", fil);
    let post = ["post", "part.ncl", "-f", "post.fil", "--deny-warnings"];
    assert_eq!(place.run(&post).status, 1);
    let one = place.run(&[&post[..], &["--allow", "W0151"]].concat());
    assert!(one.status == 1 && one.err.contains("1 warning"), "{one:?}");
    // W0309 comes while the script runs.
    let both = place.run(&[&post[..], &["--allow", "W0151", "--allow", "W0309"]].concat());
    assert_eq!(both.status, 0, "{both:?}");
}

#[test]
fn an_error_that_stands_is_wrong_usage() {
    let place = Folder::new().with("post.fil", OPEN);
    for code in ["E0501", "E9999", "nonsense"] {
        let ran = place.run(&["check", "post.fil", "--allow", code]);
        assert_eq!(ran.status, 2, "{ran:?}");
    }
}
