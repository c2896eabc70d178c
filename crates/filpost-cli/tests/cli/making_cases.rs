//! `filpost test --init`: cases made from files that are there.

use crate::support::{Folder, NC, SMALL};

fn place(files: &[(&str, &str)]) -> Folder {
    files.iter().fold(Folder::new(), |place, (name, text)| place.with(name, text))
}

const INIT: [&str; 10] = [
    "test",
    "--init",
    "cases/one",
    "--cl",
    "part.ncl",
    "--nc",
    "out/part.nc",
    "-m",
    "m.toml",
    "--ignore=n",
];

#[test]
fn a_case_is_made_from_files_that_are_there() {
    let fil = "INCLUD/'lib/speed.fil'\nFINI\n";
    let speed = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nCIMFIL/OFF\n";
    let place = place(&[
        ("part.ncl", SMALL),
        ("out/part.nc", NC),
        ("m.toml", "name = 'mine'\nseqno.increment = 10\n"),
        ("scripts/all.fil", fil),
        ("scripts/lib/speed.fil", speed),
    ]);
    let arguments: Vec<&str> = INIT.into_iter().chain(["-f", "scripts/all.fil"]).collect();
    let ran = place.run(&arguments);
    let said = ran.out + &ran.err;
    assert!(said.starts_with("cases/one is made; "), "{said}");
    assert_eq!(place.text("cases/one/part.nc").unwrap_or_default(), NC);
    let toml = place.text("cases/one/case.toml").unwrap_or_default();
    assert!(
        toml.contains("machine = \"../../m.toml\"")
            && toml.contains("fil = [\"../../scripts/all.fil\"]"),
        "{toml}"
    );
    assert!(toml.contains("ignore = [\"n\"]"), "{toml}");
    let again = place.run(&arguments);
    assert_eq!(again.status, 1);
    assert!(again.err.contains("E0804"), "{}", again.err);
}

#[test]
fn a_case_tests_what_becomes_of_the_post() {
    let place = Folder::new();
    place.run(&["new", "own", "--base", "haas-mill"]);
    let place = place.with("part.ncl", SMALL);
    place.run(&["post", "part.ncl", "-p", "own", "-o", "part.nc"]);
    let nc = ["--nc", "part.nc", "-p", "own"];
    let made = ["test", "--init", "own/cases/two", "--cl", "part.ncl"];
    let ran = place.run(&[&made[..], &nc[..]].concat());
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    assert_eq!(place.run(&["test", "own"]).out, "2 passed, 0 failed\n");
    let machine = place.text("own/machine.toml").unwrap_or_default();
    let place = place.with("own/machine.toml", format!("seqno.increment = 5\n{machine}"));
    let ran = place.run(&["test", "own"]);
    assert!(ran.out.ends_with("0 passed, 2 failed\n"), "{}{}", ran.out, ran.err);
}

#[test]
fn a_case_that_fails_when_it_is_made_says_so() {
    let nc = NC.replace("S900", "S950");
    let place = place(&[("part.ncl", SMALL), ("part.nc", &nc)]);
    let arguments =
        ["test", "--init", "c", "--cl", "part.ncl", "--nc", "part.nc", "-p", "fanuc-mill"];
    let ran = place.run(&arguments);
    assert_eq!(ran.status, 1);
    assert!(ran.out.contains("it fails now:"), "{}", ran.out);
    assert!(ran.out.contains("spindle speed"), "{}", ran.out);
}

#[test]
fn a_case_is_not_made_of_two_files_of_one_name() {
    let place = place(&[("part.ncl", SMALL), ("out/part.ncl", NC)]);
    let arguments =
        ["test", "--init", "c", "--cl", "part.ncl", "--nc", "out/part.ncl", "-p", "fanuc-mill"];
    let ran = place.run(&arguments);
    assert!(ran.err.contains("E0805"), "{}", ran.err);
    assert!(!place.0.path().join("c").exists(), "nothing is left");
    assert_eq!(place.run(&["test", "--init", "c"]).status, 2);
}

/// A script that writes the date and what a table holds.
const READS: &str = "CIMFIL/ON,PARTNO\nDMY=POSTF(13)\nT1=TEXT/DATEF()\nINSERT/'(',T1,')'\n\
                     DMY=FILEF(1,READ,'deep/speeds.txt')\nT2=TEXT/READ,1\nINSERT/'(',T2,')'\n\
                     DMY=FILEF(1,CLOSE)\nCIMFIL/OFF\nFINI\n";

const READING: [&str; 15] = [
    "test",
    "--init",
    "cases/one",
    "--cl",
    "part.ncl",
    "--nc",
    "part.nc",
    "-p",
    "fanuc-mill",
    "--option",
    "style=plain",
    "-f",
    "post.fil",
    "--set-clock",
    "2026-01-31T12:00:00",
];

fn reading() -> Folder {
    let nc = "%\nO0007 (7)\nN10 G90 G94 G17\nN20 (2026-01-31)\nN30 (T1 8000)\nN40 G21\nN50 T1 M6\n\
              N60 S900 M3\nN70 G1 G43 X1. Y2. Z3. F200. H1\nN80 M30\n%\n";
    place(&[
        ("part.ncl", SMALL),
        ("part.nc", nc),
        ("post.fil", READS),
        ("tables/deep/speeds.txt", "T1 8000\n"),
        ("tables/other.txt", "\u{444}\u{440}\u{435}\u{437}\u{430}\n"),
    ])
}

#[test]
fn a_case_has_the_clock_and_the_folder_of_its_script() {
    let place = reading();
    let arguments: Vec<&str> = READING.into_iter().chain(["--grant", "read=tables"]).collect();
    let ran = place.run(&arguments);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let toml = place.text("cases/one/case.toml").unwrap_or_default();
    assert!(toml.contains("read = \"tables\"\nclock = \"2026-01-31T12:00:00\"\n"), "{toml}");
    assert_eq!(place.text("cases/one/tables/deep/speeds.txt").as_deref(), Some("T1 8000\n"));
    assert!(place.text("cases/one/tables/other.txt").is_some());
    // What the script reads was copied.
    std::fs::remove_dir_all(place.0.path().join("tables")).expect("the folder goes");
    let again = place.run(&["test", "cases"]);
    assert_eq!(again.out, "1 passed, 0 failed\n", "{}", again.err);
}

#[test]
fn a_case_without_its_grants_says_what_is_missing() {
    let place = reading();
    let ran = place.run(&READING);
    assert_eq!(ran.status, 1);
    assert!(
        ran.out.contains("it fails now:") && ran.out.contains("no folder is granted"),
        "{}",
        ran.out
    );
}

#[test]
fn a_folder_that_cant_be_part_of_a_case_is_refused() {
    let place = reading();
    let link = place.0.path().join("tables/link");
    #[cfg(unix)]
    std::os::unix::fs::symlink("/etc/passwd", &link).expect("a link");
    #[cfg(not(unix))]
    std::fs::write(&link, vec![0; 65 << 20]).expect("a large file");
    let arguments: Vec<&str> = READING.into_iter().chain(["--grant", "read=tables"]).collect();
    let ran = place.run(&arguments);
    assert!(ran.status == 1 && ran.err.contains("E0810"), "{}", ran.err);
    assert!(!place.0.path().join("cases").exists(), "nothing is left");
    for wrong in ["write=tables", "tables", "read="] {
        let arguments: Vec<&str> = READING.into_iter().chain(["--grant", wrong]).collect();
        assert_eq!(place.run(&arguments).status, 2, "{wrong}");
    }
}

/// The files of a case may lie in its folder already; those of others are not replaced.
#[test]
fn files_that_are_there_stay_as_they_are() {
    let place = place(&[("c/part.ncl", SMALL), ("c/part.nc", NC), ("other.nc", "M30\n")]);
    let arguments = [
        "test",
        "--init",
        "c",
        "--cl",
        "c/part.ncl",
        "--nc",
        "c/part.nc",
        "-p",
        "fanuc-mill",
        "--option=style=plain",
    ];
    let ran = place.run(&arguments);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    assert_eq!(place.text("c/part.ncl").as_deref(), Some(SMALL));
    let place = place.with("d/part.ncl", "another part").with("d/part.nc", NC);
    let arguments =
        ["test", "--init", "d", "--cl", "c/part.ncl", "--nc", "d/part.nc", "-p", "fanuc-mill"];
    let ran = place.run(&arguments);
    assert!(ran.status == 1 && ran.err.contains("E0805"), "{}", ran.err);
    assert_eq!(place.text("d/part.ncl").as_deref(), Some("another part"));
    assert_eq!(place.text("d/case.toml"), None);
}

#[test]
fn a_case_that_cant_be_written_leaves_nothing() {
    let place = place(&[("part.ncl", SMALL), ("part.nc", NC), ("c/part.nc/x", "")]);
    let arguments =
        ["test", "--init", "c", "--cl", "part.ncl", "--nc", "part.nc", "-p", "fanuc-mill"];
    let ran = place.run(&arguments);
    assert_eq!(ran.status, 1, "{}", ran.out);
    assert!(ran.err.contains("E070"), "{}", ran.err);
    assert_eq!((place.text("c/part.ncl"), place.text("c/case.toml")), (None, None));
}
