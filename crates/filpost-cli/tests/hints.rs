//! The help of each code names ways that there are: each command, option, setting and word in it
//! is tried.

use std::collections::BTreeMap;
use std::process::{Command, Output};

/// Letters that are no word of FIL, CL or the control.
const ABBREVIATIONS: [&str; 5] = ["CLDATA", "LRP", "RELCOM", "UTF", "ENDCAS"];

/// Endings of files, which look as keys of settings do.
const FILES: [&str; 8] = ["toml", "fil", "ncl", "nc", "map", "md", "tsv", "json"];

fn filpost(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_filpost"));
    command.args(arguments).output().expect("the command runs")
}

fn printed(arguments: &[&str]) -> String {
    String::from_utf8_lossy(&filpost(arguments).stdout).into_owned()
}

fn succeeds(arguments: &[&str]) -> bool {
    filpost(arguments).status.success()
}

/// The help texts of all commands, by their names.
fn commands() -> BTreeMap<String, String> {
    let names = printed(&["--help"]);
    let names = names.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = names.take_while(|line| !line.is_empty());
    let names = names.filter_map(|line| line.split_whitespace().next());
    let mut texts: BTreeMap<String, String> = names
        .filter(|name| *name != "help")
        .map(|name| (name.to_string(), printed(&[name, "--help"])))
        .collect();
    let machine =
        ["show", "import", "diff", "schema"].map(|name| printed(&["machine", name, "--help"]));
    texts.entry("machine".into()).or_default().push_str(&machine.concat());
    texts
}

/// The characters of a hint, cut where another kind of word begins.
fn tokens<'h>(hint: &'h str, belongs: impl Fn(char) -> bool + 'h) -> impl Iterator<Item = &'h str> {
    hint.split(move |character| !belongs(character)).map(|token| token.trim_matches(['.', '-']))
}

/// What of a hint is not there.
fn missing(hint: &str, commands: &BTreeMap<String, String>) -> Vec<String> {
    let mut missing = Vec::new();
    let options = hint.split_whitespace().filter_map(|word| Some(&word[word.find("--")?..]));
    for option in options {
        let name: String =
            option.chars().take_while(|c| c.is_ascii_lowercase() || *c == '-').collect();
        if !commands.values().any(|text| text.contains(&name)) {
            missing.push(name);
        }
    }
    for rest in hint.split("filpost ").skip(1) {
        let name = rest.split(|c: char| !c.is_ascii_lowercase()).next().unwrap_or_default();
        let is_command = hint.contains(&format!("`filpost {name}"));
        if is_command && !commands.contains_key(name) {
            missing.push(format!("filpost {name}"));
        }
    }
    let of_key = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "._".contains(c);
    for key in tokens(hint, of_key) {
        let ending = key.rsplit('.').next().unwrap_or_default();
        let begins = key.starts_with(|c: char| c.is_ascii_lowercase());
        if key.contains('.') && begins && !FILES.contains(&ending) {
            missing.extend(setting(key, hint));
        }
    }
    for word in tokens(hint, |c| c.is_ascii_uppercase() || c.is_ascii_digit()) {
        let letters = word.chars().take_while(char::is_ascii_uppercase).count();
        let is_known = || ABBREVIATIONS.contains(&word) || succeeds(&["explain", word]);
        if letters > 2 && !is_known() {
            missing.push(word.to_string());
        }
    }
    missing
}

/// A setting that there is not, or that can't have the value which the hint gives.
fn setting(key: &str, hint: &str) -> Option<String> {
    if !succeeds(&["explain", key]) {
        // A list of words is a key too.
        let folder = tempfile::tempdir().expect("a folder");
        let machine = folder.path().join("machine.toml");
        let text = format!("base = \"fanuc-mill\"\n{key} = [\"QMSNOTE\"]\n");
        std::fs::write(&machine, text).expect("a machine");
        let machine = machine.display().to_string();
        return (!succeeds(&["machine", "show", "-m", &machine])).then(|| key.to_string());
    }
    let (_, value) = hint.split_once(&format!("{key} = "))?;
    let value: String = value.chars().take_while(|c| !" ,;)".contains(*c)).collect();
    let assigned = format!("{key}={}", value.trim_end_matches('.'));
    let tried = filpost(&["machine", "show", key, "-p", "fanuc-mill", "--set", &assigned]);
    let said = String::from_utf8_lossy(&tried.stderr).into_owned();
    // Other settings of the machine may contradict it; the value itself must be one.
    ["E0604", "E0605"].iter().any(|code| said.contains(code)).then_some(assigned)
}

#[test]
fn the_help_of_each_code_names_ways_that_there_are() {
    let commands = commands();
    assert!(commands.len() > 15, "{:?}", commands.keys());
    let codes = filpost::all_codes();
    let wrong: Vec<String> = codes
        .iter()
        .map(|code| (code.name(), missing(code.hint, &commands)))
        .filter(|(_, missing)| !missing.is_empty())
        .map(|(name, missing)| format!("{name}: {}", missing.join(", ")))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_way_that_there_is_not_is_found() {
    let commands = commands();
    for hint in [
        "Give --no-such-option.",
        "`filpost nothing` lists them.",
        "Set rapid.nothing.",
        "Set rapid.split = banana.",
        "Put NOSUCHWD before it.",
    ] {
        assert_eq!(missing(hint, &commands).len(), 1, "{hint}");
    }
}
