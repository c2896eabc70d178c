//! The corpus in WebAssembly: each case gives the bytes there that it gives natively, or is
//! refused with the same codes and words.
//!
//! `FILPOST_WASM` names the module, which `.ci/wasm` builds; node runs it.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;

use filpost::case::{self, Case};
use filpost::{CodePage, Diag, Error};
use serde_json::{Value, json};

/// Cases whose scripts read a folder, which no host of the module grants.
const MOST_WITH_FILES: usize = 20;

#[test]
fn the_corpus_gives_the_same_bytes_in_wasm() {
    let Ok(wasm) = std::env::var("FILPOST_WASM") else {
        println!("skipped: FILPOST_WASM names no module (.ci/wasm builds it)");
        return;
    };
    if Command::new("node").arg("--version").output().is_err() {
        println!("skipped: node is not there");
        return;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let cases = case::find(&root.join("corpus")).unwrap();
    let (cases, with_files): (Vec<_>, Vec<_>) =
        cases.into_iter().partition(|case| case.file.read.is_none());
    // The module has no pages of two bytes.
    let (cases, double): (Vec<_>, Vec<_>) =
        cases.into_iter().partition(|case| !case.folder.ends_with("shift-jis"));
    assert_eq!(double.len(), 1);
    assert!(cases.len() > 600 && with_files.len() <= MOST_WITH_FILES);
    let requests = cases.iter().map(request).collect();
    let answers = answers(Path::new(&wasm), &root, requests);
    assert_eq!(answers.len(), cases.len());
    let different: Vec<String> =
        cases.iter().zip(&answers).filter_map(|(case, answer)| difference(case, answer)).collect();
    assert!(different.is_empty(), "{}", different.join("\n"));
    let posted = answers.iter().filter(|answer| answer["nc"].is_string()).count();
    assert!(posted > 330, "{posted}");
    println!(
        "{posted} programs and {} refusals are the same; {} cases read files",
        answers.len() - posted,
        with_files.len()
    );
}

/// What the module gives otherwise than the library; `None` where it is the same.
fn difference(case: &Case, answer: &Value) -> Option<String> {
    let native = match case.run() {
        Ok((nc, warnings)) => {
            // Bytes as characters U+0000 to U+00FF, as the module gives programs in code pages.
            let bytes: String = nc.iter().map(|byte| char::from(*byte)).collect();
            json!({ "nc": bytes, "warnings": said(&warnings) })
        }
        Err(error) => json!({ "errors": errors(&error) }),
    };
    let of = |key: &str| match &answer[key] {
        Value::Array(diags) => {
            let pair = |diag: &Value| words(&text(&diag["code"]), &text(&diag["message"]));
            diags.iter().map(pair).collect()
        }
        _ => Value::Null,
    };
    let found = match &answer["nc"] {
        Value::String(nc) => {
            let in_utf8 = || nc.bytes().map(char::from).collect::<String>().into();
            let bytes = answer.get("bytes").cloned().unwrap_or_else(in_utf8);
            json!({ "nc": bytes, "warnings": of("warnings") })
        }
        _ => json!({ "errors": of("errors") }),
    };
    (native != found).then(|| {
        format!("{}:\nnative {native}\nwasm   {found} {}", case.folder.display(), answer["trap"])
    })
}

fn said(diags: &[Diag]) -> Value {
    diags.iter().map(|diag| words(&diag.code.name(), &diag.message)).collect()
}

/// A code and its sentence; files have other names here, so a sentence that names one is left
/// out.
fn words(code: &str, message: &str) -> Value {
    json!([code, if message.contains(".fil") { "" } else { message }])
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_string()
}

fn errors(error: &Error) -> Value {
    said(error.diags())
}

/// A file as a page hands it over: one that is not in UTF-8 is in the page of Windows.
fn as_text(bytes: Vec<u8>) -> String {
    let windows = CodePage::named("windows-1252").unwrap();
    String::from_utf8(bytes)
        .unwrap_or_else(|error| windows.decode_all(error.as_bytes()).into_owned())
}

/// A case as a request.
fn request(case: &Case) -> Value {
    let file = &case.file;
    let text = |name: &str| as_text(std::fs::read(case.folder.join(name)).unwrap());
    let named = |name: &String| json!({ "name": name, "text": text(name) });
    let includes = file.fil.iter().flat_map(|name| included(&case.folder.join(name)));
    let mut request = json!({
        "do": "post",
        "cl": text(&file.cl),
        "cl_name": file.cl,
        "fil": file.fil.iter().map(named).collect::<Vec<_>>(),
        "includes": includes.collect::<Vec<_>>(),
        "set": file.set,
        "options": file.options,
        "levels": file.levels,
        "strict": file.strict,
        "allow": file.allow,
        "raw_records": file.raw_records,
    });
    let optional = [
        ("ready", file.ready.clone().map(Value::from)),
        ("machine", file.machine.as_ref().map(named)),
        ("option_file", file.option_file.as_ref().map(named)),
        ("compat", file.compat.as_ref().map(named)),
        ("clock", file.clock.clone().map(Value::from)),
        ("fuel", file.fuel.map(Value::from)),
        ("dialect", file.dialect.map(|dialect| dialect.to_string().into())),
        ("units", file.units.map(|unit| unit.to_string().into())),
    ];
    for (key, value) in optional {
        if let Some(value) = value {
            request[key] = value;
        }
    }
    request
}

/// What a script includes, by the names that it says.
fn included(path: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap();
    let names = text.lines().filter_map(|line| line.trim().strip_prefix("INCLUD/"));
    let found = names.filter_map(|name| {
        let text = std::fs::read_to_string(path.with_file_name(name.trim())).ok()?;
        Some(json!({ "name": name.trim(), "text": text }))
    });
    found.collect()
}

/// The answers of the module, in the order of the requests.
fn answers(wasm: &Path, root: &Path, requests: Vec<Value>) -> Vec<Value> {
    let mut node = Command::new("node")
        .arg(root.join("tests/wasm/answer.mjs"))
        .arg(wasm)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = node.stdin.take().unwrap();
    let writer = thread::spawn(move || {
        for request in requests {
            writeln!(input, "{request}").unwrap();
        }
    });
    let output = BufReader::new(node.stdout.take().unwrap());
    let answers =
        output.lines().map(|line| serde_json::from_str(&line.unwrap()).unwrap()).collect();
    writer.join().unwrap();
    assert!(node.wait().unwrap().success());
    answers
}
