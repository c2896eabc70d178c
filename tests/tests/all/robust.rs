//! Nothing that comes in may panic, hang, or write a number that is none.

use filpost::{Limits, Program};
use proptest::prelude::*;

/// Words and numbers a CL record may hold, likely and unlikely ones.
fn item() -> impl Strategy<Value = String> {
    prop_oneof![
        (-1e4..1e4f64).prop_map(|number| format!("{number:.4}")),
        Just("0.0".to_string()),
        Just("1E300".to_string()),
        Just("999999.0".to_string()),
        prop::sample::select(
            &[
                "ON", "OFF", "RPM", "CLW", "MMPM", "IPM", "DRILL", "DEEP", "DEPTH", "STEP",
                "CLEAR", "RETURN", "LEFT", "RIGHT", "OUT", "OPTION", "AUTO", "TPI", "INCR", "MM",
                "INCHES", "NOMORE", "THREAD", "DWELL", "FLOOD", "TURN", "MILL",
            ][..]
        )
        .prop_map(str::to_string),
    ]
}

fn record() -> impl Strategy<Value = String> {
    let words = prop::sample::select(
        &[
            "GOTO", "GODLTA", "FROM", "CIRCLE", "RAPID", "FEDRAT", "SPINDL", "COOLNT", "LOADTL",
            "CYCLE", "CUTCOM", "DELAY", "STOP", "UNITS", "MULTAX", "TLAXIS", "PREFUN", "AUXFUN",
            "SEQNO", "MODE", "THREAD", "OP", "TRANS", "REPEAT", "POSTN", "OPSKIP", "PARTNO",
            "PPRINT", "INSERT", "END", "REWIND", "SELCTL", "TURRET", "CUTTER", "MACHIN", "WOBBLE",
        ][..],
    );
    (words, prop::collection::vec(item(), 0..9))
        .prop_map(|(word, items)| format!("{word} / {}", items.join(", ")))
}

/// Sensible records between the others, so that a run gets further.
fn program() -> impl Strategy<Value = String> {
    let sensible = prop_oneof![
        Just("FEDRAT / 200, MMPM".to_string()),
        Just("RAPID".to_string()),
        prop::array::uniform3(-500.0..500.0f64)
            .prop_map(|[x, y, z]| format!("GOTO / {x:.4}, {y:.4}, {z:.4}")),
        Just("CYCLE / DEEP, DEPTH, 9, STEP, 2, MMPM, 90, CLEAR, 1".to_string()),
        Just("CYCLE / OFF".to_string()),
        Just("LOADTL / 4".to_string()),
    ];
    prop::collection::vec(prop_oneof![4 => sensible, 1 => record()], 1..30)
        .prop_map(|records| records.join("\n") + "\nFINI\n")
}

/// Every word of a block is a letter and a number that is one.
fn is_block(line: &str) -> bool {
    let comment = line.contains('(') || line == "%" || line.starts_with('O');
    comment
        || line.trim_start_matches('/').split(' ').all(|word| {
            let mut characters = word.chars();
            characters.next().is_some_and(|letter| letter.is_ascii_uppercase())
                && characters.as_str().parse::<f64>().is_ok_and(f64::is_finite)
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn records_of_any_form_are_posted_or_refused(cl in program(), ready in 0..4usize) {
        let ready = ["fanuc-mill", "fanuc-lathe", "grbl", "linuxcnc-mill"][ready];
        let post = Program::builder().generic(ready).build().unwrap();
        let mut nc = Vec::new();
        let texts = ["PPRINT", "INSERT", "PARTNO"];
        let has_text = cl.lines().any(|line| texts.iter().any(|text| line.starts_with(text)));
        if post.stream(cl.as_bytes(), &mut nc).is_ok() && !has_text {
            for line in String::from_utf8(nc).unwrap().lines() {
                prop_assert!(is_block(line), "{line}\n{cl}");
            }
        }
    }

    #[test]
    fn the_same_input_gives_the_same_bytes(cl in program()) {
        let run = || {
            let post = Program::builder().build().unwrap();
            let mut nc = Vec::new();
            let result = post.stream(cl.as_bytes(), &mut nc);
            (nc, result.map(|report| report.blocks).map_err(|error| error.to_string()))
        };
        prop_assert_eq!(run(), run());
    }

    #[test]
    fn any_bytes_as_cl_or_fil_or_machine(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let limits = Limits { fuel: 10_000, ..Limits::default() };
        let built = Program::builder().fil("noise.fil", &text).limits(limits).build();
        let _ = Program::builder().machine("machine.toml", &text).build();
        let _ = Program::builder().option_file("uncx01.p01", &text).build();
        for post in built.into_iter().chain(Program::builder().build()) {
            let _ = post.stream(bytes.as_slice(), std::io::sink());
        }
    }
}

#[test]
fn ten_megabytes_of_noise_end_soon() {
    let mut state = 0x2545_F491_4F6C_DD1Du64;
    let noise: Vec<u8> = std::iter::repeat_with(|| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as u8
    })
    .take(10_000_000)
    .collect();
    let post = Program::builder().build().unwrap();
    assert!(post.stream(noise.as_slice(), std::io::sink()).is_err());
    let text: String = noise.iter().map(|byte| char::from(byte & 0x7f)).collect();
    assert!(Program::builder().fil("noise.fil", &text).build().is_err());
    assert!(post.stream(text.as_bytes(), std::io::sink()).is_err());
}

#[test]
fn a_program_is_shared_by_threads_and_its_blocks_move_between_them() {
    fn is_shared<T: Send + Sync>(_: &T) {}
    fn is_send<T: Send>(_: &T) {}
    let program = Program::builder().build().unwrap();
    is_shared(&program);
    is_send(&program.start().observe(|_| {}));
    is_send(&program.blocks(&b"FINI"[..]));
}
