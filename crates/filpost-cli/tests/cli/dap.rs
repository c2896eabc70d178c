//! `filpost dap`

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::support::{Folder, SMALL};

fn message(text: &str) -> String {
    format!("Content-Length: {}\r\n\r\n{text}", text.len())
}

#[test]
fn a_client_launches_a_run_over_standard_input_and_output() {
    let place = Folder::new().with("part.ncl", SMALL);
    let launch = format!(
        r#"{{"seq":2,"type":"request","command":"launch","arguments":{{"cwd":{:?},"cl":"part.ncl","ready":"fanuc-mill","options":{{"style":"plain"}}}}}}"#,
        place.0.path()
    );
    let mut child = place
        .command(&["dap"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    for text in [
        r#"{"seq":1,"type":"request","command":"initialize","arguments":{}}"#,
        launch.as_str(),
        r#"{"seq":3,"type":"request","command":"setFunctionBreakpoints","arguments":{"breakpoints":[{"name":"record FINI"}]}}"#,
        r#"{"seq":4,"type":"request","command":"configurationDone"}"#,
    ] {
        stdin.write_all(message(text).as_bytes()).expect("the command listens");
    }
    // The run stops at its last record; with the end of the input the command ends.
    let mut stdout = child.stdout.take().expect("a pipe");
    let (mut said, mut bytes) = (String::new(), [0; 4096]);
    while !said.contains(r#""event":"stopped""#) {
        let count = stdout.read(&mut bytes).expect("a pipe");
        assert!(count > 0, "the command ended: {said}");
        said.push_str(&String::from_utf8_lossy(&bytes[..count]));
    }
    drop(stdin);
    assert!(child.wait().expect("the command ends").success(), "{said}");
    for part in [r#""event":"initialized""#, "N40 G1 G43 X1. Y2. Z3. F200. H1"] {
        assert!(said.contains(part), "{part}:\n{said}");
    }
}

#[test]
fn a_client_of_vs_code_goes_through_breakpoints_of_each_kind() {
    let named = std::env::var_os("FILPOST_EDITORS").map(PathBuf::from);
    let client = "node_modules/@vscode/debugadapter-testsupport";
    let Some(modules) = named.filter(|folder| folder.join(client).is_dir()) else {
        eprintln!("skipped: FILPOST_EDITORS names no folder with {client}");
        return;
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().expect("the repository is there");
    let case = root.join("corpus/papers/deep-thread-worm");
    let script = root.join("fil-scripts/papers/deep-thread.fil");
    let text = std::fs::read_to_string(&script).expect("the script is there");
    let line = 1 + text.lines().position(|line| line.contains("CALL/TAKEU")).expect("a line");
    let output = Command::new("node")
        .arg(root.join("crates/filpost-cli/tests/cli/dap.js"))
        .arg(env!("CARGO_BIN_EXE_filpost"))
        .args([&case, &script])
        .arg(line.to_string())
        .args([case.join("part.ncl"), case.join("expected.nc")])
        .env("NODE_PATH", modules.join("node_modules"))
        .output()
        .expect("node starts");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let wrong = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.contains("all sessions passed"), "{said}{wrong}");
}
