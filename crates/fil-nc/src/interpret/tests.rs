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

/// Whether a program is read on the machine that these settings make of a usual one.
fn is_read(base: Commons, settings: &[&str], text: &str) -> bool {
    let mut commons = base;
    for setting in settings {
        apply_setting(&mut commons, setting).unwrap();
    }
    let program = format!("%\nO1\nG90 G94 G17 G21\n{text}\nM30\n%\n");
    events(program.as_bytes(), "test", &Dialect::new(&commons).unwrap()).is_ok()
}

#[test]
fn an_osp_goes_to_the_end_of_the_travel_by_its_name_alone() {
    for (block, read) in [
        ("G16 H0 G0 Z=VPSLZ", true),
        ("G16H0G0Z=VPSLZ", true),
        ("G16 H0 G0 Z0.", false),
        ("G16 H1 G0 Z=VPSLZ", false),
        ("G16 G0 Z=VPSLZ", false),
        ("G16 H0 G0 Z=VPSLX", false),
        ("G0 Z=VPSLZ", false),
    ] {
        assert_eq!(is_read(default_commons(), &["tool.length_code=56"], block), read, "{block}");
        assert!(!is_read(default_commons(), &[], block), "{block}");
    }
}

#[test]
fn p_selects_the_spindle_of_a_block() {
    let settings = [
        "rotary.primary_kind=1",
        "rotary.primary_axis=3",
        "rotary.primary_k=1",
        "spindle.select_number=11",
        "mill_turn.milling_code=35",
        "mill_turn.turning_code=34",
        "mill_turn.live_cw_code=3",
        "mill_turn.live_ccw_code=4",
        "mill_turn.live_stop_code=5",
        "mill_turn.live_select_number=12",
    ];
    for (blocks, read) in [
        ("S800 M3 P11\nM5 P11", true),
        ("S800 M3 P11\nM5 P11\nM35\nS2000 M3 P12\nM5 P12\nM34", true),
        ("S800 M3", false),
        ("S800 M3 P13", false),
        ("S800 M3 P12", false),
        ("M35\nS2000 M3 P11", false),
    ] {
        assert_eq!(is_read(lathe(), &settings, blocks), read, "{blocks}");
    }
}

#[test]
fn a_live_tool_needs_its_own_speed() {
    let settings = [
        "rotary.primary_kind=1",
        "rotary.primary_axis=3",
        "rotary.primary_k=1",
        "mill_turn.milling_code=154",
        "mill_turn.turning_code=155",
        "mill_turn.live_cw_code=133",
        "mill_turn.live_ccw_code=134",
        "mill_turn.live_stop_code=135",
        "mill_turn.live_speed_address=P",
    ];
    for (blocks, read) in [
        ("M154\nP2000 M133\nM135\nM155", true),
        ("M154\nM133", false),
        ("M154\nS2000 M133", false),
        ("P2000 M133", false),
    ] {
        assert_eq!(is_read(lathe(), &settings, blocks), read, "{blocks}");
    }
}

#[test]
fn a_frame_without_angles_needs_to_know_where_the_rotary_axes_stand() {
    let settings =
        ["rotary.frame_form=1", "rotary.frame_code=2540", "rotary.frame_cancel_code=255"];
    for (blocks, read) in [
        ("G0 A-10. C-60.\nG254\nX1. Y2.\nG255", true),
        ("G0 A-10.\nG254", false),
        ("G0 A-10. C-60.\nG254\nA0.", false),
        ("G0 A-10. C-60.\nG254 X1.", false),
    ] {
        assert_eq!(is_read(five_axes(), &settings, blocks), read, "{blocks}");
    }
}
