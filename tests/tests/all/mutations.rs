//! A hand-written program against its CL text, as rs274 sees it: no difference,
//! and each single change to it must be noticed.

use std::path::Path;

use filpost_tests::cl_path::cl_path;
use filpost_tests::compare::compare;
use filpost_tests::nc_path::nc_path;
use filpost_tests::path::ToolPath;
use filpost_tests::rs274;
use rayon::prelude::*;

const CL: &str = "\
$$*          Pro/CLfile  Version 8.0 - 8.0.3.0
UNITS / MM
LOADTL / 3
SPINDL / RPM, 2000.,  CLW
RAPID
GOTO / 10., 20., 8.
FEDRAT / 120.,  MMPM
GOTO / 10., 20., -1.25
FEDRAT / 300.,  MMPM
GOTO / 30., 20., -1.25
CIRCLE / 30., 25., -1.25, 0., 0., 1., 5.
GOTO / 35., 25., -1.25
CIRCLE / 45., 25., -1.25, 0., 0., -1., 10.
GOTO / 45., 35., -1.25
RAPID
GOTO / 45., 35., 8.
RAPID
GOTO / 12., 42., 8.
CYCLE / DEEP, DEPTH, 6., STEP, 2.5, MMPM, 75., CLEAR, 1.5
GOTO / 12., 42., 0.
GOTO / 24., 42., 0.
GOTO / 36., 48., 0.
CYCLE / OFF
RAPID
GOTO / 36., 48., 8.
SPINDL / OFF
FINI
";

const NC: &str = "\
%
N1 G21 G17 G40 G49 G80 G90 G94
N2 G53 G0 Z0.
N3 T3 M6
N4 S2000 M3
N5 G0 X10. Y20.
N6 G43 H3 Z8.
N7 G1 Z-1.25 F120.
N8 X30. F300.
N9 G3 X35. Y25. I0. J5.
N10 G2 X45. Y35. I10. J0.
N11 G0 Z8.
N12 X12. Y42.
N13 G99 G83 Z-6. R1.5 Q2.5 F75.
N14 X24.
N15 X36. Y48.
N16 G80
N17 G0 Z8.
N18 M5
N19 G53 Z0.
N20 M30
%
";

fn expected() -> ToolPath {
    cl_path(CL.as_bytes(), "by hand").unwrap()
}

/// What is said of a program: differences, or why it was refused.
fn findings(program: &Path, nc: &str) -> Vec<String> {
    let found = rs274::run(program, nc).and_then(|calls| nc_path(&calls, nc));
    match found {
        Ok(path) => compare(&expected(), &path).iter().map(ToString::to_string).collect(),
        Err(refused) => vec![refused],
    }
}

#[test]
fn the_program_agrees() {
    let Some(program) = rs274::program() else { return };
    assert_eq!(findings(&program, NC), Vec::<String>::new());
}

/// Adds 1 to each digit in turn of the words that a path depends on.
#[test]
fn each_changed_digit_is_noticed() {
    let Some(program) = rs274::program() else { return };
    let mut word = ' ';
    let mut digits = Vec::new();
    for (at, character) in NC.char_indices() {
        match character.to_digit(10) {
            None if character.is_ascii_alphabetic() => word = character,
            Some(digit) if "TXYZIJRFH".contains(word) => digits.push((at, digit)),
            _ => {}
        }
    }
    digits.par_iter().for_each(|(at, digit)| {
        let mut changed = NC.to_string();
        changed.replace_range(at..=at, &((digit + 1) % 10).to_string());
        let line = NC[..*at].lines().count();
        let text = changed.lines().nth(line - 1).unwrap();
        if !text.contains("G53") {
            assert!(!findings(&program, &changed).is_empty(), "not noticed: {text}");
        }
    });
}

/// Changes of a preparatory word, of a block, and what must be said.
#[test]
fn changed_words_are_named() {
    let Some(program) = rs274::program() else { return };
    for (old, new, said) in [
        ("N9 G3 X35. Y25. I0. J5.", "N9 G2 X35. Y25. I0. J5.", "arc clockwise (G2)"),
        ("N10 G2", "N10 G3", "arc counterclockwise (G3)"),
        ("N7 G1 Z-1.25", "N7 G0 Z-1.25", "rapid to X10.0000 Y20.0000 Z-1.2500 in place of feed"),
        ("N11 G0", "N11 G1", "feed to X45.0000 Y35.0000 Z8.0000 in place of rapid"),
        ("N14 X24.\n", "", "no hole at X24.0000 Y42.0000"),
        ("N15 X36. Y48.\n", "", "no hole at X36.0000 Y48.0000"),
        ("Z-6. R1.5 Q2.5", "Z-60. R1.5 Q2.5", "hole down to Z-60.0000"),
        ("N8 X30. F300.\n", "", "Radius to end of arc"),
        ("G21", "G20", "hole at"),
        ("G90", "G91", ""),
        ("G17", "G18", ""),
        ("N16 G80\nN17 G0 Z8.", "N16 G80", ""),
    ] {
        assert!(NC.contains(old), "{old}");
        let found = findings(&program, &NC.replacen(old, new, 1));
        assert!(found.iter().any(|what| what.contains(said)), "{new}: {found:?}");
    }
}
