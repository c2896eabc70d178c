//! How fast FIL is read and compiled, and how that grows with the number of macros:
//! `cargo bench -p filpost-tests --bench compile`.

use std::fmt::Write as _;
use std::time::Instant;

use fil_cl::Vocabulary;
use fil_vm::{FilFile, LoadOptions};

/// Lines of the generated file, about.
const LINES: usize = 100_000;

/// Lines of one macro.
const MACRO_LINES: usize = 18;

/// The best of this many runs counts.
const REPEATS: usize = 5;

/// Lines a second that are promised.
const PROMISE: f64 = 200_000.0;

/// Numbers of macros that are compiled, least first.
const MACROS: [usize; 3] = [3_000, 30_000, 300_000];

/// A macro among the most of them may take so many times as long as one among the least.
const GROWTH: f64 = 1.5;

/// Macros of statements as scripts have them.
fn script() -> String {
    let mut text = String::new();
    for number in 0..LINES / MACRO_LINES {
        push_macro(&mut text, number);
    }
    text.push_str("FINI\n");
    text
}

fn push_macro(text: &mut String, number: usize) {
    let _ = write!(
        text,
        "$$ Macro number {number}\n\
         MAC{number}=MACRO/PX,PY=0\n\
         ZVAL=POSTF(7,8)/SQRTF(2)+PX*3.5 $$ a comment\n\
         IF (ZVAL.GT.10.AND.PY.EQ.0) THEN\n\
         POSTN/OUT,G,0,X,PX,Y,PY,Z,ZVAL\n\
         ELSE\n\
         DO/LA,II=1,5\n\
         SUM=SUM+II*ABSF(PX-PY)\n\
         LA) CONTIN\n\
         ENDIF\n\
         CASE/PX\n\
         WHEN/1,2\n\
         SPINDL/RPM,900+SUM,CLW\n\
         WHEN/OTHER\n\
         TT=TEXT/'X',PX\n\
         ENDCAS\n\
         TERMAC\n\n"
    );
}

/// Short macros, each with a name of its own.
fn macros(count: usize) -> String {
    let mut text = String::new();
    for number in 0..count {
        let _ = write!(text, "MAC{number}=MACRO/PX,PY=0\nZVAL=PX*2+PY\nTERMAC\n");
    }
    text.push_str("FINI\n");
    text
}

/// Seconds that a script takes, the best of some runs.
fn seconds(text: &str) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..REPEATS {
        let mut vocabulary = Vocabulary::new();
        let file = FilFile { name: "script.fil", text };
        let start = Instant::now();
        let loaded = fil_vm::load(&[file], &mut vocabulary, LoadOptions::default());
        best = best.min(start.elapsed().as_secs_f64());
        if let Err(diags) = loaded {
            panic!("the script is refused: {}", diags[0]);
        }
    }
    best
}

fn word(holds: bool) -> &'static str {
    if holds { "holds" } else { "DOES NOT HOLD" }
}

fn main() {
    let text = script();
    let lines = text.lines().count();
    let best = seconds(&text);
    let rate = lines as f64 / best;
    let verdict = word(rate >= PROMISE);
    println!("{lines} lines of FIL read and compiled in {best:.3} s: {rate:.0} lines/s, {verdict}");
    let mut least = None;
    for count in MACROS {
        let each = seconds(&macros(count)) / count as f64;
        let least = *least.get_or_insert(each);
        let verdict = word(each <= least * GROWTH);
        println!(
            "{count} macros: {:.0} ns each, at most {GROWTH} times the first {verdict}",
            each * 1e9
        );
    }
}
