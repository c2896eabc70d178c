//! Regression cases: a folder with `case.toml`, a CL file, a post and the NC
//! program it must give.
//!
//! `case.toml`: `cl`; `ready`, `machine` (machine.toml) or `option_file`; `fil` (a file or a
//! list); `set` (list of `key=value`); `compat`; `strict`; `read` (a folder for scripts);
//! `clock`; `expect` (NC file) or `expect_error` (code); `expect_warnings`; `expect_at`
//! (`file:line` of the error or of the first warning expected); `origin` and `repairs` for
//! people.

use std::path::{Path, PathBuf};

use fil_diag::Diag;
use fil_vm::Moment;
use serde::Deserialize;
use similar::TextDiff;

use crate::builder::Post;
use crate::error::{Error, RunCode};
use crate::files;
use crate::granted::Clock;
use crate::includes;

/// The text of a `case.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// The CL file.
    pub cl: String,
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
    /// A compat file.
    pub compat: Option<String>,
    /// A folder that scripts may read.
    pub read: Option<String>,
    /// The moment of DATEF and TIMEF, as `2026-01-31T12:00:00`.
    pub clock: Option<String>,
    /// Refuse extensions.
    #[serde(default)]
    pub strict: bool,
    /// The expected NC program.
    pub expect: Option<String>,
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
    /// Who published it, and where each part comes from.
    pub origin: String,
    /// What was repaired against the print.
    #[serde(default)]
    pub repairs: Vec<String>,
}

/// A case folder.
#[derive(Clone, Debug)]
pub struct Case {
    /// The folder.
    pub folder: PathBuf,
    /// Its file.
    pub file: CaseFile,
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As expected.
    Passed,
    /// Not as expected; the text says how.
    Failed(String),
    /// The expected file was written anew; the text is what changed.
    Updated(String),
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
        folders.extend(entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()));
    }
    cases.sort_by(|a, b| a.folder.cmp(&b.folder));
    Ok(cases)
}

impl Case {
    /// Reads a case folder.
    ///
    /// # Errors
    /// E0705 for a `case.toml` that is missing or wrong.
    pub fn load(folder: &Path) -> Result<Case, Error> {
        let path = folder.join("case.toml");
        let text = files::read_text(&path, None)?;
        let file = toml::from_str(&text).map_err(|error| {
            let index = fil_diag::LineIndex::new(&text);
            let range = error.span().unwrap_or(0..0);
            let place = index.place(&path.display().to_string(), &text, range);
            Error::setup(Diag::new(RunCode::CaseFile, error.message().to_string()).at(place))
        })?;
        Ok(Case { folder: folder.to_path_buf(), file })
    }

    /// The post of the case.
    ///
    /// # Errors
    /// As [`crate::Builder::build`]; files that can't be read.
    pub fn post(&self) -> Result<Post, Error> {
        let text = |name: &str| files::read_text(&self.folder.join(name), None);
        let mut builder = Post::builder().strict(self.file.strict);
        if let Some(name) = &self.file.ready {
            builder = builder.ready(name);
        }
        if let Some(name) = &self.file.machine {
            builder = builder.machine(name, &text(name)?);
        }
        if let Some(name) = &self.file.option_file {
            builder = builder.option_file(name, &text(name)?);
        }
        let mut paths = Vec::new();
        for name in &self.file.fil {
            let path = self.folder.join(name);
            builder = builder.fil(&path.display().to_string(), &text(name)?);
            paths.push(path);
        }
        builder = builder.includes(includes::beside(&paths, None));
        if let Some(folder) = &self.file.read {
            builder = builder.grant_read(self.folder.join(folder));
        }
        if let Some(text) = &self.file.clock {
            let moment = Moment::parse(text).ok_or_else(|| {
                let message = format!("clock = '{text}' is no moment as 2026-01-31T12:00:00");
                Error::setup(Diag::new(RunCode::CaseFile, message))
            })?;
            builder = builder.clock(Clock::Fixed(moment));
        }
        for setting in &self.file.set {
            builder = builder.set(setting);
        }
        if let Some(name) = &self.file.compat {
            let compat = crate::read_compat(name, &text(name)?).map_err(Error::setup)?;
            builder = builder.compat(compat);
        }
        if let Some(fuel) = self.file.fuel {
            builder = builder.limits(crate::Limits { fuel, ..crate::Limits::default() });
        }
        builder.cl_name(&self.file.cl).build()
    }

    /// Posts the case's CL file. The second part are the codes of all warnings.
    ///
    /// # Errors
    /// As [`Case::post`] and [`Post::run`].
    pub fn run(&self) -> Result<(Vec<u8>, Vec<Diag>), Error> {
        let mut post = self.post()?;
        let cl = files::read(&self.folder.join(&self.file.cl))?;
        let mut nc = Vec::new();
        let report = post.run_seekable(std::io::Cursor::new(cl), &mut nc)?;
        let warnings = post.warnings().iter().cloned().chain(report.warnings).collect();
        Ok((nc, warnings))
    }

    /// Runs the case and compares; with `update` the expected file is written anew.
    pub fn check(&self, update: bool) -> Verdict {
        match (self.run(), &self.file.expect_error) {
            (Err(error), Some(code)) => self
                .expect_code(code, error.diags(), true)
                .map_or(Verdict::Passed, |missing| Verdict::Failed(format!("{missing}\n{error}"))),
            (Err(error), None) => Verdict::Failed(error.to_string()),
            (Ok(_), Some(code)) => Verdict::Failed(format!("expected {code}, but it was posted")),
            (Ok((nc, warnings)), None) => self.compare(&nc, &warnings, update),
        }
    }

    /// What is missing, when none of the diagnostics has this code at the place expected.
    fn expect_code(&self, code: &str, diags: &[Diag], placed: bool) -> Option<String> {
        let mut of_code = diags.iter().filter(|diag| diag.code.name() == code).peekable();
        if of_code.peek().is_none() {
            return Some(format!("expected {code}, got:"));
        }
        let at = self.file.expect_at.as_ref().filter(|_| placed)?;
        let mut places = of_code.map(place_in_case);
        (!places.any(|place| place.as_ref() == Some(at)))
            .then(|| format!("expected {code} at {at}, got:"))
    }

    fn compare(&self, nc: &[u8], warnings: &[Diag], update: bool) -> Verdict {
        for (index, code) in self.file.expect_warnings.iter().enumerate() {
            if let Some(missing) = self.expect_code(code, warnings, index == 0) {
                let found: Vec<String> = warnings.iter().map(Diag::to_string).collect();
                return Verdict::Failed(format!("{missing}\n{}", found.join("\n")));
            }
        }
        let Some(expect) = &self.file.expect else { return Verdict::Passed };
        let path = self.folder.join(expect);
        let found = String::from_utf8_lossy(nc);
        let wanted = match files::read_text(&path, None) {
            Ok(text) => text.replace("\r\n", "\n"),
            Err(_) if update => String::new(),
            Err(error) => return Verdict::Failed(error.to_string()),
        };
        if wanted == found {
            return Verdict::Passed;
        }
        let changes = TextDiff::from_lines(wanted.as_str(), &found)
            .unified_diff()
            .header(expect, "this run")
            .to_string();
        if !update {
            return Verdict::Failed(changes);
        }
        match std::fs::write(&path, nc) {
            Ok(()) => Verdict::Updated(changes),
            Err(error) => Verdict::Failed(format!("{}: {error}", path.display())),
        }
    }
}

/// The primary place of a diagnostic as `file:line`, the file without its folder.
fn place_in_case(diag: &Diag) -> Option<String> {
    let place = diag.places.first()?;
    let file = Path::new(&place.file).file_name()?.to_string_lossy();
    Some(format!("{file}:{}", place.line))
}
