//! One source for each code, with the place it is reported at.

use fil_syntax::{SyntaxCode, parse};

/// Asserts that a source raises exactly this code, at line and column.
fn raises(source: &str, code: u16, line: u32, column: usize) {
    let diags = parse("t.fil", source).diags;
    let found: Vec<_> = diags
        .iter()
        .map(|diag| {
            let place = diag.spans.first().expect("a place");
            (diag.code.number, place.line, place.column())
        })
        .collect();
    assert_eq!(found, [(code, line, column)], "{source:.200}\n{diags:#?}");
}

/// The message of the only diagnostic of a source.
fn message(source: &str) -> String {
    let diags = parse("t.fil", source).diags;
    assert_eq!(diags.len(), 1, "{diags:#?}");
    diags[0].message.clone()
}

#[test]
fn e0101_unexpected() {
    raises("A=1\nB=(2+\nFINI", 101, 2, 6);
    raises("COOLNT ON\nFINI", 101, 1, 8);
    raises("A=1; B==2\nFINI", 101, 1, 8);
    assert_eq!(message("B=(2+\nFINI"), "the statement ends here, expected a value");
    let after = "found \"ON\", expected \"(\", \"/\", \"=\" or the end of the statement";
    assert_eq!(message("COOLNT ON\nFINI"), after);
    assert_eq!(message("5=A\nFINI"), "found the number 5, expected a statement");
    assert_eq!(message("JUMPTO/'A'\nFINI"), "found the text \"'A'\", expected a label");
    assert_eq!(
        message("A=POSTF(7 8)\nFINI"),
        "found the number 8, expected an operator, \",\" or \")\""
    );
}

#[test]
fn e0102_bad_character() {
    raises("А=1\nFINI", 102, 1, 1);
    raises("A=1 $ B\nFINI", 102, 1, 5);
    raises("PPRINT/'ok' $$ да\nA=\"X\"\nFINI", 102, 2, 3);
}

#[test]
fn e0103_unclosed_text() {
    raises("T=TEXT/'abc\nFINI", 103, 1, 8);
}

#[test]
fn e0104_unknown_operator() {
    raises("A=5.GG.6\nFINI", 104, 1, 4);
}

#[test]
fn e0105_number_too_large() {
    raises("A=1E999\nFINI", 105, 1, 3);
}

#[test]
fn e0106_too_deep() {
    let brackets = format!("A={}1{}\nFINI", "(".repeat(101), ")".repeat(101));
    raises(&brackets, 106, 1, 103);
    raises(&format!("A={}1\nFINI", "-".repeat(101)), 106, 1, 103);
    raises(&format!("A=1{}\nFINI", "**1".repeat(101)), 106, 1, 304);
    raises(&format!("A=1{}\nFINI", "+1".repeat(200)), 106, 1, 3);
    let blocks = format!("{}{}FINI", "IF(A)THEN\n".repeat(101), "ENDIF\n".repeat(101));
    raises(&blocks, 106, 101, 1);
}

#[test]
fn e0107_too_long() {
    raises(&format!("FINI\n$$ {}", "x".repeat(16_384)), 107, 2, 1);
    let statement = format!("RESERV/A{}\nFINI", ",10,B$\n".repeat(3000));
    raises(&statement, 107, 2500, 2);
}

#[test]
fn e0108_file_too_large() {
    raises(&" \n".repeat((32 << 20) + 1), 108, 1, 1);
}

#[test]
fn e0109_too_many_errors() {
    let diags = parse("t.fil", &"A=(\n".repeat(5000)).diags;
    assert_eq!(diags.len(), 101);
    assert!(diags[..100].iter().all(|diag| diag.code.number == 101));
    assert_eq!((diags[100].code.number, diags[100].spans[0].line), (109, 101));
}

#[test]
fn e0110_wrong_section() {
    raises("CIMFIL/CYCLE\nCIMFIL/OFF\nFINI", 110, 1, 1);
    raises("CIMFIL/ON\nFINI", 110, 1, 1);
    raises("CIMFIL/ON,5000,X\nFINI", 110, 1, 1);
    raises("CIMFIL/ON,2.5\nFINI", 110, 1, 1);
}

#[test]
fn e0111_wrong_arguments() {
    raises("PRINT/MAYBE\nFINI", 111, 1, 1);
    raises("REDEF/\nFINI", 111, 1, 1);
    raises("RESERV/A,10,B\nFINI", 111, 1, 1);
    raises("CASE/A\nWHEN/1,OTHER\nENDCAS\nFINI", 111, 2, 1);
    raises("A(1)=MACRO\nTERMAC\nFINI", 111, 1, 3);
}

#[test]
fn e0112_unclosed_block() {
    raises("IF(A)THEN\nFINI", 112, 1, 1);
    raises("CASE/A\nWHEN/1\nIF(B)THEN\nENDCAS\nFINI", 112, 3, 1);
    raises("M=MACRO\nDO/L,I=1,5\nTERMAC\nFINI", 112, 2, 1);
    raises("CIMFIL/ON,OP\nDO/L,I=1,2\nCIMFIL/OFF\nFINI", 112, 2, 1);
    raises("CIMFIL/ON,OP\nIF(A)THEN\nDO/L,I=1,2\nENDIF\nCIMFIL/OFF\nFINI", 112, 3, 1);
    let both = parse("t.fil", "CASE/A\nWHEN/1\nIF(B)THEN\nENDCAS\nFINI").diags.remove(0);
    assert_eq!((both.spans[1].line, both.spans[1].label.as_str()), (4, "still open at ENDCAS"));
}

#[test]
fn e0113_stray_word() {
    raises("A=1\n  ENDIF\nFINI", 113, 2, 3);
    raises("ELSE\nFINI", 113, 1, 1);
    raises("ELSEIF(A)THEN\nFINI", 113, 1, 1);
    raises("WHEN/1\nFINI", 113, 1, 1);
    raises("ENDCAS\nFINI", 113, 1, 1);
    raises("TERMAC\nFINI", 113, 1, 1);
    raises("CIMFIL/OFF\nFINI", 113, 1, 1);
}

#[test]
fn e0114_unclosed_area() {
    raises("CIMFIL/ON,CYCLE\nA=1\nFINI", 114, 1, 1);
    raises("M=MACRO/X\nA=X\nFINI", 114, 1, 1);
}

#[test]
fn e0115_nested_area() {
    raises("CIMFIL/ON,CYCLE\nCIMFIL/ON,GOTO\nCIMFIL/OFF\nFINI", 115, 2, 1);
    raises("CIMFIL/ON,CYCLE\nM=MACRO\nTERMAC\nFINI", 115, 2, 1);
}

#[test]
fn e0116_before_when() {
    raises("CASE/A\nB=1\nWHEN/1\nENDCAS\nFINI", 116, 2, 1);
}

#[test]
fn e0117_after_last() {
    raises("IF(A)THEN\nELSE\nELSEIF(B)THEN\nENDIF\nFINI", 117, 3, 1);
    raises("IF(A)THEN\nELSE\nELSE\nENDIF\nFINI", 117, 3, 1);
    raises("CASE/A\nWHEN/OTHER\nWHEN/1\nENDCAS\nFINI", 117, 3, 1);
}

#[test]
fn e0118_wrong_do_end() {
    raises("DO/L,I=1,2\nDO/L,J=1,2\nL) CONTIN\nL) CONTIN\nFINI", 118, 2, 4);
    raises("DO/L,I=1,2\nDO/L,J=1,2\nL) CONTIN\nFINI", 118, 2, 4);
    raises("DO/L,I=1,5\nIF(I.EQ.2)THEN\nL) CONTIN\nENDIF\nL) CONTIN\nFINI", 118, 3, 1);
    raises("DO/L,I=1,5\nIF(I.EQ.2)THEN\nL) CONTIN\nENDIF\nFINI", 118, 3, 1);
    raises("DO/L,I=1,2\nL) IF(A)THEN\nENDIF\nFINI", 118, 2, 1);
}

#[test]
fn e0119_wrong_label() {
    raises("IF(A)THEN\nL) ELSE\nENDIF\nFINI", 119, 2, 1);
    raises("L) CIMFIL/ON,CYCLE\nCIMFIL/OFF\nFINI", 119, 1, 1);
}

#[test]
fn e0122_statement_in_text() {
    raises("PPRINT STOP; COOLNT/OFF\nFINI", 122, 1, 8);
    raises("IF(A)INSERT M6 ;DMY=POSTF(13)\nFINI", 122, 1, 13);
    assert_eq!(message("PPRINT A; X=1\nFINI"), "\"X=1\" is part of the text");
}

#[test]
fn e0123_section_after_fini() {
    raises("FINI\nA=1\n cimfil/ON,CYCLE\nCIMFIL/OFF\n", 123, 3, 2);
    raises("FINI\nA=1; SIMFIL /ON,OP\n", 123, 2, 6);
    raises("FINI\nthe word CIMFIL in a sentence\n", 153, 2, 1);
}

#[test]
fn w0150_closed_by_section() {
    raises("CIMFIL/ON,OP\nIF(A)THEN\nB=1\nCIMFIL/OFF\nFINI", 150, 2, 1);
    raises("CIMFIL/ON,OP\nCASE/A\nWHEN/1\nB=1\nCIMFIL/OFF\nFINI", 150, 2, 1);
}

#[test]
fn w0151_misspelled() {
    raises("SIMFIL/ON,CYCLE\nCIMFIL/OFF\nFINI", 151, 1, 1);
}

#[test]
fn w0152_missing_fini() {
    raises("A=1\nB=2\n\n", 152, 2, 4);
    raises("", 152, 1, 1);
}

#[test]
fn w0153_after_fini() {
    raises("FINI\n$$ a comment is fine\n ; \nA=(\n", 153, 4, 1);
}

#[test]
fn e0124_sign_before_power() {
    raises("A=-B**2\nFINI", 124, 1, 3);
    assert!(parse("t.fil", "A=(-B)**2 ; C=-(B**2) ; D=2**-B\nFINI").diags.is_empty());
}

#[test]
fn w0155_semicolon_in_text() {
    raises("PPRINT STOP; wait 5 s\nFINI", 155, 1, 8);
    assert!(parse("t.fil", "PPRINT/'STOP'; COOLNT/OFF\nFINI").diags.is_empty());
}

#[test]
fn every_code_has_a_number_of_its_own_in_this_range() {
    let mut numbers: Vec<_> = SyntaxCode::ALL.iter().map(|code| code.number).collect();
    assert!(numbers.iter().all(|number| (101..200).contains(number)));
    numbers.dedup();
    assert_eq!(numbers.len(), SyntaxCode::ALL.len());
}
