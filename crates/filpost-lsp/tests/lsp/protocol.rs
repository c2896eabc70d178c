//! The protocol: each feature asked as an editor asks, on files of a folder.

use std::fs;
use std::thread;

use filpost_lsp::{Fault, Server, serve};
use lsp_server::{Connection, Message, Notification, Request};
use serde_json::{Value, json};

use crate::typed;

/// A script with `|` where the editor's cursor stands.
struct Editor {
    server: Server,
    uri: String,
    told: Vec<Value>,
    line: u32,
    character: u32,
}

impl Editor {
    /// Opens a text as `post.fil` without a file behind it.
    fn new(marked: &str) -> Self {
        Editor::open("untitled:post.fil", "fil", marked)
    }

    fn open(uri: &str, language: &str, marked: &str) -> Self {
        Editor::open_in(&Value::Null, uri, language, marked)
    }

    /// The same with the parameters of `initialize`.
    fn open_in(params: &Value, uri: &str, language: &str, marked: &str) -> Self {
        let mut server = Server::new(params);
        let at = marked.find('|').unwrap_or(marked.len());
        let text = marked.replacen('|', "", 1);
        let line = marked[..at].matches('\n').count() as u32;
        let start = marked[..at].rfind('\n').map_or(0, |end| end + 1);
        let character = marked[start..at].encode_utf16().count() as u32;
        let document = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
        let told =
            server.notification("textDocument/didOpen", &json!({ "textDocument": document }));
        told.iter().for_each(|(method, params)| typed::notification(method, params));
        let told = told.into_iter().map(|(_, params)| params).collect();
        Editor { server, uri: uri.to_string(), told, line, character }
    }

    fn params(&self) -> Value {
        json!({
            "textDocument": { "uri": self.uri },
            "position": { "line": self.line, "character": self.character },
            "context": { "includeDeclaration": true },
        })
    }

    fn ask(&mut self, method: &str) -> Value {
        let params = self.params();
        self.request(method, &params).unwrap_or_else(|fault| panic!("{method}: {fault:?}"))
    }

    fn request(&mut self, method: &str, params: &Value) -> Result<Value, Fault> {
        let answer = self.server.request(method, params)?;
        typed::answer(method, &answer);
        Ok(answer)
    }

    fn labels(&mut self) -> Vec<String> {
        let items = self.ask("textDocument/completion");
        let items = items.as_array().expect("a list");
        items.iter().map(|item| item["label"].as_str().expect("a label").to_string()).collect()
    }

    fn diagnostics(&self) -> Vec<&Value> {
        let of_own = self.told.iter().filter(|params| params["uri"] == self.uri.as_str());
        of_own.flat_map(|params| params["diagnostics"].as_array().expect("a list")).collect()
    }

    fn fixes(&mut self) -> Vec<Value> {
        let mut params = self.params();
        let at = params["position"].clone();
        params["range"] = json!({ "start": at, "end": at });
        let found = self.request("textDocument/codeAction", &params).expect("answered");
        found.as_array().expect("a list").clone()
    }

    /// The text after the edits of a fix in this document.
    fn applied(&self, text: &str, fix: &Value) -> String {
        let edits = fix["edit"]["changes"][&self.uri].as_array().expect("edits");
        edits.iter().rev().fold(text.to_string(), |text, edit| {
            let byte = |place: &Value| {
                let line = place["line"].as_u64().expect("a line") as usize;
                let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
                start + place["character"].as_u64().expect("a character") as usize
            };
            let (from, to) = (byte(&edit["range"]["start"]), byte(&edit["range"]["end"]));
            format!("{}{}{}", &text[..from], edit["newText"].as_str().expect("text"), &text[to..])
        })
    }
}

#[test]
fn diagnostics_come_with_code_place_and_hint() {
    let editor = Editor::new("SPINDEL/ON\nFINI\n");
    let found = editor.diagnostics();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0]["message"].as_str().expect("text").contains("did you mean SPINDL?"));
    assert_eq!(found[0]["range"]["start"], json!({ "line": 0, "character": 0 }));
    assert_eq!(found[0]["range"]["end"], json!({ "line": 0, "character": 7 }));
}

#[test]
fn diagnostics_follow_each_change_and_go_with_the_document() {
    let mut editor = Editor::new("NN=1\n");
    assert_eq!(editor.diagnostics()[0]["code"], "W0152");
    let change = json!({
        "textDocument": { "uri": editor.uri },
        "contentChanges": [{ "text": "IF(1==2)CONTIN\nFINI\n" }],
    });
    let told = editor.server.notification("textDocument/didChange", &change);
    assert_eq!(told[0].1["diagnostics"][0]["severity"], 1, "{told:?}");
    let close = json!({ "textDocument": { "uri": editor.uri } });
    let told = editor.server.notification("textDocument/didClose", &close);
    assert_eq!(told[0].1["diagnostics"], json!([]));
}

#[test]
fn hints_are_actions() {
    for (before, after) in [
        ("|SPINDEL/ON\nFINI\n", "SPINDL/ON\nFINI\n"),
        ("NN=1\nIF(NN=|=2)CONTIN\nFINI\n", "NN=1\nIF(NN.EQ.2)CONTIN\nFINI\n"),
        ("NN=1\nIF(NN|=2)CONTIN\nFINI\n", "NN=1\nIF(NN.EQ.2)CONTIN\nFINI\n"),
        ("NN=1\nIF(NN!|=2)CONTIN\nFINI\n", "NN=1\nIF(NN.NE.2)CONTIN\nFINI\n"),
        ("|NN=1", "NN=1\nFINI\n"),
    ] {
        let mut editor = Editor::new(before);
        let text = before.replacen('|', "", 1);
        let fixes = editor.fixes();
        let made: Vec<String> = fixes.iter().map(|fix| editor.applied(&text, fix)).collect();
        assert!(made.contains(&after.to_string()), "{before}: {made:?}");
    }
}

#[test]
fn an_allowed_code_is_allowed_after_its_action() {
    let text = "CIMFIL/ON,COOLNT\n  NN=PO|STF(5)\nCIMFIL/OFF\nFINI\n";
    let mut editor = Editor::new(text);
    let plain = text.replacen('|', "", 1);
    let codes = |editor: &Editor| -> Vec<String> {
        let found = editor.diagnostics();
        found.iter().map(|diag| diag["code"].as_str().expect("a code").to_string()).collect()
    };
    assert!(codes(&editor).contains(&"W0218".to_string()), "{:?}", codes(&editor));
    let fixes = editor.fixes();
    let fix = fixes.iter().find(|fix| fix["title"] == "allow W0218 here").expect("an action");
    let after = editor.applied(&plain, fix);
    assert!(!codes(&Editor::new(&after)).contains(&"W0218".to_string()), "{after}");
}

#[test]
fn hover_explains_names_functions_numbers_and_words() {
    for (text, wanted) in [
        ("XX=SQR|TF(2)\nFINI\n", "square root"),
        ("XX=POSTF(1|3)\nFINI\n", "POSTF(13)"),
        ("XX=POSTF(1)+POS|TF(13)\nFINI\n", "POSTF(13)"),
        ("XX=POSTF(2,3,48|7,1)\nFINI\n", "487"),
        ("XX=POSTF(3,3,37|4)\nFINI\n", "last output value of S"),
        ("CIMFIL/ON,CYC|LE\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n", "CYCLE"),
        ("$$ how deep\nDEEPER=5\nXX=DEEP|ER\nFINI\n", "$$ how deep\nDEEPER=5"),
        ("XX=COMF('rapid.spl|it')\nFINI\n", "rapid.split"),
        ("RESE|RV/TAB,3\nTAB(1)=1\nFINI\n", "RESERV"),
    ] {
        let mut editor = Editor::new(text);
        let found = editor.ask("textDocument/hover");
        let shown = found["contents"]["value"].as_str().unwrap_or_default();
        assert!(shown.contains(wanted), "{text}: {found}");
    }
    assert_eq!(Editor::new("$$ SQR|TF\nFINI\n").ask("textDocument/hover"), Value::Null);
}

#[test]
fn completion_proposes_what_is_legal_there() {
    for (text, some, none) in [
        ("|\nFINI\n", "CIMFIL", "SQRTF("),
        ("CIMFIL/O|\nFINI\n", "ON", "CYCLE"),
        ("CIMFIL/ON,|\nFINI\n", "CYCLE", "ON"),
        ("CYCLE/|\nFINI\n", "DRILL", "RESERV"),
        ("CIMFIL/ON,CYCLE\nCASE/POSTF(7,4)\nWHEN/ICODEF(|\nFINI\n", "DRILL", "SQRTF("),
        ("CASE/1\nWHEN/|\nENDCAS\nFINI\n", "OTHER", "CYCLE"),
        ("XX=POSTF(|\nFINI\n", "13", "XX"),
        ("XX=POSTF(2,3,|\nFINI\n", "487", "POSTF("),
        ("MYMAC=MACRO/P1\nTERMAC\nCALL/|\nFINI\n", "MYMAC", "SQRTF("),
        ("MYMAC=MACRO/P1\nTERMAC\nCALL/MYMAC,|\nFINI\n", "P1=", "MYMAC"),
        ("DEPTH=1\nXX=DE|\nFINI\n", "DEPTH", "CYCLE"),
        ("LAB)CONTIN\nJUMPTO/|\nFINI\n", "LAB", "CYCLE"),
        ("XX=COMF('rap|')\nFINI\n", "rapid.split", "CYCLE"),
        ("POSTN/|\nFINI\n", "OUT", "CYCLE"),
    ] {
        let labels = Editor::new(text).labels();
        assert!(labels.iter().any(|label| label == some), "{text}: no {some} in {labels:?}");
        assert!(labels.iter().all(|label| label != none), "{text}: {none} in {labels:?}");
    }
    assert!(Editor::new("$$ CIM|\nFINI\n").labels().is_empty());
    assert!(Editor::new("PPRINT/'CIM|'\nFINI\n").labels().is_empty());
}

/// Of thousands of names those that begin as what is typed; the editor asks again.
#[test]
fn a_long_list_is_cut_to_what_is_typed() {
    let names: String = (0..2000).map(|number| format!("NAME{number}=1\n")).collect();
    let ask = |typed: &str| {
        let text = format!("{names}XX={typed}|\nFINI\n");
        Editor::new(&text).ask("textDocument/completion")
    };
    let all = ask("");
    assert_eq!(all["isIncomplete"], true);
    assert_eq!(all["items"].as_array().map(Vec::len), Some(1500));
    let some = ask("name19");
    let items = some["items"].as_array().expect("a list");
    assert!(items.iter().any(|item| item["label"] == "NAME1999"), "{some}");
    assert!(
        items.iter().all(|item| {
            item["label"].as_str().is_some_and(|label| label.starts_with("NAME19"))
        })
    );
}

#[test]
fn signature_help_counts_arguments() {
    for (text, label, active) in [
        ("XX=ATAN2F(1,|2)\nFINI\n", "ATAN2F(", 1),
        ("XX=POSTF(2,3,|487,1)\nFINI\n", "POSTF(2,", 2),
        ("XX=SQRTF(ABSF(|1))\nFINI\n", "ABSF(", 0),
        ("MYMAC=MACRO/P1,P2\nTERMAC\nCALL/MYMAC,1,|2\nFINI\n", "CALL/MYMAC,P1,P2", 1),
        ("MYMAC=MACRO/P1,P2\nTERMAC\nCALL/MYMAC,P2=|2\nFINI\n", "CALL/MYMAC,P1,P2", 1),
    ] {
        let found = Editor::new(text).ask("textDocument/signatureHelp");
        let shown = found["signatures"][0]["label"].as_str().unwrap_or_default();
        assert!(shown.starts_with(label), "{text}: {found}");
        assert_eq!(found["activeParameter"], active, "{text}: {found}");
    }
}

#[test]
fn definition_and_references_of_names() {
    let text = "DEEPER=5\nCIMFIL/ON,COOLNT\nXX=DEEP|ER+1\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let mut editor = Editor::new(text);
    let found = editor.ask("textDocument/definition");
    assert_eq!(found[0]["range"]["start"], json!({ "line": 0, "character": 0 }), "{found}");
    let found = editor.ask("textDocument/references");
    let lines: Vec<u64> = found
        .as_array()
        .expect("a list")
        .iter()
        .map(|place| place["range"]["start"]["line"].as_u64().expect("a line"))
        .collect();
    assert_eq!(lines, [0, 2]);
}

#[test]
fn a_rename_changes_all_places_or_says_why_not() {
    let text = "DEEPER=5\nXX=DEEP|ER+deeper\nFINI\n";
    let mut editor = Editor::new(text);
    let mut params = editor.params();
    let mut rename = |editor: &mut Editor, name: &str| {
        params["newName"] = json!(name);
        editor.request("textDocument/rename", &params)
    };
    let edit = rename(&mut editor, "depth1").expect("renamed");
    let plain = text.replacen('|', "", 1);
    assert_eq!(
        editor.applied(&plain, &json!({ "edit": edit })),
        "DEPTH1=5\nXX=DEPTH1+DEPTH1\nFINI\n"
    );
    for taken in ["XX", "SQRTF", "CYCLE", "IF", "5A", "A B", "", "X"] {
        assert!(rename(&mut editor, taken).is_err(), "{taken}");
    }
    let mut word = Editor::new("CIMFIL/ON,CYC|LE\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n");
    let params = word.params();
    assert!(word.server.request("textDocument/prepareRename", &params).is_err());
}

const WHOLE: &str = "$$ one\n$$ two\nRESERV/TAB,3\nCIMFIL/ON,GOTO\n  IF(POSTF(7,6).GT.1)THEN\n    \
                     TAB(1)=POSTF(7,8)\n  ENDIF\n  DMY=POSTF(13)\nCIMFIL/OFF\nMAKE=MACRO/P\n  \
                     JUMPTO/LEND\n  LEND)CONTIN\nTERMAC\nFINI\n";

#[test]
fn symbols_folds_hints_and_tokens() {
    let mut editor = Editor::new(WHOLE);
    let symbols = editor.ask("textDocument/documentSymbol");
    let names: Vec<&str> = symbols
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|entry| entry["name"].as_str())
        .collect();
    assert_eq!(names, ["TAB", "CIMFIL/ON,GOTO", "DMY", "MAKE"], "{symbols}");
    assert_eq!(symbols[3]["children"][0]["name"], "LEND", "{symbols}");
    let found = editor.request("workspace/symbol", &json!({ "query": "mak" })).expect("found");
    assert_eq!(found[0]["name"], "MAKE", "{found}");
    let folds = editor.ask("textDocument/foldingRange");
    let lines: Vec<[u64; 2]> = folds
        .as_array()
        .expect("a list")
        .iter()
        .map(|fold| {
            [fold["startLine"].as_u64().expect("a line"), fold["endLine"].as_u64().expect("a line")]
        })
        .collect();
    assert_eq!(lines, [[0, 1], [3, 8], [4, 6], [9, 12]]);
    let hints = editor.ask("textDocument/inlayHint");
    let labels: Vec<&str> = hints
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|hint| hint["label"].as_str())
        .collect();
    assert!(labels.contains(&": x") && labels.contains(&": z"), "{labels:?}");
    let tokens = editor.ask("textDocument/semanticTokens/full");
    let data = tokens["data"].as_array().expect("numbers");
    assert!(data.len() > 50 && data.len().is_multiple_of(5));
    assert_eq!(data[..5], [json!(0), json!(0), json!(6), json!(0), json!(0)]);
}

/// The hints of a script, each with the text before it in its line.
fn hints(text: &str) -> Vec<String> {
    let hints = Editor::new(text).ask("textDocument/inlayHint");
    let told = |hint: &Value| {
        let number = |name: &str| hint["position"][name].as_u64().expect("a number") as usize;
        let line = text.lines().nth(number("line")).expect("a line");
        let label = hint["label"].as_str().expect("a label");
        format!("{}{label}", &line[..number("character")])
    };
    hints.as_array().expect("a list").iter().map(told).collect()
}

#[test]
fn words_of_records_are_named_where_their_numbers_are_fixed() {
    for (section, word, name) in [
        ("GOTO", "7", Some("y")),
        ("GOTO", "11", Some("k")),
        ("GOTO", "12", None),
        ("CIRCLE", "15", Some("radius")),
        ("LOADTL", "4", Some("tool")),
        ("LOADTL", "6", None),
        ("CYCLE,DEEP", "4", Some("DEEP")),
        ("CYCLE,DEEP", "6", None),
        ("CYCLE", "4", Some("type, or OFF")),
        ("THREAD,AUTO", "11", Some("z")),
        ("SPINDL", "3", Some("major word")),
        ("SPINDL", "4", None),
        ("PPRINT", "1", Some("number of the record")),
    ] {
        let text = format!("CIMFIL/ON,{section}\nXX=POSTF(7,{word})\nCIMFIL/OFF\nFINI\n");
        let found = hints(&text);
        let named: Vec<&String> =
            found.iter().filter(|hint| hint.starts_with("XX=POSTF(7,")).collect();
        let wanted = name.map(|name| format!("XX=POSTF(7,{word}: {name}"));
        assert_eq!(named, wanted.iter().collect::<Vec<_>>(), "{section} {word}");
    }
    // Outside of a section nobody knows the record.
    assert!(hints("XX=POSTF(7,6)\nFINI\n").iter().all(|hint| !hint.starts_with("XX=POSTF(7,")));
}

#[test]
fn numbers_of_addresses_are_named_by_their_letters() {
    for (text, wanted) in [
        ("POSTN/OUT,7,28,26,0\nFINI\n", &["POSTN/OUT,7: G", "POSTN/OUT,7,28,26: Z"][..]),
        (
            "POSTN/OUT,G,28,26,NN*2,3,1\nNN=1\nFINI\n",
            &["POSTN/OUT,G,28,26: Z", "POSTN/OUT,G,28,26,NN*2,3: C"],
        ),
        ("REPEAT/26,5.5\nFINI\n", &["REPEAT/26: Z"]),
        ("REPEAT/OFF\nPOSTN/OUT,53,1\nFINI\n", &[]),
        ("$$ POSTN/OUT,7,28\nFINI\n", &[]),
        (
            "IF(1.EQ.1)POSTN/OUT,7,28; REPEAT/24,1\nFINI\n",
            &["IF(1.EQ.1)POSTN/OUT,7: G", "IF(1.EQ.1)POSTN/OUT,7,28; REPEAT/24: X"],
        ),
        ("POSTN/OUT,7, $ $$ first, second\n  28,26,0\nFINI\n", &["POSTN/OUT,7: G", "  28,26: Z"]),
        (
            "XX=POSTF(3,3,379)\nFINI\n",
            &["XX=POSTF(3: clear-common", "XX=POSTF(3,3,379: the last output value of X"],
        ),
        // A setting that holds a letter, and one that holds a count.
        (
            "XX=POSTF(2,1,487,21)\nFINI\n",
            &[
                "XX=POSTF(2: set-common",
                "XX=POSTF(2,1,487: dwell.address",
                "XX=POSTF(2,1,487,21: U",
            ],
        ),
    ] {
        assert_eq!(hints(text), wanted, "{text}");
    }
}

#[test]
fn symbols_of_the_folder_are_found_in_files_that_are_not_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    };
    write("open.fil", "OLDNAME=MACRO\nTERMAC\nFINI\n");
    write("posts/mill.fil", "INCLUD/shared.txt\nMILLONE=MACRO\nTERMAC\nFINI\n");
    write("posts/shared.txt", "SHAREDONE=MACRO\nTERMAC\nFINI\n");
    write("posts/uncx01.f12", "TWELVE=MACRO\nTERMAC\nFINI\n");
    write("node_modules/x.fil", "HIDDENONE=MACRO\nTERMAC\nFINI\n");
    write("notes.txt", "NOSCRIPT=MACRO\nTERMAC\nFINI\n");
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let params = json!({ "workspaceFolders": [{ "uri": uri("") }] });
    let own = "NEWNAME=MACRO\nTERMAC\nFINI\n";
    let mut editor = Editor::open_in(&params, &uri("open.fil"), "fil", own);
    let mut names = |query: &str| -> Vec<String> {
        let found = editor.request("workspace/symbol", &json!({ "query": query }));
        let found = found.expect("answered");
        let name = |symbol: &Value| {
            let file = symbol["location"]["uri"].as_str().expect("a file");
            format!("{} {}", symbol["name"].as_str().expect("a name"), &file[uri("").len()..])
        };
        found.as_array().expect("a list").iter().map(name).collect()
    };
    assert_eq!(
        names(""),
        [
            "NEWNAME open.fil",
            "MILLONE posts/mill.fil",
            "SHAREDONE posts/shared.txt",
            "TWELVE posts/uncx01.f12"
        ]
    );
    assert_eq!(names("millo"), ["MILLONE posts/mill.fil"]);
    assert!(names("OLDNAME").is_empty(), "the text of the editor counts");
    // What is saved is read again.
    write("posts/mill.fil", "MILLTWO=MACRO\nTERMAC\nFINI\n");
    let saved = json!({ "textDocument": { "uri": uri("posts/mill.fil") } });
    editor.server.notification("textDocument/didSave", &saved);
    let found = editor.request("workspace/symbol", &json!({ "query": "MILL" }));
    assert_eq!(found.expect("answered")[0]["name"], "MILLTWO");
}

#[test]
fn formatting_is_that_of_fmt() {
    let mut editor = Editor::new("cimfil/on,cycle\ndmy=postf(13)\ncimfil/off\nfini\n");
    let edits = editor.ask("textDocument/formatting");
    let wanted = filpost::syntax::format("x", "cimfil/on,cycle\ndmy=postf(13)\ncimfil/off\nfini\n");
    assert_eq!(edits[0]["newText"], wanted.expect("formatted").as_str());
    let mut broken = Editor::new("IF(1==2\nFINI\n");
    let params = broken.params();
    assert!(broken.server.request("textDocument/formatting", &params).is_err());
}

#[test]
fn places_count_utf_16() {
    let mut editor = Editor::new("$$ глубина 𝛑\nDEEPER=5 $$ глубина\nTT='Ж𝛑'; XX=DEEP|ER\nFINI\n");
    let hover = editor.ask("textDocument/hover");
    // Ж is one unit, 𝛑 two.
    assert_eq!(hover["range"]["start"], json!({ "line": 2, "character": 13 }), "{hover}");
    assert_eq!(hover["range"]["end"], json!({ "line": 2, "character": 19 }), "{hover}");
}

#[test]
fn settings_are_checked_explained_and_completed() {
    let uri = "file:///x/machine.toml";
    let text = "name = \"Mill\"\n[rapid]\nspl|it = 1\nsplt = 2\n";
    let mut editor = Editor::open(uri, "toml", text);
    assert!(!editor.diagnostics().is_empty());
    let hover = editor.ask("textDocument/hover");
    assert!(
        hover["contents"]["value"].as_str().unwrap_or_default().contains("rapid.split"),
        "{hover}"
    );
    let mut keys = Editor::open(uri, "toml", "[rapid]\nsp|\n");
    assert!(keys.labels().contains(&"split".to_string()));
    let mut choices = Editor::open(uri, "toml", "[rapid]\nsplit = |\n");
    assert!(choices.labels().contains(&"1".to_string()));
    let symbols = editor.ask("textDocument/documentSymbol");
    assert_eq!(symbols[1]["name"], "rapid", "{symbols}");
    for (before, after) in [
        ("[rapid]\nsp|lt = 1\n", "[rapid]\nsplit = 1\n"),
        ("rapid.sp|lt = 1\n", "rapid.split = 1\n"),
        ("[seqnoo]\nincr|ement = 3\n", "[seqno]\nincrement = 3\n"),
    ] {
        let mut editor = Editor::open(uri, "toml", before);
        let fixes = editor.fixes();
        assert_eq!(fixes.len(), 1, "{before}: {fixes:?}");
        assert_eq!(editor.applied(&before.replacen('|', "", 1), &fixes[0]), after);
    }
    let idle = Editor::open(uri, "toml", "[rapid]\nsplit = 1\n");
    assert!(idle.diagnostics().is_empty(), "{:?}", idle.diagnostics());
    let mut idle = Editor::open(uri, "toml", "[program]\nmerg|ing = 1\n");
    assert_eq!(idle.diagnostics()[0]["code"], "W0651", "{:?}", idle.diagnostics());
    let hover = idle.ask("textDocument/hover");
    assert!(hover["contents"]["value"].as_str().unwrap_or_default().contains("does **not** act"));
}

#[test]
fn statements_of_a_cl_file_show_their_words() {
    let cl = "PARTNO / 7\nLOADTL / 3\nCYCLE / DRILL, DEPTH, 5.0,  $\n CL|EAR, 2.0\nGOTO / 1, 2, 3\nFINI\n";
    let mut editor = Editor::open("file:///x/part.ncl", "cl", cl);
    let hover = editor.ask("textDocument/hover");
    let shown = hover["contents"]["value"].as_str().unwrap_or_default();
    assert!(shown.contains("   4  DRILL") && shown.contains("   7  CLEAR"), "{shown}");
    for (statement, lines) in [
        ("GOTO / 1, 2, 3", &["   3  5            subtype", "   7  2            y"][..]),
        ("CIRCLE / 0, 0, 0, 0, 0, 1, 7", &["   2  3000         type", "  15  7            radius"]),
        ("MULTAX / ON", &["   3  2            subtype", "   4  ON           ON or OFF"]),
        ("PPRINT ONE, TWO", &["   4  'ONE, TWO'   text"]),
        ("LOADTL / 4", &["   1  3            number of the record", "   4  4            tool"]),
    ] {
        // The statement before it is refused, and stops nothing.
        let text = format!("PARTNO / 7\nGOTO / 1, 2, 3\nLOADTL / (\n{statement}|");
        let hover = Editor::open("file:///x/part.ncl", "cl", &text).ask("textDocument/hover");
        let shown = hover["contents"]["value"].as_str().unwrap_or_default();
        for line in lines {
            assert!(shown.contains(&format!("{line}\n")), "{statement}: {line}\n{shown}");
        }
    }
    let symbols = editor.ask("textDocument/documentSymbol");
    assert_eq!(symbols[1]["name"], "LOADTL / 3", "{symbols}");
    assert_eq!(symbols[1]["children"][0]["kind"], 5, "{symbols}");
}

#[test]
fn included_files_share_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    fs::create_dir(folder.path().join("parts")).expect("made");
    write("main.fil", "OUTER=1\nINCLUD/parts/one.fil\nCALL/HELPER\nFINI\n");
    let one = "HELPER=MACRO\nXX=OUTER\nTERMAC\nFINI\n";
    write("parts/one.fil", one);
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let main = "OUTER=1\nINCLUD/parts/one.fil\nCALL/HEL|PER\nFINI\n";
    let mut main = Editor::open(&uri("main.fil"), "fil", main);
    let found = main.ask("textDocument/definition");
    assert_eq!(found[0]["uri"], uri("parts/one.fil"), "{found}");
    main.line = 1;
    let found = main.ask("textDocument/definition");
    assert_eq!(found[0]["uri"], uri("parts/one.fil"), "INCLUD leads to its file: {found}");
    let included = Editor::open(&uri("parts/one.fil"), "fil", one);
    assert!(included.diagnostics().is_empty(), "{:?}", included.diagnostics());
    // What is wrong in the edited text of the included file is seen, not what the disk has.
    let broken = Editor::open(&uri("parts/one.fil"), "fil", &one.replace("XX=OUTER", "XX="));
    assert!(!broken.diagnostics().is_empty());
    fs::remove_file(folder.path().join("main.fil")).expect("removed");
    let alone = Editor::open(&uri("parts/one.fil"), "fil", one);
    assert!(!alone.diagnostics().is_empty());
}

#[test]
fn files_of_a_case_are_checked_together_for_its_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write("one.fil", "CALL/HELPER\nFINI\n");
    write("two.fil", "HELPER=MACRO\nXX=1\nYY=XX\nZZ=YY\nPPRINT/ZZ\nTERMAC\nFINI\n");
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let codes = |params: &Value| -> Vec<String> {
        let editor = Editor::open_in(params, &uri("one.fil"), "fil", "CALL/HELPER\nFINI\n");
        let found = editor.diagnostics();
        found.iter().map(|diag| diag["message"].as_str().expect("text").to_string()).collect()
    };
    let params = json!({ "workspaceFolders": [{ "uri": uri("") }] });
    assert!(!codes(&params).is_empty(), "the macro is nowhere");
    write("part.ncl", "FINI\n");
    write(
        "case.toml",
        "cl = \"part.ncl\"\nready = \"fanuc-mill\"\nfil = [\"two.fil\", \"one.fil\"]\norigin = \"x\"\n",
    );
    assert_eq!(codes(&params), Vec::<String>::new());
    assert!(!codes(&Value::Null).is_empty(), "without a folder nothing is known of the case");
}

#[test]
fn a_hover_tells_what_a_name_held_in_the_last_run_of_its_case() {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    let fil = "NN=0\nCIMFIL/ON,GOTO\nNN=NN+1\nXX=POSTF(7,6)*NN\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    write("post.fil", fil);
    write(
        "part.ncl",
        "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nGOTO / 4, 2, 3\nFINI\n",
    );
    write(
        "case.toml",
        "cl = \"part.ncl\"\nready = \"fanuc-mill\"\noptions.style = \"plain\"\nfil = [\"post.fil\"]\norigin = \"x\"\n",
    );
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let params = json!({ "workspaceFolders": [{ "uri": uri("") }] });
    let hover = |marked: &str| {
        let mut editor = Editor::open_in(&params, &uri("post.fil"), "fil", marked);
        let found = editor.ask("textDocument/hover");
        found["contents"]["value"].as_str().unwrap_or_default().to_string()
    };
    let at = |before: &str| fil.replacen(before, &format!("{before}|"), 1);
    assert!(
        hover(&at("XX=POSTF(7,6)*N")).ends_with(": `NN = 2`"),
        "{}",
        hover(&at("XX=POSTF(7,6)*N"))
    );
    assert!(hover(&at("NN=N")).ends_with(": `NN = 1`"), "before the line");
    let record = hover(&at("XX=POS"));
    assert!(record.contains("record 5, CL line 5: 2 = `5000`, 3 = `5`"), "{record}");
    assert!(record.contains("6 = `4`"), "{record}");
    // What is not saved has not run.
    let edited = at("XX=POSTF(7,6)*N").replace("NN=0", "NN=5");
    assert!(!hover(&edited).contains("line ran last"));
    // A line that has never run, and a script without end, hold nothing up.
    let endless = "LA) XX=1\nJUMPTO/LA\nFINI\n";
    write("post.fil", endless);
    let told = hover("LA) X|X=1\nJUMPTO/LA\nFINI\n");
    assert!(told.ends_with("`XX = 1`"), "{told}");
}

#[test]
fn a_session_over_a_connection() {
    let (editor, server) = Connection::memory();
    let thread = thread::spawn(move || serve(&server));
    let request = |id: i32, method: &str, params: Value| {
        let message = Request { id: id.into(), method: method.into(), params };
        editor.sender.send(Message::Request(message)).expect("sent");
    };
    let notify = |method: &str, params: Value| {
        let message = Notification { method: method.into(), params };
        editor.sender.send(Message::Notification(message)).expect("sent");
    };
    let answer = || editor.receiver.recv().expect("an answer");
    request(1, "initialize", json!({ "capabilities": {} }));
    let Message::Response(ready) = answer() else { panic!("no response") };
    let capabilities = ready.response_result.expect("capabilities");
    assert_eq!(capabilities["capabilities"]["hoverProvider"], true);
    typed::answer("initialize", &capabilities);
    notify("initialized", json!({}));
    let document =
        json!({ "uri": "untitled:a.fil", "languageId": "fil", "version": 1, "text": "NN=1\n" });
    notify("textDocument/didOpen", json!({ "textDocument": document }));
    let Message::Notification(told) = answer() else { panic!("no notification") };
    assert_eq!(told.method, "textDocument/publishDiagnostics");
    request(2, "textDocument/unheardOf", json!({ "textDocument": { "uri": "untitled:a.fil" } }));
    let Message::Response(refused) = answer() else { panic!("no response") };
    assert_eq!(refused.response_result.expect_err("an error").code, -32601);
    request(3, "shutdown", Value::Null);
    let Message::Response(done) = answer() else { panic!("no response") };
    assert!(done.response_result.is_ok());
    notify("exit", Value::Null);
    thread.join().expect("no panic").expect("a clean end");
}
