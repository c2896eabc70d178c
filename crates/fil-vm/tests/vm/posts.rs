//! Post words in FIL become records.

use crate::bench::{fails, globals};

#[test]
fn a_bare_name_is_a_variable_where_it_is_set_else_a_word() {
    let bench =
        globals("SPEED=500\nSPINDL/RPM,SPEED,CLW\nPOSTN/OUT,G,01,X,SPEED/2\nRAPID\nCOOLNT/OFF");
    assert_eq!(
        bench.host.log,
        ["SPINDL RPM 500 CLW", "POSTN OUT 7 1 24 250", "RAPID", "COOLNT OFF"]
    );
}

#[test]
fn motions_have_their_own_layout() {
    let bench = globals("XX=1\nGOTO/XX,2,3\nFROM/1,2,3,0,0,1\nGODLTA/1,2,-3\nCIRCLE/1,2,3,0,0,1,5");
    assert_eq!(
        bench.host.log,
        [
            "GOTO - - 1 2 3",
            "FROM - - 1 2 3 0 0 1",
            "GODLTA - - 1 2 -3",
            "CIRCLE 0 4 7 - - 1 2 3 0 0 1 5"
        ]
    );
    assert_eq!(fails("GOTO/1,2", "").spans[0].line, 1);
}

#[test]
fn text_words_take_texts_and_the_variable_they_name() {
    let bench = globals(
        "TOOL1='MILL 10'\nPPRINT TOOL1\nPPRINT USE TOOL1 NOW\nINSERT/'G4 P',TOOL1\nPPRINT/'A',2.5",
    );
    assert_eq!(
        bench.host.log,
        ["PPRINT 'MILL 10'", "PPRINT 'USE TOOL1 NOW'", "INSERT 'G4 PMILL 10'", "PPRINT 'A2.5'"]
    );
}

#[test]
fn empty_values_become_empty_slots() {
    let bench = globals("POSTN/OUT,X,999999\nCYCLE/DRILL,T1\nT1='A'\nCYCLE/DRILL,T1");
    assert_eq!(bench.host.log, ["POSTN OUT 24 -", "CYCLE DRILL -", "CYCLE DRILL 'A'"]);
    assert_eq!(bench.warned(), [309]);
}
