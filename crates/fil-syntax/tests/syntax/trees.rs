//! Trees of small sources, as snapshots.

use fil_syntax::parse;
use fil_syntax::print::print;

/// The tree of a source without its spans, and its diagnostics.
fn tree(source: &str) -> String {
    let parsed = parse("t.fil", source);
    let mut text = without_spans(&format!("{:#?}", parsed.program.items));
    for diag in &parsed.diags {
        text.push_str(&format!("\n{diag}"));
    }
    text
}

/// Drops the spans from a tree that was printed over many lines.
fn without_spans(tree: &str) -> String {
    let mut out = Vec::new();
    let mut lines = tree.lines();
    while let Some(line) = lines.next() {
        if line.trim_start() == "span: Span {" {
            lines.by_ref().take(3).for_each(drop);
        } else {
            out.push(line);
        }
    }
    out.join("\n")
}

macro_rules! snapshots {
    ($($name:ident: $source:expr;)*) => {
        $(#[test]
        fn $name() {
            insta::assert_snapshot!(tree($source));
        })*
    };
}

snapshots! {
    assignments: "a=5.EQ.6; B(I+1) = -.5E1*(2-C)**2**3\nFINI";
    relations_and_logic: "A=.NOT.B.LT.3.AND.C.OR.D.GE.1D2\nFINI";
    post_words: "RAPID\nRAPID/\nPOSTN/OUT, G, 00, X,XPOS $\n ,Z,-1 ; COOLNT/on\nFINI";
    free_text: "PPRINT TOOL 5; R=2 $$ note\nINSERT/G5 P1\nPARTNO 'IT''S', T\nPPRINT\nFINI";
    texts: "T=TEXT/'ab''c',U,RANGE,1\nLETTER = 5\nT(2)=TEXT/\nFINI";
    if_blocks: "IF (A) THEN\nB=1\nELSEIF(C)THEN\nELSE\nD=1\nL9) ENDIF\nFINI";
    one_line_if: "IF(A.EQ.1)JUMPTO/L1\nIF(X) 10,L1,010\nIF((A)) PPRINT hello\n10) CONTIN\nFINI";
    loops: "DO/LC, I=1, N+1, 1\nDO/LD,J=1,2\nLD) A=J\nLC) CONTIN\nFINI";
    cases: "CASE/X\nWHEN/(ICODEF(MILL))\nA=1\nWHEN/1,2\nWHEN/OTHER\nB=1\nENDCAS\nFINI";
    macros: "M1=MACRO/P,Q=2\nRESERV/A,10,B,P\nTERMAC\nM2=MACRO\nTERMAC\nCALL/M1,Q=5,3\nFINI";
    sections: "CIMFIL/ON,CYCLE,DEEP\nCIMFIL/OFF\nCIMFIL/ON,5000,5\nA=1\nCIMFIL/OFF\nFINI";
    switches: "PRINT/OFF,IN\nREDEF/ON\nINCLUD/lib\\a.fil $$ x\nINCLUD/'my file.fil'\nFINI";
    words_as_names: "ON=1\nOUT=ON\nTO=STEP\nIF=5\nDO(2)=TEXT\nTHEN=OTHER\nA=CASE(IF)\nFINI";
    refused_lines_leave_the_rest: "A=1\nB=)\nL) C=(;D=2\nFINI";
}

#[test]
fn line_ends_and_marks_do_not_matter() {
    let source = "A=1 $$ note\nIF(A)THEN\nB=1 $\n +2\nENDIF\nFINI\n";
    let expected = print(&parse("t.fil", source).program);
    for other in [
        source.replace('\n', "\r\n"),
        source.replace('\n', "\r"),
        format!("\u{feff}{source}"),
        source.to_ascii_lowercase(),
        format!("{source}\x1a"),
    ] {
        let parsed = parse("t.fil", &other);
        assert!(parsed.diags.is_empty(), "{:?}", parsed.diags);
        assert_eq!(print(&parsed.program), expected);
    }
}
