//! MACRO and CALL.

use crate::bench::{Bench, globals};

#[test]
fn arguments_go_by_name_and_by_position_and_defaults_fill_in() {
    let bench = globals(
        "MM=MACRO/PA,PB=20,PC=BASE+1\nRES=PA*10000+PB*100+PC\nTERMAC\nBASE=6\n\
         CALL/MM,PC=3,PA=1\nR1=RES\nCALL/MM,4,5\nR2=RES",
    );
    assert_eq!((bench.number("R1"), bench.number("R2")), (12003.0, 40507.0));
}

#[test]
fn parameters_hide_global_names_and_all_other_names_are_shared() {
    let bench = globals("MM=MACRO/VV\nVV=VV+1\nSHARED=VV\nTERMAC\nVV=100\nCALL/MM,VV=VV+1");
    assert_eq!((bench.number("VV"), bench.number("SHARED")), (100.0, 102.0));
}

#[test]
fn macros_call_macros_and_the_stack_is_told() {
    let mut bench = Bench::new(
        "INNER=MACRO/PA\nCOOLNT/ON\nXX=1/PA\nTERMAC\nOUTER=MACRO\nCALL/INNER,PA=DD\nTERMAC\n\
         DD=1\nCALL/OUTER\nDD=0\nCALL/OUTER",
    );
    let diag = bench.globals().unwrap_err();
    assert_eq!(diag.spans[0].line, 3);
    assert_eq!(
        diag.notes,
        [
            "in macro INNER, called from test.fil:6",
            "in macro OUTER, called from test.fil:11",
            "in global area of test.fil",
            "XX = 1, PA = 0",
        ]
    );
    let stacks: Vec<_> = bench.host.sites.iter().map(|s| s.lines(bench.machine.module())).collect();
    assert_eq!(stacks[0], ["test.fil:2", "test.fil:6", "test.fil:9"]);
    assert_eq!(stacks[1], ["test.fil:2", "test.fil:6", "test.fil:11"]);
}

#[test]
fn labels_belong_to_their_macro() {
    let bench = globals(
        "MM=MACRO/PA\nIF(PA.EQ.0)JUMPTO/LA\nRES=1\nLA) CONTIN\nTERMAC\nRES=0\nCALL/MM,0\nJUMPTO/LA\nRES=5\nLA) CONTIN",
    );
    assert_eq!(bench.number("RES"), 0.0);
}
