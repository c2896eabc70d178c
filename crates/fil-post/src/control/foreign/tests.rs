use fil_machine::{Letter, files};
use proptest::prelude::*;

use super::*;
use crate::cause::Cause;
use crate::control_state::{MachineSpot, Rotation, TextFrame, modal};

/// A control of a machine with these settings.
fn control_of(settings: &str) -> Control {
    let (commons, _) = files::read_toml("machine.toml", settings).expect("settings");
    Control::new(commons).expect("a machine")
}

/// The control of a ready post.
fn control(post: &str) -> Control {
    let posts = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fil-scripts/posts");
    let settings = std::fs::read_to_string(format!("{posts}/{post}/machine.toml"));
    control_of(&settings.expect("a ready post"))
}

fn families() -> [Control; 3] {
    ["fanuc-mill", "heidenhain-tnc640", "sinumerik-840d"].map(control)
}

fn word_address(text: &str) -> ForeignBlock {
    control("fanuc-mill").read(text.to_string())
}

fn sinumerik(text: &str) -> ForeignBlock {
    control("sinumerik-840d").read(text.to_string())
}

fn klartext(text: &str) -> ForeignBlock {
    control("heidenhain-tnc640").read(text.to_string())
}

/// Words as the tape spells them, without what the reader passes over.
fn spelled(words: &[(Letter, f64)]) -> String {
    let words = words.iter().map(|(letter, value)| format!("{letter}{value}"));
    words.collect::<Vec<_>>().join(" ")
}

#[test]
fn an_insert_is_read_block_by_block() {
    let control = control_of("tape.end_of_block_char = \"$\"");
    let blocks = control.read_insert("G91 G28 Z0 $ $GOTO 5$ M9");
    let texts: Vec<&str> = blocks.iter().map(|block| block.text.as_str()).collect();
    assert_eq!(texts, ["G91 G28 Z0", "GOTO 5", "M9"]);
    assert_eq!(spelled(blocks[0].words()), "G91 G28 Z0");
    assert!(blocks[1].unread.is_some() && blocks[1].words().is_empty());
    assert!(blocks[2].has_function(|_, code| code.value() == 9.0));
}

#[test]
fn what_cannot_be_read_says_where_it_begins() {
    for (text, part) in [("G1 X#5 Y2", "X#5 Y2"), ("M8;G91", ";G91"), ("(open", "(open")] {
        assert_eq!(word_address(text).unread.as_deref(), Some(part), "{text}");
    }
    assert_eq!(sinumerik("G0 X1 GOTOF L1").unread.as_deref(), Some("GOTOF"));
    assert_eq!(klartext("L X+1 M128").unread.as_deref(), Some("M128"));
}

#[test]
fn statements_of_a_sinumerik_become_effects() {
    let frame = |text: &str| sinumerik(text).frame;
    assert_eq!(frame("SUPA G0 Z0 D0"), TextFrame::OfTheMachine);
    assert_eq!(frame("TRANS X10"), TextFrame::Shifted);
    assert_eq!(frame("CYCLE800()"), TextFrame::Turned);
    assert_eq!(frame("X=R1"), TextFrame::Unread);
    assert_eq!(sinumerik("D2").effects, [Effect::Edge(2.0)]);
    assert_eq!(sinumerik("SPOS=90").effects, [Effect::set(modal::SPINDLE, Rotation::Standing)]);
    assert_eq!(sinumerik("N10 MSG(\"A;B\") SOFT").effects, []);
    assert!(sinumerik("N5 SETMS(2)").named(&["SETMS"]).is_some());
    assert_eq!(spelled(sinumerik("N5 T=\"MILL\" M1=3 G1X10").words()), "T0 M3 G1 X10");
    assert!(sinumerik("/G0 X1").skipped);
}

#[test]
fn lines_of_klartext_become_effects() {
    let z = Letter::of(b'Z');
    assert_eq!(
        klartext("12 L Z+5.5 M91 ; up").effects,
        [Effect::DoubtAxes, Effect::Clears(z, Some(MachineSpot::At(5.5))), Effect::DoubtAxes]
    );
    assert_eq!(klartext("L Z+5.5").effects, [Effect::DoubtAxes, Effect::Stands(z, 5.5)]);
    assert_eq!(
        klartext("CYCL DEF 7.0 DATUM SHIFT").effects[1..],
        [Effect::ShiftAxes, Effect::Forget(modal::WORK_OFFSET.group)]
    );
    assert_eq!(klartext("Q5 = Q6 * 2").effects, []);
    assert!(klartext("L X+1 M13").has_function(|_, code| code.value() == 13.0));
}

#[test]
fn reading_leaves_the_control_as_it_is() {
    for control in families() {
        let before = format!("{:?}", control.state);
        for text in ["M30", "G91 G41 X1", "TOOL CALL 5 Z S100", "D0 M4", "LBL CALL 1"] {
            control.read(text.to_string());
        }
        assert_eq!(format!("{:?}", control.state), before);
    }
}

/// Texts with the marks that readers look for.
fn text() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        "[A-Za-z]{1,8}",
        "[A-Z][+-]?[0-9]{0,4}\\.?[0-9]{0,3}",
        "[/;()\\[\\]=#\"%~* $]{1,3}",
        "(MCALL|CYCLE8[0-9]|SUPA|SPOS|R[0-9]+=|#[0-9]+=|TOOL CALL|CYCL DEF|STOP|FN 0:)",
        "\\PC{0,6}",
    ];
    prop::collection::vec(part, 0..8).prop_map(|parts| parts.concat())
}

/// Letters of words that a text says as POSTN does, with whole functions.
fn words() -> impl Strategy<Value = Vec<(Letter, f64)>> {
    let axis = (prop::sample::select(b"XYZIJKR".to_vec()), -99_999i32..99_999)
        .prop_map(|(letter, value)| (Letter::of(letter), f64::from(value) / 1000.0));
    let function = (prop::sample::select(b"GMSTDH".to_vec()), 0i32..99)
        .prop_map(|(letter, value)| (Letter::of(letter), f64::from(value)));
    prop::collection::vec(prop_oneof![axis, function], 1..8)
}

proptest! {
    #[test]
    fn any_text_is_read_and_learned(text in text()) {
        for mut control in families() {
            let block = control.read(text.clone());
            prop_assert_eq!(&block.text, &text);
            control.learn(&block);
        }
    }

    #[test]
    fn a_text_is_read_alike_whatever_came_before(text in text(), other in text()) {
        for mut control in families() {
            let first = control.read(text.clone());
            let between = control.read(other.clone());
            control.learn(&between);
            control.learn(&first);
            prop_assert_eq!(format!("{:?}", control.read(text.clone())), format!("{first:?}"));
        }
    }

    #[test]
    fn words_that_the_post_writes_are_read_back(words in words()) {
        let mut control = control("brother-mill");
        let caused: Vec<_> =
            words.iter().map(|(letter, value)| (*letter, *value, Cause::default())).collect();
        let start = control.tape.text.len();
        control.tape.words(&caused, &control.tables, &mut control.commons).expect("words that fit");
        let block = control.read(control.tape.last_line(start, &control.tables));
        prop_assert_eq!(block.words(), &words[..], "{}", block.text);
    }
}
