//! Whatever the pages name exists: commands, options, settings and their values, codes,
//! numbers of POSTF.

use std::collections::BTreeMap;
use std::process::Command;

use filpost::locations::{Location, TABLE};
use filpost::postf::POSTF;
use filpost::{Error, Program, all_codes, user_blocks};
use filpost_tests::root;

/// Options of other programs and of the project's own scripts, with the page that names them.
const OF_OTHERS: &[(&str, &str)] = &[
    ("docs/performance.md", "--gigabyte"),
    ("docs/playground.md", "--pictures"),
    ("docs/testing.md", "--suite"),
    ("docs/testing.md", "--seeds"),
    ("docs/testing.md", "--jobs"),
    ("docs/testing.md", "--build"),
    ("docs/testing.md", "--quick"),
    ("docs/howto/many-files.md", "--array"),
];

/// Keys that are wrong on purpose.
const WRONG_KEYS: &[&str] = &["rapid.spilt"];

/// All pages but the change log, which also names what is no longer there.
fn pages() -> Vec<(String, String)> {
    let mut pages = vec!["README.md".to_string(), "CONTRIBUTING.md".to_string()];
    let folders =
        ["docs", "docs/papers", "docs/editors", "docs/howto", "docs/errors", "docs/reference"];
    let crates = std::fs::read_dir(root().join("crates")).expect("the crates");
    pages.extend(
        crates.flatten().map(|entry| format!("crates/{}/README.md", entry.file_name().display())),
    );
    for folder in folders {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder of pages");
        let names = entries.flatten().map(|entry| entry.file_name().display().to_string());
        pages.extend(
            names.filter(|name| name.ends_with(".md")).map(|name| format!("{folder}/{name}")),
        );
    }
    let read =
        |name: String| Some((name.clone(), std::fs::read_to_string(root().join(&name)).ok()?));
    let mut pages: Vec<_> = pages.into_iter().filter_map(read).collect();
    pages.retain(|(name, _)| name != "docs/history.md");
    pages.sort();
    pages
}

/// The texts between backquotes of a page, and the lines of its examples that begin with a command,
/// each with its line.
fn spans(page: &str) -> Vec<(usize, &str)> {
    let mut spans = Vec::new();
    let mut is_example = false;
    for (index, line) in page.lines().enumerate() {
        if line.starts_with("```") {
            is_example = !is_example;
        } else if is_example {
            spans.extend(line.trim().starts_with("filpost ").then_some((index + 1, line.trim())));
        } else {
            spans.extend(line.split('`').skip(1).step_by(2).map(|span| (index + 1, span)));
        }
    }
    spans
}

fn help(words: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_filpost")).args(words).arg("--help").output();
    String::from_utf8(output.expect("the command runs").stdout).expect("UTF-8")
}

/// Each command with its options, those of its own commands among them.
fn commands() -> BTreeMap<String, Vec<String>> {
    let names = |text: &str| -> Vec<String> {
        let list = text.split("Commands:\n").nth(1).unwrap_or_default();
        let lines = list.lines().take_while(|line| line.starts_with("  "));
        let name = |line: &str| line.trim_start().split(' ').next().unwrap_or_default().to_string();
        lines
            .filter(|line| !line.starts_with("   "))
            .map(name)
            .filter(|name| name != "help")
            .collect()
    };
    let mut found = BTreeMap::new();
    for command in names(&help(&[])) {
        let mut text = help(&[&command]);
        for inner in names(&text) {
            text += &help(&[&command, &inner]);
        }
        found.insert(command, listed(&text));
    }
    found
}

/// The options that the help of a command lists.
fn listed(help: &str) -> Vec<String> {
    let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    let heads = lines.map(|line| line.split("  ").next().unwrap_or_default());
    options(&heads.collect::<Vec<_>>().join(" "))
}

/// The options in a text: `-o`, `--output`.
fn options(text: &str) -> Vec<String> {
    let is_name = |c: char| c.is_ascii_alphabetic() || c == '-';
    let mut found: Vec<String> = text
        .split(|c: char| c.is_whitespace() || ",[]()".contains(c))
        .filter(|word| {
            let name = word.trim_start_matches('-');
            word.starts_with('-')
                && word.len() - name.len() <= 2
                && name.starts_with(|c: char| c.is_ascii_alphabetic())
        })
        .map(|word| word.split(|c| !is_name(c)).next().unwrap_or_default().to_string())
        .filter(|word| word.starts_with("--") || word.len() == 2)
        .collect();
    found.sort();
    found.dedup();
    found
}

#[test]
fn commands_and_options_exist() {
    let commands = commands();
    let known = |option: &String| {
        ["-h", "--help", "-V", "--version"].contains(&option.as_str())
            || commands.values().any(|options| options.contains(option))
    };
    let mut wrong = Vec::new();
    let mut count = 0;
    for (name, page) in pages() {
        for (line, span) in spans(&page) {
            let place = format!("{name}:{line}: {span}");
            let none = if let Some(rest) = span.strip_prefix("filpost ") {
                let command = rest.split([' ', ',']).next().unwrap_or_default();
                if !command.starts_with(|c: char| c.is_ascii_lowercase()) || command == "help" {
                    continue;
                }
                let Some(own) = commands.get(command) else {
                    wrong.push(format!("{place}: no such command"));
                    continue;
                };
                let is_own = |option: &String| own.contains(option) || option == "--help";
                options(rest).into_iter().filter(|o| !is_own(o)).collect::<Vec<_>>()
            } else if span.starts_with("--") {
                let others = |option: &String| OF_OTHERS.contains(&(name.as_str(), option));
                options(span).into_iter().filter(|o| !known(o) && !others(o)).collect()
            } else {
                continue;
            };
            wrong.extend(none.iter().map(|option| format!("{place}: no {option}")));
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 300, "only {count} commands and options");
}

#[test]
fn the_page_of_commands_has_each_option_of_each_command() {
    let page = std::fs::read_to_string(root().join("docs/commands.md")).expect("the page");
    let sections: Vec<&str> = page.split("\n## ").collect();
    for (command, of_command) in commands() {
        assert!(
            page.contains(&format!("`filpost {command}")) || page.contains(&format!("`{command}`")),
            "{command}"
        );
        let section = sections.iter().find(|section| {
            section.lines().next().is_some_and(|title| title.split(' ').any(|word| word == command))
        });
        let named = options(&section.unwrap_or(&"").replace(['`', '|'], " "));
        for option in of_command.iter().filter(|o| !["-h", "--help"].contains(&o.as_str())) {
            let is_long = option.starts_with("--");
            assert!(!is_long || named.contains(option), "commands.md, {command}: lacks {option}");
        }
    }
}

/// `group.key` of machine.toml, where the group is one of settings.
fn is_key(name: &str) -> Option<bool> {
    let (group, rest) = name.split_once('.')?;
    let is_name = |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || "_.".contains(c));
    if !is_name(rest) || rest.is_empty() || ["md", "toml", "fil", "nc", "rs", "ncl"].contains(&rest)
    {
        return None;
    }
    if group == "address" {
        let (letter, field) = rest.split_once('.').unwrap_or((rest, "slot"));
        return Some(letter.len() == 1 && ["slot", "char", "format", "spec"].contains(&field));
    }
    let lists = || user_blocks::LISTS.into_iter().map(|(name, _)| name);
    if group == "blocks" {
        return Some(
            lists().any(|list| list == name || list == rest) || Location::named(name).is_some(),
        );
    }
    let is_group = TABLE.iter().any(|row| row.name.split('.').next() == Some(group));
    is_group.then(|| Location::named(name).is_some())
}

/// What is wrong with a value, on the generic mill; a contradiction of another setting is not.
fn fault_of_value(key: &str, value: &str) -> Option<String> {
    let built = Program::builder().ready("fanuc-mill").set(&format!("{key}={value}")).build();
    let Err(Error::Setup(diags)) = built else { return None };
    let diag = diags.iter().find(|diag| [604, 605].contains(&diag.code.number))?;
    Some(diag.message.clone())
}

#[test]
fn settings_exist_and_take_their_values() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for (name, page) in pages() {
        for (line, span) in spans(&page) {
            let place = format!("{name}:{line}: {span}");
            let (key, value) = span.split_once(" = ").map_or((span, None), |(k, v)| (k, Some(v)));
            match is_key(key) {
                Some(false) if !WRONG_KEYS.contains(&key) => {
                    wrong.push(format!("{place}: no such setting"));
                }
                Some(true) => count += 1,
                _ => continue,
            }
            let is_value = |value: &&str| !value.contains('…') && !key.starts_with("address.");
            if let Some(value) = value.filter(is_value)
                && let Some(fault) = fault_of_value(key, value)
            {
                wrong.push(format!("{place}: {fault}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 300, "only {count} settings");
}

#[test]
fn codes_exist_with_their_letter() {
    let names: Vec<String> = all_codes().into_iter().map(|code| code.name()).collect();
    let mut of_command = BTreeMap::new();
    let mut wrong = Vec::new();
    for (name, page) in pages() {
        for word in page.split(|c: char| !c.is_ascii_alphanumeric()) {
            let is_code = word.len() == 5
                && word.starts_with(['E', 'W'])
                && word[1..].starts_with('0')
                && word[1..].chars().all(|c| c.is_ascii_digit());
            if !is_code || names.iter().any(|code| code == word) {
                continue;
            }
            let is_there = *of_command.entry(word.to_string()).or_insert_with(|| {
                let ran =
                    Command::new(env!("CARGO_BIN_EXE_filpost")).args(["explain", word]).output();
                String::from_utf8_lossy(&ran.expect("it runs").stdout).starts_with(word)
            });
            if !is_there {
                wrong.push(format!("{name}: {word}"));
            }
        }
    }
    assert!(wrong.is_empty(), "no such codes: {}", wrong.join(", "));
}

#[test]
fn numbers_of_postf_exist() {
    let mut wrong = Vec::new();
    for (name, page) in pages() {
        for part in page.split("POSTF(").skip(1) {
            let digits: String = part.chars().take_while(char::is_ascii_digit).collect();
            let Ok(number) = digits.parse::<u16>() else { continue };
            let is_known = POSTF.iter().any(|row| row.number == number);
            // These tell of numbers that are not published.
            let tells = name == "docs/compat.md" || name.starts_with("docs/errors/");
            if !is_known && !tells {
                wrong.push(format!("{name}: POSTF({number})"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
