//! Messages and exit statuses of all commands.

use crate::support::{Folder, Ran, SMALL, WRONG};

#[test]
fn colours_only_where_they_are_wanted() {
    let place = Folder::new().with("part.ncl", WRONG);
    for (name, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
        let output = place.command(&["post", "part.ncl"]).env(name, value).output();
        let ran = Ran::of(output.expect("the command starts"));
        assert!(!ran.err.contains('\u{1b}'), "{name}: {}", ran.err);
    }
}

#[test]
fn messages_cannot_steer_the_terminal() {
    let cl = "UNITS / MM\nCYCLE / SIDE\u{1b}[2JWAYS, 3\nFINI\n";
    let ran = Folder::new().with("part.ncl", cl).run(&["post", "part.ncl"]);
    assert_eq!(ran.status, 1, "{ran:?}");
    assert!(!ran.err.contains('\u{1b}'), "{:?}", ran.err);
}

#[test]
fn wrong_usage_has_its_own_status() {
    let place = Folder::new();
    for arguments in [&[][..], &["fly"], &["post"], &["post", "a", "--fast"]] {
        assert_eq!(place.run(arguments).status, 2, "{arguments:?}");
    }
    let version = place.run(&["--version"]);
    let facts: Vec<&str> = version.out.lines().collect();
    let [name, commit, target, build] = facts[..] else { panic!("{}", version.out) };
    assert_eq!(name, concat!("filpost ", env!("CARGO_PKG_VERSION")));
    assert!(commit.starts_with("commit: "), "{commit}");
    assert!(target.starts_with(&format!("target: {}", std::env::consts::ARCH)), "{target}");
    assert!(build.starts_with("build: "), "{build}");
    assert_eq!(place.run(&["-V"]).out.trim_end(), name);
    let completions = place.run(&["completions", "bash"]);
    assert!(completions.status == 0 && completions.out.contains("--deny-warnings"));
}

#[test]
fn messages_look_as_they_should() {
    let place = Folder::new()
        .with("form.ncl", WRONG)
        .with("open.fil", "CIMFIL/ON,COOLNT\nIF(AA.EQ.1) THEN\nOPSTOP\nCIMFIL/OFF\nFINI\n")
        .with("stack.fil", "CIMFIL/ON,SPINDL\nBB=SQRTF(0-1)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("part.ncl", SMALL);
    insta::assert_snapshot!("refused_record", place.run(&["post", "form.ncl"]).err);
    insta::assert_snapshot!("open_block", place.run(&["check", "open.fil"]).err);
    insta::assert_snapshot!(
        "fil_run_time",
        place.run(&["post", "part.ncl", "-f", "stack.fil"]).err
    );
}
