//! The documentation holds what it says: its commands run as printed, its
//! links lead somewhere, and its tables have a row for each thing of the code.

#[path = "docs/named.rs"]
mod named;
#[path = "docs/terms.rs"]
mod terms;

use std::process::{Command, Output};

use filpost::builtins::BUILTINS;
use filpost::locations::{Evidence, TABLE};
use filpost::postf::{Grade, POSTF};
use filpost::{cl::Vocabulary, dispatch, operation_name, ready};
use filpost_tests::examples::{Block, blocks, run};
use filpost_tests::root;

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// README.md and the pages of docs/, docs/papers/ and docs/editors/.
fn pages() -> Vec<(String, String)> {
    let mut pages = vec![("README.md".to_string(), read("README.md"))];
    for folder in ["docs", "docs/papers", "docs/editors"] {
        for entry in std::fs::read_dir(root().join(folder)).into_iter().flatten() {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|ending| ending == "md") {
                let file = path.file_name().expect("a name").to_string_lossy();
                let name = format!("{folder}/{file}");
                pages.push((name.clone(), read(&name)));
            }
        }
    }
    pages.sort();
    pages
}

/// Runs a command as it is printed, in the folder of the workspace.
fn shell(line: &str) -> Output {
    let arguments = line
        .strip_prefix("filpost ")
        .unwrap_or_else(|| panic!("`{line}` is no command of filpost; mark its block as text"));
    Command::new(env!("CARGO_BIN_EXE_filpost"))
        .args(arguments.split_whitespace())
        .current_dir(root())
        .output()
        .expect("the command runs")
}

#[test]
fn commands_run_as_printed() {
    let mut count = 0;
    for (name, page) in pages() {
        for block in blocks(&page).into_iter().filter(|block| block.words == ["sh"]) {
            for line in block.text.lines() {
                let output = shell(line);
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success(), "{name}: {line}\n{said}");
                assert!(!output.stdout.is_empty() || !said.is_empty(), "{name}: {line} is mute");
                count += 1;
            }
        }
    }
    assert!(count >= 15, "only {count} commands");
}

/// A block `sh fails` ends with status 1.
#[test]
fn commands_that_fail_do_so() {
    for (name, page) in pages() {
        for block in blocks(&page).into_iter().filter(|block| block.words == ["sh", "fails"]) {
            assert_eq!(shell(block.text.trim()).status.code(), Some(1), "{name}: {}", block.text);
        }
    }
}

/// A block `nc` or `text printed` right after a command is what it prints.
#[test]
fn what_is_shown_is_what_is_printed() {
    let mut count = 0;
    for (name, page) in pages() {
        for pair in blocks(&page).windows(2) {
            let shown = pair[1].words == ["nc"] || pair[1].words == ["text", "printed"];
            if pair[0].words.first() == Some(&"sh") && shown {
                let output = shell(pair[0].text.trim());
                assert_eq!(String::from_utf8_lossy(&output.stdout), pair[1].text, "{name}");
                count += 1;
            }
        }
    }
    assert!(count >= 10, "only {count} commands are shown with what they print");
}

#[test]
fn the_first_group_of_grooves_is_the_listing_of_the_paper() {
    let page = read("docs/papers/embos.md");
    let listing = read("corpus/papers/embos-grooves/figure-7.nc");
    let all = blocks(&page);
    let command = all.iter().find(|block| block.words == ["sh"]).expect("a command");
    assert_eq!(String::from_utf8_lossy(&shell(command.text.trim()).stdout), listing);
}

#[test]
fn examples_of_fil_and_settings_are_accepted() {
    let mut count = 0;
    for (name, page) in pages() {
        for block in blocks(&page).into_iter().filter(|block| block.words != ["nc"]) {
            let compat = block.words == ["toml"] && block.heading.contains("ompat");
            let words = if compat { vec!["toml", "compat"] } else { block.words.clone() };
            let Some(diags) = run(&Block { words, ..block.clone() }) else { continue };
            let errors: Vec<_> = diags.iter().filter(|diag| diag.is_error()).collect();
            assert!(errors.is_empty(), "{name}:{}: {errors:?}", block.line);
            count += 1;
        }
    }
    assert!(count >= 6, "only {count} examples");
}

#[test]
fn links_lead_somewhere() {
    let mut all = pages();
    for folder in ["docs/errors", "docs/howto"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("the folder is there") {
            let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
            all.push((format!("{folder}/{name}"), read(&format!("{folder}/{name}"))));
        }
    }
    for (name, page) in all {
        let folder = root().join(&name).parent().expect("a folder").to_path_buf();
        for part in page.split("](").skip(1) {
            let link = &part[..part.find(')').expect("a link ends")];
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            if file.starts_with("http") {
                continue;
            }
            let target = if file.is_empty() { root().join(&name) } else { folder.join(file) };
            assert!(target.is_file(), "{name}: {link}");
            if anchor.is_empty() {
                continue;
            }
            let text = std::fs::read_to_string(&target).expect("the page");
            let has = |line: &str| {
                line.starts_with('#')
                    && line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-")
                        == anchor
            };
            assert!(text.lines().any(has), "{name}: {link}");
        }
    }
}

#[test]
fn the_summary_lists_every_page() {
    let summary = read("docs/SUMMARY.md");
    for (name, _) in pages() {
        let Some(page) = name.strip_prefix("docs/").filter(|page| *page != "SUMMARY.md") else {
            continue;
        };
        assert!(summary.contains(&format!("({page})")), "SUMMARY.md lacks {page}");
    }
    for code in filpost::all_codes() {
        let name = code.name();
        assert!(
            summary.contains(&format!("[{name}](errors/{name}.md)")),
            "SUMMARY.md lacks {name}"
        );
    }
}

fn grade(grade: Grade) -> &'static str {
    match grade {
        Grade::Published => "published",
        Grade::Inferred => "inferred",
        Grade::Own => "our own",
    }
}

#[test]
fn compat_has_a_row_for_each_function_with_its_grade() {
    let page = read("docs/compat.md");
    for row in BUILTINS {
        let start = format!("| `{}` | {} | {} |", row.call(), row.doc, grade(row.grade));
        assert!(page.lines().any(|line| line.starts_with(&start)), "no row {start}");
    }
}

#[test]
fn compat_has_a_row_for_each_postf_number_with_its_grade() {
    let page = read("docs/compat.md");
    let language = read("docs/language.md");
    for row in POSTF {
        let arguments: String = row.arguments.iter().map(|name| format!(",{name}")).collect();
        let call = format!("| `POSTF({}{arguments})` | {} |", row.number, row.doc);
        let start = format!("{call} `{}` | {} |", operation_name(row.op), grade(row.grade));
        assert!(page.lines().any(|line| line.starts_with(&start)), "no row {start}");
        assert!(language.lines().any(|line| line == call), "language.md lacks {call}");
    }
}

#[test]
fn the_language_page_lists_each_function() {
    let page = read("docs/language.md");
    for row in BUILTINS {
        let start = format!("| `{}` | {}", row.call(), row.doc);
        assert!(page.lines().any(|line| line.starts_with(&start)), "no row {start}");
    }
}

#[test]
fn compat_has_a_row_for_each_post_word_and_no_other() {
    let page = read("docs/compat.md");
    let section = page.split("## Post words").nth(1).expect("the section");
    let section = section.split("\n## ").next().expect("its end");
    let vocabulary = Vocabulary::new();
    let mut wanted: Vec<&str> =
        dispatch::HANDLERS.iter().map(|(word, _)| vocabulary.name(*word)).collect();
    wanted.sort_unstable();
    let found: Vec<&str> = section
        .lines()
        .filter_map(|line| line.strip_prefix("| ")?.split(" |").next())
        .filter(|word| word.chars().all(|letter| letter.is_ascii_uppercase()))
        .collect();
    assert_eq!(found, wanted);
}

#[test]
fn compat_counts_the_common_locations() {
    let page = read("docs/compat.md");
    let mut groups: Vec<&str> = TABLE.iter().filter_map(|row| row.name.split('.').next()).collect();
    groups.sort_unstable();
    groups.dedup();
    for group in groups {
        let of_group = || TABLE.iter().filter(move |row| row.name.split('.').next() == Some(group));
        let count = |evidence| of_group().filter(|row| row.evidence == evidence).count();
        let used = of_group().filter(|row| row.used).count();
        let row = format!(
            "| `{group}` | {} | {} | {} | {used} of {} |",
            count(Evidence::Report),
            count(Evidence::Inferred),
            count(Evidence::Own),
            of_group().count()
        );
        assert!(page.lines().any(|line| line == row), "no row {row}");
    }
}

#[test]
fn every_row_of_compat_has_a_grade() {
    let page = read("docs/compat.md");
    let graded = page.split("## Common locations").next().expect("the tables before it");
    let graded = graded.split("## Statements of FIL").nth(1).expect("the tables");
    for line in graded.lines().filter(|line| line.starts_with("| ") && !line.contains("| grade |"))
    {
        let has = ["| published |", "| inferred |", "| our own |"];
        assert!(has.iter().any(|grade| line.contains(grade)), "no grade: {line}");
    }
}

#[test]
fn the_pages_name_every_ready_post() {
    let page = read("docs/machine.md");
    for post in ready::READY {
        assert!(page.contains(&format!("| `{}` |", post.name)), "{}", post.name);
    }
}

#[test]
fn files_named_by_the_architecture_are_there() {
    let page = read("docs/architecture.md");
    for part in page.split('`').skip(1).step_by(2) {
        if part.contains('/') && !part.contains([' ', '*']) {
            assert!(root().join(part).exists(), "{part}");
        }
    }
}

/// The page of the dialects has a row for each of them that says how it is recognized.
#[test]
fn the_page_of_dialects_has_them_all() {
    use filpost::cl::dialect::{ClDialect, Sign};
    use filpost::cl::vocabulary::Vocabulary;

    let page = read("docs/dialects.md");
    let vocabulary = Vocabulary::new();
    for dialect in ClDialect::ALL {
        let row = page
            .lines()
            .find(|line| line.starts_with(&format!("| `{dialect}` |")))
            .unwrap_or_else(|| panic!("no row of {dialect}"));
        let rules = dialect.rules();
        for sign in rules.signs {
            let spelled = match sign {
                Sign::Word(word) => vocabulary.name(*word),
                Sign::Name(text) | Sign::Prefix(text) => text,
                Sign::Text(_, text) | Sign::TextBegin(_, text) => text,
                Sign::Pseudo => "`$$->`",
                // Without blanks in the table, so only its first letters are looked for.
                Sign::Comment(text) => &text.trim_start_matches('*')[..3],
            };
            assert!(row.to_lowercase().contains(&spelled.to_lowercase()), "{dialect}: {spelled}");
        }
        let circle = rules.circle.map_or("none".to_string(), |form| form.spell_counts());
        assert!(row.contains(&format!("| {circle}")), "{dialect}: {circle}");
        let ends = if rules.writes_fini { "| yes |" } else { "| no |" };
        assert!(row.ends_with(ends), "{dialect}");
    }
}
