//! Which section takes which record, and files that include others.

use fil_cl::Vocabulary;
use fil_vm::{FilFile, Included, LoadOptions, load};

use crate::bench::{compile, lines, run};

const CL: &str = "CYCLE / DRILL, 1\nCYCLE / DEEP, 2\nRAPID\nGOTO / 1.0, 2.0, 3.0\nFROM / 0.0, 0.0, 0.0\nCYCLE / OFF\nFINI\n";

#[test]
fn more_specific_keys_win() {
    let fil = "CIMFIL/ON,5000\nPPRINT/'MOTION'\nCIMFIL/OFF\nCIMFIL/ON,CYCLE\nPPRINT/'CYCLE'\nCIMFIL/OFF\n\
               CIMFIL/ON,CYCLE,DEEP\nPPRINT/'DEEP'\nCIMFIL/OFF\nCIMFIL/ON,5000,5\nPPRINT/'POINT'\nCIMFIL/OFF";
    assert_eq!(
        run(fil, CL).host.log,
        [
            "PPRINT 'CYCLE'",
            "PPRINT 'DEEP'",
            "= RAPID",
            "PPRINT 'POINT'",
            "PPRINT 'MOTION'",
            "PPRINT 'CYCLE'",
            "= FINI"
        ]
    );
}

#[test]
fn types_2000_go_by_the_code_of_the_major_word() {
    let fil = "CIMFIL/ON,2000,1054\nPPRINT/'CYCLE'\nCIMFIL/OFF";
    assert_eq!(run(fil, "CYCLE / OFF\nRAPID\n").host.log, ["PPRINT 'CYCLE'", "= RAPID"]);
}

#[test]
fn a_key_of_numbers_and_one_of_the_word_are_the_same() {
    let fil = "CIMFIL/ON,GOTO\nCIMFIL/OFF\nCIMFIL/ON,5000,5\nCIMFIL/OFF\nFINI\n";
    let diags = compile(fil).unwrap_err();
    assert_eq!(diags[0].code.number, 210);
    assert_eq!(diags[0].spans.iter().map(|place| place.line).collect::<Vec<_>>(), [3, 1]);
}

#[test]
fn values_last_from_section_to_section() {
    let fil =
        "NN=0\nCIMFIL/ON,CYCLE\nNN=NN+1\nCIMFIL/OFF\nCIMFIL/ON,FINI\nPOSTN/OUT,N,NN\nCIMFIL/OFF";
    assert_eq!(run(fil, CL).host.log.last().unwrap(), "POSTN OUT 14 3");
}

#[test]
fn an_outcome_tells_what_the_section_did() {
    let fil = "CIMFIL/ON,CYCLE,OFF\nCIMFIL/OFF\nCIMFIL/ON,CYCLE,DRILL\nDMY=POSTF(13)\nCIMFIL/OFF\n\
               CIMFIL/ON,CYCLE,DEEP\nDMY=POSTF(8,5,9)\nDMY=POSTF(14)\nCIMFIL/OFF\nFINI\n";
    let mut bench = crate::bench::globals(fil);
    let outcomes = bench.records(CL).unwrap();
    let seen: Vec<_> =
        outcomes.iter().map(|o| (o.processed, o.replaced, o.edited, o.swallowed())).collect();
    assert_eq!(
        seen,
        [(true, false, false, false), (false, true, true, true), (false, false, false, true)]
    );
}

#[test]
fn several_files_share_their_names() {
    let files = [
        FilFile { name: "a.fil", text: "MM=MACRO/PA\nRES=PA+OFFS\nTERMAC\nFINI\n" },
        FilFile { name: "b.fil", text: "OFFS=1\nCALL/MM,1\nCOOLNT/RES\nFINI\n" },
    ];
    let loaded = load(&files, &mut Vocabulary::new(), LoadOptions::default()).unwrap();
    assert!(loaded.warnings.is_empty(), "{}", lines(&loaded.warnings));
}

fn include(main: &str, others: &[(&str, &str)]) -> Result<Vec<u16>, Vec<u16>> {
    let mut loader = |_: &str, name: &str| {
        let found = others.iter().find(|(known, _)| *known == name);
        let included = |(name, text): &(&str, &str)| Included {
            name: name.to_string(),
            text: text.to_string(),
        };
        found.map(included).ok_or_else(|| "not there".to_string())
    };
    let options = LoadOptions { loader: Some(&mut loader), ..LoadOptions::default() };
    let numbers = |diags: Vec<fil_diag::Diag>| diags.iter().map(|diag| diag.code.number).collect();
    let files = [FilFile { name: "main.fil", text: main }];
    match load(&files, &mut Vocabulary::new(), options) {
        Ok(loaded) => Ok(numbers(loaded.warnings)),
        Err(diags) => Err(numbers(diags)),
    }
}

#[test]
fn includ_brings_in_statements_sections_and_macros() {
    let lib = ("lib.fil", "OFFS=1\nMM=MACRO/PA\nRES=PA\nTERMAC\n");
    assert_eq!(include("INCLUD/lib.fil\nCALL/MM,OFFS\nFINI\n", &[lib]), Ok(vec![]));
    let body = ("body.fil", "RES=2\nLA) CONTIN\n");
    let main = "CIMFIL/ON,CYCLE\nJUMPTO/LA\nINCLUD/body.fil\nCIMFIL/OFF\nFINI\n";
    assert_eq!(include(main, &[body]), Ok(vec![]));
    let main = "CIMFIL/ON,CYCLE\nINCLUD/lib.fil\nCIMFIL/OFF\nFINI\n";
    assert_eq!(include(main, &[lib]), Err(vec![214]));
}

#[test]
fn includ_refuses_cycles_and_files_that_are_not_there() {
    let one = ("one.fil", "INCLUD/two.fil\n");
    let two = ("two.fil", "INCLUD/one.fil\n");
    assert_eq!(include("INCLUD/one.fil\nFINI\n", &[one, two]), Err(vec![214]));
    assert_eq!(include("INCLUD/none.fil\nFINI\n", &[]), Err(vec![214]));
}

#[test]
fn only_a_section_with_a_silent_way_is_warned_of() {
    let body = |text: &str| {
        let fil = format!(
            "MS=MACRO\nRAPID\nTERMAC\nMQ=MACRO\nXX=1\nTERMAC\nCIMFIL/ON,CYCLE\n{text}\nCIMFIL/OFF\nFINI\n"
        );
        let options = LoadOptions { lint: true, ..LoadOptions::default() };
        let files = [FilFile { name: "a.fil", text: &fil }];
        let loaded = load(&files, &mut Vocabulary::new(), options).unwrap();
        loaded.warnings.iter().any(|diag| diag.code.number == 220)
    };
    assert!(body("XX=1"));
    assert!(!body("DMY=POSTF(13)"));
    assert!(!body("IF(POSTF(7,4).EQ.1)THEN\nRAPID\nELSE\nDMY=POSTF(13)\nENDIF"));
    assert!(body("CASE/POSTF(7,4)\nWHEN/1\nRAPID\nENDCAS"));
    assert!(!body("CALL/MS"));
    assert!(body("CALL/MQ"));
    assert!(body("DO/LA,II=1,POSTF(7,4)\nRAPID\nLA) CONTIN"), "the loop may have no pass");
}
