//! The commands of docs/install.md run as printed: the short ones always, those that build for
//! minutes with `FILPOST_INSTALL=1`. Skipped ones are told with the reason.

use std::path::Path;
use std::process::Command;

use filpost_tests::root;

use crate::support::Folder;

/// The command with which a command of the page begins, or one of its variants, and how long
/// it takes.
const KNOWN: &[(&str, bool)] = &[
    ("cargo add", false),
    ("cargo install", true),
    (".ci/release", true),
    (".ci/archive", true),
    (".ci/wheel", true),
    (".ci/book", true),
    (".ci/playground", true),
    ("crates/filpost-py/check", true),
    ("crates/filpost-capi/install", true),
    ("crates/filpost-lsp/editors/vscode/package.sh", true),
];

/// The command at the top of the page, and those of the table of parts: the words between grave
/// accents of its second column.
fn commands() -> Vec<String> {
    let page = std::fs::read_to_string(root().join("docs/install.md")).expect("the page");
    let mut commands: Vec<String> =
        page.lines().filter(|line| line.starts_with("cargo install")).map(str::to_string).collect();
    let rows = page.lines().skip_while(|line| *line != "| part | command | needs |").skip(2);
    for row in rows.take_while(|line| line.starts_with('|')) {
        let how = row.split('|').nth(2).expect("a second column");
        commands.extend(how.split('`').skip(1).step_by(2).map(str::to_string));
    }
    commands
}

/// Runs a command: `cargo add` in a program of somebody else, with the path to the checkout; the
/// others in the checkout.
fn run(line: &str) {
    let place = Folder::new();
    let mut shell = Command::new("bash");
    shell.arg("-c");
    if line.starts_with("cargo add") {
        let place = place
            .with("Cargo.toml", "[package]\nname = \"host\"\nedition = \"2024\"\n[workspace]\n")
            .with("src/main.rs", "fn main() {}\n");
        let line = line.replace("crates/", &format!("{}/crates/", root().display()));
        shell.arg(&line).current_dir(place.0.path()).env("CARGO_NET_OFFLINE", "true");
        succeed(&line, &mut shell);
        let added = place.text("Cargo.toml").expect("the file");
        assert!(added.contains("[dependencies]\nfilpost = "), "{added}");
        return;
    }
    let prefix = place.0.path().join("prefix").display().to_string();
    shell.arg(line.replace("PREFIX", &prefix).replace("FOLDER", &prefix)).current_dir(root());
    shell.env("CARGO_INSTALL_ROOT", &prefix).env("PIP_TARGET", &prefix);
    succeed(line, &mut shell);
    if line.starts_with("cargo install") {
        assert!(Path::new(&prefix).join("bin/filpost").is_file(), "{line} installs the command");
    }
    if line.contains("PREFIX") {
        assert!(Path::new(&prefix).join("include/filpost.h").is_file(), "{line} installs it");
    }
}

fn succeed(line: &str, shell: &mut Command) {
    let ran = shell.output().expect("bash");
    let (out, err) = (String::from_utf8_lossy(&ran.stdout), String::from_utf8_lossy(&ran.stderr));
    if let Some(reason) = out.lines().next().filter(|first| first.starts_with("skipped:")) {
        println!("{line}: {reason}");
    }
    assert!(ran.status.success(), "{line}\n{out}\n{err}");
}

#[test]
fn the_commands_of_the_page_run_as_printed() {
    let commands = commands();
    assert!(commands.len() >= 9, "{commands:?}");
    let all = std::env::var_os("FILPOST_INSTALL").is_some();
    for line in &commands {
        let (_, long) = KNOWN
            .iter()
            .find(|(begin, _)| line.starts_with(begin))
            .unwrap_or_else(|| panic!("`{line}` is not known here: say how long it takes"));
        let program = line.split(' ').next().expect("a word");
        if program.contains('/') {
            assert!(root().join(program).is_file(), "{program} is there");
        }
        if *long && !all {
            println!("skipped: `{line}` builds for minutes (FILPOST_INSTALL=1)");
            continue;
        }
        run(line);
    }
}

#[test]
fn the_version_says_what_the_page_says() {
    let place = Folder::new();
    let long = place.run(&["--version"]).out;
    let facts = [env!("CARGO_PKG_VERSION"), std::env::consts::ARCH, std::env::consts::OS];
    assert!(facts.iter().all(|fact| long.contains(fact)), "{long}");
    let short = place.run(&["-V"]).out;
    assert_eq!(short, format!("filpost {}\n", env!("CARGO_PKG_VERSION")));
}
