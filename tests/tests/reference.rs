//! The reference in `docs/reference/`: a page for each statement, function, form
//! of TEXT/ and POSTF number, and one for the words without effect, made from the
//! tables that the program itself reads.
//! `FILPOST_UPDATE=1` writes the pages anew.

use std::collections::BTreeMap;

use fil_post::no_effect;
use filpost::builtins::BUILTINS;
use filpost::postf::{Grade, POSTF};
use filpost::statements::STATEMENTS;
use filpost_tests::examples::{Block, run};
use filpost_tests::root;

const FOLDER: &str = "docs/reference";

fn grade(grade: Grade) -> &'static str {
    match grade {
        Grade::Published => "Published in a script or listing.",
        Grade::Inferred => "Inferred from published scripts, or recalled.",
        Grade::Own => "Our own reading.",
    }
}

fn sentence(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(|first| first.to_uppercase().to_string());
    let rest = characters.as_str().trim_end_matches('.');
    format!("{}{rest}.", first.unwrap_or_default())
}

fn page(title: &str, form: &str, doc: &str, rest: &str) -> String {
    format!("# {title}\n\n```text\n{form}\n```\n\n{}\n\n{}\n", sentence(doc), rest.trim_end())
}

/// The words and items that change nothing, with the reason of each.
fn no_effect_page() -> String {
    let mut page = String::from(
        "# Words without effect\n\nThese words and items of CL records are known and change nothing in \
         the NC program; a word that may be left out says what holds without it. Any other word \
         that the post has no handler for is refused ([E0513](../errors/E0513.md)), and any other \
         item that a handler does not take refuses its record ([E0506](../errors/E0506.md)). A test \
         changes and leaves out every item of many CL files: what changes nothing stands here.\n\n| word | item | reason |\n|---|---|---|\n",
    );
    for row in no_effect::rows() {
        let item = if row.item == "*" { "the whole record" } else { row.item };
        let left_out = if row.left_out_only { " left out" } else { "" };
        page.push_str(&format!("| {} | {item}{left_out} | {} |\n", row.major, row.reason));
    }
    page
}

/// File name without ending, and text, of every page; the index among them.
fn pages() -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    let mut index = String::from(
        "# Reference\n\nA page for each statement, function and POSTF number. `filpost explain` \
         says the same in the terminal.\n\n## Statements\n\n",
    );
    let mut add = |index: &mut String, file: String, title: &str, text: String| {
        index.push_str(&format!("- [{title}]({file}.md)\n"));
        assert!(pages.insert(file, text).is_none(), "two pages for {title}");
    };
    for row in STATEMENTS {
        let example = match row.example {
            "" => String::new(),
            example => format!("\n\n## Example\n\n```fil\n{example}```"),
        };
        let rest = format!("{}{example}", grade(row.grade));
        let text = page(row.word, row.form, row.doc, &rest);
        add(&mut index, format!("statement-{}", row.word), row.word, text);
    }
    index.push_str("\nAll other words make a record for the post: see [compat](../compat.md).\n");
    index.push_str("\n## Functions and forms\n\n");
    for row in BUILTINS {
        let extension =
            if row.extension { " An extension of filpost, refused under `--strict`." } else { "" };
        let rest = format!("{}{extension}", grade(row.grade));
        let text = page(row.name, &row.call(), row.doc, &rest);
        add(&mut index, row.name.replace('/', "-"), row.name, text);
    }
    index.push_str("\n## POSTF\n\n");
    for row in POSTF {
        let arguments: Vec<String> = row.arguments.iter().map(|name| format!(",{name}")).collect();
        let call = format!("POSTF({}{})", row.number, arguments.concat());
        let operation = filpost::operation_name(row.op);
        let rest = format!("{} Its name in a compat file is `{operation}`.", grade(row.grade));
        let title = format!("POSTF({})", row.number);
        let text = page(&title, &call, row.doc, &rest);
        add(&mut index, format!("POSTF-{}", row.number), &title, text);
    }
    index.push_str("\n## CL records\n\n- [Words without effect](no-effect.md)\n");
    pages.insert("no-effect".into(), no_effect_page());
    pages.insert("README".into(), index);
    pages
}

#[test]
fn the_pages_say_what_the_tables_say() {
    let folder = root().join(FOLDER);
    let pages = pages();
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::create_dir_all(&folder).unwrap();
        for (name, text) in &pages {
            std::fs::write(folder.join(format!("{name}.md")), text).unwrap();
        }
    }
    for (name, text) in &pages {
        let found = std::fs::read_to_string(folder.join(format!("{name}.md"))).unwrap_or_default();
        assert_eq!(&found, text, "{FOLDER}/{name}.md");
    }
    let files = std::fs::read_dir(&folder).expect("docs/reference is there").count();
    assert_eq!(files, pages.len(), "a page without a row");
}

#[test]
fn the_summary_lists_the_reference() {
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
    for name in pages().keys() {
        assert!(summary.contains(&format!("(reference/{name}.md)")), "{name} is not in SUMMARY.md");
    }
}

#[test]
fn the_examples_run() {
    for row in STATEMENTS.iter().filter(|row| !row.example.is_empty()) {
        let block = Block { words: vec!["fil"], text: row.example.into(), heading: "", line: 1 };
        let diags = run(&block).expect("an example of FIL is run");
        let errors: Vec<_> = diags.iter().filter(|diag| diag.is_error()).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", row.word);
    }
}
