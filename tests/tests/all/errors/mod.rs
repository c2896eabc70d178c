//! The error catalogue: every code has its page in `docs/errors/`, and a case
//! in `corpus/errors/`, a file of the lint suite, of `tests/motions/` or of `tests/stock/`, or a test
//! here. The examples of the pages are run: what stands under "Wrong"
//! raises the code with the words printed there, what stands under "Right" does
//! not. `FILPOST_UPDATE=1` writes the words anew.

mod file_work;
mod language;
mod reading;

use std::collections::BTreeMap;
use std::path::PathBuf;

use filpost::case::Case;
use filpost::{Code, Diag, Error, Program, Severity, all_codes};
use filpost_tests::examples;
use filpost_tests::{lints, motions, root, stock};

/// Codes that no small case folder can raise, with the test that does.
const TESTED_HERE: &[(&str, &str)] = &[
    ("E0107", "e0107_line_too_long"),
    ("E0108", "e0108_file_too_large"),
    ("E0109", "e0109_too_many_errors"),
    ("E0120", "e0120_and_e0121_encodings"),
    ("E0121", "e0120_and_e0121_encodings"),
    ("E0215", "e0215_program_too_large"),
    ("W0220", "w0220_and_w0221_findings_of_check"),
    ("W0221", "w0220_and_w0221_findings_of_check"),
    ("E0229", "e0229_name_of_an_added_function"),
    ("E0305", "e0305_call_depth"),
    ("E0317", "e0317_host_function"),
    ("E0401", "e0401_reading_fails"),
    ("E0403", "e0403_statement_too_long"),
    ("E0409", "e0409_stream_goes_back"),
    ("E0410", "e0410_no_such_record"),
    ("E0411", "e0411_too_many_words"),
    ("E0412", "e0412_and_e0413_writing_cl"),
    ("E0413", "e0412_and_e0413_writing_cl"),
    ("E0414", "e0414_last_line_without_an_end"),
    ("E0701", "e0701_missing_file"),
    ("E0702", "e0702_absent_folder"),
    ("E0705", "e0705_case_file"),
    ("E0707", "e0707_to_e0710_line_maps"),
    ("E0708", "e0707_to_e0710_line_maps"),
    ("E0709", "e0707_to_e0710_line_maps"),
    ("E0710", "e0707_to_e0710_line_maps"),
    ("E0711", "e0711_cancelled"),
    ("E0712", "e0712_record_from_memory"),
    ("E0713", "e0713_codes_that_stand"),
    ("E0714", "e0714_machin_names_no_post"),
    ("E0724", "e0724_tool_change_is_no_program"),
    ("E0715", "e0715_units_contradict"),
    ("E0716", "e0716_changed_as_written"),
    ("W0757", "w0757_choice_against_the_signs"),
    ("E0717", "e0717_program_too_long"),
    ("E0915", "e0915_program_changes_while_compared"),
    ("E0916", "e0916_line_without_an_end"),
    ("E0940", "e0940_unit_not_known"),
    ("E0941", "e0941_another_part"),
];

fn pages() -> BTreeMap<String, (PathBuf, String)> {
    let folder = root().join("docs/errors");
    let entries = std::fs::read_dir(&folder).expect("docs/errors is there");
    entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.file_name().is_some_and(|name| name != "README.md"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).expect("a page");
            (name, (path, text))
        })
        .collect()
}

#[test]
fn every_code_has_its_page_and_every_page_its_code() {
    let pages = pages();
    for code in all_codes() {
        let (_, page) =
            pages.get(&code.name()).unwrap_or_else(|| panic!("no page {}", code.name()));
        let first = page.lines().next().unwrap_or_default();
        assert_eq!(first, format!("# {}: {}", code.name(), code.title));
        let flat = page.split_whitespace().collect::<Vec<_>>().join(" ");
        for text in [code.reason, code.hint] {
            assert!(flat.contains(text), "{} does not say: {text}", code.name());
        }
        for heading in ["## Wrong", "## Right"] {
            assert!(page.lines().any(|line| line == heading), "{}: no {heading}", code.name());
        }
    }
    let known: Vec<String> = all_codes().iter().map(|code| code.name()).collect();
    for name in pages.keys().filter(|name| !name[1..].starts_with("08")) {
        assert!(known.contains(name), "page {name} has no code");
    }
}

#[test]
fn titles_are_short() {
    for code in all_codes() {
        let words: Vec<&str> = code.title.split_whitespace().collect();
        assert!(words.len() <= 10, "{}: {}", code.name(), code.title);
        let is_clause = words.iter().any(|word| ["that", "which", "who", "what"].contains(word));
        assert!(!is_clause, "{}: {}", code.name(), code.title);
        assert!(!code.hint.is_empty(), "{} has no hint", code.name());
    }
}

#[test]
fn a_page_says_the_levels_of_its_code() {
    for code in all_codes() {
        let (_, page) = &pages()[&code.name()];
        let said = page.lines().find(|line| line.starts_with("Level: "));
        assert_eq!(said, filpost::level_line(code).as_deref(), "{}", code.name());
    }
}

#[test]
fn the_index_lists_every_page() {
    let index = std::fs::read_to_string(root().join("docs/errors/README.md")).expect("the index");
    for code in all_codes() {
        let row = format!("| [{0}]({0}.md) | {1} |", code.name(), code.title);
        assert!(index.contains(&row), "the index lacks {row}");
    }
}

#[test]
fn every_code_has_a_case_or_a_test() {
    let cases = filpost::case::find(&root().join("corpus/errors")).expect("cases");
    let expected = |case: &Case| -> Vec<String> {
        let warnings = case.file.expect_warnings.iter();
        case.file.expect_error.iter().chain(warnings).cloned().collect()
    };
    for case in &cases {
        let folder = case.folder.file_name().expect("a name").to_string_lossy().into_owned();
        let codes = expected(case);
        assert!(codes.contains(&folder[..5].to_string()), "{folder} expects {codes:?}");
        assert!(
            case.file.expect_at.is_some() || PLACELESS.contains(&&folder[..5]),
            "{folder}: where?"
        );
    }
    let bad = lints::fil_files(&root().join("tests/lints/bad"));
    let read = |path: &PathBuf| std::fs::read_to_string(path).expect("a file of the lint suite");
    let lints: Vec<String> = bad.iter().flat_map(|path| lints::listed(&read(path))).collect();
    let programs: Vec<String> =
        motions::files().iter().filter_map(|path| motions::listed(path)).collect();
    let simulated = simulated();
    let source = concat!(
        include_str!("language.rs"),
        include_str!("reading.rs"),
        include_str!("file_work.rs")
    );
    for code in all_codes() {
        let name = code.name();
        let in_corpus = cases.iter().any(|case| expected(case).contains(&name));
        let here = TESTED_HERE.iter().find(|(code, _)| *code == name);
        let in_lints = lints.iter().any(|listed| listed.starts_with(&name));
        let in_nc = programs.iter().any(|listed| listed.starts_with(&name));
        let in_file = in_lints || in_nc || simulated.contains(&name);
        let once = in_corpus != here.is_some() || (in_file && here.is_none());
        assert!(once, "{name}: a case or a test, and not both");
        if let Some((_, test)) = here {
            assert!(source.contains(&format!("fn {test}()")), "there is no test {test}");
        }
    }
}

/// The codes that programs of `tests/stock/` expect.
fn simulated() -> Vec<String> {
    stock::files().iter().flat_map(|path| stock::listed(path)).collect()
}

/// Codes that name no line of a file.
const PLACELESS: &[&str] = &["E0607", "E0609", "E0703", "W0752", "W0753"];

#[test]
fn examples_do_what_the_pages_say() {
    let update = std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1");
    let mut failures = Vec::new();
    for code in all_codes() {
        let name = code.name();
        let (path, page) = &pages()[&name];
        let mut fresh = page.clone();
        let blocks = examples::blocks(page);
        for (index, block) in blocks.iter().enumerate() {
            let Some(diags) = examples::run(block) else { continue };
            match block.heading {
                "Wrong" => match diags.iter().find(|diag| diag.code == code) {
                    Some(diag) => {
                        let said = blocks.get(index + 1).map_or("", |next| &next.text);
                        if said != format!("{diag}\n") && update {
                            fresh = fresh.replacen(
                                &format!("```text\n{said}```"),
                                &format!("```text\n{diag}\n```"),
                                1,
                            );
                        } else if said != format!("{diag}\n") {
                            failures.push(format!("{name}: it says\n{diag}\nnot\n{said}"));
                        }
                    }
                    None => {
                        failures.push(format!("{name} line {}: not raised {diags:?}", block.line))
                    }
                },
                "Right" => {
                    let bad = |diag: &&Diag| diag.code == code || diag.is_error();
                    if let Some(diag) = diags.iter().find(bad) {
                        failures.push(format!("{name} line {}: {diag}", block.line));
                    }
                }
                heading => failures.push(format!("{name}: an example under {heading}")),
            }
        }
        if update && fresh != *page {
            std::fs::write(path, fresh).expect("the page is written");
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn most_pages_have_examples_that_run() {
    let runs =
        |page: &str| examples::blocks(page).iter().any(|block| examples::run(block).is_some());
    let without: Vec<String> = pages()
        .into_iter()
        .filter(|(name, (_, page))| !name[1..].starts_with("08") && !runs(page))
        .map(|(name, _)| name)
        .filter(|name| !TESTED_HERE.iter().any(|(code, _)| code == name))
        // Their pages tell of programs of `tests/stock/`, which run as tests.
        .filter(|name| !simulated().contains(name))
        .collect();
    assert!(without.is_empty(), "{without:?}");
}

/// The codes of building a post with this FIL file.
fn building(fil: &str) -> Vec<String> {
    names(&Program::builder().fil("t.fil", fil).build().expect_err("refused"))
}

fn names(error: &Error) -> Vec<String> {
    error.diags().iter().map(|diag| diag.code.name()).collect()
}

/// The code of posting this CL text.
fn posting(cl: &str) -> String {
    let post = Program::builder().build().expect("the generic mill");
    let error = post.stream(cl.as_bytes(), &mut Vec::new()).expect_err("refused");
    names(&error).remove(0)
}

#[test]
fn severities_and_letters_agree() {
    let letter = |code: &Code| if code.severity() == Severity::Error { 'E' } else { 'W' };
    assert!(all_codes().iter().all(|code| code.name().starts_with(letter(code))));
}
