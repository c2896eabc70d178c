//! The pages of the post words: what compat.md says of a word, its words by position
//! and what an example writes. All but the examples themselves is made from what the
//! program does.

use std::collections::BTreeMap;
use std::fmt::Write;

use filpost::Program;
use filpost::cl::reader::{Options, Reader};
use filpost::cl::record::WordView;
use filpost::cl::{Record, Vocabulary};

use crate::root;

/// What stands before an example that does not stand alone.
const START: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 1000, CLW\nFEDRAT / 200, MMPM\nRAPID\n\
                     GOTO / 0, 0, 50\n";

/// An example of a post word.
struct Example<'a> {
    word: &'a str,
    /// The form that it shows; empty for the first one of a word.
    form: &'a str,
    post: &'a str,
    alone: bool,
    settings: Vec<&'a str>,
    lines: &'a str,
}

/// The examples in `tests/reference/words.txt`.
fn examples(text: &str) -> Vec<Example<'_>> {
    let mut examples: Vec<Example<'_>> = Vec::new();
    let parts = text.split("\n#").skip(1).filter_map(|part| part.split_once('\n'));
    for (head, lines) in parts {
        let (further, head) = match head.strip_prefix('#') {
            Some(head) => (true, head.trim()),
            None => (false, head.trim()),
        };
        let (form, rest) = match head.split_once(" | ") {
            Some((form, rest)) => (form, rest),
            None if further => (head, ""),
            None => head.split_once(' ').unwrap_or((head, "")),
        };
        let word = if further { examples.last().expect("a word").word } else { form };
        let rest: Vec<&str> = rest.split_whitespace().collect();
        let post =
            rest.iter().position(|part| *part == "on").map_or("fanuc-mill", |at| rest[at + 1]);
        examples.push(Example {
            word,
            form: if further { form } else { "" },
            post,
            alone: rest.contains(&"alone"),
            settings: rest.iter().copied().filter(|part| part.contains('=')).collect(),
            lines,
        });
    }
    examples
}

/// What the rows of compat.md say of a post word: of `WORD: part` the part comes first, of `WORD
/// in a case` the whole name, of a row of a family of controls its name.
fn rows(compat: &str, word: &str) -> Vec<String> {
    let mut family = "";
    let mut found = Vec::new();
    for line in compat.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            family = if ["Klartext", "SINUMERIK"].contains(&heading) { heading } else { "" };
        }
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [name, does, ..] = cells[..] else { continue };
        let Some(rest) = name.split(", ").find_map(|part| part.strip_prefix(word)) else {
            continue;
        };
        let is_list = name.split(", ").all(|part| part.chars().all(|c| c.is_ascii_uppercase()));
        let part = match rest.strip_prefix(": ") {
            Some(part) => format!("{part}: "),
            None if is_list && rest.is_empty() => String::new(),
            None if name.starts_with(word) && (rest.is_empty() || rest.starts_with(' ')) => {
                format!("{name}: ")
            }
            None => continue,
        };
        let family = if family.is_empty() { String::new() } else { format!("{family}: ") };
        found.push(format!("{family}{part}{does}"));
    }
    found
}

/// The pages by word.
pub fn pages() -> BTreeMap<String, String> {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).expect("a file of the tree");
    let (compat, text) = (read("docs/compat.md"), read("tests/reference/words.txt"));
    let mut pages = BTreeMap::new();
    for example in examples(&text) {
        let page: &mut String = pages.entry(example.word.to_string()).or_default();
        page.push_str(&section(&example, &compat));
    }
    pages
}

/// What an example adds to the page of its word: the first one begins it.
fn section(example: &Example<'_>, compat: &str) -> String {
    let word = example.word;
    let mut page = String::new();
    if example.form.is_empty() {
        let _ = write!(page, "# {word}\n\n");
        for does in rows(compat, word) {
            // Links count from the folder of the page.
            let _ = writeln!(page, "- {}", does.replace("](", "](../"));
        }
        page.push_str("\n## Example\n");
    } else {
        let _ = write!(page, "\n## {}\n", example.form);
    }
    let start = if example.alone { "" } else { START };
    let last = if word == "FINI" { "" } else { "FINI\n" };
    let cl = format!("{start}{}\n{last}", example.lines.trim_end());
    let _ = write!(page, "\n```cl\n{}\n```\n", example.lines.trim_end());
    let first = start.lines().count() as u32 + 1;
    page.push_str(&written(example, &cl, first));
    if example.form.is_empty() {
        page.push_str(
            "\n## Words by position\n\nFor POSTF(7,n), in the first record of the example:\n",
        );
    } else {
        page.push_str("\nIts words:\n");
    }
    page.push_str("\n| n | word |\n|---|---|\n");
    page.push_str(&positions(word, &cl, first));
    page
}

/// What the word-address control writes for the lines of the example.
fn written(example: &Example<'_>, cl: &str, first: u32) -> String {
    let builder = Program::builder().generic(example.post);
    let builder = example.settings.iter().fold(builder, |builder, setting| builder.set(setting));
    let program = builder.build().expect("a ready post with settings that agree");
    let post = match &example.settings[..] {
        [] => format!("`{}`", example.post),
        settings => format!("`{}` with `{}`", example.post, settings.join("`, `")),
    };
    let lines = first..first + example.lines.trim_end().lines().count() as u32;
    let mut blocks = Vec::new();
    for block in program.blocks(cl.as_bytes()) {
        match block {
            Ok(block) if lines.contains(&block.origin.line) => blocks.push(block.text),
            Ok(_) => {}
            Err(error) => {
                let diag = &error.diags()[0];
                let hint = diag.hint.as_deref().unwrap_or(diag.code.hint);
                let name = diag.code.name();
                let whose = if example.settings.is_empty() { "The post" } else { &post };
                return format!(
                    "\n{whose} refuses it ([{name}](../errors/{name}.md)): {}. {hint}\n",
                    diag.message
                );
            }
        }
    }
    if blocks.is_empty() {
        return format!("\n{post} writes nothing for it.\n");
    }
    format!("\n{post} writes:\n\n```text\n{}\n```\n", blocks.join("\n"))
}

fn positions(word: &str, cl: &str, first: u32) -> String {
    let mut reader = Reader::new(cl.as_bytes(), "example", Options::default());
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    while reader.read(&mut vocabulary, &mut record).expect("an example is read") {
        if record.line < first || vocabulary.name(record.major) != word {
            continue;
        }
        let mut table = String::new();
        for n in 1..=record.len() {
            let Some(view) = record.word(n, &vocabulary) else { continue };
            let text = match view {
                _ if n == 1 => "number of the record".to_string(),
                _ if n == 2 => format!("{} (type)", record.kind),
                WordView::Number(number) => number.to_string(),
                WordView::Word { name, .. } => name.to_string(),
                WordView::Text(text) => format!("`'{text}'`"),
                WordView::Empty => "EMPTY".to_string(),
            };
            let _ = writeln!(table, "| {n} | {text} |");
        }
        return table;
    }
    String::from("| - | the reader makes no separate record of it |\n")
}
