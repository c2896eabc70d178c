//! The one door from the judges of this member to the post: a CL text and a
//! machine go in, the program or the refusal comes out.

use filpost::{Diag, Error, Program};

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
#[derive(Clone, Debug, PartialEq)]
pub struct Posted {
    /// The NC program.
    pub nc: String,
    /// Warnings, those of building first, as code and message.
    pub warnings: Vec<String>,
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
    let program = build(job).map_err(refused)?;
    let mut warnings: Vec<String> = program.warnings().iter().map(Diag::to_string).collect();
    let mut nc = Vec::new();
    let report = program.run(job.cl.as_bytes(), &mut nc).map_err(refused)?;
    warnings.extend(report.warnings.iter().map(Diag::to_string));
    Ok(Posted { nc: String::from_utf8_lossy(&nc).into_owned(), warnings })
}

fn build(job: &Job) -> Result<Program, Error> {
    let mut builder = match &job.machine {
        Machine::Ready(name) => Program::builder().ready(name),
        Machine::Toml(text) => Program::builder().machine("machine.toml", text),
        Machine::OptionFile(text) => Program::builder().option_file("uncx01.p01", text),
    };
    for setting in &job.settings {
        builder = builder.set(setting);
    }
    for (name, text) in &job.fil {
        builder = builder.fil(name, text);
    }
    builder.build()
}

fn refused(error: Error) -> Refused {
    let code = error.diags().first().map_or_else(String::new, |diag| diag.code.name());
    Refused { code, message: error.to_string() }
}
