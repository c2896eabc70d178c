//! Breakpoints of each kind, and each kind of step.

use serde_json::{Value, json};

use crate::client::{Client, FIL, of};

#[test]
fn a_breakpoint_in_fil_shows_calls_names_and_the_record() {
    let mut client = Client::launched(FIL, json!({}));
    let fil = client.path("post.fil");
    let placed = client.breakpoints(&fil, json!([{ "line": 8 }, { "line": 2 }, { "line": 99 }]));
    assert_eq!(placed[0]["verified"], true);
    // RESERV does nothing when it runs; the next line that does has the breakpoint.
    assert_eq!(placed[1]["line"], 4);
    assert_eq!(placed[2]["verified"], false);
    let stop = client.start();
    assert_eq!(stop["reason"], "breakpoint");
    assert_eq!(stop["hitBreakpointIds"], json!([placed[0]["id"]]));
    let stack = client.stack();
    assert_eq!(stack, [("section GOTO".to_string(), 8), ("record 6: GOTO".to_string(), 6)]);
    let (_, names) = client.scope("Names");
    assert_eq!((of(&names, "NN"), of(&names, "XX")), ("1", "never set"));
    assert_eq!(of(&names, "TT"), "3 elements");
    let (_, record) = client.scope("Record");
    assert_eq!((of(&record, "2"), of(&record, "6"), of(&record, "8")), ("5000", "1", "3"));
    for (expression, value) in [
        ("NN+1", "2"),
        ("POSTF(7,7)", "2"),
        ("SQRTF(POSTF(7,8)*3)", "3"),
        ("NN.EQ.1.AND..NOT.(POSTF(5).LT.3)", "1"),
        ("X", "24"),
        ("'a''b'", "'a''b'"),
    ] {
        assert_eq!(client.value(expression), value, "{expression}");
    }
    // What could change the run, and what is none, is refused in words.
    assert!(client.value("POSTF(14)").contains("could change the run"));
    assert!(client.value("NN+").len() > 5 && client.value("QQQ").contains("no script uses"));
    assert!(client.value("1\nFINI").contains("one line"));
    client.end();
}

#[test]
fn steps_go_in_over_out_and_to_the_next_record_and_block() {
    let mut client = Client::launched(FIL, json!({ "stopOnEntry": true }));
    assert_eq!(client.start()["reason"], "step");
    assert_eq!(client.line(), 1);
    client.step("nextRecord");
    assert_eq!(client.stack(), [("record 1: PARTNO".to_string(), 1)]);
    let fil = client.path("post.fil");
    client.breakpoints(&fil, json!([{ "line": 9 }]));
    client.step("continue");
    client.step("stepIn");
    let stack = client.stack();
    assert_eq!(stack[0], ("macro HALF".to_string(), 4));
    assert_eq!(stack[1], ("section GOTO".to_string(), 9));
    let (_, parameters) = client.scope("Parameters");
    assert_eq!((of(&parameters, "VV"), of(&parameters, "FF")), ("1", "2"));
    client.step("stepOut");
    assert_eq!(client.line(), 10);
    client.step("continue");
    client.step("next");
    assert_eq!(client.line(), 10, "a call is stepped over");
    client.step("stepOut");
    assert_eq!(client.stack(), [("record 8: GOTO".to_string(), 8)]);
    client.breakpoints(&fil, json!([]));
    client.step("next");
    assert_eq!(client.stack()[0].0, "record 9: FINI", "a section is stepped over");
    client.end();
    let mut client = Client::launched(FIL, json!({ "stopOnEntry": true }));
    client.start();
    client.step("nextBlock");
    let (_, first) = client.scope("Tape");
    client.step("nextBlock");
    let (_, second) = client.scope("Tape");
    let count = |tape: &[(String, String)]| of(tape, "blocks").parse::<u64>().expect("a number");
    assert!(count(&first) > 0 && count(&second) > count(&first), "{first:?} {second:?}");
    client.end();
}

#[test]
fn conditions_hit_counts_and_log_points() {
    let mut client = Client::launched(FIL, json!({}));
    let fil = client.path("post.fil");
    client.breakpoints(
        &fil,
        json!([
            { "line": 8, "condition": "NN.EQ.2" },
            { "line": 10, "hitCondition": "== 3" },
            { "line": 9, "logMessage": "XX is {XX}, {QQ}" },
            { "line": 11, "hitCondition": "often" },
            { "line": 7, "condition": "NN+2" },
        ]),
    );
    client.ask("configurationDone", json!({}));
    let said = client.output_before("stopped");
    assert_eq!((client.line(), client.value("NN").as_str()), (8, "2"));
    let console: Vec<&str> =
        said.iter().filter(|(kind, _)| kind == "console").map(|(_, line)| line.as_str()).collect();
    // Line 7 once for each point, line 9 at the first of them.
    let [first, line, second] = console[..] else { panic!("{said:?}") };
    assert!(line.starts_with("XX is 1, {QQ: "), "{line}");
    assert_eq!([first, second], ["the condition NN+2 is 2", "the condition NN+2 is 3"]);
    client.step("continue");
    assert_eq!((client.line(), client.value("NN").as_str()), (10, "3"));
    client.end();
}

#[test]
fn records_blocks_and_parts_stop_a_run() {
    let mut client = Client::launched(FIL, json!({ "nc": "part.nc" }));
    client.write("part.nc", "%\n");
    let cl = client.path("part.ncl");
    client.breakpoints(&cl, json!([{ "line": 4 }]));
    let answer = client.ask(
        "setFunctionBreakpoints",
        json!({ "breakpoints": [
            { "name": "record goto", "hitCondition": "%2" },
            { "name": "block X5." },
            { "name": "half", "condition": "NN.EQ.3" },
            { "name": "line 3" },
            { "name": "macro HALVES" },
        ] }),
    );
    assert_eq!(answer["breakpoints"][3]["verified"], false);
    assert_eq!(answer["breakpoints"][4]["verified"], false);
    client.start();
    assert_eq!(client.stack(), [("record 4: SPINDL".to_string(), 4)]);
    client.step("continue");
    assert_eq!(client.stack(), [("record 7: GOTO".to_string(), 7)]);
    let stop = client.step("continue");
    assert_eq!(
        (stop["reason"].as_str(), stop["text"].as_str()),
        (Some("function breakpoint"), Some("macro HALF"))
    );
    let stop = client.step("continue");
    assert!(stop["text"].as_str().is_some_and(|text| text.contains("X5.")), "{stop}");
    client.end();

    let mut client = Client::launched(FIL, json!({ "nc": "part.nc" }));
    client.write("part.nc", "%\n");
    let nc = client.path("part.nc");
    client.breakpoints(&nc, json!([{ "line": 4 }]));
    let stop = client.start();
    assert!(stop["text"].as_str().is_some_and(|text| text.starts_with("N20 ")), "{stop}");
    client.end();
}

#[test]
fn data_breakpoints_watch_names_settings_and_letters() {
    let mut client = Client::launched(FIL, json!({ "stopOnEntry": true }));
    client.start();
    let watch = |client: &mut Client, name: &str, reference: u64| -> Value {
        let arguments = json!({ "variablesReference": reference, "name": name });
        client.ask("dataBreakpointInfo", arguments)["dataId"].clone()
    };
    assert_eq!(watch(&mut client, "NN", 1), "name NN");
    assert_eq!(watch(&mut client, "QQ", 0), Value::Null);
    assert_eq!(watch(&mut client, "INTCOM 1861", 0), "INTCOM 1861");
    assert!(watch(&mut client, "seqno.increment", 0).as_str().is_some());
    let x = watch(&mut client, "X", 0);
    assert_eq!(x, "address X");
    let name = watch(&mut client, "NN", 1);
    client.ask(
        "setDataBreakpoints",
        json!({ "breakpoints": [{ "dataId": name, "condition": "NN.EQ.2" }, { "dataId": x }] }),
    );
    let texts: Vec<String> = (0..3)
        .map(|_| {
            let stop = client.step("continue");
            assert_eq!(stop["reason"], "data breakpoint");
            stop["text"].as_str().expect("a text").to_string()
        })
        .collect();
    assert_eq!(texts, ["X was not written and is 1", "NN was 1 and is 2", "X was 1 and is 4"]);
    client.end();
}
