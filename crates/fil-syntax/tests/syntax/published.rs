//! Scripts of other people: a default FIL file of the option file generator and
//! the printed scripts of three papers. They are not part of this repository.

use std::path::PathBuf;

use fil_syntax::tree::{Item, Program, StmtKind};
use fil_syntax::{decode, parse};

/// The text of a file of the data folder; `None`, and said so, where it is absent.
fn text(name: &str) -> Option<String> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let data = std::env::var("FILPOST_DATA").map_or(root.join("../shared/data"), PathBuf::from);
    match std::fs::read(data.join(name)) {
        Ok(bytes) => Some(decode(&bytes, None).expect("a guess").0.into_owned()),
        Err(error) => {
            println!("skipped, {name}: {error}");
            None
        }
    }
}

/// Reads a text that may have warnings only, and gives their codes.
fn read(name: &str, text: &str) -> (Program, Vec<String>) {
    let parsed = parse(name, text);
    let errors: Vec<_> = parsed.diags.iter().filter(|diag| diag.is_error()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    (parsed.program, parsed.diags.iter().map(|diag| diag.code.name()).collect())
}

#[test]
fn the_default_fil_file_has_no_warnings() {
    let Some(text) = text("option-file/uncx01.f02") else { return };
    let (program, warnings) = read("uncx01.f02", &text);
    assert!(warnings.is_empty(), "{warnings:?}");
    let assigned = program
        .items
        .iter()
        .filter(|item| matches!(item, Item::Stmt(s) if matches!(s.kind, StmtKind::Assign { .. })));
    assert_eq!(assigned.count(), 27);
}

#[test]
fn the_cycle_script_is_read_in_spite_of_its_misprint() {
    let Some(text) = text("../papers/embos-cycle.fil") else { return };
    let (_, warnings) = read("embos-cycle.fil", &text);
    assert_eq!(warnings, ["W0151", "W0151", "W0152"]);
}

#[test]
fn the_motion_body_is_read_inside_a_section() {
    let Some(text) = text("../papers/embos-motion-body.fil") else { return };
    let source = format!("CIMFIL/ON,GOTO\n{text}\nCIMFIL/OFF\nFINI\n");
    let (_, warnings) = read("embos-motion-body.fil", &source);
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn the_first_thread_script_is_read_with_its_broken_lines_joined() {
    let Some(text) = text("../papers/thread-g76.fil") else { return };
    let lines: Vec<_> = text.lines().collect();
    let joined = lines.join("\n").replace("на първият\nрезб", "на първият резб");
    let joined = joined.replace("A,TN\nA,F,", "A,TNA,F,");
    assert_eq!(joined.lines().count() + 2, lines.len());
    let (_, warnings) = read("thread-g76.fil", &joined);
    assert_eq!(warnings, ["W0152"]);
}

#[test]
fn the_second_thread_script_is_read_with_its_block_closed() {
    let Some(text) = text("../papers/thread-g92.fil") else { return };
    let (program, warnings) = read("thread-g92.fil", &text);
    assert_eq!(warnings, ["W0150", "W0152"]);
    let Some(Item::Section(section)) = program.items.first() else { panic!("no section") };
    assert_eq!(section.body.len(), 2);
}
