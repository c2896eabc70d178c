//! The first screen of a crate on docs.rs says what it is for, how it is built, how to begin, and where
//! its limits are.

use std::fs;
use std::path::{Path, PathBuf};

/// What each first screen has, as a heading or as the first word of a paragraph.
const PARTS: &[&str] = &["Goal", "Model", "Quick start", "Limits"];

/// The library of a folder with a manifest, where it is published.
fn library(folder: &Path) -> Option<PathBuf> {
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).ok()?;
    let is_published = !manifest.contains("publish = false");
    let paths = ["src/lib.rs", "posts.rs"].map(|file| folder.join(file));
    paths.into_iter().find(|path| is_published && path.is_file())
}

/// Name of the folder and first screen of each published library.
fn pages() -> Vec<(String, String)> {
    let root = filpost_tests::root();
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let folders = crates.chain([root.join("fil-scripts")]);
    let page = |folder: PathBuf| {
        let text = fs::read_to_string(library(&folder)?).unwrap();
        let page = text.lines().map_while(|line| line.strip_prefix("//!"));
        let name = folder.file_name()?.to_str()?.to_string();
        Some((name, page.collect::<Vec<_>>().join("\n")))
    };
    let pages: Vec<_> = folders.filter_map(page).collect();
    assert!(pages.len() > 15, "{pages:?}");
    pages
}

#[test]
fn each_published_library_begins_with_goal_model_quick_start_and_limits() {
    for (name, page) in pages() {
        for part in PARTS {
            let is_there = |line: &str| {
                line.trim_start().starts_with(&format!("**{part}.**"))
                    || line.trim() == format!("# {part}")
            };
            assert!(page.lines().any(is_there), "{name}: no {part}");
        }
        assert!(page.contains("```"), "{name}: no example");
    }
}

/// What a host may hold on to: all other published libraries say that they are no API.
const API: &[&str] = &["filpost", "fil-scripts", "fil-vm", "fil-nc"];

#[test]
fn each_other_library_says_that_it_is_no_api() {
    for (name, page) in pages() {
        let is_marked = page.contains("without an API of its own");
        assert_eq!(is_marked, !API.contains(&name.as_str()), "{name}");
    }
}

/// Who takes the interpreter or the checker alone names no other crate of the workspace: their example
/// is such a program, and `cargo test` compiles and runs it.
#[test]
fn the_interpreter_and_the_checker_stand_alone() {
    let root = filpost_tests::root();
    for (name, example) in
        [("fil_vm", "fil-vm/examples/interpret.rs"), ("fil_nc", "fil-nc/examples/check.rs")]
    {
        let text = fs::read_to_string(root.join("crates").join(example)).unwrap();
        let syntax = syn::parse_file(&text).unwrap();
        let mut crates: Vec<String> = Vec::new();
        for item in &syntax.items {
            let syn::Item::Use(item) = item else { continue };
            let used = crate::code::paths::of_use(&item.tree, false);
            crates.extend(used.iter().map(|used| used.path[0].clone()));
        }
        crates.retain(|used| used != "std");
        crates.dedup();
        assert_eq!(crates, [name], "{example}");
        for other in
            ["fil_cl::", "fil_diag::", "fil_syntax::", "fil_machine::", "fil_text::", "filpost::"]
        {
            assert!(!text.contains(other), "{example} names {other}");
        }
        let manifest =
            fs::read_to_string(root.join("crates").join(name.replace('_', "-")).join("Cargo.toml"));
        assert!(manifest.unwrap().contains("[[example]]"), "{example} is no test");
    }
}
