//! Regression cases: a folder with `case.toml`, a CL file, a post and the NC
//! program it must give.
//!
//! `case.toml`: `cl`; `dialect` (of the CL file, where it is not recognized); `ready`, `machine` (machine.toml) or `option_file`; `fil` (a file or a
//! list); `set` (list of `key=value`); `[options]` of the post; `compat`; `strict`; `allow`; `[levels]`; `read` (a folder for scripts);
//! `clock`; `units` (of a CL file without UNITS); `expect` (NC file) or `expect_error` (code); `listing` (its expected text);
//! `tolerance`, `ignore`, `diameter` (how the NC programs are compared; letter by letter
//! when none is given); `expect_warnings`; `expect_at` (`file:line` of the error or of the
//! first warning expected); `[simulate]` (stock, part and tools); `origin` and `repairs` for people.

mod mutants;
mod outcome;
mod recipe;
mod side_by_side;
mod unified;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use fil_cl::ClDialect;
use fil_diag::Diag;
use fil_machine::Unit;
use fil_nc::diff;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::error::{Error, RunCode};
use crate::program::Program;
use crate::simulate::Setup;
use crate::units::unit_named;
use crate::{file_names, files};

pub use mutants::{Mutant, mutants};
pub use outcome::{Fresh, Outcome, Verdict};
use recipe::Recipe;
pub use recipe::{Programs, Unsaved};
pub use side_by_side::{Row, side_by_side};

/// The text of a `case.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// The CL file.
    pub cl: String,
    /// The dialect of the CL file, by its name.
    #[serde(default, deserialize_with = "dialect")]
    pub dialect: Option<ClDialect>,
    /// Sections see the records as they are written.
    #[serde(default)]
    pub raw_records: bool,
    /// A ready post.
    pub ready: Option<String>,
    /// A `machine.toml`.
    pub machine: Option<String>,
    /// An option file.
    pub option_file: Option<String>,
    /// FIL files, in order.
    #[serde(default)]
    pub fil: Vec<String>,
    /// Settings on top.
    #[serde(default)]
    pub set: Vec<String>,
    /// Values of options of the post.
    #[serde(default, deserialize_with = "options")]
    pub options: BTreeMap<String, String>,
    /// A compat file.
    pub compat: Option<String>,
    /// A folder that scripts may read.
    pub read: Option<String>,
    /// The moment of DATEF and TIMEF, as `2026-01-31T12:00:00`.
    pub clock: Option<String>,
    /// Refuse extensions.
    #[serde(default)]
    pub strict: bool,
    /// Codes that are allowed.
    #[serde(default)]
    pub allow: Vec<String>,
    /// Levels by code, `all` or `profile`, as in a machine.toml.
    #[serde(default)]
    pub levels: BTreeMap<String, String>,
    /// The expected NC program.
    pub expect: Option<String>,
    /// The expected listing.
    pub listing: Option<String>,
    /// The unit of a CL file without UNITS: `mm` or `inch`.
    #[serde(default, deserialize_with = "unit")]
    pub units: Option<Unit>,
    /// Largest difference of a length or an angle that still counts as equal; with it, or with
    /// `ignore`, programs are compared as a control reads them.
    pub tolerance: Option<f64>,
    /// What that comparison leaves out: `n`, `comments`, `dates`, `points`, letters.
    #[serde(default)]
    pub ignore: Vec<String>,
    /// X of that comparison is written as a diameter.
    #[serde(default)]
    pub diameter: bool,
    /// The code that must come when the input is to be refused.
    pub expect_error: Option<String>,
    /// Codes of the warnings that must come.
    #[serde(default)]
    pub expect_warnings: Vec<String>,
    /// Where the error, or the first of the warnings expected, must point:
    /// `file:line`, the file without its folder.
    pub expect_at: Option<String>,
    /// Most loop passes, calls and reads of a section.
    pub fuel: Option<u64>,
    /// What `filpost simulate` cuts: the keys of a setup file.
    #[serde(default, deserialize_with = "setup")]
    pub simulate: Option<Setup>,
    /// Who published it, and where each part comes from.
    pub origin: String,
    /// What was repaired against the print.
    #[serde(default)]
    pub repairs: Vec<String>,
}

/// A dialect by its name.
fn dialect<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<ClDialect>, D::Error> {
    let name = String::deserialize(deserializer)?;
    name.parse().map(Some).map_err(D::Error::custom)
}

/// Stock, part and tools.
fn setup<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Setup>, D::Error> {
    let table = toml::Table::deserialize(deserializer)?;
    Setup::of_table(&table)
        .map(Some)
        .map_err(|what| D::Error::custom(format!("[simulate]: {what}")))
}

/// Values of options: a text, a number, true or false.
fn options<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, String>, D::Error> {
    let table = toml::Table::deserialize(deserializer)?;
    let shown = |value: toml::Value| match value {
        toml::Value::String(text) => text,
        other => other.to_string(),
    };
    Ok(table.into_iter().map(|(name, value)| (name, shown(value))).collect())
}

impl CaseFile {
    /// Names of the files that a run reads.
    fn inputs(&self) -> impl Iterator<Item = &String> {
        let named = [Some(&self.cl), self.machine.as_ref(), self.option_file.as_ref()];
        named.into_iter().flatten().chain(&self.fil).chain(&self.compat)
    }

    /// Names as written on Windows, for every system: `/` between folders.
    fn use_slashes(&mut self) {
        let named = [&mut self.machine, &mut self.option_file, &mut self.compat, &mut self.read];
        let named = named.into_iter().chain([&mut self.expect, &mut self.listing]).flatten();
        for name in named.chain([&mut self.cl]).chain(&mut self.fil) {
            *name = name.replace('\\', "/");
        }
    }

    /// Refuses an expected file, which an update writes, outside of the folder of the case,
    /// in place of an input, or under a name that Windows does not allow; the text is what
    /// is wrong.
    fn refuse_written_names(&self) -> Result<(), String> {
        let tidy = |name: &String| -> PathBuf {
            Path::new(name).components().filter(|part| *part != Component::CurDir).collect()
        };
        let inputs: Vec<PathBuf> = self.inputs().map(tidy).collect();
        let written = [("expect", &self.expect), ("listing", &self.listing)];
        for (key, name) in written.into_iter().filter_map(|(key, name)| Some((key, name.as_ref()?)))
        {
            let path = tidy(name);
            if path.components().any(|part| !matches!(part, Component::Normal(_))) {
                return Err(format!("{key} = \"{name}\" leads out of the folder of the case"));
            }
            if let Some(fault) = name.split('/').find_map(file_names::fault) {
                return Err(format!("{key} = \"{name}\": {fault}"));
            }
            // Case is no difference on many disks.
            let is =
                |input: &Path| file_names::alike(&input.to_string_lossy(), &path.to_string_lossy());
            if inputs.iter().any(|input| is(input)) || is(Path::new("case.toml")) {
                return Err(format!("{key} = \"{name}\" is what the case reads"));
            }
        }
        match (&self.expect, &self.listing) {
            (Some(one), Some(two)) if tidy(one) == tidy(two) => {
                Err(format!("expect and listing are one file, \"{one}\""))
            }
            _ => Ok(()),
        }
    }

    /// How the NC programs are compared; the text is what is wrong with it.
    fn comparison(&self) -> Result<diff::Options, String> {
        let tolerance = self.tolerance.unwrap_or(0.0);
        if !tolerance.is_finite() || tolerance < 0.0 {
            return Err(format!("tolerance = {tolerance} is no length"));
        }
        let mut ignore = diff::Ignore::default();
        for entry in &self.ignore {
            ignore.add(entry).map_err(|entry| {
                format!("ignore: `{entry}` is not n, comments, dates, points, spaces or a letter")
            })?;
        }
        Ok(diff::Options { tolerance, ignore, diameter: self.diameter, ..Default::default() })
    }
}

/// A unit by its name.
fn unit<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<Unit>, D::Error> {
    let name = String::deserialize(deserializer)?;
    let wrong = || D::Error::custom(format!("units is mm or inch, not `{name}`"));
    unit_named(&name).map(Some).ok_or_else(wrong)
}

/// A case folder.
#[derive(Clone, Debug)]
pub struct Case {
    /// The folder.
    pub folder: PathBuf,
    /// Its file.
    pub file: CaseFile,
}

/// All case folders below a folder, sorted.
///
/// # Errors
/// A `case.toml` that can't be read.
pub fn find(folder: &Path) -> Result<Vec<Case>, Error> {
    let mut cases = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        if folder.join("case.toml").is_file() {
            cases.push(Case::load(&folder)?);
        }
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        let below = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir());
        folders.extend(below.filter(|path| !leads_back(path)));
    }
    cases.sort_by(|a, b| a.folder.cmp(&b.folder));
    Ok(cases)
}

/// True for a link to a folder that it lies in.
fn leads_back(path: &Path) -> bool {
    let real = || Some((path.canonicalize().ok()?, path.parent()?.canonicalize().ok()?));
    path.is_symlink() && real().is_some_and(|(real, from)| from.starts_with(real))
}

impl Case {
    /// Reads a case folder.
    ///
    /// # Errors
    /// E0705 for a `case.toml` that is missing or wrong.
    pub fn load(folder: &Path) -> Result<Case, Error> {
        let path = folder.join("case.toml");
        let text = files::read_text(&path, None)?;
        let wrong = |message: String, range: Range<usize>| {
            let index = fil_diag::LineIndex::new(&text);
            let place = index.place(&path.display().to_string(), &text, range);
            Error::setup(Diag::new(RunCode::CaseFile, message).at(place))
        };
        let mut file: CaseFile = toml::from_str(&text)
            .map_err(|error| wrong(error.message().to_string(), error.span().unwrap_or(0..0)))?;
        file.use_slashes();
        file.comparison().map_err(|message| wrong(message, 0..0))?;
        file.refuse_written_names().map_err(|message| wrong(message, 0..0))?;
        Ok(Case { folder: folder.to_path_buf(), file })
    }

    /// The files of the case, those that are compared too.
    pub fn files(&self) -> Vec<PathBuf> {
        let expected = self.file.expect.iter().chain(&self.file.listing);
        let named = self.file.inputs().chain(expected).map(|name| self.folder.join(name));
        named.chain([self.folder.join("case.toml")]).collect()
    }

    /// The files that a run of the case reads: its own, and those that its FIL includes.
    pub fn inputs(&self, program: &Program) -> Vec<PathBuf> {
        let named = self.file.inputs().map(|name| self.folder.join(name));
        let fil = program.fil_files().into_iter().map(PathBuf::from);
        named.chain([self.folder.join("case.toml")]).chain(fil).collect()
    }

    /// Refuses a case whose expected file is one that its run reads, by whatever name.
    fn refuse_over(&self, inputs: &[PathBuf]) -> Result<(), Error> {
        let inputs: Vec<PathBuf> = inputs.iter().map(|path| files::real_path(path)).collect();
        for name in self.file.expect.iter().chain(&self.file.listing) {
            if inputs.contains(&files::real_path(&self.folder.join(name))) {
                let message = format!("{name} is to be compared, and is what the case reads");
                return Err(Error::setup(Diag::new(RunCode::CaseFile, message)));
            }
        }
        Ok(())
    }

    /// The program of the case.
    ///
    /// # Errors
    /// As [`crate::Builder::build`]; files that can't be read.
    pub fn program(&self) -> Result<Program, Error> {
        Recipe::of(self)?.build()
    }

    /// The program of the case with unsaved texts in place of its machine, its FIL files and
    /// what they include.
    ///
    /// # Errors
    /// As [`Case::program`].
    pub fn program_with(&self, unsaved: &Unsaved) -> Result<Program, Error> {
        Recipe::with_unsaved(self, unsaved)?.build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loaded(lines: &str) -> Result<Case, Error> {
        let folder = tempfile::tempdir().unwrap();
        let text = format!("origin = 'made here'\n{lines}");
        std::fs::write(folder.path().join("case.toml"), text).unwrap();
        Case::load(folder.path())
    }

    #[test]
    fn a_case_written_on_windows_names_its_files_on_every_system() {
        let lines =
            "cl = '..\\cl\\part.ncl'\r\nfil = ['..\\post.fil']\r\nexpect = 'out\\part.nc'\r\n";
        let file = loaded(lines).unwrap().file;
        assert_eq!((&*file.cl, &*file.fil[0]), ("../cl/part.ncl", "../post.fil"));
        assert_eq!(file.expect.as_deref(), Some("out/part.nc"));
    }

    #[test]
    fn an_expected_file_has_a_name_of_every_system_in_its_folder() {
        for name in ["..\\part.nc", "NUL", "out/com1.nc", "part.", "a?.nc"] {
            let refused = loaded(&format!("cl = 'part.ncl'\nexpect = '{name}'\n")).unwrap_err();
            assert_eq!(refused.diags()[0].code.name(), "E0705", "{name}");
        }
    }
}
