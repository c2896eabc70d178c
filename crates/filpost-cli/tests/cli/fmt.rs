//! `filpost fmt` as its users meet it.

use std::path::Path;

use crate::support::{Folder, Ran};

const MESSY: &str = "cimfil/on,goto\nx=postf(13)\ncimfil/off\nfini";
const TIDY: &str = "CIMFIL/ON,GOTO\n  X = POSTF(13)\nCIMFIL/OFF\nFINI\n";

fn folder(files: &[(&str, &[u8])]) -> Folder {
    files.iter().fold(Folder::new(), |place, (name, bytes)| place.with(name, bytes))
}

fn fmt(place: &Folder, arguments: &[&str], input: &[u8]) -> Ran {
    place.run_with_input(&[&["fmt"], arguments].concat(), input)
}

#[test]
fn files_are_rewritten_and_named_when_they_change() {
    let place = folder(&[("a.fil", MESSY.as_bytes()), ("b.fil", TIDY.as_bytes())]);
    let before = std::fs::metadata(place.0.path().join("b.fil")).expect("a file").modified();
    let ran = fmt(&place, &["a.fil", "b.fil"], b"");
    assert_eq!(ran.seen(), (0, "a.fil\n", "2 files: 1 formatted, 0 refused\n"));
    assert_eq!(place.bytes("a.fil"), TIDY.as_bytes());
    let after = std::fs::metadata(place.0.path().join("b.fil")).expect("a file").modified();
    assert_eq!(before.expect("a time"), after.expect("a time"));
    let ran = fmt(&place, &["a.fil", "b.fil"], b"");
    assert_eq!(ran.seen(), (0, "", "2 files: 0 formatted, 0 refused\n"));
}

#[test]
fn check_names_what_would_change_and_changes_nothing() {
    let place = folder(&[("a.fil", MESSY.as_bytes()), ("b.fil", TIDY.as_bytes())]);
    let ran = fmt(&place, &["--check", "a.fil", "b.fil"], b"");
    assert_eq!(ran.seen(), (1, "a.fil\n", "2 files: 1 to be formatted, 0 refused\n"));
    assert_eq!(place.bytes("a.fil"), MESSY.as_bytes());
    assert_eq!(fmt(&place, &["--check", "b.fil"], b"").status, 0);
    assert_eq!(fmt(&place, &["--check", "-"], MESSY.as_bytes()).seen().0, 1);
    assert_eq!(fmt(&place, &["--check", "-"], TIDY.as_bytes()).seen().1, "");
}

#[test]
fn standard_input_goes_to_standard_output() {
    let place = folder(&[]);
    let ran = fmt(&place, &["-"], MESSY.as_bytes());
    assert_eq!(ran.seen(), (0, TIDY, "1 file: 1 formatted, 0 refused\n"));
    let ran = fmt(&place, &["-"], b"A=(\nFINI\n");
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("E0101") && ran.err.contains("standard input"), "{}", ran.err);
}

#[test]
fn a_file_with_errors_is_left_alone_and_the_others_are_formatted() {
    let place = folder(&[("bad.fil", b"a=(\nFINI"), ("a.fil", MESSY.as_bytes())]);
    let ran = fmt(&place, &["bad.fil", "none.fil", "a.fil"], b"");
    assert_eq!((ran.status, ran.out.as_str()), (1, "a.fil\n"));
    assert!(ran.err.contains("E0101") && ran.err.contains("E0701"), "{}", ran.err);
    assert!(ran.err.ends_with("3 files: 1 formatted, 2 refused\n"), "{}", ran.err);
    assert_eq!(place.bytes("bad.fil"), b"a=(\nFINI");
}

#[test]
fn the_encoding_and_the_line_ends_are_kept() {
    // "a=1 $$ шаг по оси" in windows-1251.
    let comment = b"$$ \xF8\xE0\xE3 \xEF\xEE \xEE\xF1\xE8";
    let source = [b"a=1 ", comment.as_slice(), b"\r\nfini"].concat();
    let expected = [b"A = 1  ", comment.as_slice(), b"\r\nFINI\r\n"].concat();
    let place = folder(&[("a.fil", &source), ("b.fil", &source)]);
    assert_eq!(fmt(&place, &["a.fil"], b"").status, 0);
    assert_eq!(place.bytes("a.fil"), expected);
    assert_eq!(fmt(&place, &["--encoding", "cp1251", "b.fil"], b"").status, 0);
    assert_eq!(place.bytes("b.fil"), expected);
    let ran = fmt(&place, &["--encoding", "utf-8", "b.fil"], b"");
    assert!(ran.status == 1 && ran.err.contains("E0121"), "{}", ran.err);
}

#[test]
fn our_own_scripts_have_the_layout() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut scripts = Vec::new();
    for folder in ["posts", "lib"] {
        find_scripts(&root.join("fil-scripts").join(folder), &mut scripts);
    }
    assert!(!scripts.is_empty(), "no scripts in fil-scripts");
    let mut arguments = vec!["--check"];
    arguments.extend(scripts.iter().map(String::as_str));
    let ran = fmt(&folder(&[]), &arguments, b"");
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{}", ran.err);
}

fn find_scripts(folder: &Path, found: &mut Vec<String>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            find_scripts(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "fil") {
            let path = path.canonicalize().expect("a path");
            found.push(path.to_str().expect("UTF-8").to_string());
        }
    }
}
