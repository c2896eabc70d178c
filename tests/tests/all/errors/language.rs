//! Codes of FIL: files, functions, limits.

use filpost::{Limits, Program, files};
use filpost_tests::examples::PART;

use super::{building, names};

#[test]
fn e0107_line_too_long() {
    assert_eq!(building(&format!("$$ {}\nFINI\n", "x".repeat(16_384))), ["E0107"]);
}

#[test]
fn e0108_file_too_large() {
    assert_eq!(building(&" \n".repeat((32 << 20) + 1)), ["E0108"]);
}

#[test]
fn e0109_too_many_errors() {
    let codes = building(&"A=(\n".repeat(200));
    assert_eq!((codes.len(), codes.last().map(String::as_str)), (101, Some("E0109")));
}

#[test]
fn e0120_and_e0121_encodings() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.fil");
    std::fs::write(&path, b"$$ \xff\nFINI\n").expect("a file");
    let refused = |encoding| names(&files::read_text(&path, Some(encoding)).expect_err("refused"));
    assert_eq!(refused("klingon"), ["E0120"]);
    assert_eq!(refused("utf-8"), ["E0121"]);
    assert!(files::read_text(&path, Some("windows-1251")).is_ok());
}

#[test]
fn e0215_program_too_large() {
    assert_eq!(building(&format!("{}FINI\n", "XX=1\n".repeat(66_000))), ["E0215"]);
    // Said once, and not for each name that is too many.
    let names: String = (0..70_000).map(|number| format!("N{number}A=1\n")).collect();
    let said = building(&format!("{names}FINI\n"));
    assert!(said.len() <= 2 && said.iter().all(|code| code == "E0215"), "{} errors", said.len());
}

#[test]
fn w0220_and_w0221_findings_of_check() {
    let fil = "CIMFIL/ON,CYCLE\nIF(POSTF(7,4).EQ.MISSNG)DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let diags = filpost_tests::examples::check(fil);
    let found: Vec<_> = diags.iter().map(|diag| (diag.code.number, diag.spans[0].line)).collect();
    assert_eq!(found, [(220, 1), (221, 2)]);
    let build = Program::builder().fil("t.fil", fil).build().expect("a run does not look for them");
    assert!(build.warnings().is_empty());
}

#[test]
fn e0229_name_of_an_added_function() {
    let built = Program::builder().function("SQRTF", 1, |_| Ok(0.0)).build();
    assert_eq!(names(&built.expect_err("refused")), ["E0229"]);
}

#[test]
fn e0305_call_depth() {
    let fil = "MA=MACRO\nXX=1\nTERMAC\nMB=MACRO\nCALL/MA\nTERMAC\nCALL/MB\nFINI\n";
    let limits = Limits { call_depth: 1, ..Limits::default() };
    let post = Program::builder().fil("t.fil", fil).limits(limits).build().expect("a post");
    let error = post.stream(PART.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0305"]);
    assert_eq!(error.diags()[0].spans[0].line, 5);
}

#[test]
fn e0317_host_function() {
    let fil = "XX=LIFEF(3)\nFINI\n";
    let post = Program::builder()
        .fil("t.fil", fil)
        .function("LIFEF", 1, |_| Err::<f64, _>("the tool table is not there".into()))
        .build()
        .expect("a post");
    let error = post.stream(PART.as_bytes(), &mut Vec::new()).expect_err("refused");
    assert_eq!(names(&error), ["E0317"]);
    assert!(error.to_string().contains("the tool table is not there"), "{error}");
}
