//! `cargo xtask new-word`.

use super::tree::{Tree, with_line};

/// Write the skeleton of a post word, which refuses its record until it is filled in
#[derive(clap::Args)]
pub struct Args {
    /// The major word, such as CLAMP; `crates/fil-cl/data/vocabulary.tsv` has it
    pub name: String,
    /// Minor words that it takes, such as ON OFF
    pub minors: Vec<String>,
}

const MODULES: &str = "crates/fil-post/src/words/mod.rs";
const WORDS: &str = "crates/fil-cl/src/words.rs";

/// Where the major and the minor words of [`WORDS`] end.
const MAJOR_ENDS: &str = "\n    }\n    EITHER";
const MINOR_ENDS: &str = "\n    }\n}";

/// Writes the files.
///
/// # Errors
/// A word that the vocabulary lacks, that has a handler, or that is listed as without effect.
pub fn write(tree: &mut Tree, args: &Args) -> Result<String, String> {
    let name = args.name.to_ascii_uppercase();
    let module = name.to_ascii_lowercase();
    let minors: Vec<String> = args.minors.iter().map(|word| word.to_ascii_uppercase()).collect();
    refuse(tree, &name)?;
    minors.iter().try_for_each(|minor| is_in_vocabulary(tree, minor))?;
    declare(tree, &name, MAJOR_ENDS)?;
    minors.iter().try_for_each(|minor| declare(tree, minor, MINOR_ENDS))?;
    let file = format!("crates/fil-post/src/words/{module}.rs");
    tree.create(&file, &handler(&name))?;
    tree.change(MODULES, |text| with_line(text, "", "pub mod ", &format!("pub mod {module};")))?;
    let row = format!("    (w::{name}, I(word::{module}::handle)),");
    tree.change("crates/fil-post/src/dispatch.rs", |text| {
        with_line(text, "pub const HANDLERS", "    (w::", &row)
    })?;
    tree.change("crates/fil-nc/src/verify/cl_path/words.rs", |text| {
        let end = text.find("\n];")?;
        let row = format!("\n    (w::{name}, Ignored(NO_PROGRAM)),");
        Some(format!("{}{row}{}", &text[..end], &text[end..]))
    })?;
    tree.change("tests/reference/words.txt", |text| example(text, &name, &minors))?;
    let row = format!("| {name} | refused: what it does is not known | our own | - |");
    tree.change("docs/compat.md", |text| with_line(text, "| word | forms and effect", "| ", &row))?;
    let line = format!("  - [{name}](reference/word-{name}.md)");
    tree.change("docs/SUMMARY.md", |text| summary(text, &line))?;
    tree.create(
        &format!("tests/words/{module}-is-refused.ncl"),
        &format!("$$ error: E0506 at 2\n{name}\nFINI\n"),
    )?;
    Ok(format!(
        "{}\nTo do:\n\
         1. {file}: take the items, make the operation (crates/fil-post/src/operation.rs).\n\
         2. crates/fil-nc/src/verify/cl_path/words.rs: how `filpost verify` reads it, from the CL file alone.\n\
         3. docs/compat.md: forms, effect, grade, source.\n\
         4. tests/words/{module}-is-refused.ncl: the error that it keeps; a file beside it for what is written.\n\
         5. tests/reference/words.txt: an example that a machinist would write.\n\
         6. A code of its own: cargo xtask new-code.\n\
         7. The cases: FILPOST_UPDATE=1 cargo test -p filpost-tests --test files words/{module}\n\
         8. The pages: FILPOST_UPDATE=1 cargo test -p filpost-tests --test all -- reference:: verify::",
        tree.told()
    ))
}

fn is_listed(tree: &Tree, file: &str, name: &str) -> Result<bool, String> {
    let text = tree.read(file)?;
    Ok(text.lines().any(|line| line.split('\t').next() == Some(name)))
}

fn is_in_vocabulary(tree: &Tree, name: &str) -> Result<(), String> {
    const VOCABULARY: &str = "crates/fil-cl/data/vocabulary.tsv";
    match is_listed(tree, VOCABULARY, name)? {
        true => Ok(()),
        false => Err(format!("{VOCABULARY} has no word {name}: add it with its code")),
    }
}

fn refuse(tree: &Tree, name: &str) -> Result<(), String> {
    is_in_vocabulary(tree, name)?;
    if tree.read("crates/fil-post/src/dispatch.rs")?.contains(&format!("(w::{name}, ")) {
        return Err(format!("{name} has a handler"));
    }
    if is_listed(tree, "crates/fil-post/data/no-effect.tsv", name)? {
        return Err(format!(
            "{name} is a row of crates/fil-post/data/no-effect.tsv: take it out first"
        ));
    }
    Ok(())
}

/// Gives the word a constant in the group that ends so, where it has none.
fn declare(tree: &mut Tree, name: &str, group_ends: &str) -> Result<(), String> {
    let text = tree.read(WORDS)?;
    let is_there = |line: &str| {
        line.starts_with("        ") && line.split(',').any(|word| word.trim() == name)
    };
    if text.lines().any(is_there) {
        return Ok(());
    }
    tree.change(WORDS, |text| {
        let words = text.find("\nwords! {")?;
        let end = words + text[words..].find(group_ends)?;
        Some(format!("{}\n        {name},{}", &text[..end], &text[end..]))
    })
}

/// The examples with one of a word more, a statement for each of its minor words.
fn example(text: &str, name: &str, minors: &[String]) -> Option<String> {
    let heading = format!("# {name}");
    let statements: String = match minors {
        [] => format!("{name}\n"),
        _ => minors.iter().map(|minor| format!("{name} / {minor}\n")).collect(),
    };
    let later = |line: &&str| line.starts_with("# ") && **line > *heading;
    let at = text.lines().find(later).and_then(|line| text.find(&format!("{line}\n")));
    let at = at.unwrap_or(text.len());
    Some(format!("{}{heading}\n{statements}{}", &text[..at], &text[at..]))
}

/// The summary with the page of a word more.
fn summary(text: &str, line: &str) -> Option<String> {
    let mut lines: Vec<&str> = text.lines().collect();
    let is_word = |line: &&str| line.contains("](reference/word-");
    let last = lines.iter().rposition(&is_word)? + 1;
    let place = lines.iter().position(|found| is_word(found) && *found > line).unwrap_or(last);
    lines.insert(place, line);
    Some(lines.join("\n") + "\n")
}

fn handler(name: &str) -> String {
    format!(
        "//! {name}: what it makes the machine do, by the manual of which control.

use fil_diag::Result;

use crate::items::Items;
use crate::post::Post;

/// Refuses the record: what it does is not known yet.
///
/// # Errors
/// Always.
pub fn handle(_: &mut Post, items: &mut Items) -> Result<()> {{
    items.deny_rest()?;
    Err(items.error(\"what {name} does on this machine is not known\"))
}}
"
    )
}
