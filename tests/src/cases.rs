//! Cases of shops, new users and adversaries: the tables of `tests/cases/`, each beside a folder
//! of the same name with the inputs.
//!
//! `case NAME: WHAT` begins a case, and `run CL ARGUMENTS` posts (`-p POST`, `-m MACHINE`,
//! `-f FIL`, `--set KEY=VALUE`, `--units UNIT`, `--grant read=FOLDER`, `--grant write`). What
//! follows is asked of it:
//!
//! - `refused CODE TEXT`: the post refuses with this code, and a message or help holds the text;
//!   without this line it makes a program.
//! - `warns CODES`: it warns of these; without this line of nothing.
//! - `line BLOCK`, `numbered BLOCK`: blocks in this order, without and with their sequence
//!   numbers.
//! - `never BLOCK`, `never-numbered BLOCK`: no block is so. `count N BLOCK`: N blocks are.
//! - `agrees`: `filpost verify` finds nothing; `compares all`: it leaves nothing open, `leaves TEXT`:
//!   it leaves something open that holds the text.
//! - `without BLOCK`, `behind BLOCK: TEXT`: blocks are taken out, a block is put behind the first
//!   one; `finds TEXT`: then verify finds something that holds the text.
//! - `explains SUBJECT: TEXT`: what `filpost explain` tells holds the text.
//!
//! `…` in a block is any text. `LIB/` is `fil-scripts/lib`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use filpost::verify::{Allowed, NcProgram};
use filpost::{Builder, Diag, Error, Program, Run, Severity, Unit, explain, includes};

use crate::root;

/// One case of a table.
#[derive(Clone, Debug)]
pub struct Case {
    /// Table and name.
    pub name: String,
    folder: PathBuf,
    lines: Vec<String>,
}

/// The cases of all tables.
///
/// # Panics
/// A table that can't be read, or two cases with one name.
pub fn all() -> Vec<Case> {
    let folder = root().join("tests/cases");
    let entries = fs::read_dir(&folder).expect("tests/cases").flatten();
    let mut tables: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    tables.retain(|path| path.extension().is_some_and(|ending| ending == "txt"));
    tables.sort();
    let cases: Vec<Case> = tables.iter().flat_map(|table| of_table(table)).collect();
    let names: BTreeSet<&str> = cases.iter().map(|case| &case.name[..]).collect();
    assert_eq!(names.len(), cases.len(), "a case of tests/cases has the name of another");
    cases
}

fn of_table(path: &Path) -> Vec<Case> {
    let text = fs::read_to_string(path).expect("a table");
    let table = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let parts = text.split("\ncase ").skip(1);
    parts
        .map(|part| {
            let mut lines = part.lines().filter(|line| !line.is_empty()).map(str::to_string);
            let head = lines.next().unwrap_or_default();
            let name = head.split(':').next().unwrap_or_default();
            Case {
                name: format!("{table}/{name}"),
                folder: path.with_extension(""),
                lines: lines.collect(),
            }
        })
        .collect()
}

/// What a post made of an input.
struct Outcome {
    program: Option<Program>,
    unit: Option<Unit>,
    cl: Vec<u8>,
    nc: Vec<String>,
    /// Codes of the warnings.
    warnings: BTreeSet<String>,
    /// What refused it: the code, and all that is told.
    refused: Option<(String, String)>,
}

impl Case {
    /// Runs the case.
    ///
    /// # Errors
    /// All that is not as the table asks.
    pub fn check(&self) -> Result<(), String> {
        let mut lines = self.lines.iter();
        let first = lines.next().and_then(|line| line.strip_prefix("run "));
        let written = tempfile::tempdir().map_err(|error| error.to_string())?;
        let mut outcome = self.run(first.ok_or("no line `run`")?, written.path())?;
        let mut wrong = Vec::new();
        let asked = |word: &str| self.lines.iter().any(|line| first_word(line).0 == word);
        if let (Some((code, told)), false) = (&outcome.refused, asked("refused")) {
            wrong.push(format!("refused: {code}\n{told}"));
        } else if !outcome.warnings.is_empty() && !asked("warns") {
            wrong.push(format!("warns of {}", joined(&outcome.warnings)));
        }
        let mut from = 0;
        for line in lines {
            if let Err(said) = outcome.ask(line, &mut from) {
                wrong.push(format!("{line}: {said}"));
            }
        }
        if wrong.is_empty() {
            return Ok(());
        }
        Err(format!("{}\n{}", wrong.join("\n"), outcome.nc.join("\n")))
    }

    fn run(&self, line: &str, written: &Path) -> Result<Outcome, String> {
        let mut words = line.split(' ');
        let cl = self.read(words.next().unwrap_or_default())?;
        let mut builder = Program::builder();
        let mut unit = None;
        while let Some(word) = words.next() {
            let value = words.next().unwrap_or_default();
            builder = match word {
                "-p" => builder.ready(value),
                "-m" => self.machine(builder, value)?,
                "-f" => self.script(builder, value)?,
                "--set" => builder.set(value),
                "--units" => {
                    unit = Some(if value == "mm" { Unit::Mm } else { Unit::Inch });
                    builder
                }
                "--grant" => match value.strip_prefix("read=") {
                    Some(folder) => builder.grant_read(self.folder.join(folder)),
                    None => builder.grant_write(written),
                },
                other => return Err(format!("`{other}` of `{line}` is not known")),
            };
        }
        let cl = cl.into_bytes();
        let mut outcome = Outcome {
            program: None,
            unit,
            cl,
            nc: Vec::new(),
            warnings: BTreeSet::new(),
            refused: None,
        };
        match builder.build() {
            Ok(program) => outcome.post(program),
            Err(error) => outcome.refused = Some(refusal(&error)),
        }
        Ok(outcome)
    }

    fn read(&self, name: &str) -> Result<String, String> {
        let path = self.path(name);
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn path(&self, name: &str) -> PathBuf {
        match name.strip_prefix("LIB/") {
            Some(name) => root().join("fil-scripts/lib").join(name),
            None => self.folder.join(name),
        }
    }

    fn machine(&self, builder: Builder, name: &str) -> Result<Builder, String> {
        let text = self.read(name)?;
        let is_toml = name.ends_with(".toml");
        Ok(if is_toml { builder.machine(name, &text) } else { builder.option_file(name, &text) })
    }

    fn script(&self, builder: Builder, name: &str) -> Result<Builder, String> {
        let (text, path) = (self.read(name)?, self.path(name));
        // A file that it includes lies beside it.
        let name = path.to_string_lossy().into_owned();
        Ok(builder.fil(&name, &text).includes(includes::beside(&[path], None)))
    }
}

impl Outcome {
    fn post(&mut self, program: Program) {
        self.warnings = codes(program.warnings());
        match self.start(program.start()).post(&self.cl) {
            Ok(posted) => {
                self.warnings.extend(codes(&posted.report().warnings));
                self.nc = posted.text().lines().map(str::to_string).collect();
            }
            Err(error) => self.refused = Some(refusal(&error)),
        }
        self.program = Some(program);
    }

    fn start<'o>(&self, run: Run<'o>) -> Run<'o> {
        match self.unit {
            Some(unit) => run.units(unit),
            None => run,
        }
    }

    /// Asks for what a line says; `from` is the block behind the one found last.
    fn ask(&mut self, line: &str, from: &mut usize) -> Result<(), String> {
        let (word, rest) = first_word(line);
        match word {
            "refused" => self.is_refused(rest),
            "warns" => {
                let wanted: BTreeSet<String> = rest.split(' ').map(str::to_string).collect();
                told(wanted == self.warnings, || format!("it warns of {}", joined(&self.warnings)))
            }
            "line" | "numbered" => {
                let blocks = self.blocks(word == "numbered");
                let found = blocks.iter().skip(*from).position(|block| matches(rest, block));
                *from += found.ok_or_else(|| format!("not from block {} on", *from + 1))? + 1;
                Ok(())
            }
            "never" | "never-numbered" => {
                let blocks = self.blocks(word == "never-numbered");
                let found = blocks.iter().find(|block| matches(rest, block));
                found.map_or(Ok(()), |block| Err(format!("found `{block}`")))
            }
            "count" => {
                let (wanted, pattern) = first_word(rest);
                let blocks = self.blocks(false);
                let found = blocks.iter().filter(|block| matches(pattern, block)).count();
                told(wanted == found.to_string(), || format!("found {found}"))
            }
            "agrees" => {
                let found = self.verify().0;
                told(found.is_empty(), || found.join("\n"))
            }
            "compares" => {
                let open = self.verify().1;
                told(open.is_empty(), || open.join("\n"))
            }
            "leaves" => {
                let open = self.verify().1.join("\n");
                told(open.contains(rest), || format!("verify leaves `{open}` open"))
            }
            "without" => {
                self.nc.retain(|block| !matches(rest, without_number(block)));
                Ok(())
            }
            "behind" => {
                let (pattern, text) = rest.split_once(": ").ok_or("no text")?;
                let at = self.nc.iter().position(|block| matches(pattern, without_number(block)));
                self.nc.insert(at.ok_or("no such block")? + 1, text.to_string());
                Ok(())
            }
            "finds" => {
                let found = self.verify().0.join("\n");
                told(found.contains(rest), || format!("verify finds `{found}`"))
            }
            "explains" => {
                let (subject, text) = rest.split_once(": ").ok_or("no text")?;
                let told_of_it = explain::explain(subject, &[]).unwrap_or_default();
                told(told_of_it.contains(text), || told_of_it)
            }
            other => Err(format!("`{other}` is not known")),
        }
    }

    fn is_refused(&self, wanted: &str) -> Result<(), String> {
        let (code, text) = first_word(wanted);
        match &self.refused {
            None => Err("it is posted".to_string()),
            Some((found, all)) => {
                told(found == code && all.contains(text), || format!("{found}: {all}"))
            }
        }
    }

    fn blocks(&self, with_numbers: bool) -> Vec<&str> {
        let block = |line| if with_numbers { line } else { without_number(line) };
        self.nc.iter().map(|line| block(line)).collect()
    }

    /// What verify finds and what it could not compare.
    fn verify(&self) -> (Vec<String>, Vec<String>) {
        let Some(program) = &self.program else {
            return (vec!["no post".to_string()], Vec::new());
        };
        let text = self.nc.join("\n") + "\n";
        let nc = NcProgram { text: text.as_bytes(), name: "part.nc" };
        match self.start(program.start()).verify(&self.cl[..], nc, Allowed::default()) {
            Ok((report, _)) => (
                report.findings.iter().map(ToString::to_string).collect(),
                report.unverified.into_iter().map(|open| open.what).collect(),
            ),
            Err(error) => {
                let (code, told) = refusal(&error);
                (vec![format!("{code} {told}")], Vec::new())
            }
        }
    }
}

fn first_word(line: &str) -> (&str, &str) {
    line.split_once(' ').unwrap_or((line, ""))
}

fn told(is_so: bool, said: impl FnOnce() -> String) -> Result<(), String> {
    if is_so { Ok(()) } else { Err(said()) }
}

fn codes(diags: &[Diag]) -> BTreeSet<String> {
    diags.iter().map(|diag| diag.code.name()).collect()
}

fn joined(codes: &BTreeSet<String>) -> String {
    codes.iter().map(|code| &code[..]).collect::<Vec<_>>().join(" ")
}

fn refusal(error: &Error) -> (String, String) {
    let mut diags = error.diags().iter();
    let Some(first) = diags.find(|diag| diag.severity == Severity::Error) else {
        return (String::new(), error.to_string());
    };
    let help = first.hint.as_deref().unwrap_or_default();
    (first.code.name(), format!("{}\n{help}", first.message))
}

/// The block without `N10 ` before it, or the bare number of Klartext and of GRBL.
fn without_number(block: &str) -> &str {
    let digits = block.strip_prefix('N').unwrap_or(block);
    let rest = digits.trim_start_matches(|letter: char| letter.is_ascii_digit());
    if rest.len() == digits.len() { block } else { rest.trim_start() }
}

/// True if the block is as the pattern, in which `…` is any text.
fn matches(pattern: &str, block: &str) -> bool {
    let mut parts = pattern.split('…');
    let Some(mut rest) = block.strip_prefix(parts.next().unwrap_or_default()) else { return false };
    let mut parts = parts.peekable();
    if parts.peek().is_none() {
        return rest.is_empty();
    }
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    true
}
