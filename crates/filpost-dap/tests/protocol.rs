//! The debugger asked as a client asks it: each kind of breakpoint, each kind of step, what is
//! shown and what is set.

use std::collections::VecDeque;
use std::io::{BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                  FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nGOTO / 4, 2, 3\nGOTO / 5, 6, 3\nFINI\n";

const FIL: &str = "NN=0\nRESERV/TT,3\nHALF=MACRO/VV,FF=2\nRR=VV/FF\nTERMAC\n\
                   CIMFIL/ON,GOTO\nNN=NN+1\nXX=POSTF(7,6)\nCALL/HALF,VV=XX\nTT(NN)=RR\n\
                   DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

/// A client at the other end of the wire.
struct Client {
    requests: Option<Sender<Vec<u8>>>,
    messages: Receiver<Value>,
    events: VecDeque<Value>,
    seq: u64,
    server: Option<std::thread::JoinHandle<Result<(), String>>>,
    folder: TempDir,
}

struct Input(Receiver<Vec<u8>>, VecDeque<u8>);

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        if self.1.is_empty() {
            match self.0.recv() {
                Ok(bytes) => self.1.extend(bytes),
                Err(_) => return Ok(0),
            }
        }
        self.1.read(buffer)
    }
}

struct Output(Sender<Value>, Vec<u8>);

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.1.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let text = String::from_utf8(std::mem::take(&mut self.1)).expect("UTF-8");
        let (head, body) = text.split_once("\r\n\r\n").expect("a header");
        let length: usize =
            head.trim_start_matches("Content-Length:").trim().parse().expect("a length");
        assert_eq!(length, body.len());
        // A test that is over listens no more.
        let _ = self.0.send(serde_json::from_str(body).expect("JSON"));
        Ok(())
    }
}

impl Client {
    fn new() -> Client {
        let (requests, input) = channel();
        let (output, messages) = channel();
        let server = std::thread::spawn(move || {
            let input = BufReader::new(Input(input, VecDeque::new()));
            filpost_dap::serve(input, Output(output, Vec::new()))
        });
        let folder = TempDir::new().expect("a folder");
        let mut client = Client {
            requests: Some(requests),
            messages,
            events: VecDeque::new(),
            seq: 0,
            server: Some(server),
            folder,
        };
        let answer = client.ask("initialize", json!({ "adapterID": "filpost" }));
        assert_eq!(answer["supportsStepBack"], true);
        client
    }

    /// A client that has launched the small part, with these files beside it.
    fn launched(fil: &str, more: Value) -> Client {
        let mut client = Client::new();
        client.write("part.ncl", CL);
        client.write("post.fil", fil);
        let mut arguments = json!({ "cwd": client.folder.path(), "cl": "part.ncl",
            "ready": "fanuc-mill", "fil": ["post.fil"] });
        for (key, value) in more.as_object().expect("keys") {
            arguments[key] = value.clone();
        }
        client.ask("launch", arguments);
        client.event("initialized");
        client
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file");
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn send(&mut self, command: &str, arguments: Value) -> u64 {
        self.seq += 1;
        let body = json!({ "seq": self.seq, "type": "request", "command": command,
            "arguments": arguments })
        .to_string();
        let message = format!("Content-Length: {}\r\n\r\n{body}", body.len());
        self.requests.as_ref().expect("open").send(message.into_bytes()).expect("a server");
        self.seq
    }

    fn next(&self) -> Value {
        self.messages.recv_timeout(Duration::from_secs(60)).expect("an answer in time")
    }

    fn try_ask(&mut self, command: &str, arguments: Value) -> Result<Value, String> {
        let seq = self.send(command, arguments);
        loop {
            let message = self.next();
            if message["type"] == "event" {
                self.events.push_back(message);
            } else {
                assert_eq!(message["request_seq"], seq);
                return match message["success"].as_bool() {
                    Some(true) => Ok(message["body"].clone()),
                    _ => Err(message["message"].as_str().unwrap_or_default().to_string()),
                };
            }
        }
    }

    fn ask(&mut self, command: &str, arguments: Value) -> Value {
        self.try_ask(command, arguments).unwrap_or_else(|error| panic!("{command}: {error}"))
    }

    /// The next event of a name; those before it are passed over.
    fn event(&mut self, name: &str) -> Value {
        loop {
            let message = self.events.pop_front().unwrap_or_else(|| self.next());
            if message["event"] == name {
                return message["body"].clone();
            }
            assert!(
                !(name == "stopped" && message["event"] == "terminated"),
                "the run ended and did not stop"
            );
        }
    }

    /// All output up to the next event of a name, line by line, with the category.
    fn output_before(&mut self, name: &str) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        loop {
            let message = self.events.pop_front().unwrap_or_else(|| self.next());
            if message["event"] == name {
                return lines;
            }
            if message["event"] == "output" {
                let text = |key: &str| message["body"][key].as_str().unwrap_or_default();
                let line = text("output").trim_end().to_string();
                lines.push((text("category").to_string(), line));
            }
        }
    }

    fn breakpoints(&mut self, path: &Path, breakpoints: Value) -> Value {
        let arguments = json!({ "source": { "path": path }, "breakpoints": breakpoints });
        self.ask("setBreakpoints", arguments)["breakpoints"].clone()
    }

    fn start(&mut self) -> Value {
        self.ask("configurationDone", json!({}));
        self.event("stopped")
    }

    fn step(&mut self, command: &str) -> Value {
        self.ask(command, json!({ "threadId": 1 }));
        self.event("stopped")
    }

    /// Names of the frames with their lines.
    fn stack(&mut self) -> Vec<(String, u64)> {
        let frames = self.ask("stackTrace", json!({ "threadId": 1 }))["stackFrames"].clone();
        let frames = frames.as_array().expect("frames").clone();
        let line = |frame: &Value| frame["line"].as_u64().expect("a line");
        let name = |frame: &Value| frame["name"].as_str().expect("a name").to_string();
        frames.iter().map(|frame| (name(frame), line(frame))).collect()
    }

    fn line(&mut self) -> u64 {
        self.stack()[0].1
    }

    fn value(&mut self, expression: &str) -> String {
        let answer = self.try_ask("evaluate", json!({ "expression": expression }));
        match answer {
            Ok(answer) => answer["result"].as_str().expect("a text").to_string(),
            Err(message) => message,
        }
    }

    /// The variables of a scope, by name.
    fn scope(&mut self, name: &str) -> (u64, Vec<(String, String)>) {
        let scopes = self.ask("scopes", json!({ "frameId": 1 }))["scopes"].clone();
        let scopes = scopes.as_array().expect("scopes").clone();
        let scope = scopes.iter().find(|scope| scope["name"] == name).expect("the scope");
        let reference = scope["variablesReference"].as_u64().expect("a reference");
        (reference, self.variables(reference))
    }

    fn variables(&mut self, reference: u64) -> Vec<(String, String)> {
        let answer = self.ask("variables", json!({ "variablesReference": reference }));
        let list = answer["variables"].as_array().expect("variables").clone();
        let text = |value: &Value| value.as_str().expect("a text").to_string();
        list.iter().map(|one| (text(&one["name"]), text(&one["value"]))).collect()
    }

    fn end(mut self) {
        self.ask("disconnect", json!({}));
        drop(self.requests.take());
        let server = self.server.take().expect("a server");
        assert_eq!(server.join().expect("no panic"), Ok(()));
    }
}

fn of<'v>(list: &'v [(String, String)], name: &str) -> &'v str {
    let found = list.iter().find(|(known, _)| known == name);
    found.map_or("missing", |(_, value)| value)
}

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
