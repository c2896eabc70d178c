//! DO, CASE, IF, JUMPTO.

use crate::bench::{Bench, globals};

#[test]
fn do_takes_both_ends_and_leaves_the_first_value_past_the_end() {
    let bench = globals("SUM=0\nDO/LA,II=1,4\nSUM=SUM+II\nLA) CONTIN");
    assert_eq!((bench.number("SUM"), bench.number("II")), (10.0, 5.0));
}

#[test]
fn do_tests_before_the_first_pass() {
    let bench = globals("NN=0\nDO/LA,II=5,4\nNN=NN+1\nLA) CONTIN");
    assert_eq!((bench.number("NN"), bench.number("II")), (0.0, 5.0));
}

#[test]
fn do_steps_backwards() {
    let bench = globals("NN=0\nDO/LA,II=3,-3,-2\nNN=NN*10+II\nLA) CONTIN");
    // 3, 1, -1, -3
    assert_eq!((bench.number("NN"), bench.number("II")), (3087.0, -5.0));
}

#[test]
fn do_settles_end_and_step_before_the_first_pass() {
    let bench = globals("LAST=3;ST=1;NN=0\nDO/LA,II=1,LAST,ST\nLAST=99;ST=50\nNN=NN+1\nLA) CONTIN");
    assert_eq!(bench.number("NN"), 3.0);
    let bench = globals("II=2\nDO/LA,II=1,II+1\nLA) CONTIN");
    assert_eq!(bench.number("II"), 4.0, "the end is 2 + 1");
}

#[test]
fn the_loop_variable_is_an_ordinary_one() {
    let bench = globals("NN=0\nDO/LA,II=1,10\nNN=NN+1\nII=II+4\nLA) CONTIN");
    assert_eq!((bench.number("NN"), bench.number("II")), (2.0, 11.0));
}

#[test]
fn a_jump_to_the_last_statement_goes_to_the_next_pass() {
    let bench = globals("SUM=0\nDO/LA,II=1,5\nIF(II.EQ.3)JUMPTO/LA\nSUM=SUM+II\nLA) CONTIN");
    assert_eq!(bench.number("SUM"), 12.0);
}

#[test]
fn a_jump_leaves_nested_loops() {
    let bench = globals(
        "DO/LA,II=1,5\nDO/LB,JJ=1,5\nIF(II*JJ.EQ.6)JUMPTO/OUTSID\nLB) CONTIN\nLA) CONTIN\nOUTSID) CONTIN",
    );
    assert_eq!((bench.number("II"), bench.number("JJ")), (2.0, 3.0));
}

#[test]
fn jumpto_goes_back_and_forth() {
    let bench = globals("NN=0\nLA) NN=NN+1\nIF(NN.LT.7)JUMPTO/LA\nJUMPTO/LB\nNN=100\nLB) CONTIN");
    assert_eq!(bench.number("NN"), 7.0);
}

#[test]
fn arithmetic_if_looks_at_the_sign() {
    for (value, wanted) in [("-0.001", 1.0), ("0", 2.0), ("5", 3.0)] {
        let bench = globals(&format!(
            "VV={value}\nIF(VV)LN,LZ,LP\nLN) RR=1\nJUMPTO/LE\nLZ) RR=2\nJUMPTO/LE\nLP) RR=3\nLE) CONTIN"
        ));
        assert_eq!(bench.number("RR"), wanted, "{value}");
    }
}

#[test]
fn arithmetic_if_may_go_back() {
    let bench = globals("VV=-3\nLA) VV=VV+1\nIF(VV)LA,LB,LB\nLB) CONTIN");
    assert_eq!(bench.number("VV"), 0.0);
}

#[test]
fn if_takes_the_first_arm_that_holds() {
    for (value, wanted) in [(1, 10.0), (2, 20.0), (3, 30.0)] {
        let bench = globals(&format!(
            "VV={value}\nIF(VV.EQ.1)THEN\nRR=10\nELSEIF(VV.LE.2)THEN\nRR=20\nELSE\nRR=30\nENDIF"
        ));
        assert_eq!(bench.number("RR"), wanted);
    }
}

#[test]
fn and_and_or_leave_the_rest_out_when_it_is_settled() {
    // 1/ZZ would be an error.
    let bench = globals(
        "ZZ=0;RR=0\nIF(ZZ.NE.0.AND.1/ZZ.GT.1)RR=RR+1\nIF(ZZ.EQ.0.OR.1/ZZ.GT.1)RR=RR+2\n\
         IF(.NOT.(ZZ.NE.0.AND.1/ZZ.GT.1))RR=RR+4\nIF(.NOT.(ZZ.EQ.0.OR.1/ZZ.GT.1))RR=RR+8",
    );
    assert_eq!(bench.number("RR"), 6.0);
}

#[test]
fn every_comparison_agrees_with_arithmetic() {
    type Holds = fn(i32, i32) -> bool;
    let operators: [(&str, Holds); 6] = [
        ("EQ", |x, y| x == y),
        ("NE", |x, y| x != y),
        ("LT", |x, y| x < y),
        ("LE", |x, y| x <= y),
        ("GT", |x, y| x > y),
        ("GE", |x, y| x >= y),
    ];
    for (name, holds) in operators {
        for (x, y) in [(1, 2), (2, 2), (3, 2)] {
            let bench = globals(&format!(
                "XX={x};YY={y};RR=0;NN=0\nIF(XX.{name}.YY)RR=1\nIF(.NOT.XX.{name}.YY)NN=1\nVV=(XX.{name}.YY)\nIF(VV)NN=NN+10"
            ));
            let wanted = f64::from(u8::from(holds(x, y)));
            assert_eq!(bench.number("RR"), wanted, "{x}.{name}.{y}");
            assert_eq!(bench.number("NN"), 1.0 - wanted + 10.0 * wanted, "{x}.{name}.{y}");
        }
    }
}

#[test]
fn case_does_not_fall_through() {
    let program = |value| {
        format!(
            "RR=0\nCASE/{value}\nWHEN/1,2\nRR=RR+1\nWHEN/3\nRR=RR+10\nWHEN/OTHER\nRR=RR+100\nENDCAS"
        )
    };
    for (value, wanted) in [("1", 1.0), ("2", 1.0), ("3", 10.0), ("4", 100.0), ("1+2", 10.0)] {
        assert_eq!(globals(&program(value)).number("RR"), wanted, "{value}");
    }
}

#[test]
fn case_without_other_may_take_nothing_and_texts_are_cases_too() {
    let bench = globals(
        "RR=0\nCASE/7\nWHEN/1\nRR=1\nENDCAS\nT1='DRILL'\nCASE/T1\nWHEN/'TAP'\nSS=1\nWHEN/'DRILL'\nSS=2\nENDCAS",
    );
    assert_eq!((bench.number("RR"), bench.number("SS")), (0.0, 2.0));
}

#[test]
fn a_loop_inside_case_inside_if_keeps_its_lines() {
    let mut bench = Bench::new(
        "VV=2\nIF(VV.EQ.2)THEN\nCASE/VV\nWHEN/2\nDO/LA,II=1,3\nXX=1/(II-3)\nLA) CONTIN\nENDCAS\nENDIF",
    );
    let diag = bench.globals().unwrap_err();
    assert_eq!((diag.code.number, diag.spans[0].line), (301, 6));
}
