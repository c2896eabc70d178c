//! `filpost test` as its users meet it: reports, tolerances, cases made.

use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                  FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";

const NC: &str = "%\nO0007 (7)\nN10 G21 G90 G94 G17\nN20 T1 M6\nN30 S900 M3\n\
                  N40 G1 G43 X1. Y2. Z3. F200. H1\nN50 M30\n%\n";

const CASE: &str = "cl = 'part.ncl'\nready = 'fanuc-mill'\nexpect = 'part.nc'\norigin = 'ours'\n";

fn place(files: &[(&str, &str)]) -> TempDir {
    let place = TempDir::new().expect("a folder for the test");
    for (name, text) in files {
        let path = place.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    }
    place
}

fn filpost(place: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_filpost"))
        .args(arguments)
        .current_dir(place.path())
        .output()
        .expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn read(place: &TempDir, name: &str) -> String {
    std::fs::read_to_string(place.path().join(name)).unwrap_or_default()
}

/// Ten cases of which the seventh fails.
fn ten_cases() -> TempDir {
    let place = place(&[]);
    for number in 0..10 {
        let folder = place.path().join(format!("case-{number}"));
        std::fs::create_dir(&folder).expect("a folder");
        let nc = if number == 7 { NC.replace("Z3.", "Z3.5") } else { NC.to_string() };
        for (name, text) in [("part.ncl", CL), ("case.toml", CASE), ("part.nc", &nc)] {
            std::fs::write(folder.join(name), text).expect("a file");
        }
    }
    place
}

#[test]
fn a_failing_case_is_told_in_words_and_the_rest_goes_on() {
    let place = ten_cases();
    let ran = filpost(&place, &["test", "."]);
    let out = text(&ran.stdout);
    assert_eq!(ran.status.code(), Some(1), "{out}");
    assert!(out.contains("FAILED ./case-7\n"), "{out}");
    assert!(out.contains("block N40: Z deeper by 0.5 (3 instead of 3.5)"), "{out}");
    assert!(out.ends_with("9 passed, 1 failed\n"), "{out}");
}

#[test]
fn reports_for_people_and_for_servers() {
    let place = ten_cases();
    filpost(&place, &["test", ".", "--html", "r.html", "--junit", "r.xml"]);
    let html = read(&place, "r.html");
    assert!(html.starts_with("<!DOCTYPE html>"), "{html}");
    assert!(html.contains("block N40: Z deeper by 0.5 (3 instead of 3.5)"), "{html}");
    assert!(!html.contains("http://") && !html.contains("src="), "it needs no other file");
    let xml = read(&place, "r.xml");
    assert!(xml.contains("tests=\"10\"") && xml.contains("failures=\"1\""), "{xml}");
    assert!(xml.contains("<testcase name=\"case-7\""), "{xml}");
    assert!(xml.contains("message=\"block N40: Z deeper by 0.5"), "{xml}");
}

#[test]
fn update_shows_the_difference_and_writes() {
    let place = ten_cases();
    let ran = filpost(&place, &["test", ".", "--update"]);
    let out = text(&ran.stdout);
    assert!(out.contains("UPDATED ./case-7\n") && out.contains("-N40 G1"), "{out}");
    assert!(out.ends_with("10 passed, 0 failed\n"), "{out}");
    assert_eq!(read(&place, "case-7/part.nc"), NC);
}

#[test]
fn a_tolerance_and_an_ignore_list_forgive() {
    let nc = NC.replace("Z3.", "Z3.004").replace("N40 ", "").replace("(7)", "(8)");
    let with = |more: &str| {
        let case = format!("{CASE}{more}");
        let files = [("part.ncl", CL), ("case.toml", case.as_str()), ("part.nc", nc.as_str())];
        let ran = filpost(&place(&files), &["test", "."]);
        (ran.status.code(), text(&ran.stdout) + &text(&ran.stderr))
    };
    let forgiving = "tolerance = 0.01\nignore = ['n', 'comments']\n";
    assert_eq!(with(forgiving), (Some(0), "1 passed, 0 failed\n".to_string()));
    let (status, out) = with("tolerance = 0.001\nignore = ['n', 'comments']\n");
    assert_eq!(status, Some(1), "{out}");
    assert!(out.contains("Z deeper by 0.004"), "{out}");
    for wrong in ["ignore = ['everything']\n", "tolerance = -1\n"] {
        let (status, out) = with(wrong);
        assert_eq!(status, Some(1), "{out}");
        assert!(out.contains("E0705"), "{out}");
    }
}

#[test]
fn a_difference_of_letters_alone_is_said_to_be_one() {
    let nc = NC.replace("Z3.", "Z3.0");
    let place = place(&[("part.ncl", CL), ("case.toml", CASE), ("part.nc", &nc)]);
    let ran = filpost(&place, &["test", "."]);
    assert_eq!(ran.status.code(), Some(1));
    assert!(text(&ran.stdout).contains("a control reads both alike"), "{}", text(&ran.stdout));
}

#[test]
fn a_listing_is_compared() {
    let case = format!("{CASE}listing = 'part.lst'\n");
    let files = [("part.ncl", CL), ("case.toml", &case), ("part.nc", NC), ("part.lst", "")];
    let place = place(&files);
    let ran = filpost(&place, &["test", "."]);
    assert_eq!(ran.status.code(), Some(1));
    assert!(
        text(&ran.stdout).contains("+      6       6  GOTO / 1.0, 2.0, 3.0"),
        "{}",
        text(&ran.stdout)
    );
    filpost(&place, &["test", ".", "--update"]);
    filpost(&place, &["post", "part.ncl", "-p", "fanuc-mill", "-o", "x.nc", "--listing", "x.lst"]);
    assert_eq!(read(&place, "part.lst"), read(&place, "x.lst"));
    assert_eq!(filpost(&place, &["test", "."]).status.code(), Some(0));
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
        ("part.ncl", CL),
        ("out/part.nc", NC),
        ("m.toml", "name = 'mine'\nseqno.increment = 10\n"),
        ("scripts/all.fil", fil),
        ("scripts/lib/speed.fil", speed),
    ]);
    let arguments: Vec<&str> = INIT.into_iter().chain(["-f", "scripts/all.fil"]).collect();
    let ran = filpost(&place, &arguments);
    let said = text(&ran.stdout) + &text(&ran.stderr);
    assert!(said.starts_with("cases/one is made; "), "{said}");
    assert_eq!(read(&place, "cases/one/part.nc"), NC);
    assert_eq!(read(&place, "cases/one/lib/speed.fil"), speed);
    let toml = read(&place, "cases/one/case.toml");
    assert!(
        toml.contains("machine = \"m.toml\"") && toml.contains("fil = [\"all.fil\"]"),
        "{toml}"
    );
    assert!(toml.contains("ignore = [\"n\"]"), "{toml}");
    let again = filpost(&place, &arguments);
    assert_eq!(again.status.code(), Some(1));
    assert!(text(&again.stderr).contains("E0804"), "{}", text(&again.stderr));
}

#[test]
fn a_case_that_fails_when_it_is_made_says_so() {
    let nc = NC.replace("S900", "S950");
    let place = place(&[("part.ncl", CL), ("part.nc", &nc)]);
    let arguments =
        ["test", "--init", "c", "--cl", "part.ncl", "--nc", "part.nc", "-p", "fanuc-mill"];
    let ran = filpost(&place, &arguments);
    assert_eq!(ran.status.code(), Some(1));
    assert!(text(&ran.stdout).contains("it fails now:"), "{}", text(&ran.stdout));
    assert!(text(&ran.stdout).contains("spindle speed"), "{}", text(&ran.stdout));
}

#[test]
fn a_case_is_not_made_of_two_files_of_one_name() {
    let place = place(&[("part.ncl", CL), ("out/part.ncl", NC)]);
    let arguments =
        ["test", "--init", "c", "--cl", "part.ncl", "--nc", "out/part.ncl", "-p", "fanuc-mill"];
    let ran = filpost(&place, &arguments);
    assert!(text(&ran.stderr).contains("E0805"), "{}", text(&ran.stderr));
    assert!(!Path::exists(&place.path().join("c")), "nothing is left");
    assert_eq!(filpost(&place, &["test", "--init", "c"]).status.code(), Some(2));
}
