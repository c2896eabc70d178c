//! POSTF operations on a host with commons and records.

use fil_vm::{CommonKind, Compat, Functions, Limits, PostfOp};

use crate::bench::{Bench, fails, globals, run};

/// A section for CYCLE with this body.
fn cycle(body: &str) -> String {
    format!("CIMFIL/ON,CYCLE\n{body}\nCIMFIL/OFF")
}

const CL: &str =
    "CYCLE / DRILL, DEPTH, 10.0, MMPM, 200.0\nGOTO / 1.0, 2.0, 3.0\nGOTO / 4.0, 5.0, 6.0\nFINI\n";

fn values(body: &str, names: &[&str]) -> Vec<f64> {
    let bench = run(&cycle(body), CL);
    names.iter().map(|name| bench.number(name)).collect()
}

#[test]
fn commons_are_read_stored_and_cleared_at_once() {
    let bench = globals(
        "D=POSTF(2,3,487,0.5)\nD=POSTF(2,1,25,4)\nD=POSTF(2,2,7,999999)\nV1=POSTF(1,3,487)\nD=POSTF(3,1,25)\nV2=POSTF(1,1,25)",
    );
    assert_eq!(bench.host.commons.into_iter().collect::<Vec<_>>(), [((CommonKind::Dbl, 487), 0.5)]);
    let bench = globals("D=POSTF(2,3,486,2)\nV1=POSTF(1,3,486)\nV2=POSTF(1,3,5)\nV3=POSTF(4)");
    assert_eq!(["V1", "V2", "V3"].map(|n| bench.number(n)), [2.0, 999_999.0, 999_999.0]);
}

#[test]
fn words_are_counted_from_one() {
    let seen = values(
        "V1=POSTF(5);V2=POSTF(7,1);V3=POSTF(7,2);V4=POSTF(7,3);V5=POSTF(7,4);V6=POSTF(7,6)\n\
         NN=8\nV7=POSTF(7,NN);V8=POSTF(6,4);V9=POSTF(6,6);W1=POSTF(6,9);W2=POSTF(17)",
        &["V1", "V2", "V3", "V4", "V5", "V6", "V7", "V8", "V9", "W1", "W2"],
    );
    assert_eq!(seen, [8.0, 1.0, 2000.0, 1054.0, 163.0, 10.0, 200.0, 2.0, 1.0, 0.0, 1.0]);
}

#[test]
fn past_the_end_is_empty_with_one_warning() {
    let bench = run(&cycle("DO/LA,II=1,3\nVV=POSTF(7,9)\nLA) CONTIN"), CL);
    assert_eq!(bench.number("VV"), 999_999.0);
    assert_eq!(bench.warned(), [310]);
}

#[test]
fn a_minor_word_stays_one_when_it_is_replaced_by_a_code() {
    let bench = run(&cycle("D=POSTF(8,4,ICODEF(TAP))\nD=POSTF(8,6,12.5)\nD=POSTF(13)"), CL);
    assert_eq!(bench.host.log[0], "CYCLE TAP DEPTH 12.5 MMPM 200");
    let bench = run(&cycle("D=POSTF(8,6,168)\nD=POSTF(13)"), CL);
    assert_eq!(bench.host.log[0], "CYCLE DRILL DEPTH 168 MMPM 200", "a number stays a number");
    let bench = run(&cycle("D=POSTF(8,4,ICODEF(EMBOSL))\nD=POSTF(13)"), CL);
    assert_eq!(bench.host.log[0], "CYCLE EMBOSL DEPTH 10 MMPM 200");
}

#[test]
fn words_are_found_inserted_deleted_and_cut() {
    let bench = run(
        &cycle(
            "V1=POSTF(9,4,ICODEF(MMPM));V2=POSTF(9,8,ICODEF(MMPM))\nD=POSTF(10,9,3)\nD=POSTF(11,4)\nD=POSTF(13)\nD=POSTF(12,5)\nD=POSTF(13)\nD=POSTF(12,7)\nD=POSTF(13)",
        ),
        CL,
    );
    assert_eq!([bench.number("V1"), bench.number("V2")], [7.0, 0.0]);
    assert_eq!(
        bench.host.log[..3],
        ["CYCLE DEPTH 10 MMPM 200 3", "CYCLE DEPTH 10", "CYCLE DEPTH 10 - -"]
    );
}

#[test]
fn reading_on_consumes_records_and_tells_the_end() {
    let bench = run(
        &cycle(
            "S1=POSTF(14);X1=POSTF(7,6)\nS2=POSTF(14);X2=POSTF(7,6)\nS3=POSTF(14)\nS4=POSTF(14);T4=POSTF(7,2)",
        ),
        CL,
    );
    let seen = ["S1", "X1", "S2", "X2", "S3", "S4", "T4"].map(|name| bench.number(name));
    assert_eq!(seen, [0.0, 1.0, 0.0, 4.0, 0.0, 1.0, 14000.0]);
    assert!(bench.host.log.is_empty());
}

#[test]
fn saved_and_restored() {
    let bench = run(&cycle("D=POSTF(20)\nD=POSTF(14)\nD=POSTF(13)\nD=POSTF(21)\nD=POSTF(13)"), CL);
    assert_eq!(
        bench.host.log,
        ["GOTO - - 1 2 3", "CYCLE DRILL DEPTH 10 MMPM 200", "= GOTO - - 4 5 6", "= FINI"]
    );
}

#[test]
fn stepping_back_and_going_to_a_record() {
    let bench = run(
        &cycle(
            "S1=POSTF(16,3);X1=POSTF(7,6)\nS2=POSTF(15);X2=POSTF(7,6)\nS3=POSTF(16,9)\nD=POSTF(16,4)\nNN=POSTF(17)",
        ),
        CL,
    );
    let seen = ["S1", "X1", "S2", "X2", "S3", "NN"].map(|name| bench.number(name));
    assert_eq!(seen, [0.0, 4.0, 0.0, 1.0, 1.0, 4.0]);
}

#[test]
fn the_listing_is_switched() {
    assert!(globals("DMY = POSTF(24,1)").host.tracing);
    assert!(!globals("DMY = POSTF(24,1)\nDMY=POSTF(24,0)").host.tracing);
}

#[test]
fn numbers_known_only_at_run_time() {
    let seen = values("NN=7\nV1=POSTF(NN,6)\nNN=5\nV2=POSTF(NN)", &["V1", "V2"]);
    assert_eq!(seen, [10.0, 8.0]);
    let diag = fails(&cycle("NN=18\nV1=POSTF(NN)"), CL);
    assert_eq!(diag.code.number, 315);
    let diag = fails(&cycle("NN=7\nV1=POSTF(NN)"), CL);
    assert_eq!(diag.code.number, 315);
}

#[test]
fn a_site_gives_numbers_their_operation() {
    let mut compat = Compat::default();
    compat.postf.insert(18, PostfOp::Length);
    compat.postf.remove(&5);
    let mut bench =
        Bench::with(&cycle("VV=POSTF(18)"), Limits::default(), compat, Functions::new());
    bench.records(CL).unwrap();
    assert_eq!(bench.number("VV"), 8.0);
    assert!(bench.warnings.is_empty(), "the site's own choice is not noted");
}

#[test]
fn own_readings_are_noted_once() {
    let bench = Bench::new(&cycle("V1=POSTF(5)\nV2=POSTF(5)\nV3=POSTF(4)"));
    let noted: Vec<_> = bench.warnings.iter().map(|d| (d.code.number, d.spans[0].line)).collect();
    assert_eq!(noted, [(218, 2), (218, 4)]);
}

#[test]
fn couplets_have_functions_of_our_own() {
    let seen = values(
        "V1=COUPLF(DEPTH);V2=COUPLF(CLEAR,-1);V3=HASF(MMPM);V4=HASF(IPM)",
        &["V1", "V2", "V3", "V4"],
    );
    assert_eq!(seen, [10.0, -1.0, 1.0, 0.0]);
}

#[test]
fn neighbours_are_seen_without_reading_on() {
    let fil = "CIMFIL/ON,CYCLE\nV1=NEXTF(X);V2=NEXTF(Z);N1=POSTF(17)\nCIMFIL/OFF\n\
               CIMFIL/ON,FINI\nV3=PREVF(Y)\nCIMFIL/OFF";
    let bench = run(fil, CL);
    assert_eq!(["V1", "V2", "V3", "N1"].map(|name| bench.number(name)), [1.0, 3.0, 5.0, 1.0]);
    assert_eq!(bench.host.log.len(), 2, "both motions are still there");
    assert_eq!(fails("CIMFIL/ON,FINI\nXX=NEXTF(X)\nCIMFIL/OFF", CL).code.number, 316);
}

#[test]
fn commons_have_names_and_letters_their_last_value() {
    let bench =
        globals("D=POSTF(2,3,486,2);D=POSTF(2,3,379,7.5)\nV1=COMF('output_scale_x');V2=LASTF(X)");
    assert_eq!((bench.number("V1"), bench.number("V2")), (2.0, 7.5));
    assert_eq!(fails("XX=COMF('nothing')", "").code.number, 316);
    assert_eq!(fails("XX=LASTF(27)", "").code.number, 316);
}

#[test]
fn an_error_shows_the_record_and_the_values() {
    let diag = fails(&cycle("DEP=COUPLF(DEPTH)\nVV=SQRTF(5-DEP)"), CL);
    assert_eq!(diag.code.number, 301);
    assert_eq!(diag.message, "SQRTF(-5) has no finite result");
    assert_eq!(
        diag.notes,
        [
            "in section CYCLE",
            "record 1, CL line 1: 2=2000 3=CYCLE 4=DRILL 5=DEPTH 6=10 7=MMPM 8=200",
            "VV = never set, DEP = 10",
        ]
    );
}
