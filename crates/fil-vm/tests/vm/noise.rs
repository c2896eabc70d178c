//! Programs put together at random: whatever they do, the machine comes back
//! within its limits.

use std::sync::Arc;

use fil_cl::{Record, Vocabulary};
use fil_vm::{FilFile, Interpreter, Limits, LoadOptions, load};
use proptest::prelude::*;

use crate::bench::Mock;

const STATEMENTS: &[&str] = &[
    "XX=XX+1",
    "YY=XX/ZZ",
    "ZZ=0",
    "T1=TEXT/T1,'AB',T1",
    "T1='A'",
    "XX=T1",
    "AR(XX)=YY",
    "YY=AR(1)",
    "JUMPTO/LA",
    "JUMPTO/LB",
    "IF(XX.GT.3)JUMPTO/LB",
    "IF(XX)LA,LB,LA",
    "CALL/MM,XX",
    "CALL/NN",
    "XX=POSTF(14)",
    "XX=POSTF(7,XX)",
    "XX=POSTF(8,4,YY)",
    "XX=POSTF(10,4,T1)",
    "XX=POSTF(11,4)",
    "XX=POSTF(12,XX)",
    "XX=POSTF(20)",
    "XX=POSTF(21)",
    "XX=POSTF(16,XX)",
    "XX=POSTF(15)",
    "XX=POSTF(XX,4)",
    "XX=POSTF(13)",
    "POSTN/OUT,X,XX,Y,T1",
    "GOTO/XX,YY,ZZ",
    "PPRINT/T1,XX",
    "XX=EXPF(XX)",
    "XX=XX**YY",
    "XX=-XX",
    "YY=LNTHF(T1)",
    "XX=MAXF(XX,YY,3)",
    "XX=(XX.GT.YY.AND.YY.NE.2)",
    "A=XX",
    "YY=NEXTF(X)",
    "XX=COUPLF(DEPTH,YY)",
    "XX=1E300*1E10",
    "T1=TEXT/PART,T1,XX,YY",
    "T1=TEXT/REPEAT,T1,XX",
    "T1=TEXT/MODIFY,T1,'A','AB'",
    "T1=TEXT/CONVF,XX,YY,3,ZEROS,TRIM",
    "XX=INDXF(T1,'B',XX)",
    "XX=SCALF(T1)",
    "T1=TEXTF(XX)",
    "XX=DAT(XX)",
    "XX=FILEF(XX,READ,T1)",
    "WRITE/1,T1",
    "WARN/T1,XX",
    "IF(XX.GT.YY)ERROR/XX,T1",
    "T1=TEXT/CLW",
];

/// A body with its labels, and a loop around its middle.
fn body(picks: &[usize]) -> String {
    let lines: Vec<&str> = picks.iter().map(|pick| STATEMENTS[pick % STATEMENTS.len()]).collect();
    let third = lines.len() / 3;
    let (head, rest) = lines.split_at(third);
    let (middle, tail) = rest.split_at(third);
    format!(
        "LA) CONTIN\n{}\nDO/LC,II=1,YY\n{}\nLC) CONTIN\nLB) CONTIN\n{}\n",
        head.join("\n"),
        middle.join("\n"),
        tail.join("\n")
    )
}

proptest! {
    #[test]
    fn the_machine_always_comes_back(
        one in prop::collection::vec(0usize..1000, 0..12),
        two in prop::collection::vec(0usize..1000, 0..12),
        called in prop::collection::vec(0usize..1000, 0..6),
    ) {
        let inner: String = body(&called).replace("CALL/", "T1=TEXT/'NO CALL HERE',");
        let text = format!(
            "DATA/DAT,1,'A'\nRESERV/AR,4\nMM=MACRO/PA=2\n{inner}TERMAC\nNN=MACRO\nCALL/MM\nTERMAC\n{}CIMFIL/ON,CYCLE\n{}CIMFIL/OFF\nFINI\n",
            body(&one), body(&two)
        );
        let mut vocab = Vocabulary::new();
        let files = [FilFile { name: "noise.fil", text: &text }];
        let limits = Limits { fuel: 3000, text_bytes: 10_000, ..Limits::default() };
        let Ok(loaded) = load(&files, &mut vocab, LoadOptions { lint: true, ..LoadOptions::default() }) else {
            return Ok(());
        };
        let mut machine = Interpreter::new(Arc::new(loaded.module), limits, Arc::default());
        let mut host = Mock::default();
        let mut record = Record::command(fil_cl::words::CYCLE);
        host.records = vec![Record::goto([1.0, 2.0, 3.0], None); 3];
        let _ = machine.run_globals(&mut vocab, &mut host);
        let section = machine.module().find(&record, &vocab).expect("CYCLE has a section");
        let _ = machine.run_section(section, &mut record, &mut vocab, &mut host);
        if let Some(number) = machine.number("XX") {
            prop_assert!(number.is_finite());
        }
    }
}
