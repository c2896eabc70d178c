//! One test for each FIL file of `tests/lints/`, whose header lists what a check
//! must find in it, and for each script of `fil-scripts/`: the published ones
//! have the findings listed here, all others have none.

use std::path::{Path, PathBuf};

use filpost::check::{self, Options};
use filpost::{files, includes};
use filpost_tests::{lints, root};
use libtest_mimic::{Failed, Trial};

/// What a check says of the published scripts.
const PAPERS: &[(&str, &[&str])] = &[
    ("embos-cycle.fil", &["W0151 at 1", "W0220 at 1", "W0151 at 3", "W0152 at 3"]),
    ("embos-motion.fil", &["W0221 at 4", "W0246 at 5"]),
    (
        "thread-g76.fil",
        &[
            "W0220 at 1",
            "W0230 at 8",
            "W0230 at 9",
            "W0230 at 10",
            "W0230 at 11",
            "W0230 at 14",
            "W0152 at 20",
        ],
    ),
    (
        "thread-g92.fil",
        &["W0220 at 1", "W0150 at 3", "W0230 at 4", "W0230 at 5", "W0230 at 6", "W0152 at 26"],
    ),
];

pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for folder in ["bad", "good"] {
        for path in lints::fil_files(&root().join("tests/lints").join(folder)) {
            let name = format!("lints/{folder}/{}", name(&path));
            trials.push(Trial::test(name, move || {
                lists_something(&path, folder == "bad")?;
                lints::run(&path).map_err(Failed::from)
            }));
        }
    }
    for path in lints::fil_files(&root().join("fil-scripts")).into_iter().filter(|p| !is_part(p)) {
        let shown = path.strip_prefix(root()).expect("a path below the root");
        let shown = shown.to_string_lossy().replace('\\', "/");
        trials.push(Trial::test(format!("lints/{shown}"), move || script(&path)));
    }
    trials.push(Trial::test("lints/papers are all there", papers_are_there));
    trials.push(Trial::test("lints/embos files together", embos_together));
    trials
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Files of `bad/` list findings, those of `good/` list none.
fn lists_something(path: &Path, something: bool) -> Result<(), Failed> {
    let text = files::read_text(path, None).map_err(|error| error.to_string())?;
    if lints::listed(&text).is_empty() == something {
        return Err("a file of bad/ lists findings, one of good/ lists none".into());
    }
    Ok(())
}

/// A file in the folder of a script, `screw/` beside `screw.fil`, is checked with it.
fn is_part(path: &Path) -> bool {
    path.parent().is_some_and(|folder| folder.with_extension("fil").is_file())
}

fn findings(paths: &[PathBuf]) -> Result<Vec<String>, Failed> {
    let mut texts = Vec::new();
    for path in paths {
        texts.push(files::read_text(path, None).map_err(|error| error.to_string())?);
    }
    let names: Vec<_> = paths.iter().map(|path| path.to_string_lossy()).collect();
    let files: Vec<(&str, &str)> =
        names.iter().zip(&texts).map(|(name, text)| (name.as_ref(), text.as_str())).collect();
    let mut loader = includes::beside(paths, None);
    let options = Options { includes: Some(&mut loader), ..Options::default() };
    Ok(lints::found(&check::check(&files, options)))
}

fn script(path: &Path) -> Result<(), Failed> {
    let published = path.parent().is_some_and(|folder| folder.ends_with("papers"));
    let row = PAPERS.iter().find(|(file, _)| published && *file == name(path));
    let expected = row.map_or(&[][..], |(_, expected)| expected);
    let found = findings(&[path.to_path_buf()])?;
    if found != expected {
        return Err(format!("{found:#?}").into());
    }
    if published { extensions_are_named(path) } else { Ok(()) }
}

/// What `filpost check --strict` refuses stands in the header after `Extensions:`,
/// with the reason.
fn extensions_are_named(path: &Path) -> Result<(), Failed> {
    let text = files::read_text(path, None).map_err(|error| error.to_string())?;
    let header: Vec<&str> = text.lines().take_while(|line| line.starts_with("$$")).collect();
    let header = header.join(" ");
    let named = header.split_once("Extensions:").map_or("", |(_, named)| named);
    let named: Vec<&str> = named.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    let options = Options { strict: true, ..Options::default() };
    for diag in check::check(&[("a.fil", text.as_str())], options) {
        let word = diag.message.split(|c: char| !c.is_ascii_alphanumeric()).next();
        if diag.code.name() == "E0219" && !word.is_some_and(|word| named.contains(&word)) {
            return Err(format!("the header does not name an extension: {}", diag.message).into());
        }
    }
    Ok(())
}

fn papers_are_there() -> Result<(), Failed> {
    for (file, _) in PAPERS {
        let path = root().join("fil-scripts/papers").join(file);
        if !path.is_file() {
            return Err(format!("{} is not there", path.display()).into());
        }
    }
    Ok(())
}

/// Loaded with the section that sets it, CTYPE is no longer a name set nowhere,
/// but still one that has no value before the first CYCLE.
fn embos_together() -> Result<(), Failed> {
    let folder = root().join("fil-scripts/papers");
    let files = ["embos-cycle.fil", "embos-motion.fil"].map(|file| folder.join(file));
    let found = findings(&files)?;
    let about_ctype: Vec<&String> = found
        .iter()
        .filter(|found| found.starts_with("W0221") || found.ends_with("at 4"))
        .collect();
    if about_ctype == ["W0231 at 4"] { Ok(()) } else { Err(format!("{found:#?}").into()) }
}
