//! `filpost test --coverage`, `--mutate` and `filpost post --profile`

use crate::support::{Folder, NC, SMALL};

/// Line 3 runs and its condition is never true; the section for CYCLE never runs.
const FIL: &str = "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nIF(POSTF(7,4).GT.5)OPSTOP\nCIMFIL/OFF\n\
                   CIMFIL/ON,CYCLE\nDO/LA,II=1,3\nPPRINT/'HOLE'\nLA) CONTIN\nCIMFIL/OFF\nFINI\n";

const CASE: &str = "cl = 'part.ncl'\nready = 'fanuc-mill'\noptions.style = 'plain'\nfil = ['post.fil']\n\
                    expect = 'part.tap'\norigin = 'own'\n";

fn place() -> Folder {
    let folder = Folder::new().with("part.ncl", SMALL).with("post.fil", FIL);
    folder.with("case.toml", CASE).with("part.tap", NC)
}

#[test]
fn what_no_case_runs_is_named() {
    let place = place();
    let ran =
        place.run(&["test", ".", "--coverage", "--lcov", "c.info", "--coverage-html", "c.html"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    for said in [
        "1 passed, 0 failed",
        "lines 2 of 5 (40 %), outcomes of conditions 1 of 4 (25 %), sections and macros 1 of 2 (50 %)",
        "  line 5: the section CYCLE never ran",
        "  lines that never ran: 6-8",
        "  line 3: the condition was never true",
    ] {
        assert!(ran.out.contains(said), "{said}:\n{}", ran.out);
    }
    assert!(!ran.out.contains("the DO"), "a DO that never ran has no outcome:\n{}", ran.out);
    let lcov = place.text("c.info").expect("the tracefile is there");
    for line in [
        "FN:5,section CYCLE",
        "FNDA:0,section CYCLE",
        "DA:3,1",
        "DA:7,0",
        "BRDA:3,3,0,0",
        "BRDA:3,3,1,1",
        "BRDA:6,6,0,-",
        "LF:5",
        "LH:2",
    ] {
        assert!(lcov.lines().any(|known| known == line), "{line}:\n{lcov}");
    }
    let source = lcov.lines().find_map(|line| line.strip_prefix("SF:")).expect("a file");
    assert!(std::path::Path::new(source).is_absolute(), "{source}");
    let page = place.text("c.html").expect("the page is there");
    assert!(page.contains("class=\"miss\"") && page.contains("the condition was never true"));
}

#[test]
fn reports_of_coverage_need_coverage_and_never_overwrite_a_case() {
    let place = place();
    assert_eq!(place.run(&["test", ".", "--lcov", "c.info"]).status, 2);
    let over = place.run(&["test", ".", "--coverage", "--lcov", "post.fil"]);
    assert_eq!(over.status, 1, "{over:?}");
    assert_eq!(place.text("post.fil").as_deref(), Some(FIL));
}

#[test]
fn changes_that_no_case_notices_are_named() {
    let ran = place().run(&["test", ".", "--mutate"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    for said in [
        "post.fil:5: the section is dropped: no case notices it",
        "post.fil:3: the constant 5 becomes 6: no case notices it",
        "post.fil:6: the constant 3 becomes 4: no case runs the line",
    ] {
        assert!(ran.out.contains(said), "{said}:\n{}", ran.out);
    }
    // An OPSTOP more is seen, and so is a tool change that never comes.
    let turned = "post.fil:3: the condition POSTF(7,4).GT.5 is turned";
    assert!(!ran.out.contains(turned), "{}", ran.out);
    let last = ran.out.lines().last().unwrap_or_default();
    assert!(
        last.starts_with("changes: ") && last.ends_with("2 in lines that no case runs"),
        "{last}"
    );
}

#[test]
fn settings_that_no_case_notices_are_named() {
    let machine = "base = 'fanuc-mill'\n[cycle]\ndrill_code = 181\n[spindle]\ncw_code = 13\n";
    let case = CASE
        .replace("ready = 'fanuc-mill'\noptions.style = 'plain'\n", "machine = 'machine.toml'\n");
    let place = place().with("machine.toml", machine).with("case.toml", case);
    let place = place.with("part.tap", NC.replace("S900 M3", "S900 M13"));
    let ran = place.run(&["test", ".", "--coverage"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    // The CL file turns the spindle, drills no hole, has no feed and one work offset.
    let unnoticed: Vec<&str> = ran
        .out
        .lines()
        .filter_map(|line| line.split_once("machine.toml: no case notices "))
        .map(|(_, said)| said)
        .collect();
    let settings =
        ["cycle.drill_code", "feed.inverse_format", "feed.upm_format", "fixture.extended_code"];
    assert_eq!(unnoticed, settings.map(|setting| format!("{setting} at its default")));
}

#[test]
fn a_profile_tells_of_words_sections_and_lines() {
    let place = place();
    let ran = place.run(&[
        "post",
        "part.ncl",
        "-p",
        "fanuc-mill",
        "--option=style=plain",
        "-f",
        "post.fil",
        "--profile=p.svg",
        "-o",
        "out.nc",
    ]);
    assert_eq!(ran.status, 0, "{ran:?}");
    for said in ["GOTO", "section LOADTL", "post.fil:3", "own time"] {
        assert!(ran.err.contains(said), "{said}:\n{}", ran.err);
    }
    assert_eq!(place.text("out.nc").as_deref(), Some(NC), "the program is the same");
    let svg = place.text("p.svg").expect("the picture is there");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{svg}");
    assert!(svg.contains("<title>section LOADTL: "), "{svg}");
    let over = place.run(&["post", "part.ncl", "-p", "fanuc-mill", "--profile=part.ncl"]);
    assert_eq!(over.status, 1, "{over:?}");
    assert_eq!(place.text("part.ncl").as_deref(), Some(SMALL));
}
