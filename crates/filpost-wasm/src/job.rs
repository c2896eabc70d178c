//! What is posted: CL text, machine, FIL, and how they are read.

use std::collections::HashMap;

use filpost::cl::reader;
use filpost::{Builder, Clock, Diag, Error, Included, Limits, Moment, Program, Run, unit_named};

use crate::fields::{Fields, Named};
use crate::machine::MachineOf;
use crate::{Fault, Misuse};

/// A request to post. All but `cl` may be left out; the names are those of `case.toml`.
pub(crate) struct Job {
    /// The CL text.
    pub cl: String,
    /// Its name in messages.
    pub cl_name: String,
    machine: MachineOf,
    fil: Vec<Named>,
    /// What INCLUD may name, by the name it says.
    includes: Vec<Named>,
    compat: Option<Named>,
    strict: bool,
    allow: Vec<String>,
    levels: Vec<(String, String)>,
    clock: Option<String>,
    fuel: Option<u64>,
    dialect: Option<String>,
    raw_records: bool,
    units: Option<String>,
}

impl Job {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let job = Job {
            cl: fields.needed("cl")?,
            cl_name: fields.text("cl_name")?.unwrap_or_else(|| "part.ncl".to_string()),
            machine: MachineOf::read(&mut fields)?,
            fil: fields.files("fil")?,
            includes: fields.files("includes")?,
            compat: fields.file("compat")?,
            strict: fields.flag("strict")?,
            allow: fields.texts("allow")?,
            levels: fields.named_values("levels")?,
            clock: fields.text("clock")?,
            fuel: fields.number("fuel")?,
            dialect: fields.text("dialect")?,
            raw_records: fields.flag("raw_records")?,
            units: fields.text("units")?,
        };
        fields.end()?;
        Ok(job)
    }

    /// The program of machine and FIL.
    pub fn program(&self) -> Result<Program, Fault> {
        Ok(self.builder()?.build()?)
    }

    /// The machine alone; none where it can't be read.
    #[cfg(feature = "post")]
    pub fn machine(&self) -> Option<filpost::Commons> {
        self.machine.builder().build_machine().ok()
    }

    /// A builder with machine and FIL.
    pub fn builder(&self) -> Result<Builder, Fault> {
        let setup = |diag: Box<Diag>| Error::Setup(vec![*diag]);
        let mut builder = self.machine.builder().strict(self.strict);
        for name in &self.allow {
            builder = builder.allow(filpost::allowable(name).map_err(setup)?);
        }
        let levels = self.levels.iter().map(|(name, level)| (name.as_str(), level.as_str()));
        builder = builder.levels(&filpost::levels_named(levels).map_err(setup)?);
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
            let moment =
                Moment::parse(text).ok_or_else(|| Misuse(format!("clock: {text} is no moment")))?;
            builder = builder.clock(Clock::Fixed(moment));
        }
        Ok(self.with_includes(builder))
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
        let wrong = |what: &str, name: &str| Misuse(format!("{what}: there is no {name}"));
        let dialect = match &self.dialect {
            Some(name) => Some(name.parse().map_err(|_| wrong("dialect", name))?),
            None => None,
        };
        let reading =
            reader::Options { dialect, raw: self.raw_records, ..reader::Options::default() };
        let run = program.start().cl_name(&self.cl_name).cl_options(reading);
        match &self.units {
            Some(name) => Ok(run.units(unit_named(name).ok_or_else(|| wrong("units", name))?)),
            None => Ok(run),
        }
    }
}
