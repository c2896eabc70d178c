//! The rules of the layout, each by an example.

use fil_syntax::format;

/// Asserts what a text comes out as, and that it then stays so.
#[track_caller]
fn comes_out(source: &str, expected: &str) {
    let text = format("t.fil", source).expect("no errors");
    assert_eq!(text, expected, "\ngot:\n{text}\nexpected:\n{expected}");
    assert_eq!(format("t.fil", &text).expect("no errors"), text);
}

#[test]
fn words_are_in_upper_case_and_texts_as_written() {
    comes_out(
        "cimfil/on,goto\npostn / out , x , xpos\npprint Hello, world = 5\n\
         insert/ g5 p1\nt = text/'mixed Case',3,postf(7,4)\ncimfil/off\nfini",
        "CIMFIL/ON,GOTO\n  POSTN/OUT,X,XPOS\n  PPRINT Hello, world = 5\n  \
         INSERT/g5 p1\n  T = TEXT/'mixed Case',3,POSTF(7,4)\nCIMFIL/OFF\nFINI\n",
    );
}

#[test]
fn blanks_stand_around_what_is_assigned_and_its_sums() {
    comes_out(
        "XIT=XSTR+(2*CDIST-1)\nA( I+1 )= - B ** 2 - - 1 / 4.50\nPOSTN/OUT,X,A+1\nT=TEXT/A+1\nFINI",
        "XIT = XSTR + (2*CDIST-1)\nA(I+1) = -B**2 - -1/4.50\nPOSTN/OUT,X,A+1\nT = TEXT/A+1\nFINI\n",
    );
    comes_out(
        "if( a .eq. 1 .and..not. b.lt.2.or.c )jumpto/ 010\nif(a)x=1+2\nIF(A)1, 2 ,L\nFINI",
        "IF (A.EQ.1 .AND. .NOT.B.LT.2 .OR. C) JUMPTO/010\nIF (A) X = 1 + 2\nIF (A) 1,2,L\nFINI\n",
    );
    comes_out(
        "CALL/M , P = 5,X+1\nRESERV/A, 10\nDO/L, I = 1 , N-1\nL)CONTIN\nFINI",
        "CALL/M,P=5,X+1\nRESERV/A,10\nDO/L,I=1,N-1\nL) CONTIN\nFINI\n",
    );
}

#[test]
fn blocks_are_indented() {
    comes_out(
        "M=MACRO/P=1,Q\nCASE/P\nWHEN/1,2\nDO/L1,I=1,5\nDO/02,J=1,5\n2)A=I+J\nB=A\nL1)CONTIN\n\
         WHEN/OTHER\nIF(Q)THEN\nA=1\nELSEIF(P)THEN\nA=2\nELSE\nA=3\nX)ENDIF\nENDCAS\nTERMAC\nFINI",
        "M = MACRO/P=1,Q\n  CASE/P\n  WHEN/1,2\n    DO/L1,I=1,5\n      DO/02,J=1,5\n        \
         2) A = I + J\n      B = A\n    L1) CONTIN\n  WHEN/OTHER\n    IF (Q) THEN\n      A = 1\n    \
         ELSEIF (P) THEN\n      A = 2\n    ELSE\n      A = 3\n    X) ENDIF\n  ENDCAS\nTERMAC\nFINI\n",
    );
}

#[test]
fn a_section_ends_the_blocks_left_open_in_it() {
    comes_out(
        "SIMFIL/ON,OP\nIF(A)THEN\nCASE/C\nWHEN/1\nB=1\nCIMFIL/OFF\nA=1\nFINI",
        "SIMFIL/ON,OP\n  IF (A) THEN\n    CASE/C\n    WHEN/1\n      B = 1\nCIMFIL/OFF\nA = 1\nFINI\n",
    );
}

#[test]
fn what_a_user_can_allow_is_no_hindrance() {
    comes_out("A=-B**2\nPPRINT STOP; A=1\nFINI", "A = -B**2\nPPRINT STOP; A=1\nFINI\n");
}

#[test]
fn comments_follow_the_statement_below_them() {
    comes_out(
        "$$ head\nCIMFIL/ON,OP\n$$ first  \n\t$$second\nA=1    $$ why\n$$ last\nCIMFIL/OFF\n$$ tail\nFINI$$ end",
        "$$ head\nCIMFIL/ON,OP\n  $$ first\n  $$second\n  A = 1  $$ why\n  $$ last\nCIMFIL/OFF\n$$ tail\nFINI  $$ end\n",
    );
}

#[test]
fn banners_stay_in_the_first_column() {
    comes_out(
        "CIMFIL/ON,OP\n$$ =====\n$$ motion\n$$ =====\nA=1\n $$ ----\nB=1\nCIMFIL/OFF\nFINI\n",
        "CIMFIL/ON,OP\n$$ =====\n$$ motion\n$$ =====\n  A = 1\n  $$ ----\n  B = 1\nCIMFIL/OFF\nFINI\n",
    );
}

#[test]
fn one_blank_line_is_kept() {
    comes_out(
        "\n\n  \nA=1\n\n\t\n\nB=1\n;\nC=1\n\n$$ c\n\n\nFINI\n\n\n",
        "A = 1\n\nB = 1\nC = 1\n\n$$ c\n\nFINI\n",
    );
}

#[test]
fn statements_of_a_line_stay_together() {
    comes_out(
        "A=1;B=2 ;; C=3; $$ three\nD=4 $\n ;E=5\nFINI",
        "A = 1; B = 2; C = 3  $$ three\nD = 4; E = 5\nFINI\n",
    );
    let long = format!("A=1;B={}\nFINI", "1+".repeat(16) + "1");
    let sum = "1 + ".repeat(16) + "1";
    comes_out(&long, &format!("A = 1\nB = {sum}\nFINI\n"));
}

#[test]
fn long_lines_are_broken_after_a_comma() {
    comes_out(
        "CIMFIL/ON,OP\nPOSTN/OUT,G,76,X,XSTART,Z,ZENDPOS,K,THREADP,D,FDEPTH,I,MAXF(TTAPER,TMIN),A,TNOSE\nCIMFIL/OFF\nFINI",
        "CIMFIL/ON,OP\n  POSTN/OUT,G,76,X,XSTART,Z,ZENDPOS,K,THREADP,D,FDEPTH,I, $\n      \
         MAXF(TTAPER,TMIN),A,TNOSE\nCIMFIL/OFF\nFINI\n",
    );
    comes_out(
        "LENGTH=SQRTF((XEND-XSTART)**2+(YEND-YSTART)**2)+SQRTF((XEND-XMID)**2+(YEND-YMID)**2)\nFINI",
        "LENGTH = SQRTF((XEND-XSTART)**2+(YEND-YSTART)**2) + $\n    SQRTF((XEND-XMID)**2+(YEND-YMID)**2)\nFINI\n",
    );
}

#[test]
fn lines_are_joined_unless_a_comment_parts_them() {
    comes_out(
        "POSTN/OUT, $\n X,1, $ $$ across\n Y, $ $$ up\n $ $$ and up\n 2 $$ done\nFINI",
        "POSTN/OUT,X,1, $  $$ across\n    Y, $  $$ up\n    $  $$ and up\n    2  $$ done\nFINI\n",
    );
    comes_out(
        "L $ $$ label\n ) CONTIN $ $$ a\n $$ b\nFINI",
        "L) $  $$ label\n    CONTIN  $$ a\n$$ b\nFINI\n",
    );
}

#[test]
fn words_that_take_text_keep_what_makes_it_text() {
    comes_out(
        "PPRINT 'a' , B\nPPRINT/'a'\nPPRINT/ $\n a\nPPRINT=1\nPPRINT\nREMARK /  x $\nL)LETTER ABC\nIF(A)INSERT/m0 \nFINI",
        "PPRINT 'a',B\nPPRINT/'a'\nPPRINT/ $\n    A\nPPRINT = 1\nPPRINT\nREMARK/x $\nL) LETTER ABC\nIF (A) INSERT/m0\nFINI\n",
    );
    comes_out(
        "includ/ Sub\\a.fil;A=1\nINCLUD/'x y.fil'\nFINI",
        "INCLUD/Sub\\a.fil; A = 1\nINCLUD/'x y.fil'\nFINI\n",
    );
}

#[test]
fn line_ends_stay_as_they_are() {
    comes_out("A=1\r\n\r\nFINI", "A = 1\r\n\r\nFINI\r\n");
    comes_out("A=1\rFINI", "A = 1\rFINI\r");
    comes_out("A=1\r\nB=2\nFINI", "A = 1\r\nB = 2\r\nFINI\r\n");
    comes_out("\u{feff}FINI\x1a", "FINI\n");
    comes_out("", "");
    comes_out(" \n\n", "");
    comes_out("$$ only", "$$ only\n");
}

#[test]
fn what_follows_fini_is_left_alone() {
    comes_out("fini\n$$ c\n\n\n  a=(1\n  b = 2 \n\n", "FINI\n$$ c\n\n  a=(1\n  b = 2\n");
    comes_out("fini ; a=(1", "FINI; a=(1\n");
}

#[test]
fn a_text_with_errors_is_refused() {
    let diags = format("t.fil", "A=1\nB=(\nFINI").expect_err("an error");
    assert_eq!((diags[0].code.number, diags[0].spans[0].line), (101, 2));
}

#[test]
fn a_line_that_indentation_would_make_too_long_leaves_the_text_alone() {
    let source = format!("CIMFIL/ON,OP\nPPRINT {}\nCIMFIL/OFF\nFINI\n", "X".repeat(16_384 - 7));
    assert_eq!(format("t.fil", &source).expect("no errors"), source);
}

#[test]
fn a_lone_continuation_sign_behind_fini_is_nothing() {
    for source in ["A=1\nFINI\n$", "A=1\nFINI\n$\n", "A=1\nFINI\n$  "] {
        comes_out(source, "A = 1\nFINI\n");
    }
    comes_out("A=1\nFINI\n$ NOTES", "A = 1\nFINI\n$ NOTES\n");
}

#[test]
fn what_follows_fini_has_the_line_ends_of_the_file() {
    comes_out("\r\nFINI; A=1\nB", "FINI; A=1\r\nB\r\n");
}
