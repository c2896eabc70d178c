//! What an editor asks beyond the protocol: a case posted as it stands there, and the
//! settings of a machine as a form has them.

use std::fs;
use std::path::Path;

use filpost_lsp::{Fault, Server};
use serde_json::{Value, json};
use tempfile::TempDir;

const CL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                  FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
const FIL: &str = "SAY=MACRO\nPPRINT ONE\nTERMAC\nCIMFIL/ON,LOADTL\nCALL/SAY\n\
                   DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

/// A case in a folder, and a server that has the folder open.
struct Desk {
    folder: TempDir,
    server: Server,
}

impl Desk {
    fn new() -> Desk {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            fs::write(folder.path().join(name), text).expect("written");
        };
        write("part.ncl", CL);
        write("post.fil", FIL);
        write("machine.toml", "# mine\n[seqno]\nincrement = 10 # ten\n");
        let case = "cl = 'part.ncl'\nmachine = 'machine.toml'\nfil = ['post.fil']\norigin = 'x'\n";
        write("case.toml", case);
        let uri = uri(folder.path());
        let server = Server::new(&json!({ "workspaceFolders": [{ "uri": uri }] }));
        Desk { folder, server }
    }

    fn uri(&self, name: &str) -> String {
        uri(&self.folder.path().join(name))
    }

    fn open(&mut self, name: &str, language: &str) {
        let text = fs::read_to_string(self.folder.path().join(name)).expect("a file");
        let document =
            json!({ "uri": self.uri(name), "languageId": language, "version": 1, "text": text });
        self.server.notification("textDocument/didOpen", &json!({ "textDocument": document }));
    }

    fn change(&mut self, name: &str, text: &str) {
        let change = json!({
            "textDocument": { "uri": self.uri(name) },
            "contentChanges": [{ "text": text }],
        });
        self.server.notification("textDocument/didChange", &change);
    }

    fn preview(&mut self, plot: bool) -> Value {
        let params = json!({ "case": self.folder.path(), "plot": plot });
        self.server.request("filpost/preview", &params).expect("answered")
    }

    fn ask(&mut self, method: &str, name: &str, more: Value) -> Result<Value, Fault> {
        let mut params = more;
        params["textDocument"] = json!({ "uri": self.uri(name) });
        self.server.request(method, &params)
    }

    /// The text of machine.toml after a setting was given a value, or why not.
    fn set(&mut self, text: &str, key: &str, value: Option<&str>) -> Result<String, String> {
        self.change("machine.toml", text);
        let edits =
            self.ask("filpost/setting", "machine.toml", json!({ "key": key, "value": value }));
        let edits = edits.map_err(|fault| fault.message)?;
        let byte = |place: &Value| {
            let number = |name: &str| place[name].as_u64().expect("a number") as usize;
            let lines = text.split_inclusive('\n').take(number("line"));
            lines.map(str::len).sum::<usize>() + number("character")
        };
        let edit = &edits[0];
        let (from, to) = (byte(&edit["range"]["start"]), byte(&edit["range"]["end"]));
        let new = edit["newText"].as_str().expect("a text");
        Ok(format!("{}{new}{}", &text[..from], &text[to..]))
    }
}

fn uri(path: &Path) -> String {
    format!("file://{}", path.canonicalize().expect("a path").display())
}

fn line_with(made: &Value, text: &str) -> usize {
    let nc = made["nc"].as_str().expect("a program");
    nc.lines().position(|line| line.contains(text)).unwrap_or_else(|| panic!("{text} in {nc}"))
}

#[test]
fn each_line_of_a_preview_names_what_made_it() {
    let mut desk = Desk::new();
    let made = desk.preview(false);
    assert_eq!(made["cl"], desk.uri("part.ncl").as_str());
    assert_eq!(made["fil"], json!([desk.uri("post.fil")]));
    let nc = made["nc"].as_str().expect("a program");
    assert_eq!(made["lines"].as_array().expect("lines").len(), nc.lines().count(), "{nc}");
    // The record in line 3; the PPRINT of the macro, called from the section.
    assert_eq!(made["lines"][line_with(&made, "(ONE)")], json!([3, [[0, 2], [0, 5]]]));
    assert_eq!(made["lines"][line_with(&made, "X1.")], json!([6, []]));
    assert_eq!(made["page"], Value::Null);
    let page = desk.preview(true);
    assert!(page["page"].as_str().expect("a page").contains("<html"), "{page}");
}

#[test]
fn a_preview_is_of_the_texts_as_they_are_typed() {
    let mut desk = Desk::new();
    for (name, language) in [("post.fil", "fil"), ("machine.toml", "toml"), ("part.ncl", "cl")] {
        desk.open(name, language);
    }
    desk.change("post.fil", &FIL.replace("ONE", "TWO"));
    desk.change("machine.toml", "[seqno]\nincrement = 3\n");
    desk.change("part.ncl", &CL.replace("GOTO / 1", "GOTO / 77"));
    let made = desk.preview(false);
    let nc = made["nc"].as_str().expect("a program");
    for part in ["(TWO)", "N6 ", "X77."] {
        assert!(nc.contains(part), "{part}: {nc}");
    }
    // A wrong text gives no program, and says why.
    desk.change("post.fil", "IF(\nFINI\n");
    let refused = desk.preview(false);
    assert_eq!(refused["nc"], Value::Null);
    let why = refused["refused"][0].as_str().expect("a message");
    assert!(why.starts_with("error E01") && why.contains("post.fil"), "{why}");
}

#[test]
fn an_included_file_is_taken_as_it_is_typed() {
    let mut desk = Desk::new();
    let write = |desk: &Desk, name: &str, text: &str| {
        fs::write(desk.folder.path().join(name), text).expect("written");
    };
    write(&desk, "say.fil", "SAY=MACRO\nPPRINT ONE\nTERMAC\nFINI\n");
    let main = "INCLUD/say.fil\nCIMFIL/ON,LOADTL\nCALL/SAY\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    write(&desk, "post.fil", main);
    desk.open("say.fil", "fil");
    desk.change("say.fil", "SAY=MACRO\nPPRINT THREE\nTERMAC\nFINI\n");
    let made = desk.preview(false);
    assert!(made["nc"].as_str().expect("a program").contains("(THREE)"), "{made}");
    assert_eq!(made["fil"][1], desk.uri("say.fil").as_str(), "{made}");
}

#[test]
fn a_document_that_is_saved_is_read_from_its_file() {
    let mut desk = Desk::new();
    // Code page 1251: the editor has read it as UTF-8, with other characters.
    let part = CL.replace("PARTNO / 7", "PARTNO / 7 \u{416}").replace('\u{416}', "?");
    let mut bytes = part.clone().into_bytes();
    let at = part.find('?').expect("the character");
    bytes[at] = 0xc6;
    fs::write(desk.folder.path().join("part.ncl"), &bytes).expect("written");
    let of_file = desk.preview(false)["nc"].clone();
    let document =
        json!({ "uri": desk.uri("part.ncl"), "languageId": "cl", "version": 1, "text": part });
    desk.server.notification("textDocument/didOpen", &json!({ "textDocument": document }));
    assert_eq!(desk.preview(false)["nc"], of_file);
    desk.change("part.ncl", &part);
    assert_ne!(desk.preview(false)["nc"], of_file);
    let saved = json!({ "textDocument": { "uri": desk.uri("part.ncl") } });
    desk.server.notification("textDocument/didSave", &saved);
    assert_eq!(desk.preview(false)["nc"], of_file);
}

#[test]
fn a_file_leads_to_its_case() {
    let mut desk = Desk::new();
    let folder = desk.folder.path().canonicalize().expect("a path");
    for name in ["post.fil", "part.ncl", "machine.toml"] {
        let case = desk.ask("filpost/caseOf", name, json!({})).expect("answered");
        let case = Path::new(case.as_str().expect("a folder")).canonicalize().expect("a path");
        assert_eq!(case, folder, "{name}");
    }
    let elsewhere = json!({ "textDocument": { "uri": "file:///nowhere/post.fil" } });
    assert_eq!(desk.server.request("filpost/caseOf", &elsewhere), Ok(Value::Null));
    assert!(desk.server.request("filpost/preview", &json!({})).is_err());
    let none = desk.server.request("filpost/preview", &json!({ "case": "/nowhere" }));
    assert!(none.expect("answered")["refused"][0].is_string());
}

#[test]
fn a_form_reads_and_sets_the_values_of_a_machine() {
    let mut desk = Desk::new();
    desk.open("machine.toml", "toml");
    let form = desk.ask("filpost/settings", "machine.toml", json!({})).expect("answered");
    assert_eq!(form["values"], json!({ "seqno.increment": "10" }));
    assert_eq!(form["rows"]["seqno.increment"]["acts"], true, "{form}");
    let text = "# mine\n[seqno]\nincrement = 10 # ten\n\n[rapid]\nsplit = 1\n";
    let set = |desk: &mut Desk, key: &str, value: Option<&str>| desk.set(text, key, value);
    for (key, value, after) in [
        ("seqno.increment", Some("5"), text.replace("10 #", "5 #")),
        ("seqno.increment", None, text.replace("increment = 10 # ten\n", "")),
        ("seqno.max", Some("999"), text.replace("ten\n", "ten\nmax = 999\n")),
        ("coolant.off_code", Some("9"), format!("{text}\n[coolant]\noff_code = 9\n")),
        ("name", Some("\"Mill\""), format!("name = \"Mill\"\n{text}")),
    ] {
        assert_eq!(set(&mut desk, key, value), Ok(after), "{key}");
    }
    for (key, value) in [
        ("seqno.increment", Some("often")),
        ("seqno.increment", Some("")),
        ("seqno.nothing", Some("1")),
        ("seqno.max", None),
        ("rapid.split", Some("1\n[seqno]")),
    ] {
        assert!(set(&mut desk, key, value).is_err(), "{key} = {value:?}");
    }
    let several = "[blocks]\nstart = [\n  \"G21\",\n]\n";
    assert!(desk.set(several, "blocks.start", Some("[]")).is_err());
    let quoted = "[blocks]\nstart = [\"(A # B)\"] # c\n";
    let after = desk.set(quoted, "blocks.start", Some("[]"));
    assert_eq!(after, Ok("[blocks]\nstart = [] # c\n".to_string()));
}
