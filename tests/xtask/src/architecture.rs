//! The arrows between the folders and files right below the root of our two big crates must be
//! those of a table in `tests/xtask/architecture/`: a line `control: block tape` says what
//! `control` may use, and a line `- control -> path: REASON` an arrow that is there and shall go.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use crate::code::imports::Imports;
use crate::code::modules::Crate;

/// Which folder or file uses which.
type Arrow = (String, String);

/// Reads a table; comments begin with `#`.
///
/// # Errors
/// A line that is none of a table.
fn table(text: &str) -> Result<BTreeSet<Arrow>, String> {
    let mut arrows = BTreeSet::new();
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        let wrong = || format!("no line of the table: {line}");
        let (from, rest) = line.split_once(':').ok_or_else(wrong)?;
        let new: Vec<Arrow> = match from.strip_prefix("- ") {
            Some(arrow) => {
                let (from, to) = arrow.split_once(" -> ").ok_or_else(wrong)?;
                if rest.trim().is_empty() {
                    return Err(format!("an arrow that shall go needs a reason: {line}"));
                }
                vec![(from.into(), to.into())]
            }
            None => rest.split_whitespace().map(|to| (from.into(), to.into())).collect(),
        };
        for arrow in new {
            let said = format!("twice in the table: {} -> {}", arrow.0, arrow.1);
            if !arrows.insert(arrow) {
                return Err(said);
            }
        }
    }
    Ok(arrows)
}

/// What differs from the table, one line each.
fn differences(
    allowed: &BTreeSet<Arrow>,
    found: &BTreeMap<(&str, &str), Vec<(&str, &str)>>,
) -> Vec<String> {
    let mut told = Vec::new();
    for ((from, to), files) in found {
        if !allowed.contains(&(from.to_string(), to.to_string())) {
            let (by, used) = files[0];
            let more = match files.len() - 1 {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            told.push(format!("{from} -> {to} is new: {by} uses {used}{more}"));
        }
    }
    for (from, to) in allowed {
        if !found.contains_key(&(from.as_str(), to.as_str())) {
            told.push(format!("{from} -> {to} is gone"));
        }
    }
    told
}

fn check(name: &str) {
    let root = filpost_tests::root();
    let source = Crate::read(&root.join("crates").join(name).join("src")).unwrap();
    let imports = Imports::of(&source);
    let file = format!("tests/xtask/architecture/{name}.txt");
    let text = fs::read_to_string(root.join(&file)).unwrap();
    let allowed = table(&text).unwrap_or_else(|said| panic!("{file}: {said}"));
    let told = differences(&allowed, &imports.between_tops());
    assert!(
        told.is_empty(),
        "{name} uses other things than {file} says:\n{}\nFor an arrow that is new: move what is \
         used to where both may use it, or hand it over as an argument; one that has to be is \
         added to the table. One that is gone is taken out of it.",
        told.join("\n")
    );
}

#[test]
fn the_post_uses_what_its_table_allows() {
    check("fil-post");
}

#[test]
fn the_judge_uses_what_its_table_allows() {
    check("fil-nc");
}

#[test]
fn a_table_has_allowed_arrows_and_those_that_shall_go() {
    let text = "# A comment.\n\ncontrol: block tape\n- control -> path: asks for cycles\n";
    let found: Vec<String> =
        table(text).unwrap().into_iter().map(|(from, to)| format!("{from} {to}")).collect();
    assert_eq!(found, ["control block", "control path", "control tape"]);
    for wrong in ["control", "- control: path", "- control -> path:", "a: b b"] {
        assert!(table(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn new_arrows_and_those_that_are_gone_are_told() {
    let allowed = table("control: block tape\n").unwrap();
    let found = BTreeMap::from([
        (("control", "block"), vec![("control/a.rs", "block.rs")]),
        (("control", "path"), vec![("control/a.rs", "path/b.rs"), ("control/c.rs", "path/b.rs")]),
    ]);
    let told = differences(&allowed, &found);
    assert!(told[0].starts_with("control -> path is new: control/a.rs uses path/b.rs and 1 more"));
    assert_eq!(told[1..], ["control -> tape is gone"]);
}
