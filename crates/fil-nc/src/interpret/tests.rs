use fil_machine::Commons;
use fil_machine::files::apply_setting;
use fil_machine::locations::default_commons;
use proptest::prelude::*;

use super::events;
use crate::dialect::Dialect;

fn lathe() -> Commons {
    let mut commons = default_commons();
    for setting in ["lathe.diameter=true", "thread.code=32", "tool.format=2", "feed.mode=99"] {
        apply_setting(&mut commons, setting).unwrap();
    }
    commons
}

fn five_axes() -> Commons {
    let mut commons = default_commons();
    for setting in [
        "rotary.primary_kind=1",
        "rotary.primary_axis=3",
        "rotary.primary_k=1",
        "rotary.secondary_kind=2",
        "rotary.secondary_axis=1",
        "rotary.secondary_i=1",
    ] {
        apply_setting(&mut commons, setting).unwrap();
    }
    commons
}

fn dialects() -> [Dialect; 3] {
    [default_commons(), lathe(), five_axes()].map(|commons| Dialect::new(&commons).unwrap())
}

/// Words that make programs which get far.
fn word() -> impl Strategy<Value = String> {
    let codes = prop::sample::select(vec![
        "G0", "G1", "G2", "G3", "G4", "G17", "G18", "G19", "G20", "G21", "G28", "G32", "G41",
        "G40", "G43", "G43.4 H1", "G49", "C0. A0.", "G53", "G54", "G55", "G76", "G80", "G81",
        "G83", "G73", "G84", "G86", "G90", "G91", "G92", "G93", "G94", "G95", "G98", "G99", "M3",
        "M4", "M5", "M6", "M8", "M98", "M99", "M30", "O1", "O2", "%", "\n", "\n", "\n", "/",
    ]);
    let value =
        (prop::sample::select(b"XYZIJKRPQFSTHDUWAKL".to_vec()), -300i32..300, any::<bool>());
    prop_oneof![
        codes.prop_map(String::from),
        value.prop_map(|(letter, value, point)| {
            let letter = char::from(letter);
            if point {
                format!("{letter}{:.1}", f64::from(value) / 10.0)
            } else {
                format!("{letter}{}", value.abs() / 100)
            }
        }),
    ]
}

proptest! {
    #[test]
    fn any_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        for dialect in dialects() {
            let _ = events(&bytes, "test", &dialect);
        }
    }

    #[test]
    fn any_words_never_panic(words in proptest::collection::vec(word(), 0..80)) {
        let text = words.join(" ");
        for dialect in dialects() {
            if let Err(diag) = events(text.as_bytes(), "test", &dialect) {
                prop_assert!(!diag.spans.is_empty());
            }
        }
    }
}
