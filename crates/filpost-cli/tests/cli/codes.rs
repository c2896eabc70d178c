//! The command's own codes, 0801 to 0899: each has its page, its row in the index and
//! a test here that sees it. The other codes are judged beside `corpus/errors`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::support::Folder;

/// Where each code is seen: a file of these tests and the test in it.
const TESTED: &[(&str, &str, &str)] = &[
    ("E0801", include_str!("post.rs"), "denied_warnings_keep_the_files_of_scripts_back"),
    ("E0802", include_str!("output.rs"), "an_output_never_replaces_an_input"),
    ("E0803", include_str!("test.rs"), "a_test_run_without_cases_fails"),
    ("E0804", include_str!("making_cases.rs"), "a_case_is_made_from_files_that_are_there"),
    ("E0805", include_str!("making_cases.rs"), "a_case_is_not_made_of_two_files_of_one_name"),
    ("E0806", include_str!("trace.rs"), "places_that_are_not_there_are_refused"),
    ("E0807", include_str!("batch.rs"), "what_makes_no_sense_for_several_files_is_wrong_usage"),
    ("E0808", include_str!("new.rs"), "nothing_is_written_over"),
    (
        "E0809",
        include_str!("new.rs"),
        "a_path_without_a_name_and_a_base_that_is_not_there_are_refused",
    ),
    ("E0810", include_str!("making_cases.rs"), "a_folder_that_cant_be_part_of_a_case_is_refused"),
    ("E0811", include_str!("machine.rs"), "a_machine_is_shown_by_its_name_alone"),
    ("E0812", include_str!("studio.rs"), "without_its_program_it_says_how_to_get_it"),
    ("E0813", include_str!("../audit.rs"), "a_change_is_refused_where_it_is_denied"),
];

/// What `filpost explain` says of each code there is, by its name.
fn codes() -> BTreeMap<String, String> {
    let place = Folder::new();
    let explained = (801..900).filter_map(|number| {
        let ran = place.run(&["explain", &format!("0{number}")]);
        let name = ran.out.split_whitespace().next()?.to_string();
        (ran.status == 0).then_some((name, ran.out))
    });
    explained.collect()
}

fn docs() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/errors")
}

fn read(name: &str) -> String {
    std::fs::read_to_string(docs().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn every_code_of_the_command_is_seen_by_a_test() {
    let known: Vec<String> = codes().into_keys().collect();
    let tested: Vec<&str> = TESTED.iter().map(|(code, ..)| *code).collect();
    assert_eq!(known, tested);
    for (code, file, test) in TESTED {
        let (_, from) = file
            .split_once(&format!("#[test]\nfn {test}() {{\n"))
            .unwrap_or_else(|| panic!("{code}: there is no test {test}"));
        let body = from.split("\n}\n").next().expect("its end");
        assert!(body.contains(&format!("contains(\"{code}\")")), "{test} does not see {code}");
    }
}

#[test]
fn every_code_of_the_command_has_its_page_and_every_page_its_code() {
    let codes = codes();
    let index = read("README.md");
    for (name, explained) in &codes {
        let title = explained.lines().next().expect("a line").trim_start_matches(name).trim();
        let page = read(&format!("{name}.md"));
        assert_eq!(page.lines().next(), Some(format!("# {name}: {title}").as_str()));
        let row = format!("| [{name}]({name}.md) | {title} |");
        assert!(index.contains(&row), "the index lacks {row}");
        for heading in ["## Wrong", "## Right"] {
            assert!(page.lines().any(|line| line == heading), "{name}: no {heading}");
        }
        let flat = page.split_whitespace().collect::<Vec<_>>().join(" ");
        let [_, reason, _, hint] = explained.lines().skip(1).collect::<Vec<_>>()[1..5] else {
            panic!("{name}: {explained}")
        };
        let hint = hint.trim_start_matches("What to do: ");
        for text in [reason, hint] {
            assert!(flat.contains(text), "{name} does not say: {text}");
        }
    }
    let pages = std::fs::read_dir(docs()).expect("docs/errors").map(|entry| {
        entry.expect("an entry").path().file_stem().expect("a name").to_string_lossy().into_owned()
    });
    let mut pages: Vec<String> = pages.filter(|name| name[1..].starts_with("08")).collect();
    pages.sort();
    assert_eq!(pages, codes.into_keys().collect::<Vec<_>>());
}
