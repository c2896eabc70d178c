//! Editors as people use them, where `FILPOST_EDITORS` names a folder that
//! `.ci/install-editors` has filled: VS Code in a browser, and three editors in a terminal.
//! `FILPOST_SCREENSHOTS` names a folder for the pictures of the docs.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use filpost::syntax;

use crate::support::Folder;

/// The folder of the tools, when it has a program; else the reason is printed.
fn tools(program: &str) -> Option<PathBuf> {
    let Some(folder) = std::env::var_os("FILPOST_EDITORS").map(PathBuf::from) else {
        eprintln!("skipped: FILPOST_EDITORS names no folder made by .ci/install-editors");
        return None;
    };
    if !folder.join("bin").join(program).is_file() {
        eprintln!("skipped: {} has no {program}", folder.display());
        return None;
    }
    folder.canonicalize().ok()
}

/// A program of the PATH; else the reason is printed.
fn on_path(names: &[&str]) -> Option<PathBuf> {
    let search = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&search).collect();
    let named =
        |name: &&str| folders.iter().map(|folder| folder.join(name)).find(|at| at.is_file());
    let found = names.iter().find_map(named);
    if found.is_none() {
        eprintln!("skipped: no {}", names[0]);
    }
    found
}

fn chromium() -> Option<PathBuf> {
    let named = std::env::var_os("FILPOST_CHROMIUM").map(PathBuf::from);
    named.or_else(|| on_path(&["chromium", "chromium-browser"]))
}

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().expect("the repository is there")
}

/// The case of the tutorial in a folder of its own, `plate`.
fn plate() -> Folder {
    let mut folder = Folder::new().folder("plate");
    for entry in fs::read_dir(root().join("corpus/tutorial")).expect("the case").flatten() {
        let name = format!("plate/{}", entry.file_name().to_string_lossy());
        folder = folder.with(&name, fs::read(entry.path()).expect("a file"));
    }
    folder
}

fn said(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{out}{err}")
}

/// Runs a script of this folder with node.
fn script(name: &str, tools: &Path, arguments: &[&OsStr]) -> Output {
    Command::new("node")
        .arg(root().join("crates/filpost-cli/tests/cli").join(name))
        .arg(tools)
        .arg(env!("CARGO_BIN_EXE_filpost"))
        .args(arguments)
        .env("NODE_PATH", tools.join("node_modules"))
        .env("FILPOST_CHROMIUM", chromium().unwrap_or_default())
        .output()
        .expect("node starts")
}

fn pictures(folder: &Folder) -> PathBuf {
    let named = std::env::var_os("FILPOST_SCREENSHOTS").map(PathBuf::from);
    named.unwrap_or_else(|| folder.0.path().to_path_buf())
}

#[test]
fn vs_code_with_the_extension() {
    let Some(tools) = tools("code-server") else { return };
    if chromium().is_none() || on_path(&["node"]).is_none() {
        return;
    }
    let folder = plate().folder("empty");
    let extension = folder.0.path().join("filpost.vsix");
    let packed = Command::new(root().join("crates/filpost-lsp/editors/vscode/package.sh"))
        .args([&extension, &tools.join("extension/node_modules")])
        .output()
        .expect("the script starts");
    assert!(packed.status.success(), "{}", said(&packed));
    let (workspace, pictures) = (folder.0.path().join("plate"), pictures(&folder));
    let empty = folder.0.path().join("empty");
    let arguments = [&extension, &workspace, &empty, &pictures].map(|path| path.as_os_str());
    let output = script("vscode.js", &tools, &arguments);
    let said = said(&output);
    assert!(output.status.success() && said.contains("all steps passed"), "{said}");
}

fn in_a_terminal(editor: &str, program: &str) {
    let Some(tools) = tools(program) else { return };
    if on_path(&["tmux"]).is_none() || on_path(&["node"]).is_none() {
        return;
    }
    let folder = plate();
    let (workspace, pictures) = (folder.0.path().join("plate"), pictures(&folder));
    let root = root();
    let arguments =
        [root.as_os_str(), workspace.as_os_str(), pictures.as_os_str(), editor.as_ref()];
    let output = script("terminal.js", &tools, &arguments);
    let said = said(&output);
    let passed = output.status.success() && said.contains(&format!("{editor} passed"));
    assert!(passed, "{said}");
}

#[test]
fn neovim_as_its_page_sets_it_up() {
    in_a_terminal("neovim", "nvim");
}

#[test]
fn emacs_as_its_page_sets_it_up() {
    in_a_terminal("emacs", "emacs");
}

#[test]
fn helix_as_its_page_sets_it_up() {
    in_a_terminal("helix", "hx");
}

/// All files of FIL below a folder.
fn scripts(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            scripts(&path, found);
        } else if path.extension().is_some_and(|end| end == "fil") {
            found.push(path);
        }
    }
}

/// True for a text in which the parser of the project finds nothing wrong.
fn is_accepted(path: &Path) -> bool {
    let text = filpost::files::read_text(path, None).expect("a text");
    syntax::parse("post.fil", &text).diags.iter().all(|diag| !diag.is_error())
}

#[test]
fn the_tree_sitter_grammar_reads_what_the_parser_accepts() {
    let Some(tools) = tools("tree-sitter") else { return };
    let program = tools.join("bin/tree-sitter");
    let folder = Folder::new().folder("queries");
    let own = root().join("crates/filpost-lsp/editors/tree-sitter-fil");
    for name in ["grammar.js", "tree-sitter.json", "queries/highlights.scm"] {
        fs::copy(own.join(name), folder.0.path().join(name)).expect("copied");
    }
    let run = |arguments: &[&str]| {
        let mut command = Command::new(&program);
        let output = command.args(arguments).current_dir(folder.0.path()).output();
        output.expect("tree-sitter starts")
    };
    for arguments in [&["generate"][..], &["build", "-o", "fil.so"]] {
        let output = run(arguments);
        assert!(output.status.success(), "{}", said(&output));
    }
    let mut files = Vec::new();
    for name in ["fil-scripts", "corpus", "tests", "docs"] {
        scripts(&root().join(name), &mut files);
    }
    let names = |accepted: bool| -> String {
        let of_kind = files.iter().filter(|path| is_accepted(path) == accepted);
        of_kind.map(|path| format!("{}\n", path.display())).collect()
    };
    let own = ["--lib-path", "fil.so", "--lang-name", "fil"];
    let parse = |list: String| {
        fs::write(folder.0.path().join("list"), &list).expect("a list");
        let output = run(&[&["parse", "-q", "--stat", "--paths", "list"][..], &own].concat());
        let said = said(&output);
        let wrong = said.lines().filter(|line| line.contains("ERROR") || line.contains("MISSING"));
        (list.lines().count(), wrong.map(str::to_string).collect::<Vec<_>>())
    };
    let (count, wrong) = parse(names(true));
    assert!(count > 300 && wrong.is_empty(), "{count} files: {wrong:#?}");
    // The test can fail: what the parser refuses is mostly wrong for the grammar too.
    let (count, wrong) = parse(names(false));
    assert!(count > 20 && wrong.len() * 2 > count, "{} of {count}", wrong.len());
    let script = root().join("fil-scripts/papers/run-out.fil");
    let script = script.to_str().expect("a name");
    let colors = run(&[&["query"][..], &own, &["queries/highlights.scm", script]].concat());
    let colors = said(&colors);
    for capture in ["comment", "keyword", "function", "string", "number", "type"] {
        assert!(colors.contains(&format!("- {capture}, start")), "{capture}: {colors:.400}");
    }
}
