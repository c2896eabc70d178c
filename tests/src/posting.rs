//! The one door from the judges of this member to the post: a CL text and a
//! machine go in, the program or the refusal comes out.

use std::collections::BTreeMap;
use std::io::Cursor;

use fil_nc::verify::Allowed;
use filpost::listing::Listing;
use filpost::{Builder, Commons, Diag, Error, Event, Program, cl, includes};

use crate::{back_check, root};

/// Adds a script of the papers with this text, and the files that it includes.
pub fn with_script(builder: Builder, script: &str, text: &str) -> Builder {
    let path = root().join("fil-scripts/papers").join(script);
    let name = path.to_string_lossy().into_owned();
    builder.fil(&name, text).includes(includes::beside(&[path], None))
}

/// What is posted: a CL text with the machine it is for.
#[derive(Clone, Debug, Default)]
pub struct Job {
    /// Where the settings come from.
    pub machine: Machine,
    /// Settings on top, `key=value`.
    pub settings: Vec<String>,
    /// FIL files: name and text.
    pub fil: Vec<(String, String)>,
    /// The CL text.
    pub cl: String,
}

/// Where the settings of a job come from.
#[derive(Clone, Debug)]
pub enum Machine {
    /// A post inside the crate, by its name.
    Ready(String),
    /// The text of a `machine.toml`.
    Toml(String),
    /// The text of an option file.
    OptionFile(String),
}

impl Default for Machine {
    fn default() -> Self {
        Machine::Ready("fanuc-mill".into())
    }
}

/// A program and what was said about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Posted {
    /// The NC program.
    pub nc: String,
    /// Warnings, those of building first, as code and message without their places.
    pub warnings: Vec<String>,
    /// What stays off the tape and stands in the listing only.
    pub messages: Vec<String>,
    /// CL lines of the records for which a FIL section was run, and of those that it
    /// read on to.
    pub sections: Vec<usize>,
}

/// Why there is no program.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The code of the first error, such as E0503.
    pub code: String,
    /// The messages.
    pub message: String,
}

/// Posts a job.
///
/// # Errors
/// What the post refuses.
pub fn post(job: &Job) -> Result<Posted, Refused> {
    Prepared::new(job)?.post(&job.cl)
}

/// Posts a job and verifies its program; gives what is found wrong.
///
/// # Errors
/// The code by which the post refuses it.
pub fn verify(job: &Job) -> Result<Vec<String>, String> {
    let prepared = Prepared::new(job).map_err(|refused| refused.code)?;
    let posted = prepared.post(&job.cl).map_err(|refused| refused.code)?;
    Ok(prepared.verify(&job.cl, &posted.nc))
}

/// Verifies a program that a job did not make; gives what is found wrong.
///
/// # Errors
/// The code by which the machine is refused.
pub fn verify_nc(job: &Job, nc: &str) -> Result<Vec<String>, String> {
    Ok(Prepared::new(job).map_err(|refused| refused.code)?.verify(&job.cl, nc))
}

/// A machine with its scripts, for many CL texts.
pub struct Prepared {
    program: Program,
    reading: cl::reader::Options,
}

impl Prepared {
    /// A machine with its scripts.
    pub fn of(program: Program) -> Self {
        Prepared { program, reading: cl::reader::Options::default() }
    }

    /// Reads CL texts in a dialect; `None` recognizes it.
    pub fn with_dialect(mut self, dialect: Option<cl::ClDialect>) -> Self {
        self.reading.dialect = dialect;
        self
    }

    /// The machine and the scripts of a job.
    ///
    /// # Errors
    /// Settings or scripts that make no post.
    fn new(job: &Job) -> Result<Self, Refused> {
        let mut builder = match &job.machine {
            Machine::Ready(name) => Program::builder().generic(name),
            Machine::Toml(text) => Program::builder().machine("machine.toml", text),
            Machine::OptionFile(text) => Program::builder().option_file("uncx01.p01", text),
        };
        for setting in &job.settings {
            builder = builder.set(setting);
        }
        for (name, text) in &job.fil {
            builder = builder.fil(name, text);
        }
        builder.build().map(Prepared::of).map_err(refused)
    }

    /// The settings of the machine.
    pub fn commons(&self) -> &Commons {
        self.program.commons()
    }

    /// What is wrong with a program, or why it can't be read.
    pub fn verify(&self, cl: &str, nc: &str) -> Vec<String> {
        let found = back_check::check(self.commons(), cl, nc, Allowed::default());
        match found {
            Ok(report) => report.findings.iter().map(ToString::to_string).collect(),
            Err(diag) => vec![diag.to_string()],
        }
    }

    /// The listing of a CL text.
    ///
    /// # Errors
    /// What the post refuses.
    pub fn listing(&self, cl: &str) -> Result<String, Refused> {
        let mut listing = Listing::new(Vec::new());
        let run = self.program.start().cl_options(self.reading).observe(listing.observer());
        run.stream_seekable(Cursor::new(cl), &mut Vec::new()).map_err(refused)?;
        let text = listing.finish().expect("a listing in memory");
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    /// Posts a CL text.
    ///
    /// # Errors
    /// What the post refuses.
    pub fn post(&self, cl: &str) -> Result<Posted, Refused> {
        let mut posted = Posted::default();
        let mut nc = Vec::new();
        let mut lines = BTreeMap::new();
        let run = self.program.start().cl_options(self.reading).observe(|event| match event {
            Event::Record { record, .. } => {
                lines.insert(record.number, record.line as usize);
            }
            Event::Section { record, .. } => {
                posted.sections.extend(lines.range(record..).map(|l| l.1))
            }
            Event::Message(text) => posted.messages.push(text.to_string()),
            _ => {}
        });
        let report = run.stream_seekable(Cursor::new(cl), &mut nc).map_err(refused)?;
        posted.warnings =
            self.program.warnings().iter().chain(&report.warnings).map(said).collect();
        posted.nc = String::from_utf8_lossy(&nc).into_owned();
        Ok(posted)
    }
}

fn said(diag: &Diag) -> String {
    format!("{}: {}", diag.code.name(), diag.message)
}

fn refused(error: Error) -> Refused {
    let code = error.diags().first().map_or_else(String::new, |diag| diag.code.name());
    Refused { code, message: error.to_string() }
}
