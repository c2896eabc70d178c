//! `filpost check`

use std::path::PathBuf;

use filpost::check::{self, Options};
use filpost::{Commons, Compat, Diag, Error, Finding, Levels, Program, files, includes};
use serde_json::Value;

use crate::args::{CheckArgs, Format};
use crate::{Status, output, render, sarif, setup, summary};

/// Checks FIL files.
///
/// # Errors
/// Files that can't be read or written.
pub fn run(args: &CheckArgs) -> Result<Status, Error> {
    let compat = setup::compat(&args.reading)?.readings;
    let machine = machine(args)?;
    let groups =
        if args.together { args.files.chunks(args.files.len()) } else { args.files.chunks(1) };
    let mut diags = machine.as_ref().map_or_else(Vec::new, |machine| machine.warnings().to_vec());
    for group in groups {
        diags.extend(check_group(args, group, &compat, machine.as_ref().map(Program::commons))?);
    }
    match args.format {
        Format::Text => {
            for diag in &diags {
                render::to_stderr(diag);
            }
            output::say(&count(&diags, args.files.len()));
        }
        Format::Json => {
            output::print(format!("{:#}\n", findings(&diags)).as_bytes())?;
        }
        Format::Sarif => {
            output::print(format!("{:#}\n", sarif::log(&diags)).as_bytes())?;
        }
    }
    let wrong = diags.iter().any(Diag::is_error) || (args.deny_warnings && !diags.is_empty());
    Ok(if wrong { Status::Failed } else { Status::Done })
}

/// The machine of `-p`, `-m` and `--set`, with its own warnings.
///
/// # Errors
/// Files that can't be read; all that is wrong with the machine.
fn machine(args: &CheckArgs) -> Result<Option<Program>, Error> {
    let named = setup::named(&args.chosen, args.reading.encoding.as_deref())?;
    named.map(|named| named.builder.build()).transpose()
}

fn check_group(
    args: &CheckArgs,
    paths: &[PathBuf],
    compat: &Compat,
    machine: Option<&Commons>,
) -> Result<Vec<Diag>, Error> {
    let encoding = args.reading.encoding.as_deref();
    let mut texts = Vec::new();
    for path in paths {
        texts.push((path.display().to_string(), files::read_text(path, encoding)?));
    }
    let files: Vec<(&str, &str)> =
        texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let mut includes = includes::beside(paths, encoding);
    let options = Options {
        compat: compat.clone(),
        strict: args.reading.strict,
        levels: levels(args, machine),
        includes: Some(&mut includes),
        machine,
    };
    Ok(check::check(&files, options))
}

/// The levels of the machine, and those of the command over them.
fn levels(args: &CheckArgs, machine: Option<&Commons>) -> Levels {
    let mut levels = machine.map(Commons::levels).cloned().unwrap_or_default();
    levels.lay_over(&args.reading.levels.levels);
    levels
}

/// Findings as an array, one object each.
fn findings(diags: &[Diag]) -> Value {
    diags.iter().map(|diag| Finding::from(diag).to_json()).collect()
}

fn count(diags: &[Diag], files: usize) -> String {
    let errors = diags.iter().filter(|diag| diag.is_error()).count();
    let warnings = diags.len() - errors;
    format!(
        "{}: {}, {}",
        summary::counted(files as u64, "file"),
        summary::counted(errors as u64, "error"),
        summary::counted(warnings as u64, "warning")
    )
}
