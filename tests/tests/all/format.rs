//! Formatting changes nothing that a script does: every FIL file here compiles
//! to the same bytecode before and after, or is refused for the same reasons.

use std::path::{Path, PathBuf};

use fil_vm::{FilFile, Included, LoadOptions};
use filpost::cl::Vocabulary;
use filpost::files;
use filpost::syntax::format;
use filpost_tests::{examples, root};

/// All FIL files of the workspace.
fn scripts() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in ["corpus", "fil-scripts", "tests"] {
        find(&root().join(folder), &mut found);
    }
    found.sort();
    found
}

fn find(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            find(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "fil") {
            found.push(path);
        }
    }
}

/// The bytecode of a text without line numbers, and the codes of its warnings;
/// or the codes it is refused with.
/// The same without the warning that judges how a script is laid out: formatting answers it.
fn without_layout(
    compiled: Result<(String, Vec<String>), Vec<String>>,
) -> Result<(String, Vec<String>), Vec<String>> {
    compiled.map(|(code, mut warnings)| {
        warnings.retain(|warning| !warning.starts_with("W0248"));
        (code, warnings)
    })
}

fn compiled(path: &Path, text: &str) -> Result<(String, Vec<String>), Vec<String>> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut loader = |_: &str, name: &str| {
        let text = files::read_text(&folder.join(name), None);
        let included = |text| Included { name: name.to_string(), text };
        text.map(included).map_err(|error| error.to_string())
    };
    let file = FilFile { name: "script.fil", text };
    let options = LoadOptions { loader: Some(&mut loader), lint: true, ..LoadOptions::default() };
    let codes = |diags: &[filpost::Diag]| {
        let mut codes: Vec<String> = diags.iter().map(|diag| diag.code.name()).collect();
        codes.sort();
        codes
    };
    match fil_vm::load(&[file], &mut Vocabulary::new(), options) {
        Ok(loaded) => {
            Ok((without_lines(&fil_vm::disassemble(&loaded.module)), codes(&loaded.warnings)))
        }
        Err(diags) => Err(codes(&diags)),
    }
}

/// A disassembly without its second column, the number of the line.
fn without_lines(disassembly: &str) -> String {
    let line = |line: &str| match line.as_bytes().first() {
        Some(b' ' | b'0'..=b'9') => {
            let (position, rest) = line.trim_start().split_once(' ').unwrap_or((line, ""));
            let (number, operation) = rest.trim_start().split_once(' ').unwrap_or((rest, ""));
            assert!(number.parse::<u32>().is_ok(), "{line}");
            format!("{position} {operation}\n")
        }
        _ => format!("{line}\n"),
    };
    disassembly.lines().map(line).collect()
}

#[test]
fn every_script_does_the_same_when_formatted() {
    let (mut compiling, mut changed) = (0, 0);
    for path in scripts() {
        let name = path.display().to_string();
        let text = files::read_text(&path, None).expect("a script");
        let Ok(formatted) = format(&name, &text) else {
            assert!(compiled(&path, &text).is_err(), "{name} compiles but was not formatted");
            continue;
        };
        assert_eq!(format(&name, &formatted).ok().as_ref(), Some(&formatted), "{name}");
        let before = without_layout(compiled(&path, &text));
        assert_eq!(without_layout(compiled(&path, &formatted)), before, "{name}");
        compiling += usize::from(before.is_ok());
        changed += usize::from(formatted != text);
    }
    assert!(compiling > 60, "only {compiling} scripts were compiled");
    assert!(changed > 60, "only {changed} scripts were formatted");
}

#[test]
fn a_changed_script_is_told_apart() {
    let path = Path::new("t.fil");
    assert_ne!(compiled(path, "A1=1\nFINI\n"), compiled(path, "A1=2\nFINI\n"));
    assert_eq!(compiled(path, "A1=1\nFINI\n"), compiled(path, "\n\nA1 = 1\nFINI\n"));
}

#[test]
fn the_examples_of_the_layout_have_it() {
    let page = std::fs::read_to_string(root().join("docs/fmt.md")).expect("the page");
    let mut count = 0;
    for block in examples::blocks(&page) {
        if !block.text.contains('→') {
            let formatted = format("docs/fmt.md", &block.text).expect("no errors");
            assert_eq!(formatted, block.text, "docs/fmt.md:{}", block.line);
            count += 1;
        }
    }
    assert!(count >= 3, "only {count} examples");
}
