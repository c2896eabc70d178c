//! A client at the other end of the wire, and what it debugs.

use std::collections::VecDeque;
use std::io::{BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

pub const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                  FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nGOTO / 4, 2, 3\nGOTO / 5, 6, 3\nFINI\n";

pub const FIL: &str = "NN=0\nRESERV/TT,3\nHALF=MACRO/VV,FF=2\nRR=VV/FF\nTERMAC\n\
                   CIMFIL/ON,GOTO\nNN=NN+1\nXX=POSTF(7,6)\nCALL/HALF,VV=XX\nTT(NN)=RR\n\
                   DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

/// A client at the other end of the wire.
pub struct Client {
    requests: Option<Sender<Vec<u8>>>,
    messages: Receiver<Value>,
    pub events: VecDeque<Value>,
    seq: u64,
    server: Option<std::thread::JoinHandle<Result<(), String>>>,
    pub folder: TempDir,
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
    pub fn new() -> Client {
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
    pub fn launched(fil: &str, more: Value) -> Client {
        let mut client = Client::new();
        client.write("part.ncl", CL);
        client.write("post.fil", fil);
        let mut arguments = json!({ "cwd": client.folder.path(), "cl": "part.ncl",
            "ready": "fanuc-mill", "options": { "style": "plain" }, "fil": ["post.fil"] });
        for (key, value) in more.as_object().expect("keys") {
            arguments[key] = value.clone();
        }
        client.ask("launch", arguments);
        client.event("initialized");
        client
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file");
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn send(&mut self, command: &str, arguments: Value) -> u64 {
        self.seq += 1;
        let body = json!({ "seq": self.seq, "type": "request", "command": command,
            "arguments": arguments })
        .to_string();
        let message = format!("Content-Length: {}\r\n\r\n{body}", body.len());
        self.requests.as_ref().expect("open").send(message.into_bytes()).expect("a server");
        self.seq
    }

    pub fn next(&self) -> Value {
        self.messages.recv_timeout(Duration::from_secs(60)).expect("an answer in time")
    }

    pub fn try_ask(&mut self, command: &str, arguments: Value) -> Result<Value, String> {
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

    pub fn ask(&mut self, command: &str, arguments: Value) -> Value {
        self.try_ask(command, arguments).unwrap_or_else(|error| panic!("{command}: {error}"))
    }

    /// The next event of a name; those before it are passed over.
    pub fn event(&mut self, name: &str) -> Value {
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
    pub fn output_before(&mut self, name: &str) -> Vec<(String, String)> {
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

    pub fn breakpoints(&mut self, path: &Path, breakpoints: Value) -> Value {
        let arguments = json!({ "source": { "path": path }, "breakpoints": breakpoints });
        self.ask("setBreakpoints", arguments)["breakpoints"].clone()
    }

    pub fn start(&mut self) -> Value {
        self.ask("configurationDone", json!({}));
        self.event("stopped")
    }

    pub fn step(&mut self, command: &str) -> Value {
        self.ask(command, json!({ "threadId": 1 }));
        self.event("stopped")
    }

    /// Names of the frames with their lines.
    pub fn stack(&mut self) -> Vec<(String, u64)> {
        let frames = self.ask("stackTrace", json!({ "threadId": 1 }))["stackFrames"].clone();
        let frames = frames.as_array().expect("frames").clone();
        let line = |frame: &Value| frame["line"].as_u64().expect("a line");
        let name = |frame: &Value| frame["name"].as_str().expect("a name").to_string();
        frames.iter().map(|frame| (name(frame), line(frame))).collect()
    }

    pub fn line(&mut self) -> u64 {
        self.stack()[0].1
    }

    pub fn value(&mut self, expression: &str) -> String {
        let answer = self.try_ask("evaluate", json!({ "expression": expression }));
        match answer {
            Ok(answer) => answer["result"].as_str().expect("a text").to_string(),
            Err(message) => message,
        }
    }

    /// The variables of a scope, by name.
    pub fn scope(&mut self, name: &str) -> (u64, Vec<(String, String)>) {
        let scopes = self.ask("scopes", json!({ "frameId": 1 }))["scopes"].clone();
        let scopes = scopes.as_array().expect("scopes").clone();
        let scope = scopes.iter().find(|scope| scope["name"] == name).expect("the scope");
        let reference = scope["variablesReference"].as_u64().expect("a reference");
        (reference, self.variables(reference))
    }

    pub fn variables(&mut self, reference: u64) -> Vec<(String, String)> {
        let answer = self.ask("variables", json!({ "variablesReference": reference }));
        let list = answer["variables"].as_array().expect("variables").clone();
        let text = |value: &Value| value.as_str().expect("a text").to_string();
        list.iter().map(|one| (text(&one["name"]), text(&one["value"]))).collect()
    }

    pub fn end(mut self) {
        self.ask("disconnect", json!({}));
        drop(self.requests.take());
        let server = self.server.take().expect("a server");
        assert_eq!(server.join().expect("no panic"), Ok(()));
    }
}

pub fn of<'v>(list: &'v [(String, String)], name: &str) -> &'v str {
    let found = list.iter().find(|(known, _)| known == name);
    found.map_or("missing", |(_, value)| value)
}
