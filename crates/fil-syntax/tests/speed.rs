//! Reading and formatting take time in proportion to the text, whatever it is.

use std::time::{Duration, Instant};

use fil_syntax::{format, parse};

/// A file as people write them, of so many lines.
fn ordinary(lines: usize) -> String {
    let mut text = String::new();
    for section in 0..lines / 10 {
        text.push_str(&format!(
            "CIMFIL/ON,WORD{section}\nA=POSTF(7,4) $$ type\nIF(A.EQ.ICODEF(AUTO))THEN\n\
             B=POSTF(7,5)*2+SQRTF(A**2+1)\nDO/L, I=1, A+1, 1\nPOSTN/OUT,G,00,X,B,Z,-1.5\n\
             L) CONTIN\nELSE\nENDIF\nCIMFIL/OFF\n"
        ));
    }
    text.push_str("FINI\n");
    text
}

fn time_of(source: &str) -> Duration {
    let start = Instant::now();
    let parsed = parse("t.fil", source);
    assert!(parsed.diags.len() <= 101);
    start.elapsed()
}

#[test]
fn ten_megabytes_of_noise_are_read_in_a_moment() {
    let size = 10 << 20;
    let deep_then_long = format!("A={}{}\n", "(1+2*3.LT.".repeat(99), ") ".repeat(2000));
    let pieces = [
        "(",
        "-",
        "A",
        "A**",
        "'",
        "$ ",
        "9",
        "1+",
        "A=1;",
        "IF(A)THEN\n",
        "A=(\n",
        "DO/L,I=1,2\n",
        "L) A\n",
        "ELSE\n",
        "PPRINT ;\n",
        "A=1,$\n",
        deep_then_long.as_str(),
    ];
    for piece in pieces {
        let source = piece.repeat(size / piece.len());
        let time = time_of(&source);
        assert!(time < Duration::from_secs(20), "{:.40}: {time:?}", piece);
    }
}

#[test]
fn two_megabytes_are_formatted_in_a_moment() {
    let size = 2 << 20;
    let sum = format!("A=1{}\n", "+$\n1".repeat(199));
    let list = format!("A=MAXF(1{})\n", ",1".repeat(4000));
    for piece in ["$$\n", "$$==\n", "\n", "A=1;$\n", "A $ $$ b\n\n", &sum, &list] {
        let body = piece.repeat(size / piece.len());
        for depth in [0, 99] {
            let (opened, closed) = ("IF(A)THEN\n".repeat(depth), "ENDIF\n".repeat(depth));
            let source = format!("{opened}{body}\n{closed}FINI\n");
            let start = Instant::now();
            assert!(format("t.fil", &source).is_ok(), "{piece:.40}");
            let time = start.elapsed();
            assert!(time < Duration::from_secs(20), "{piece:.40}: {time:?}");
        }
    }
}

#[test]
#[ignore = "a measurement; run it in release"]
fn lines_per_second() {
    let source = ordinary(100_000);
    let lines = source.lines().count();
    assert!(parse("t.fil", &source).diags.is_empty());
    let best = (0..5).map(|_| time_of(&source)).min().unwrap_or_default();
    println!("{lines} lines in {best:?}: {:.0} lines/s", lines as f64 / best.as_secs_f64());
}
