//! The how-to pages hold what they show: each page of `docs/howto/` prints the
//! file of `fil-scripts/lib/` of its name, and its CL examples give the NC
//! programs printed with them.
//!
//! A page begins with `<!-- post: NAME -->`, a ready post. An `nc` block is what
//! the `cl` block above it gives with the page's `fil` block; settings in a
//! `toml` block go on top for the one example after it. The words after `nc`
//! are the codes of the warnings of that run.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use filpost::{Error, Program};
use filpost_tests::examples::{Block, blocks};
use filpost_tests::root;
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let pages = files("docs/howto", "md");
    let mut trials: Vec<Trial> = pages.into_iter().map(page_trial).collect();
    trials.extend(files("fil-scripts/lib", "fil").into_iter().map(file_trial));
    trials.push(Trial::test("howto/habits", habits));
    trials
}

/// The files of a folder with that ending, sorted.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).expect("the folder is there");
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    files
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn page_trial(path: PathBuf) -> Trial {
    Trial::test(format!("howto/{}", stem(&path)), move || page(&path))
}

fn file_trial(path: PathBuf) -> Trial {
    Trial::test(format!("howto/lib/{}", stem(&path)), move || file(&path))
}

/// `docs/habits.md` says of each case what its header says, and misses no case of a habit.
fn habits() -> Result<(), Failed> {
    let page = std::fs::read_to_string(root().join("docs/habits.md"))?;
    let mut told = Vec::new();
    for row in page.lines().filter(|line| line.starts_with("| ") && line.contains('`')) {
        let columns: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [_, says, case] = columns[..] else { return Err(format!("columns: {row}").into()) };
        let case = case.trim_matches('`');
        let folder = if case.ends_with(".fil") { "tests/language" } else { "tests/words" };
        let text = std::fs::read_to_string(root().join(folder).join(case))
            .map_err(|error| format!("{case}: {error}"))?;
        let code = |key: &str| {
            let code = text.lines().find_map(|line| line.strip_prefix(key))?;
            code.split_whitespace().next().map(str::to_string)
        };
        let expected = match (code("$$ error: "), code("$$ warning: ")) {
            (Some(code), _) => format!("refused, [{code}](errors/{code}.md)"),
            (None, Some(code)) => format!("warns, [{code}](errors/{code}.md)"),
            (None, None) => "works".to_string(),
        };
        same(&expected, says, case)?;
        told.push(case.to_string());
    }
    let missing: Vec<String> = files("tests/language", "fil")
        .iter()
        .map(|path| format!("{}.fil", stem(path)))
        .filter(|name| name.starts_with("habit-") && !told.contains(name))
        .collect();
    same("", &missing.join("\n"), "cases of habits that the page misses")
}

/// One page: its examples in order.
fn page(path: &Path) -> Result<(), Failed> {
    let page = std::fs::read_to_string(path)?;
    let ready = page
        .lines()
        .next()
        .and_then(|line| line.strip_prefix("<!-- post: ")?.strip_suffix(" -->"))
        .ok_or("the first line is no `<!-- post: NAME -->`")?;
    let (mut fil, mut cl, mut settings) = (None, None, None);
    let mut examples = 0;
    for block in blocks(&page) {
        match block.words.first().copied() {
            Some("fil") => fil = Some(block),
            Some("cl") => {
                if let Some(unused) = cl.replace(block) {
                    return Err(at(&unused, "no NC program follows this CL file"));
                }
            }
            Some("toml") => settings = Some(block),
            Some("nc") => {
                let cl = cl.take().ok_or_else(|| at(&block, "no CL file stands above"))?;
                example(ready, fil.as_ref(), &cl, settings.take(), &block)?;
                examples += 1;
            }
            _ => {}
        }
    }
    let library = root().join("fil-scripts/lib").join(stem(path)).with_extension("fil");
    if let Ok(text) = std::fs::read_to_string(library) {
        same(&text, &fil.map(|block| block.text).unwrap_or_default(), "the file of the library")?;
    }
    if examples == 0 { Err("the page has no example".into()) } else { Ok(()) }
}

/// Posts one example and compares program and warnings.
fn example(
    ready: &str,
    fil: Option<&Block<'_>>,
    cl: &Block<'_>,
    settings: Option<Block<'_>>,
    nc: &Block<'_>,
) -> Result<(), Failed> {
    let mut builder = Program::builder().generic(ready);
    for setting in settings.iter().flat_map(|block| block.text.lines()) {
        builder = builder.set(setting);
    }
    if let Some(fil) = fil {
        builder = builder.fil("macros.fil", &fil.text);
    }
    let mut found = Vec::new();
    let post = builder.build().map_err(|error| refused(cl, &error))?;
    let report = post
        .start()
        .cl_name("part.ncl")
        .stream_seekable(Cursor::new(cl.text.as_bytes()), &mut found)
        .map_err(|error| refused(cl, &error))?;
    same(&nc.text, &String::from_utf8_lossy(&found), &format!("the NC of line {}", nc.line))?;
    let warnings = post.warnings().iter().chain(&report.warnings);
    let mut codes: Vec<String> = warnings.map(|diag| diag.code.name()).collect();
    codes.sort();
    codes.dedup();
    same(&nc.words[1..].join(" "), &codes.join(" "), &format!("warnings of line {}", nc.line))
}

/// One file of the library: it has a page, cases, and nothing `check` finds wrong.
fn file(path: &Path) -> Result<(), Failed> {
    let stem = stem(path);
    for other in [format!("docs/howto/{stem}.md"), format!("corpus/lib/{stem}")] {
        if !root().join(&other).exists() {
            return Err(format!("{other} is missing").into());
        }
    }
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md"))?;
    if !summary.contains(&format!("(howto/{stem}.md)")) {
        return Err("docs/SUMMARY.md lacks the page".into());
    }
    let text = std::fs::read_to_string(path)?;
    let options = filpost::check::Options::default();
    let diags = filpost::check::check(&[("library.fil", &text)], options);
    let errors: Vec<String> =
        diags.iter().filter(|diag| diag.is_error()).map(ToString::to_string).collect();
    same("", &errors.join("\n"), "errors")
}

fn refused(cl: &Block<'_>, error: &Error) -> Failed {
    at(cl, &error.to_string())
}

fn at(block: &Block<'_>, message: &str) -> Failed {
    format!("line {}: {message}", block.line).into()
}

fn same(wanted: &str, found: &str, what: &str) -> Result<(), Failed> {
    if wanted == found {
        return Ok(());
    }
    Err(format!("{what}\nwanted:\n{wanted}\nfound:\n{found}").into())
}
