//! Each command that writes, and what may go wrong on its host: no input is lost, the files of a
//! run appear together or not at all, and nothing else stays.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::support::{Folder, Ran, SMALL};

/// Commands whose output is OUT: each with its input, and the ending of its first output.
const COMMANDS: [(&str, &str, &str); 8] = [
    ("post part.ncl -o OUT.nc --map=OUT.map --listing OUT.lst", "part.ncl", ".nc"),
    ("post part.ncl -f own.fil -o OUT.nc --profile=OUT.svg", "own.fil", ".nc"),
    ("cl part.ncl --to ncl -o OUT.ncl", "part.ncl", ".ncl"),
    ("plot n.nc -o OUT.svg", "n.nc", ".svg"),
    ("plot n.nc --cl part.ncl -o OUT.html", "part.ncl", ".html"),
    ("test case --update --junit OUT.xml --html OUT.html", "case/part.ncl", ".xml"),
    ("test case --update --coverage --lcov OUT.info", "case/case.toml", ".info"),
    ("machine import u.p01 -o OUT.toml", "u.p01", ".toml"),
];

fn place() -> Folder {
    let toml = "cl = \"part.ncl\"\nexpect = \"o.nc\"\norigin = \"a test\"\n";
    Folder::new()
        .with("part.ncl", SMALL)
        .with("own.fil", "CIMFIL/ON,GOTO\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("n.nc", "G21 G90 G94 G17\nG0 X1. Y2. Z3.\nM30\n")
        .with("u.p01", include_str!("../../../../corpus/errors/W0651-option-file/uncx01.p01"))
        .with("case/case.toml", toml)
        .with("case/part.ncl", SMALL)
        .with("case/o.nc", "old\n")
        .with("shut/kept", "kept\n")
}

/// What is in a folder: texts of files, and where links lead.
fn content(folder: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if let Ok(to) = std::fs::read_link(&path) {
            found.insert(name, format!("-> {}", to.display()));
        } else if path.is_dir() {
            let below = content(&path).into_iter();
            found.extend(below.map(|(inner, text)| (format!("{name}/{inner}"), text)));
        } else {
            found.insert(name, std::fs::read_to_string(&path).expect("a text"));
        }
    }
    found
}

/// Runs a command by the shell, its streams as the redirection says.
fn shell(place: &Folder, line: &str, streams: &str) -> Ran {
    let filpost = env!("CARGO_BIN_EXE_filpost");
    let mut shell = Command::new("bash");
    let line = format!("'{filpost}' {line} {streams}; exit ${{PIPESTATUS[0]}}");
    shell.args(["-c", &line]).current_dir(place.0.path());
    Ran::of(shell.output().expect("bash"))
}

/// The inputs are as they were, and no file in the making is left.
fn keeps(place: &Folder, before: &BTreeMap<String, String>, told: &str) {
    let after = content(place.0.path());
    for (name, text) in before.iter().filter(|(name, _)| *name != "case/o.nc") {
        assert_eq!(after.get(name), Some(text), "{told}: {name}");
    }
    assert!(!after.keys().any(|name| name.ends_with(".tmp")), "{told}: {after:?}");
}

#[test]
fn outputs_that_can_not_be_written_leave_all_as_it_was() {
    for (command, input, ending) in COMMANDS {
        for (mishap, out) in [("no folder", "none/out"), ("a file as a folder", "part.ncl/out")] {
            let place = place();
            let before = content(place.0.path());
            let ran = shell(&place, &command.replace("OUT", out), "");
            assert!(ran.status == 1 && ran.err.contains("E07"), "{mishap}: {command}: {ran:?}");
            assert_eq!(content(place.0.path()), before, "{mishap}: {command}");
        }
        // A link to an input, a link to nothing, a folder, and a hard link.
        for mishap in ["input", "nothing", "folder", "name"] {
            let place = place();
            let (root, out) = (place.0.path(), place.0.path().join(format!("out{ending}")));
            let link = |to: &str| std::os::unix::fs::symlink(to, &out).expect("a link");
            match mishap {
                "input" => link(input),
                "nothing" => link("none/gone"),
                "folder" => std::fs::create_dir(&out).expect("a folder"),
                _ => std::fs::hard_link(root.join(input), &out).expect("a link"),
            }
            let before = content(root);
            let ran = shell(&place, &command.replace("OUT", "out"), "");
            let told = format!("{mishap}: {command}: {ran:?}");
            match mishap {
                "input" => assert!(ran.err.contains("E0802"), "{told}"),
                "folder" if !command.starts_with("post") => assert_eq!(ran.status, 1, "{told}"),
                _ => {}
            }
            if mishap == "input" {
                assert_eq!(content(root), before, "{told}");
            }
            let before = before.into_iter().filter(|(name, _)| name != &format!("out{ending}"));
            keeps(&place, &before.collect(), &told);
        }
    }
}

#[test]
fn streams_that_are_closed_or_full_stop_no_command_half_way() {
    for (command, _, _) in COMMANDS {
        for streams in [">&-", "2>&-", ">&- 2>&-", ">/dev/full", "2>/dev/full", "| head -c 1"] {
            let place = place();
            let before = content(place.0.path());
            let ran = shell(&place, &command.replace("OUT", "out"), streams);
            let told = format!("{command} {streams}: {ran:?}");
            assert!(ran.status < 3 && !ran.err.contains("panicked"), "{told}");
            keeps(&place, &before, &told);
            // All or none: what fails for its stream has written nothing.
            let made =
                content(place.0.path()).keys().filter(|name| name.starts_with("out.")).count();
            assert_eq!(
                made,
                if ran.status == 0 { command.matches("OUT").count() } else { 0 },
                "{told}"
            );
        }
    }
}

#[test]
fn what_is_only_told_says_that_it_could_not_be() {
    let place = place();
    for command in
        ["--help", "--version", "post --help", "explain E0904", "man", "diff n.nc part.ncl"]
    {
        let ran = shell(&place, command, ">/dev/full");
        assert_ne!(ran.status, 0, "{command}: {ran:?}");
        let ran = shell(&place, command, "| head -c 1");
        assert!(ran.status < 3 && !ran.err.contains("panicked"), "{command}: {ran:?}");
    }
}
