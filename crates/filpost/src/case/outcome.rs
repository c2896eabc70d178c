//! A case run and compared.

use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use fil_cl::reader;
use fil_diag::Diag;
use fil_machine::locations::Location;
use fil_nc::diff;
use fil_nc::source::Source;
use fil_text::CodePage;

use super::recipe::Recipe;
use super::{Case, CaseFile, Programs, unified};
use crate::audit::Audit;
use crate::debug::SharedDebugger;
use crate::error::Error;
use crate::files;
use crate::listing::Listing;
use crate::map::Names;
use crate::pending::{NewFile, PendingFiles};
use crate::program::Program;
use crate::run::Run;

/// Sentences about a difference that are shown.
const MOST: usize = 20;

/// How a case ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As expected.
    Passed,
    /// Not as expected; the text says how.
    Failed(String),
    /// The expected files were written anew; the text is what changed.
    Updated(String),
}

/// An expected file that this run would write otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fresh {
    /// The file.
    pub path: PathBuf,
    /// The folder of the case, out of which nothing is written.
    pub folder: PathBuf,
    /// What stands there now.
    pub expected: String,
    /// What this run wrote.
    pub text: Vec<u8>,
    /// What changes, as a diff of lines.
    pub changes: String,
}

/// A case that was run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// What is not as expected; `None` for a case that passed.
    pub failure: Option<String>,
    /// The NC program of this run; `None` when the input was refused.
    pub nc: Option<String>,
    /// The proven NC program, where the case has one.
    pub wanted: Option<String>,
    /// What this run's program does otherwise, in a machinist's words.
    pub differences: Vec<String>,
    /// Expected files that differ. A case that failed for another reason has none.
    pub fresh: Vec<Fresh>,
    /// Files that the run has read; none when the input was refused.
    pub reads: Vec<PathBuf>,
}

/// What a case's run wrote.
struct Ran {
    nc: Vec<u8>,
    /// The encoding of the program.
    page: CodePage,
    listing: Option<Vec<u8>>,
    warnings: Vec<Diag>,
    reads: Vec<PathBuf>,
}

impl Outcome {
    fn failed(why: impl Into<String>) -> Outcome {
        Outcome { failure: Some(why.into()), ..Outcome::default() }
    }

    /// Writes the expected files as this run wrote them.
    ///
    /// # Errors
    /// E0702
    pub fn update(&self) -> Result<(), Error> {
        let mut pending = PendingFiles::default();
        self.update_with(&mut pending)?;
        pending.commit()
    }

    /// The same, beside their places: they appear with the files that are added otherwise.
    ///
    /// # Errors
    /// E0702
    pub fn update_with(&self, pending: &mut PendingFiles) -> Result<(), Error> {
        for fresh in &self.fresh {
            let cant = |error| files::cant_write(&fresh.path, &error);
            let name = fresh.path.strip_prefix(&fresh.folder).unwrap_or(&fresh.path);
            let mut file = NewFile::create_below(&fresh.folder, name)?;
            file.write_all(&fresh.text).map_err(cant)?;
            pending.add(file);
        }
        Ok(())
    }
}

impl Case {
    /// Posts the case's CL file. The second part are all warnings.
    ///
    /// # Errors
    /// As [`Case::program`] and [`crate::Run::stream`].
    pub fn run(&self) -> Result<(Vec<u8>, Vec<Diag>), Error> {
        self.run_whole(&self.program()?, None).map(|ran| (ran.nc, ran.warnings))
    }

    /// Runs the case and compares; with `update` the expected files are written anew.
    pub fn check(&self, update: bool) -> Verdict {
        let outcome = self.outcome();
        let Some(failure) = &outcome.failure else { return Verdict::Passed };
        if !update || outcome.fresh.is_empty() {
            return Verdict::Failed(failure.clone());
        }
        match outcome.update() {
            Ok(()) => Verdict::Updated(failure.clone()),
            Err(error) => Verdict::Failed(error.to_string()),
        }
    }

    /// Runs the case and compares what it wrote with what is expected.
    pub fn outcome(&self) -> Outcome {
        self.outcome_of(self.program())
    }

    /// The same, with a program that other cases may use as well.
    pub fn outcome_with(&self, programs: &Programs) -> Outcome {
        self.outcome_of(programs.get(self))
    }

    /// The same, with a debugger that looks on; of FIL it is told in programs
    /// [for debugging](Programs::for_debugging).
    pub fn outcome_debugged(&self, programs: &Programs, debugger: &SharedDebugger) -> Outcome {
        let ran = programs.get(self).and_then(|program| self.run_whole(&program, Some(debugger)));
        self.judge(ran)
    }

    /// The outcome with another text for one of its FIL files.
    pub fn outcome_with_text(&self, name: &str, text: String) -> Outcome {
        self.outcome_of(Recipe::of(self).and_then(|recipe| recipe.with_change(name, text).build()))
    }

    /// The outcome with a setting of the machine at its default.
    pub fn outcome_without(&self, programs: &Programs, setting: &Location) -> Outcome {
        self.outcome_of(programs.get(self).and_then(|program| program.without(setting)))
    }

    fn outcome_of(&self, program: Result<Program, Error>) -> Outcome {
        self.judge(program.and_then(|program| self.run_whole(&program, None)))
    }

    /// Compares what came of a run with what is expected.
    fn judge(&self, ran: Result<Ran, Error>) -> Outcome {
        match (ran, &self.file.expect_error) {
            (Err(error), Some(code)) => self
                .expect_code(code, error.diags(), true)
                .map_or_else(Outcome::default, |missing| {
                    Outcome::failed(format!("{missing}\n{error}"))
                }),
            (Err(error), None) => Outcome::failed(error.to_string()),
            (Ok(_), Some(code)) => Outcome::failed(format!("expected {code}, but it was posted")),
            (Ok(ran), None) => self.compare(&ran),
        }
    }

    /// The CL file of the case.
    ///
    /// # Errors
    /// E0701
    pub fn cl_text(&self) -> Result<Vec<u8>, Error> {
        files::read(&self.folder.join(&self.file.cl))
    }

    /// A run of a program that reads CL text as the case says.
    pub fn start<'o>(&self, program: &Program) -> Run<'o> {
        let CaseFile { dialect, raw_records: raw, .. } = self.file;
        let reading = reader::Options { dialect, raw, ..reader::Options::default() };
        let run = program.start().cl_name(&self.file.cl).cl_options(reading);
        match self.file.units {
            Some(unit) => run.units(unit),
            None => run,
        }
    }

    /// Posts the case's CL file and audits the program, which is given too.
    ///
    /// # Errors
    /// As [`Run::stream`] and [`Run::audit`].
    pub fn audit(&self, program: &Program) -> Result<(Audit, Vec<u8>), Error> {
        let cl = self.cl_text()?;
        let names = Names { fil: program.fil_files(), ..Names::default() };
        let (mut nc, mut map) = (Vec::new(), Vec::new());
        self.start(program).run_mapped(Cursor::new(&cl), &mut nc, &names, &mut map)?;
        let source = (&Source::memory(&nc), "the program of the case");
        let audit = self.start(program).audit(&cl[..], source, &mut Cursor::new(map))?;
        Ok((audit, nc))
    }

    fn run_whole(
        &self,
        program: &Program,
        debugger: Option<&SharedDebugger>,
    ) -> Result<Ran, Error> {
        let cl = self.cl_text()?;
        let (mut nc, mut listing) = (Vec::new(), Listing::new(Vec::new()));
        let mut run = self.start(program);
        if let Some(debugger) = debugger {
            run = run.debug(debugger);
        }
        if self.file.listing.is_some() {
            run = run.observe(listing.observer());
        }
        let report = run.stream_seekable(Cursor::new(cl), &mut nc)?;
        let mut reads = self.inputs(program);
        reads.extend(report.script_reads);
        self.refuse_over(&reads)?;
        let warnings = program.warnings().iter().cloned().chain(report.warnings).collect();
        // A listing in memory can't fail.
        let listing = self.file.listing.as_ref().and_then(|_| listing.finish().ok());
        Ok(Ran { nc, page: program.nc_page(), listing, warnings, reads })
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

    fn compare(&self, ran: &Ran) -> Outcome {
        let mut outcome = Outcome {
            nc: Some(ran.page.decode_all(&ran.nc).into_owned()),
            reads: ran.reads.clone(),
            ..Outcome::default()
        };
        for (index, code) in self.file.expect_warnings.iter().enumerate() {
            if let Some(missing) = self.expect_code(code, &ran.warnings, index == 0) {
                let found: Vec<String> = ran.warnings.iter().map(Diag::to_string).collect();
                outcome.failure = Some(format!("{missing}\n{}", found.join("\n")));
                return outcome;
            }
        }
        if let Some(name) = &self.file.expect {
            match expected(&self.folder.join(name), ran.page) {
                Ok(wanted) => self.compare_programs(name, wanted, ran, &mut outcome),
                Err(error) => return Outcome::failed(error.to_string()),
            }
        }
        if let (Some(name), Some(text)) = (&self.file.listing, &ran.listing) {
            match expected(&self.folder.join(name), CodePage::UTF_8) {
                Ok(wanted) if wanted == String::from_utf8_lossy(text) => {}
                Ok(wanted) => {
                    let shown = String::from_utf8_lossy(text);
                    outcome.differs((&self.folder, name), &wanted, (text, &shown), &[]);
                }
                Err(error) => return Outcome::failed(error.to_string()),
            }
        }
        outcome
    }

    fn compare_programs(&self, name: &str, wanted: String, ran: &Ran, outcome: &mut Outcome) {
        let by_words = self.file.tolerance.is_some() || !self.file.ignore.is_empty();
        let shown = same_line_ends(&ran.page.decode_all(&ran.nc));
        if wanted != shown {
            let (file, found) = ((&*self.folder, name), (&ran.nc[..], &*shown));
            match self.sentences(&wanted, &shown) {
                Ok(sentences) if by_words && sentences.is_empty() => {}
                Ok(sentences) if sentences.is_empty() => {
                    let alike = ["a control reads both alike".to_string()];
                    outcome.differs(file, &wanted, found, &alike);
                }
                Ok(sentences) => {
                    outcome.differs(file, &wanted, found, &sentences);
                    outcome.differences = sentences;
                }
                // What can't be read as words is still a difference of letters.
                Err(_) => outcome.differs(file, &wanted, found, &[]),
            }
        }
        outcome.wanted = Some(wanted);
    }

    /// What the program of this run does otherwise than the proven one.
    fn sentences(&self, wanted: &str, nc: &str) -> Result<Vec<String>, Box<Diag>> {
        // Case::load has looked at what is set.
        let options = self.file.comparison().unwrap_or_default();
        let name = self.file.expect.as_deref().unwrap_or_default();
        let first = diff::read(wanted.as_bytes(), name, &options)?;
        let second = diff::read(nc.as_bytes(), "this run", &options)?;
        let found = diff::compare(&first, &second, &options)?.differences;
        Ok(found.iter().map(|one| diff::sentence(one, &first, &second)).collect())
    }
}

impl Outcome {
    /// Notes an expected file that this run wrote otherwise.
    fn differs(
        &mut self,
        (folder, name): (&Path, &str),
        wanted: &str,
        (found, shown): (&[u8], &str),
        sentences: &[String],
    ) {
        let changes = unified::difference(name, wanted, shown);
        let failure = self.failure.get_or_insert_default();
        failure.push_str(&changes);
        for sentence in sentences.iter().take(MOST) {
            failure.push_str(sentence);
            failure.push('\n');
        }
        if let Some(more) = sentences.len().checked_sub(MOST).filter(|more| *more > 0) {
            failure.push_str(&format!("and {more} more\n"));
        }
        let (path, folder) = (folder.join(name), folder.to_path_buf());
        let (expected, text) = (wanted.to_string(), found.to_vec());
        self.fresh.push(Fresh { path, folder, expected, text, changes });
    }
}

/// The text of an expected file; empty when it is not there yet.
fn expected(path: &Path, page: CodePage) -> Result<String, Error> {
    if !path.exists() {
        return Ok(String::new());
    }
    let text = if page.is_utf8() {
        files::read_text(path, None)?
    } else {
        page.decode_all(&files::read(path)?).into_owned()
    };
    Ok(same_line_ends(&text))
}

/// A text with LF: how the lines of a file end also depends on how it was checked out.
fn same_line_ends(text: &str) -> String {
    text.replace("\r\n", "\n")
}

/// The primary place of a diagnostic as `file:line`, the file without its folder.
fn place_in_case(diag: &Diag) -> Option<String> {
    let place = diag.spans.first()?;
    let file = Path::new(&place.file).file_name()?.to_string_lossy();
    Some(format!("{file}:{}", place.line))
}
