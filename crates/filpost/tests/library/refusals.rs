//! All errors of a CL file at once, and none that only follows from another.

use std::io::{self, Cursor};

use filpost::{Error, Event, Program, Refusals, read_compat};

/// Unit, tool, speed and feed.
const HEAD: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n";

fn mill() -> Program {
    Program::builder().generic("fanuc-mill").build().expect("a post")
}

fn refused(program: &Program, cl: &str) -> Refusals {
    match program.stream(cl.as_bytes(), io::sink()) {
        Err(Error::Refused(refusals)) => *refusals,
        other => panic!("{other:?}"),
    }
}

/// Code, line and number of each kind: `E0513:3 x2`.
fn kinds(refusals: &Refusals) -> Vec<String> {
    let kind = |(index, diag): (usize, &filpost::Diag)| {
        let line = diag.spans.first().map_or(0, |place| place.line);
        match refusals.count(index) {
            1 => format!("{}:{line}", diag.code.name()),
            count => format!("{}:{line} x{count}", diag.code.name()),
        }
    };
    refusals.diags().iter().enumerate().map(kind).collect()
}

/// The kinds of a CL text behind [`HEAD`].
fn kinds_of(cl: &str) -> Vec<String> {
    kinds(&refused(&mill(), &format!("{HEAD}{cl}")))
}

#[test]
fn each_kind_comes_once_with_its_number() {
    let found = refused(
        &mill(),
        &format!(
            "{HEAD}SITEWD / A\nGOTO / 1, 2, 3\nROTABL / 30\nSITEWD / 5\nGOTO / 1, 2, 3.3.3\n\
             ROTABL / 60\nFEDRAT / 5..\nSHOPNOTE\nSITEWD\nFINI\n"
        ),
    );
    assert_eq!(kinds(&found), ["E0513:5 x3", "E0506:7 x2", "E0405:9 x2", "E0513:12"]);
    assert_eq!((found.further_lines(0), found.further_lines(1)), (&[8, 13][..], &[10][..]));
    assert!(found.words().eq(["SHOPNOTE", "SITEWD"]));
    assert_eq!(found.total(), 8);
}

#[test]
fn a_word_that_may_be_without_effect_leaves_nothing_in_doubt() {
    let cl = "LOADTL / 1\nSITEWD / 1\nGOTO / 0, 0, 5\nCUTCOM / LEFT, 1\nSITEWD / 2\nFINI\n";
    assert_eq!(kinds(&refused(&mill(), cl)), ["E0514:1", "E0513:2 x2", "E0509:3"]);
    let cl =
        format!("{HEAD}SITEWD\nGOTO / 0, 0, 5\nCIRCLE / 5, 0, 5, 0, 0, 1, 5\nGOTO / 11, 0, 5\n");
    assert_eq!(kinds(&refused(&mill(), &cl)), ["E0513:5", "E0504:8"]);
}

#[test]
fn a_word_that_may_be_without_effect_breaks_no_arc() {
    let arc = "CIRCLE / 5, 0, 5, 0, 0, 1, 5\nSITEWD\nGOTO / 11, 0, 5\n";
    assert_eq!(kinds_of(&format!("GOTO / 0, 0, 5\n{arc}FINI\n")), ["E0513:7", "E0504:8"]);
}

#[test]
fn what_follows_from_an_error_is_not_told() {
    // The start of the arc is not known, nor the feed, the unit, or the compensation.
    assert_eq!(
        kinds_of("GOTO / 0, 0, 5.5.5\nCIRCLE / 5, 0, 5, 0, 0, 1, 5\nGOTO / 11, 0, 5\nFINI\n"),
        ["E0405:5"]
    );
    assert_eq!(
        kinds_of("GOTO / 0, 0, 5\nCIRCLE / 5, 0, 5, 0, 0, 1, 5, BANANA\nGOTO / 9, 9, 5\nFINI\n"),
        ["E0506:6"]
    );
    let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / ABC\nGOTO / 0, 0, 5\nGOTO / 1, 0, 5\nFINI\n";
    assert_eq!(kinds(&refused(&mill(), cl)), ["E0506:3"]);
    let cl = "UNITS / FURLONG\nLOADTL / 1\nFEDRAT / 5\nGOTO / 0, 0, 5\nFINI\n";
    assert_eq!(kinds(&refused(&mill(), cl)), ["E0506:1"]);
    assert_eq!(kinds_of("GOTO / 0, 0, 5\nCUTCOM / LEFTT\nGOTO / 9, 9, 5\nFINI\n"), ["E0506:6"]);
    assert_eq!(
        kinds_of("GOTO / 0, 0, 5\nCYCLE / DRIL, 5, 2\nGOTO / 9, 9, 5\nCYCLE / OFF\nFINI\n"),
        ["E0506:6"]
    );
}

#[test]
fn a_missing_feed_or_unit_is_told_once_and_hides_nothing_else() {
    let cl = "UNITS / MM\nLOADTL / 1\nGOTO / 0, 0, 5\nGOTO / 1, 0, 5\n\
              CIRCLE / 5, 0, 5, 0, 0, 1, 4\nGOTO / 12, 0, 5\nSITEWD\nFINI\n";
    assert_eq!(kinds(&refused(&mill(), cl)), ["E0509:3", "E0504:6", "E0513:7"]);
    let cl = "LOADTL / 1\nFEDRAT / 5, MMPM\nGOTO / 0, 0, 5\nCOOLNT / WET\nGOTO / 1, 0, 5\nFINI\n";
    assert_eq!(kinds(&refused(&mill(), cl)), ["E0514:1", "E0506:4"]);
}

#[test]
fn arcs_are_judged_again_behind_a_point_that_is_certain() {
    let arc = "CIRCLE / 5, 0, 5, 0, 0, 1, 5\nGOTO / 11, 0, 5\nGOTO / 0, 0, 5\n";
    assert_eq!(kinds_of(&format!("GOTO / 0, 0, 5\n{arc}{arc}{arc}FINI\n")), ["E0504:7 x3"]);
}

#[test]
fn misspelt_words_and_words_that_move_are_never_offered() {
    let found = refused(
        &mill(),
        &format!(
            "{HEAD}GOTOO / 1, 2, 3\nGT / 1, 2\nCIRC / 1\nTABLE_TURN / 90\nSHOPWD / 1, 2, 3\nSITEWD\nFINI\n"
        ),
    );
    assert_eq!(found.diags().len(), 6);
    assert!(found.words().eq(["SITEWD"]));
    assert_eq!(found.diags()[0].hint.as_deref(), Some("did you mean GOTO?"));
}

#[test]
fn the_words_that_are_offered_make_the_file_run() {
    let cl = format!("{HEAD}SITEWD / A, 5\nGOTO / 1, 2, 3\nSHOPNOTE\nFINI\n");
    let found = refused(&mill(), &cl);
    let words: Vec<String> = found.words().map(|word| format!("{word:?}")).collect();
    let toml = format!("[words]\nwithout_effect = [{}]", words.join(", "));
    let compat = read_compat("compat.toml", &toml).expect("a compat file");
    let program = Program::builder().generic("fanuc-mill").compat(compat).build().expect("a post");
    program.stream(cl.as_bytes(), io::sink()).expect("a program");
    let again = refused(&program, &cl.replace("FINI", "THIRDWD\nFINI"));
    assert_eq!(again.listed_words(), ["SHOPNOTE", "SITEWD"]);
}

#[test]
fn observers_hear_nothing_after_the_first_error() {
    let mut lines = Vec::new();
    let cl = format!("{HEAD}SITEWD\nGOTO / 1, 2, 3\nPPRINT / A\nFINI\n");
    let run = mill().start().observe(|event| {
        if let Event::Record { record, .. } = event {
            lines.push(record.line);
        }
    });
    run.stream(cl.as_bytes(), io::sink()).expect_err("refused");
    assert_eq!(lines, [1, 2, 3, 4, 5]);
}

#[test]
fn an_error_of_fil_is_the_last_one() {
    let fil = "CIMFIL/ON,COOLNT\nXX=1/0\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let program =
        Program::builder().generic("fanuc-mill").fil("a.fil", fil).build().expect("a post");
    let cl = format!("{HEAD}SITEWD\nCOOLNT / ON\nSHOPNOTE\nFINI\n");
    assert_eq!(kinds(&refused(&program, &cl)), ["E0513:5", "E0301:2"]);
    // In doubt no section is run, and its records are not judged.
    let cl = format!("{HEAD}ROTABL / 5\nCOOLNT / WET\nSHOPNOTE\nFINI\n");
    assert_eq!(kinds(&refused(&program, &cl)), ["E0506:5", "E0513:7"]);
}

#[test]
fn a_record_that_the_post_refuses_in_a_section_does_not_end_the_list() {
    let fil = "CIMFIL/ON,COOLNT\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let program =
        Program::builder().generic("fanuc-mill").fil("a.fil", fil).build().expect("a post");
    let cl = format!("{HEAD}COOLNT / WET\nSHOPNOTE\nFINI\n");
    assert_eq!(kinds(&refused(&program, &cl)), ["E0506:5", "E0513:6"]);
}

#[test]
fn files_and_blocks_give_the_same_errors() {
    let cl = format!("{HEAD}SITEWD\nROTABL / 5\nFINI\n");
    let of_blocks = mill().blocks(cl.as_bytes()).find_map(Result::err).expect("refused");
    let of_seekable =
        mill().start().stream_seekable(Cursor::new(&cl), io::sink()).expect_err("refused");
    assert_eq!(of_blocks.to_string(), of_seekable.to_string());
    assert_eq!(of_blocks.diags().len(), 2);
}

#[test]
fn errors_of_the_forms_of_a_dialect_do_not_follow_from_each_other() {
    // CYCLE/ON changes the cycle that was refused.
    let nx = "TOOL PATH/A,TOOL,B\nCYCLE/DRIL\nCYCLE/ON,FEDTO,-5\nPAINT/PATH\nEND-OF-PATH\n";
    let found = refused(&mill(), &format!("UNITS/MM\nLOAD/TOOL,1\nFEDRAT/MMPM,5\n{nx}"));
    assert_eq!(kinds(&found), ["E0506:5"]);
    let camworks = "BOX/0,0,0,1,1,1\nCYCLE/DRILL,G98,-5,5x5,3\nCYCLE/ON\nGOTO/1,2,3\nFINI\n";
    let found = refused(&mill(), &format!("{HEAD}{camworks}"));
    assert_eq!(kinds(&found), ["E0405:6", "E0418:8"]);
}

#[test]
fn the_block_of_an_author_that_leaves_a_doubt_is_shown() {
    let cl = format!("{HEAD}RAPID\nGOTO / 0, 0, 50\nINSERT / M98 P100\nRAPID\nGOTO / 9, 0, 50\n");
    let found = refused(&mill(), &cl);
    let places: Vec<&str> =
        found.diags()[0].spans.iter().map(|place| place.excerpt.as_str()).collect();
    assert!(places.iter().any(|text| text.contains("M98 P100")), "{places:?}");
}
