//! A CL text written as one of Creo posts the program that the text itself posts, byte for
//! byte, or is refused as the text is.
//!
//! Over the CL files of this repository, and over real files where they are at hand.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use filpost::cl::{ClDialect, to_ncl};
use filpost::{Error, Program, Unit, case};
use filpost_tests::{root, tip_program, words::Header};

/// What came of a text: its program, or the code of the refusal.
type Posted = Result<Vec<u8>, String>;

fn post(program: &Program, text: &[u8], dialect: Option<ClDialect>, unit: Option<Unit>) -> Posted {
    let mut nc = Vec::new();
    let reading = filpost::cl::Options { dialect, ..Default::default() };
    let mut run = program.start().cl_options(reading);
    if let Some(unit) = unit {
        run = run.units(unit);
    }
    run.stream_seekable(Cursor::new(text), &mut nc).map(|_| nc).map_err(|error| code(&error))
}

fn code(error: &Error) -> String {
    error.diags().first().map(|diag| diag.code.name()).unwrap_or_default()
}

fn converted(text: &[u8], dialect: Option<ClDialect>) -> Result<Vec<u8>, String> {
    let mut output = Cursor::new(Vec::new());
    let reading = filpost::cl::Options { dialect, ..Default::default() };
    to_ncl(Cursor::new(text), "t", reading, None, &mut output)
        .map(|_| output.into_inner())
        .map_err(|diag| diag.code.name())
}

/// Posts a text and its conversion; true when there is a program. The conversion is refused
/// only where the reader refuses the text, too.
fn round_trip(
    name: &str,
    program: &Program,
    text: &[u8],
    dialect: Option<ClDialect>,
    unit: Option<Unit>,
) -> bool {
    let direct = post(program, text, dialect, unit);
    let ncl = match converted(text, dialect) {
        Ok(ncl) => ncl,
        Err(code) => {
            assert!(direct.is_err(), "{name}: not converted ({code}), but posted");
            return false;
        }
    };
    let again = post(program, &ncl, None, unit);
    // What a subroutine lacks is told by the reader of Creo's form, else by the post.
    if direct.is_err() && again.as_ref().is_err_and(|code| code == "E0408") {
        return false;
    }
    let show = |posted: &Posted| match posted {
        Ok(nc) => String::from_utf8_lossy(nc).into_owned(),
        Err(code) => code.clone(),
    };
    assert_eq!(show(&direct), show(&again), "{name}");
    direct.is_ok()
}

/// Machines of three and five axes, and a lathe.
fn machines() -> Vec<Program> {
    let ready = |name: &str| Program::builder().generic(name).build().unwrap();
    vec![ready("fanuc-mill"), ready("fanuc-lathe"), tip_program::MACHINES[0].post()]
}

/// All files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        println!("skipped: no folder {}", folder.display());
        return Vec::new();
    };
    let mut found: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| entry.path())
        .flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] })
        .collect();
    found.sort();
    found
}

/// Small files of each dialect, with all that it writes its own way.
#[test]
fn small_files_of_each_dialect() {
    let mut seen = Vec::new();
    for path in files(&root().join("tests/dialects")) {
        let text = std::fs::read(&path).unwrap();
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let dialect: ClDialect = stem.split('_').next().unwrap().parse().unwrap();
        let posted = machines()
            .iter()
            .filter(|program| round_trip(&stem, program, &text, None, Some(Unit::Mm)))
            .count();
        assert!(posted > 0, "{stem} posts on none of the machines");
        let report = machines()
            .iter()
            .find_map(|program| {
                let run = program.start().units(Unit::Mm);
                run.stream(&text[..], std::io::sink()).ok()
            })
            .unwrap();
        assert_eq!(report.dialect.unwrap().dialect, dialect, "{stem}");
        seen.push(dialect);
    }
    for dialect in ClDialect::ALL {
        let is_only_chosen = dialect.rules().signs.is_empty() && *dialect != ClDialect::Generic;
        assert!(seen.contains(dialect) || is_only_chosen, "no file of {dialect}");
    }
}

/// The statements of each post word, with their settings and FIL.
#[test]
fn statements_of_each_word() {
    let mut posted = 0;
    for path in files(&root().join("tests/words")) {
        let text = std::fs::read_to_string(&path).unwrap();
        let header = Header::read(&text).unwrap();
        let Ok(program) = header.post() else { continue };
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        posted += usize::from(round_trip(&name, &program, text.as_bytes(), None, None));
    }
    assert!(posted > 150, "{posted} posted");
}

#[test]
fn cases_of_the_corpus() {
    let mut posted = 0;
    for case in case::find(&root().join("corpus")).unwrap() {
        let Ok(program) = case.program() else { continue };
        let text = std::fs::read(case.folder.join(&case.file.cl)).unwrap();
        let name = case.folder.display().to_string();
        let made = round_trip(&name, &program, &text, case.file.dialect, case.file.units);
        posted += usize::from(made);
    }
    assert!(posted > 20, "{posted} posted");
}

#[test]
fn real_files() {
    let data =
        std::env::var_os("FILPOST_DATA").map_or(root().join("../shared/data"), PathBuf::from);
    let machines = machines();
    let (mut all, mut posted) = (0, 0);
    for path in ["cl", "cl-more"].iter().flat_map(|folder| files(&data.join(folder))) {
        let text = std::fs::read(&path).unwrap();
        let name = path.display().to_string();
        let made = machines
            .iter()
            .filter(|program| round_trip(&name, program, &text, None, Some(Unit::Mm)))
            .count();
        all += 1;
        posted += usize::from(made > 0);
    }
    println!("{posted} of {all} files post, and post the same once converted");
    assert!(all == 0 || posted > all / 3, "{posted} of {all}");
}
