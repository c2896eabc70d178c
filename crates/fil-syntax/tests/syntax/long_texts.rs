//! Long texts of any kind are read and formatted to their end. Work that grew by the
//! square of the length would not come to it; how fast they are is a matter of the
//! benches.

use fil_syntax::{format, parse};

/// More diagnostics than these are not kept.
const KEPT: usize = 101;

#[test]
fn noise_is_read_to_its_end() {
    let size = 1 << 20;
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
        let parsed = parse("t.fil", &piece.repeat(size / piece.len()));
        assert!(parsed.diags.len() <= KEPT, "{piece:.40}");
    }
}

#[test]
fn long_files_are_formatted_to_their_end() {
    format_long_files(0);
}

#[test]
fn long_files_in_deep_blocks_are_formatted_to_their_end() {
    format_long_files(99);
}

/// Formats long files whose lines stand in so many blocks.
fn format_long_files(depth: usize) {
    let (opened, closed) = ("IF(A)THEN\n".repeat(depth), "ENDIF\n".repeat(depth));
    let size = 1 << 19;
    let sum = format!("A=1{}\n", "+$\n1".repeat(199));
    let list = format!("A=MAXF(1{})\n", ",1".repeat(4000));
    for piece in ["$$\n", "$$==\n", "\n", "A=1;$\n", "A $ $$ b\n\n", &sum, &list] {
        let body = piece.repeat(size / piece.len());
        let source = format!("{opened}{body}\n{closed}FINI\n");
        assert!(format("t.fil", &source).is_ok(), "{piece:.40}");
    }
}
