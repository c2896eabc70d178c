//! Going back, values that are set, refused runs and wrong questions.

use std::path::Path;

use serde_json::json;

use crate::client::{Client, FIL, of};

#[test]
fn going_back_is_a_replay_and_sets_again_what_was_set() {
    let mut client = Client::launched(FIL, json!({ "output": "out.nc" }));
    let fil = client.path("post.fil");
    client.breakpoints(&fil, json!([{ "line": 8, "condition": "NN.EQ.2" }]));
    client.start();
    let (names, _) = client.scope("Names");
    let set = json!({ "variablesReference": names, "name": "NN", "value": "NN+0.5" });
    assert_eq!(client.ask("setVariable", set)["value"], "2.5");
    client.step("next");
    assert_eq!((client.line(), client.value("NN").as_str()), (9, "2.5"));
    client.step("stepBack");
    assert_eq!((client.line(), client.value("NN").as_str()), (8, "2.5"), "set again");
    client.step("stepBack");
    assert_eq!((client.line(), client.value("NN").as_str()), (7, "1"), "not set yet");
    client.step("reverseContinue");
    let (_, tape) = client.scope("Tape");
    let last = tape.last().expect("a block").1.clone();
    assert!(last.contains("X1."), "{tape:?}");
    client.step("next");
    assert_eq!(client.stack(), [("record 7: GOTO".to_string(), 7)]);
    client.breakpoints(&fil, json!([]));
    client.ask("continue", json!({}));
    let said = client.output_before("terminated");
    let blocks: Vec<&str> =
        said.iter().filter(|(kind, _)| kind == "stdout").map(|(_, line)| line.as_str()).collect();
    assert!(blocks.iter().any(|block| block.contains("X5.")), "{said:?}");
    client.end();
}

#[test]
fn a_program_with_values_set_by_hand_is_not_written() {
    for by_hand in [false, true] {
        let mut client = Client::launched(FIL, json!({ "output": "out.nc", "stopOnEntry": true }));
        client.start();
        if by_hand {
            let cl = client.path("part.ncl");
            client.breakpoints(&cl, json!([{ "line": 7 }]));
            client.step("continue");
            let (record, _) = client.scope("Record");
            let set = json!({ "variablesReference": record, "name": "6", "value": "40" });
            client.ask("setVariable", set);
        }
        client.ask("continue", json!({}));
        let said = client.output_before("exited");
        let text = format!("{said:?}");
        assert_eq!(text.contains("X40."), by_hand, "{text}");
        assert_eq!(text.contains("set by hand"), by_hand, "{text}");
        assert_eq!(client.path("out.nc").exists(), !by_hand);
        client.end();
    }
}

#[test]
fn values_of_all_kinds_are_set() {
    let mut client = Client::launched(FIL, json!({}));
    let cl = client.path("part.ncl");
    client.breakpoints(&cl, json!([{ "line": 5 }]));
    client.start();
    let console = |client: &mut Client, text: &str| {
        client.try_ask("evaluate", json!({ "expression": text, "context": "repl" }))
    };
    assert_eq!(console(&mut client, "XX=3*2").expect("set")["result"], "6");
    assert_eq!(client.value("XX"), "6");
    assert_eq!(console(&mut client, "TT(2)='a'").expect("set")["result"], "'a'");
    assert_eq!(client.value("TT(2)"), "'a'");
    console(&mut client, "POSTF(7,4)=150").expect("set");
    assert_eq!(client.value("POSTF(7,4)"), "150");
    console(&mut client, "POSTF(7,5)=IPM").expect("set");
    let (_, record) = client.scope("Record");
    assert!(of(&record, "5").starts_with("IPM"), "{record:?}");
    console(&mut client, "seqno.increment=5").expect("set");
    assert_eq!(client.value("COMF('seqno.increment')"), "5");
    for wrong in ["TT(9)=1", "QQ=1", "XX=", "POSTF(14)=1", "POSTF(7,1)=2", "seqno.increment='a'"] {
        assert!(console(&mut client, wrong).is_err(), "{wrong}");
    }
    client.end();
}

#[test]
fn a_run_that_is_refused_stands_still_where_it_is_wrong() {
    let fil = "CIMFIL/ON,SPINDL\nZZ=0\nYY=1/ZZ\nCIMFIL/OFF\nFINI\n";
    let mut client = Client::launched(fil, json!({}));
    client.ask("setExceptionBreakpoints", json!({ "filters": ["errors"] }));
    let stop = client.start();
    assert_eq!(stop["reason"], "exception");
    assert!(stop["text"].as_str().is_some_and(|text| text.starts_with("E0301")), "{stop}");
    assert_eq!((client.line(), client.value("ZZ").as_str()), (3, "0"));
    client.step("stepBack");
    assert_eq!(client.line(), 2);
    client.ask("continue", json!({}));
    client.event("stopped");
    client.ask("continue", json!({}));
    let said = client.output_before("exited");
    assert!(said.iter().any(|(kind, line)| kind == "stderr" && line.contains("E0301")), "{said:?}");
    client.end();
    // An error of the CL file, outside of FIL.
    let mut client = Client::new();
    client.write("part.ncl", "UNITS / MM\nCYCLE / SIDEWAYS, 3\nFINI\n");
    let cwd = client.folder.path().to_path_buf();
    client.ask("launch", json!({ "cwd": cwd, "cl": "part.ncl", "ready": "fanuc-mill" }));
    client.ask("setExceptionBreakpoints", json!({ "filters": ["errors"] }));
    let stop = client.start();
    assert_eq!(stop["reason"], "exception");
    assert_eq!(client.stack(), [("record 2: CYCLE".to_string(), 2)]);
    client.end();
}

#[test]
fn what_is_asked_wrongly_gets_an_answer() {
    let papers = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/papers");
    let case = papers.join("deep-thread-worm");
    let mut client = Client::new();
    for (command, arguments) in [
        ("launch", json!({})),
        ("launch", json!({ "cl": "nothing.ncl", "cwd": "/nowhere" })),
        ("launch", json!({ "case": "/nowhere" })),
        ("launch", json!({ "cl": "a", "nonsense": 3 })),
        ("launch", json!({ "case": case, "output": case.join("part.ncl") })),
        ("launch", json!({ "case": case, "output": case.join("expected.nc") })),
        ("configurationDone", json!({})),
        ("setBreakpoints", json!({})),
        ("continue", json!({})),
        ("stepBack", json!({})),
        ("setFunctionBreakpoints", json!({})),
        ("stackTrace", json!({})),
        ("evaluate", json!(null)),
        ("fly", json!({})),
    ] {
        assert!(client.try_ask(command, arguments.clone()).is_err(), "{command} {arguments}");
    }
    client.end();
    // A script without end is left in the middle.
    let mut client = Client::launched("LA) XX=1\nJUMPTO/LA\nFINI\n", json!({}));
    client.ask("configurationDone", json!({}));
    assert!(client.try_ask("evaluate", json!({ "expression": "XX" })).is_err());
    client.ask("pause", json!({}));
    assert_eq!(client.event("stopped")["reason"], "pause");
    client.end();
}

#[test]
fn the_published_scripts_are_debugged_as_cases() {
    let papers = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/papers");
    let mut client = Client::new();
    client.ask("launch", json!({ "case": papers.join("deep-thread-worm") }));
    client.event("initialized");
    let answer = client.ask(
        "setFunctionBreakpoints",
        json!({ "breakpoints": [
        { "name": "section THREAD" }, { "name": "block G92" }, { "name": "macro ONECUT" },
    ] }),
    );
    assert_eq!(answer["breakpoints"][0]["verified"], true);
    client.start();
    let mut seen = client.stack()[0].0.clone();
    for _ in 0..3 {
        client.step("continue");
        seen.push_str(&client.stack()[0].0);
    }
    assert!(seen.contains("section THREAD") && seen.contains("macro"), "{seen}");
    client.ask("setFunctionBreakpoints", json!({ "breakpoints": [] }));
    client.ask("continue", json!({}));
    let said = client.output_before("exited");
    let expected =
        std::fs::read_to_string(papers.join("deep-thread-worm/expected.nc")).expect("the case");
    let blocks: Vec<&str> =
        said.iter().filter(|(kind, _)| kind == "stdout").map(|(_, line)| line.as_str()).collect();
    let wanted: Vec<&str> = expected.lines().collect();
    assert!(!blocks.is_empty() && wanted.ends_with(&blocks), "{blocks:?}");
    client.end();
}

#[test]
fn modes_of_the_control_are_told_in_words_of_the_field() {
    let modes = |ready: &str, cl: &str, line: u32| {
        let mut client = Client::new();
        client.write("part.ncl", cl);
        let cwd = client.folder.path().to_path_buf();
        client.ask("launch", json!({ "cwd": cwd, "cl": "part.ncl", "ready": ready }));
        let cl = client.path("part.ncl");
        client.breakpoints(&cl, json!([{ "line": line }]));
        client.start();
        let (_, control) = client.scope("Control");
        client.end();
        control
    };
    let cl = "UNITS / MM\nLOADTL / 4\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\n\
              CUTCOM / LEFT\nGOTO / 5, 2, 3\nFINI\n";
    let before = modes("fanuc-mill", cl, 2);
    assert_eq!(of(&before, "spindle"), "not said", "{before:?}");
    assert_eq!(of(&before, "tool"), "not known", "{before:?}");
    let told = modes("fanuc-mill", cl, 8);
    for (name, value) in [
        ("motion", "G1"),
        ("plane", "G17 plane XY"),
        ("coordinates", "G90 absolute"),
        ("unit", "G21 mm"),
        ("feed", "G94 per minute"),
        ("compensation", "G41 left of the path"),
        ("TCPC", "off"),
        ("canned cycle", "off"),
        ("tool", "4"),
        ("spindle", "clockwise"),
    ] {
        assert_eq!(of(&told, name), value, "{name}: {told:?}");
    }
    // Klartext has no functions for modes.
    let told = modes("heidenhain-tnc640", cl, 6);
    assert_eq!(of(&told, "plane"), "plane XY", "{told:?}");
    assert_eq!(of(&told, "motion"), "missing", "{told:?}");
}
