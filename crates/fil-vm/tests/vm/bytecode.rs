//! Snapshots of the code the compiler makes.

use fil_vm::disassemble;

use crate::bench::compile;

fn code(text: &str) -> String {
    let loaded = compile(&format!("{text}\nFINI\n")).expect("the program is right");
    disassemble(&loaded.module)
}

#[test]
fn loops_and_conditions() {
    insta::assert_snapshot!(code(
        "SUM=0\nDO/LA,II=1,NN+1\nIF(II.GT.3.AND.II.NE.5)SUM=SUM+II*2\nLA) CONTIN\nLB) SUM=SUM-1\nIF(SUM.GE.10)JUMPTO/LB"
    ));
}

#[test]
fn a_section_with_case_and_posts() {
    insta::assert_snapshot!(code(
        "CIMFIL/ON,CYCLE\nCTYPE=POSTF(7,4)\nCASE/CTYPE\nWHEN/ICODEF(DRILL),ICODEF(TAP)\nPOSTN/OUT,G,81,Z,-POSTF(7,6)\nWHEN/OTHER\nDMY=POSTF(13)\nENDCAS\nCIMFIL/OFF"
    ));
}

#[test]
fn a_macro_with_arrays_and_texts() {
    insta::assert_snapshot!(code(
        "RESERV/AR,5\nMM=MACRO/PA,PB=2\nAR(PA)=MAXF(PB,3,AR(PA+1))\nT1=TEXT/'N',PA\nTERMAC\nCALL/MM,1\nPPRINT/T1"
    ));
}
