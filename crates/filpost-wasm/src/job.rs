//! What is posted: CL text, machine, FIL, and how they are read.

use std::collections::HashMap;

use filpost::cl::reader;
use filpost::{Builder, Clock, Diag, Error, Included, Limits, Moment, Program, Run, unit_named};
use serde::Deserialize;

/// A file by its name for messages, and its text.
#[derive(Deserialize)]
pub(crate) struct Named {
    pub name: String,
    pub text: String,
}

/// A request to post. All but `cl` may be left out; the names are those of `case.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Job {
    /// The CL text.
    pub cl: String,
    /// Its name in messages.
    #[serde(default = "cl_name")]
    pub cl_name: String,
    ready: Option<String>,
    machine: Option<Named>,
    option_file: Option<Named>,
    #[serde(default)]
    fil: Vec<Named>,
    /// What INCLUD may name, by the name it says.
    #[serde(default)]
    includes: Vec<Named>,
    #[serde(default)]
    set: Vec<String>,
    compat: Option<Named>,
    #[serde(default)]
    strict: bool,
    #[serde(default)]
    allow: Vec<String>,
    clock: Option<String>,
    fuel: Option<u64>,
    dialect: Option<String>,
    #[serde(default)]
    raw_records: bool,
    units: Option<String>,
    /// The drawing of the program is wanted too, as a page.
    #[serde(default)]
    pub plot: bool,
}

fn cl_name() -> String {
    "part.ncl".into()
}

/// Why a job can't begin.
pub(crate) enum Fault {
    /// The post or one of its files is wrong.
    Setup(Error),
    /// The request is.
    Misuse(String),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Fault::Setup(error)
    }
}

impl Job {
    /// The program of machine and FIL.
    pub fn program(&self) -> Result<Program, Fault> {
        let setup = |diag: Box<Diag>| Error::Setup(vec![*diag]);
        let mut builder = Program::builder().strict(self.strict);
        for name in &self.allow {
            builder = builder.allow(filpost::allowable(name).map_err(setup)?);
        }
        if let Some(name) = &self.ready {
            builder = builder.ready(name);
        }
        if let Some(Named { name, text }) = &self.machine {
            builder = builder.machine(name, text);
        }
        if let Some(Named { name, text }) = &self.option_file {
            builder = builder.option_file(name, text);
        }
        for setting in &self.set {
            builder = builder.set(setting);
        }
        for Named { name, text } in &self.fil {
            builder = builder.fil(name, text);
        }
        if let Some(Named { name, text }) = &self.compat {
            builder = builder.compat(filpost::read_compat(name, text).map_err(setup)?);
        }
        if let Some(fuel) = self.fuel {
            builder = builder.limits(Limits { fuel, ..Limits::default() });
        }
        if let Some(text) = &self.clock {
            let moment = Moment::parse(text)
                .ok_or_else(|| Fault::Misuse(format!("clock: {text} is no moment")))?;
            builder = builder.clock(Clock::Fixed(moment));
        }
        Ok(self.with_includes(builder).build()?)
    }

    fn with_includes(&self, builder: Builder) -> Builder {
        let known: HashMap<String, String> =
            self.includes.iter().map(|file| (file.name.clone(), file.text.clone())).collect();
        builder.includes(move |_, name| match known.get(name) {
            Some(text) => Ok(Included { name: name.to_string(), text: text.clone() }),
            None => Err(format!("there is no {name} here")),
        })
    }

    /// A run that reads the CL text as the request says.
    pub fn start<'o>(&self, program: &Program) -> Result<Run<'o>, Fault> {
        let wrong = |what: &str, name: &str| Fault::Misuse(format!("{what}: there is no {name}"));
        let dialect = match &self.dialect {
            Some(name) => Some(name.parse().map_err(|_| wrong("dialect", name))?),
            None => None,
        };
        let reading =
            reader::Options { dialect, raw: self.raw_records, ..reader::Options::default() };
        let run = program.start().cl_name(&self.cl_name).reading(reading);
        match &self.units {
            Some(name) => Ok(run.units(unit_named(name).ok_or_else(|| wrong("units", name))?)),
            None => Ok(run),
        }
    }
}
