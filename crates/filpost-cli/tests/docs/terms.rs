//! The pages use the terms of the trade: those of `docs/glossary.md`, and of the manuals.

use filpost_tests::root;

/// What pages once wrote, and the term that a machinist looks for.
const OLD_TERMS: &[(&str, &str)] = &[
    ("tool-tip control", "tool center point control (TCPC)"),
    ("tip control", "tool center point control (TCPC)"),
    ("tilted frame", "tilted work plane"),
    ("second spindle", "sub-spindle"),
    ("length of the tool", "tool length offset"),
    ("r level", "R plane"),
    ("level before the cycle", "initial plane"),
    ("feed a turn", "feed per revolution"),
    ("feed a revolution", "feed per revolution"),
    ("feed a minute", "feed per minute"),
    ("turns a minute", "rpm"),
    ("tool that leans", "tilted tool"),
    ("the tool leans", "tilted tool"),
    ("leaning tool", "tilted tool"),
    ("skip switch", "block delete"),
    ("texts of others", "foreign blocks"),
    ("rapid that bends", "dog-leg rapid"),
    ("on the tape", "in the program"),
    ("of its own accord", "by itself"),
    ("hangs on", "depends on"),
];

/// Where an old term is right: page and the words around it.
const RIGHT: &[(&str, &str)] = &[("docs/glossary.md", "second spindle")];

/// Pages of other sources: tables of the code, the history, what files print.
fn pages() -> Vec<(String, String)> {
    let mut names = vec!["README.md".to_string()];
    for folder in ["docs", "docs/papers", "docs/editors", "docs/errors", "docs/howto"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder of pages");
        let files = entries.flatten().map(|entry| entry.file_name().display().to_string());
        names.extend(
            files.filter(|file| file.ends_with(".md")).map(|file| format!("{folder}/{file}")),
        );
    }
    names.retain(|name| !["docs/history.md", "docs/SUMMARY.md"].contains(&name.as_str()));
    let read = |name: String| {
        let text = std::fs::read_to_string(root().join(&name)).expect("a page");
        (name, text)
    };
    names.into_iter().map(read).collect()
}

/// A line without what stands between backquotes and without the targets of links, in lower case;
/// rows of tables that the code has are left out.
fn prose(line: &str) -> String {
    let is_of_code = |part: &&str| line.contains(*part);
    let is_row = line.starts_with("| [W") || line.starts_with("| `");
    if is_row && ["| [W", "F(", "TEXT/", "INTCOM", "DBLCOM"].iter().any(is_of_code) {
        return String::new();
    }
    let outside: Vec<&str> = line.split('`').step_by(2).collect();
    let mut parts = outside.join(" ").to_lowercase();
    while let Some((before, rest)) = parts.split_once("](") {
        let after = rest.split_once(')').map_or("", |(_, after)| after);
        parts = format!("{before} {after}");
    }
    parts
}

#[test]
fn the_pages_use_the_terms_of_manuals() {
    let mut wrong = Vec::new();
    for (name, page) in pages() {
        let mut is_example = false;
        for (index, line) in page.lines().enumerate() {
            if line.starts_with("```") {
                is_example = !is_example;
            }
            if is_example {
                continue;
            }
            let prose = prose(line);
            for (old, term) in OLD_TERMS {
                let is_right = RIGHT.iter().any(|(page, words)| *page == name && words == old);
                let is_word = |at: usize| {
                    let before = prose[..at].chars().next_back();
                    let after = prose[at + old.len()..].chars().next();
                    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
                    !is_letter(before) && (!is_letter(after) || after == Some('s'))
                };
                if !is_right && prose.match_indices(old).any(|(at, _)| is_word(at)) {
                    wrong.push(format!("{name}:{}: `{old}` for {term}", index + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The texts of the settings, which `explain`, `machine show` and the studio print.
#[test]
fn the_settings_use_the_terms_of_manuals() {
    let path = root().join("crates/fil-machine/data/locations.tsv");
    let table = std::fs::read_to_string(path).expect("the table of the settings");
    let mut wrong = Vec::new();
    for row in table.lines().filter(|row| !row.starts_with('#')) {
        let columns: Vec<&str> = row.split('\t').collect();
        let [_, _, name, _, _, choices, meaning, ..] = columns[..] else { continue };
        let text = format!("{choices} {meaning}").to_lowercase();
        let found = OLD_TERMS.iter().filter(|(old, _)| text.contains(old));
        wrong.extend(found.map(|(old, term)| format!("{name}: `{old}` for {term}")));
        // Where a meaning comes from is in the column of the evidence.
        if text.contains("numbers are ours") || text.contains("reports list") {
            wrong.push(format!("{name}: evidence in its text"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Each term leads somewhere: the page that explains it has it in its text.
#[test]
fn the_glossary_has_what_machinists_look_for() {
    let glossary = std::fs::read_to_string(root().join("docs/glossary.md")).expect("the glossary");
    for term in [
        "tool length offset",
        "TCPC",
        "tilted work plane",
        "block delete",
        "R plane",
        "sub-spindle",
        "constant surface speed",
        "dog-leg",
        "initial plane",
        "work offset",
        "rigid tapping",
        "foreign block",
    ] {
        assert!(glossary.contains(term), "{term}");
    }
}
