//! The machine of a request, and what it reads of files.

use filpost::{Builder, Program};

use crate::Misuse;
use crate::fields::{Fields, Named};

/// Which machine: a ready post, a `machine.toml`, an option file, settings and options on top.
pub(crate) struct MachineOf {
    ready: Option<String>,
    machine: Option<Named>,
    option_file: Option<Named>,
    set: Vec<String>,
    options: Vec<(String, String)>,
}

impl MachineOf {
    pub fn read(fields: &mut Fields) -> Result<Self, Misuse> {
        Ok(MachineOf {
            ready: fields.text("ready")?,
            machine: fields.file("machine")?,
            option_file: fields.file("option_file")?,
            set: fields.texts("set")?,
            options: fields.named_values("options")?,
        })
    }

    /// A builder with this machine.
    pub fn builder(&self) -> Builder {
        let mut builder = Program::builder();
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
        for (name, value) in &self.options {
            builder = builder.option(name, value);
        }
        builder
    }
}
