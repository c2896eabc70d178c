//! Audits of programs: files of `tests/audit/`, each with a machine, a CL file, FIL, and what the
//! audit must print. `FILPOST_UPDATE=1` writes that part anew.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use filpost::Program;
use filpost::audit::{Audit, as_json};
use filpost::map::Names;
use filpost::nc::source::Source;

/// The mark before the name of each part.
const MARK: &str = "--- ";

/// The files of the suite.
pub fn files() -> Vec<PathBuf> {
    let folder = crate::root().join("tests/audit");
    let entries = fs::read_dir(folder).expect("tests/audit").flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.sort();
    files
}

/// Runs one file.
///
/// # Errors
/// What differs.
pub fn check(path: &Path) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
    let part = |name: &str| {
        let start =
            text.find(&format!("{MARK}{name}\n")).map(|at| at + MARK.len() + name.len() + 1);
        let rest = &text[start.ok_or_else(|| format!("no part {name}"))?..];
        Ok::<&str, String>(rest.split_once(&format!("\n{MARK}")).map_or(rest, |(part, _)| part))
    };
    let found = audit(part("machine.toml")?, part("part.ncl")?, part("mill.fil").unwrap_or(""));
    let found = match found {
        Ok(audit) => print(&audit),
        Err(error) => format!("{error}\n"),
    };
    let wanted = part("audit")?;
    if found == wanted {
        return Ok(());
    }
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        let head = &text[..text.len() - wanted.len()];
        fs::write(path, format!("{head}{found}")).map_err(|error| error.to_string())?;
    }
    Err(format!("expected\n{wanted}\nfound\n{found}"))
}

fn audit(machine: &str, cl: &str, fil: &str) -> Result<Audit, filpost::Error> {
    let builder = Program::builder().machine("machine.toml", machine);
    let builder = if fil.is_empty() { builder } else { builder.fil("mill.fil", fil) };
    let program = builder.build()?;
    let names = Names { fil: program.fil_files(), ..Names::default() };
    let (mut nc, mut map) = (Vec::new(), Vec::new());
    program.start().run_mapped(Cursor::new(cl), &mut nc, &names, &mut map)?;
    let nc = (&Source::memory(&nc), "part.nc");
    program.start().audit(cl.as_bytes(), nc, &mut Cursor::new(map))
}

fn print(audit: &Audit) -> String {
    let mut lines = vec![format!("verdict: {}", audit.verdict().name())];
    if let Some((asked, made)) = audit.motions {
        lines.push(format!("motions: {made} of {asked}"));
    }
    lines.extend(audit.findings.iter().map(|found| format!("finding: {found}")));
    lines.extend(audit.changes.iter().map(|change| format!("change: {change}")));
    lines.extend(audit.not_compared.iter().map(|what| format!("not compared: {what}")));
    let json = as_json(audit);
    assert_eq!(json["changes"].as_array().map(Vec::len), Some(audit.changes.len()));
    assert_eq!(json["verdict"], audit.verdict().name());
    lines.join("\n") + "\n"
}
