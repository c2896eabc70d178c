//! What is said of two programs: one file a behaviour in `tests/diff/`.
//!
//! A file holds the first program, the second one and what must be said, each
//! below a line `== first`, `== second`, `== says`; before them may stand
//! `tolerance: STEP`, `ignore: LIST`, `modal` and `diameter`. What is said must
//! be said the other way round too, in as many sentences. `FILPOST_UPDATE=1`
//! writes the sentences anew.

use std::path::{Path, PathBuf};

use fil_nc::diff::{Options, compare, read, sentence};
use filpost_tests::root;
use libtest_mimic::{Failed, Trial};

pub fn trials() -> Vec<Trial> {
    let entries = std::fs::read_dir(root().join("tests/diff")).expect("tests/diff is there");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let trial = |path: PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Trial::test(format!("diff/{name}"), move || run(&path))
    };
    files.into_iter().map(trial).collect()
}

fn options(head: &str) -> Result<Options, Failed> {
    let mut options = Options::default();
    for line in head.lines() {
        match line.split_once(": ") {
            Some(("tolerance", step)) => options.tolerance = step.parse()?,
            Some(("ignore", list)) => {
                list.split(',').try_for_each(|entry| options.ignore.add(entry))?;
            }
            None if line == "modal" => options.modal = true,
            None if line == "diameter" => options.diameter = true,
            _ => return Err(format!("unknown option `{line}`").into()),
        }
    }
    Ok(options)
}

fn run(path: &Path) -> Result<(), Failed> {
    let text = std::fs::read_to_string(path)?;
    let (head, rest) = text.split_once("== first\n").ok_or("no first program")?;
    let (first, rest) = rest.split_once("== second\n").ok_or("no second program")?;
    let (second, expected) = rest.split_once("== says\n").ok_or("nothing to say")?;
    let options = options(head)?;
    let said = said(first, second, &options)?;
    if std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1") {
        let kept = text.strip_suffix(expected).unwrap_or(&text);
        std::fs::write(path, format!("{kept}{said}"))?;
    } else if said != expected {
        return Err(said.into());
    }
    let back = self::said(second, first, &options)?;
    if back.lines().count() != said.lines().count() {
        return Err(format!("the other way round:\n{back}").into());
    }
    if !self::said(first, first, &options)?.is_empty() {
        return Err("a program differs from itself".into());
    }
    Ok(())
}

fn said(first: &str, second: &str, options: &Options) -> Result<String, Failed> {
    let read = |text: &str, name| read(text.as_bytes(), name, options).map_err(|d| d.to_string());
    let (first, second) = (read(first, "first")?, read(second, "second")?);
    let found = compare(&first, &second, options).map_err(|diag| diag.to_string())?.differences;
    Ok(found.iter().map(|difference| sentence(difference, &first, &second) + "\n").collect())
}
