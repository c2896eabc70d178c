//! `filpost test` as its users meet it: reports, tolerances.

use crate::support::{Folder, NC, SMALL};

const CASE: &str = "cl = 'part.ncl'\nready = 'fanuc-mill'\noptions.style = 'plain'\nexpect = 'part.nc'\norigin = 'ours'\n";

fn place(files: &[(&str, &str)]) -> Folder {
    files.iter().fold(Folder::new(), |place, (name, text)| place.with(name, text))
}

/// Ten cases of which the seventh fails.
fn ten_cases() -> Folder {
    let mut place = Folder::new();
    for number in 0..10 {
        let nc = if number == 7 { NC.replace("Z3.", "Z3.5") } else { NC.to_string() };
        for (name, text) in [("part.ncl", SMALL), ("case.toml", CASE), ("part.nc", &nc)] {
            place = place.with(&format!("case-{number}/{name}"), text);
        }
    }
    place
}

#[test]
fn a_failing_case_is_told_in_words_and_the_rest_goes_on() {
    let place = ten_cases();
    let ran = place.run(&["test", "."]);
    let out = ran.out;
    assert_eq!(ran.status, 1, "{out}");
    assert!(out.contains("FAILED ./case-7\n"), "{out}");
    assert!(out.contains("block N40: Z deeper by 0.5 (3 instead of 3.5)"), "{out}");
    assert!(out.ends_with("9 passed, 1 failed\n"), "{out}");
}

#[test]
fn reports_for_people_and_for_servers() {
    let place = ten_cases();
    place.run(&["test", ".", "--html", "r.html", "--junit", "r.xml"]);
    let html = place.text("r.html").unwrap_or_default();
    assert!(html.starts_with("<!DOCTYPE html>"), "{html}");
    assert!(html.contains("block N40: Z deeper by 0.5 (3 instead of 3.5)"), "{html}");
    assert!(html.contains("<svg") && html.contains("proven program"), "{html}");
    assert!(!html.contains("src=") && !html.contains("<link"), "it needs no other file");
    let row = "<th>6</th><td class=\"gone\">N40 G1 G43 X1. Y2. <mark>Z3.5 </mark>F200. H1</td>\
               <th>6</th><td class=\"new\">N40 G1 G43 X1. Y2. <mark>Z3. </mark>F200. H1</td>";
    assert!(html.contains(row), "{html}");
    assert!(
        html.contains("<th>5</th><td>N30 S900 M3</td><th>5</th><td>N30 S900 M3</td>"),
        "{html}"
    );
    let xml = place.text("r.xml").unwrap_or_default();
    assert!(xml.contains("tests=\"10\"") && xml.contains("failures=\"1\""), "{xml}");
    assert!(xml.contains("<testcase name=\"case-7\""), "{xml}");
    assert!(xml.contains("message=\"block N40: Z deeper by 0.5"), "{xml}");
}

#[test]
fn texts_of_programs_are_texts_in_the_report() {
    let nc = NC.replace("(7)", "(</td><script>1</script> \u{424}\u{440}\u{435}\u{437}\u{430})");
    let place = place(&[("part.ncl", SMALL), ("case.toml", CASE), ("part.nc", &nc)]);
    assert_eq!(place.run(&["test", ".", "--html", "r.html"]).status, 1);
    let html = place.text("r.html").unwrap_or_default();
    assert!(html.contains("(&lt;/td&gt;&lt;script&gt;1&lt;/script&gt; \u{424}"), "{html}");
    assert!(!html.contains("<script>"), "{html}");
    assert!(
        html.contains("Content-Security-Policy") && html.contains("default-src 'none'"),
        "{html}"
    );
}

#[test]
fn update_shows_the_difference_and_writes() {
    let place = ten_cases();
    let ran = place.run(&["test", ".", "--update"]);
    let out = ran.out;
    assert!(out.contains("UPDATED ./case-7\n") && out.contains("-N40 G1"), "{out}");
    assert!(out.ends_with("10 passed, 0 failed\n"), "{out}");
    assert_eq!(place.text("case-7/part.nc").unwrap_or_default(), NC);
}

#[test]
fn a_tolerance_and_an_ignore_list_forgive() {
    let nc = NC.replace("Z3.", "Z3.004").replace("N40 ", "").replace("(7)", "(8)");
    let with = |more: &str| {
        let case = format!("{CASE}{more}");
        let files = [("part.ncl", SMALL), ("case.toml", case.as_str()), ("part.nc", nc.as_str())];
        let ran = place(&files).run(&["test", "."]);
        (ran.status, ran.out + &ran.err)
    };
    let forgiving = "tolerance = 0.01\nignore = ['n', 'comments']\n";
    assert_eq!(with(forgiving), (0, "1 passed, 0 failed\n".to_string()));
    let (status, out) = with("tolerance = 0.001\nignore = ['n', 'comments']\n");
    assert_eq!(status, 1, "{out}");
    assert!(out.contains("Z deeper by 0.004"), "{out}");
    for wrong in ["ignore = ['everything']\n", "tolerance = -1\n"] {
        let (status, out) = with(wrong);
        assert_eq!(status, 1, "{out}");
        assert!(out.contains("E0705"), "{out}");
    }
}

#[test]
fn a_difference_of_letters_alone_is_said_to_be_one() {
    let nc = NC.replace("Z3.", "Z3.0");
    let place = place(&[("part.ncl", SMALL), ("case.toml", CASE), ("part.nc", &nc)]);
    let ran = place.run(&["test", "."]);
    assert_eq!(ran.status, 1);
    assert!(ran.out.contains("a control reads both alike"), "{}", ran.out);
}

#[test]
fn a_program_whose_lines_end_with_cr_lf_passes_its_case() {
    let machine = "base = 'fanuc-mill'\ntape.line_end = 2\n[options]\nstyle = 'plain'\n";
    let case = "cl = 'part.ncl'\nmachine = 'machine.toml'\nexpect = 'part.nc'\norigin = 'ours'\n";
    let files = [("part.ncl", SMALL), ("machine.toml", machine), ("case.toml", case)];
    let place = place(&files);
    place.run(&["test", ".", "--update"]);
    assert!(place.text("part.nc").is_some_and(|text| text.contains("\r\n")));
    let ran = place.run(&["test", "."]);
    assert_eq!(ran.status, 0, "{}", ran.out);
}

#[test]
fn a_listing_is_compared() {
    let case = format!("{CASE}listing = 'part.lst'\n");
    let files = [("part.ncl", SMALL), ("case.toml", &case), ("part.nc", NC), ("part.lst", "")];
    let place = place(&files);
    let ran = place.run(&["test", "."]);
    assert_eq!(ran.status, 1);
    assert!(ran.out.contains("+      6       6  GOTO / 1.0, 2.0, 3.0"), "{}", ran.out);
    place.run(&["test", ".", "--update"]);
    let plain = "--option=style=plain";
    place.run(&["post", "part.ncl", "-p", "fanuc-mill", plain, "-o", "x.nc", "--listing", "x.lst"]);
    assert_eq!(place.text("part.lst").unwrap_or_default(), place.text("x.lst").unwrap_or_default());
    assert_eq!(place.run(&["test", "."]).status, 0);
}
