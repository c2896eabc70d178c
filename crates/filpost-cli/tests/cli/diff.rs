//! `filpost diff` as its users meet it.

use crate::support::{Folder, Ran};

const RIGHT: &str = "%\nN10 G1 X1. Z-4.7 F200.\nM30\n%\n";

fn diff(first: &[u8], second: &[u8], more: &[&str]) -> Ran {
    let place = Folder::new().with("a b.nc", first).with("new.nc", second);
    place.run(&[&["diff", "a b.nc", "new.nc"], more].concat())
}

#[test]
fn programs_that_say_the_same() {
    let output =
        diff(RIGHT.as_bytes(), b"\xef\xbb\xbf%\r\nN10G01X1.000Z-4.70F200.\r\nM30\r\n%", &[]);
    assert_eq!(output.out, "the programs are equivalent\n");
    assert_eq!(output.status, 0);
}

#[test]
fn a_difference_is_shown_side_by_side_and_said() {
    let output = diff(RIGHT.as_bytes(), RIGHT.replace("4.7", "5").as_bytes(), &["--context", "1"]);
    let out = output.out;
    assert!(out.contains("block N10: Z deeper by 0.3 (-5 instead of -4.7)"), "{out}");
    assert!(out.contains("*     2 N10 G1 X1. Z-4.7 F200."), "{out}");
    assert!(out.ends_with("\n1 difference\n"), "{out}");
    assert!(!out.contains('\u{1b}'), "no colours where there is no terminal");
    assert_eq!(output.status, 1);
}

#[test]
fn the_tolerance_and_the_ignore_list_are_used() {
    let second = RIGHT.replace("X1.", "X1.004").replace("N10", "N20").replace("F200", "F100");
    let same = ["--tol", "0.005", "--ignore", "n,f"];
    assert_eq!(diff(RIGHT.as_bytes(), second.as_bytes(), &same).status, 0);
    let output = diff(RIGHT.as_bytes(), second.as_bytes(), &["--tol", "0.003", "--ignore", "n,f"]);
    assert_eq!(output.status, 1);
}

#[test]
fn json_has_the_numbers() {
    let second = RIGHT.replace("4.7", "5");
    let output = diff(RIGHT.as_bytes(), second.as_bytes(), &["--format", "json"]);
    let value: serde_json::Value = serde_json::from_slice(output.out.as_bytes()).expect("JSON");
    assert_eq!(value["equal"], false);
    assert_eq!(value["differences"][0]["kind"], "word");
    assert_eq!(value["differences"][0]["letter"], "Z");
    assert_eq!(value["differences"][0]["values"], serde_json::json!([-4.7, -5.0]));
}

#[test]
fn what_is_no_program_is_refused_with_its_place() {
    let output = diff(RIGHT.as_bytes(), b"? BEGIN\n", &[]);
    assert!(output.err.contains("E0901"), "{}", output.err);
    assert!(output.err.contains("new.nc:1:1"), "{}", output.err);
    assert_eq!((output.status, output.out.len()), (1, 0));
}

#[test]
fn a_wrong_option_is_wrong_usage() {
    for wrong in [["--tol", "-1"], ["--tol", "x"], ["--ignore", "everything"]] {
        assert_eq!(diff(b"", b"", &wrong).status, 2, "{wrong:?}");
    }
}
