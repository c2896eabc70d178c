//! `cargo xtask new-code`.

use super::tree::{Tree, with_line};

/// Write a code of an error or a warning: its row, its page and a case
#[derive(clap::Args)]
pub struct Args {
    /// The crate that raises it, such as fil-post
    pub crate_name: String,
    /// The variant, such as TapOfFedrat
    pub variant: String,
    /// What is wrong and where, in ten words
    pub title: String,
    /// A finding of this kind: error, doubt or warning
    #[arg(long, default_value = "error")]
    pub kind: String,
}

/// Codes below it are those of crates; each crate has some hundreds.
const LAST: u16 = 9799;

/// Writes the files.
///
/// # Errors
/// A crate without codes, a variant that is there, no free number.
pub fn write(tree: &mut Tree, args: &Args) -> Result<String, String> {
    let kind = match args.kind.as_str() {
        "error" => "Error",
        "doubt" => "Doubt",
        "warning" => "Warning",
        other => return Err(format!("`{other}` is no kind: error, doubt or warning")),
    };
    let table = ["errors.rs", "error.rs"]
        .map(|file| format!("crates/{}/src/{file}", args.crate_name))
        .into_iter()
        .find(|file| tree.has(file))
        .ok_or_else(|| format!("crates/{} has no table of codes", args.crate_name))?;
    let text = tree.read(&table)?;
    if text.contains(&format!(" {} = ", args.variant)) {
        return Err(format!("{table} has a code {}", args.variant));
    }
    let number = free_number(tree, &text)?;
    let name = format!("{}{number:04}", if kind == "Warning" { 'W' } else { 'E' });
    tree.change(&table, |text| {
        let table = text.split("#[cfg(test)]").next()?;
        let end = table.rfind("\n    }\n}")?;
        let row = format!(
            "\n        /// {title}.\n        {variant} = {number}, {kind}, \"{title}\",\n            \
             \"Why it is refused or said.\",\n            \"What to type or to change.\";",
            title = args.title,
            variant = args.variant
        );
        Some(format!("{}{row}{}", &text[..end], &text[end..]))
    })?;
    tree.create(&format!("docs/errors/{name}.md"), &page(&name, &args.title))?;
    let line = format!("  - [{name}](errors/{name}.md)");
    tree.change("docs/SUMMARY.md", |text| index(text, &line))?;
    let line = format!("| [{name}]({name}.md) | {} |", args.title);
    tree.change("docs/errors/README.md", |text| index(text, &line))?;
    let list = format!("{number:04}");
    tree.change("tests/api/codes.txt", |text| with_line(text, "", "", &list))?;
    let case = format!("corpus/errors/{name}-{}", args.title.to_lowercase().replace(' ', "-"));
    tree.create(
        &format!("{case}/case.toml"),
        &format!("cl = \"part.ncl\"\nready = \"fanuc-mill\"\noptions.style = \"plain\"\n{}origin = \"ours\"\n", expected(&name)),
    )?;
    tree.create(&format!("{case}/part.ncl"), filpost_tests::examples::PART)?;
    Ok(format!(
        "{}\nTo do:\n\
         1. {table}: reason and hint. Raise it where the fault is: `{variant}.err(…)`.\n\
         2. docs/errors/{name}.md: an example that gives the message, and one that is right; both are tests.\n\
         3. {case}: the CL file that gives it, and its line.\n\
         4. cargo test -p filpost-tests --test files errors/{name}\n\
         5. The message on the page: FILPOST_UPDATE=1 cargo test -p filpost-tests --test all errors::",
        tree.told(),
        variant = args.variant
    ))
}

/// The lines of a case that say what it gives.
fn expected(name: &str) -> String {
    match name.starts_with('W') {
        true => format!("expect_warnings = [\"{name}\"]\nexpect_at = \"part.ncl:4\"\n"),
        false => format!("expect_error = \"{name}\"\nexpect_at = \"part.ncl:4\"\n"),
    }
}

/// The number behind the last one of a table that no crate has.
fn free_number(tree: &Tree, table: &str) -> Result<u16, String> {
    let number = |line: &str| line.split_once(" = ")?.1.split(',').next()?.parse().ok();
    let own = table.lines().filter_map(number);
    let last: u16 = own.max().ok_or("no code in the table")?;
    let is_taken = |number: &u16| {
        ["E", "W"].iter().any(|letter| tree.has(&format!("docs/errors/{letter}{number:04}.md")))
    };
    (last + 1..=LAST).find(|number| !is_taken(number)).ok_or("no number is free".to_string())
}

/// An index with a line more, where the numbers of its codes have it.
fn index(text: &str, line: &str) -> Option<String> {
    let start = line.find('[')? + 1;
    let prefix = &line[..start];
    let key = |line: &str| {
        let rest = line.strip_prefix(prefix)?;
        let name = rest.get(..5)?;
        let is_code = rest.starts_with(['E', 'W']) && name[1..].bytes().all(|b| b.is_ascii_digit());
        is_code.then(|| name[1..].to_string())
    };
    let new = key(line)?;
    let mut lines: Vec<&str> = text.lines().collect();
    let later = |line: &&str| key(line).is_some_and(|found| found > new);
    let last = lines.iter().rposition(|line| key(line).is_some())? + 1;
    let place = lines.iter().position(later).unwrap_or(last);
    lines.insert(place, line);
    Some(lines.join("\n") + "\n")
}

fn page(name: &str, title: &str) -> String {
    format!(
        "# {name}: {title}\n\nWhy it is refused or said.\n\n## Wrong\n\n```cl\nFINI\n```\n\nfilpost says:\n\n\
         ```text\n{name} part.ncl:1:1: \n```\n\n## Right\n\n```cl\nFINI\n```\n\nWhat to type or to change.\n"
    )
}
