//! The drawing of a program that was posted.

use std::collections::HashMap;

use filpost::Error;
use filpost::nc::plot::{LineCause, html};
use filpost::plot::{self, Text};
use serde_json::{Value, json};

use crate::fields::{Fields, Named};
use crate::machine::MachineOf;
use crate::{Fault, Misuse, refused};

/// A request to draw: the machine, the program and the `origins` of the answer that brought
/// it, and the texts that they are lines of.
pub(crate) struct Plot {
    machine: MachineOf,
    nc: String,
    origins: Vec<Value>,
    cl: String,
    cl_name: String,
    fil: Vec<Named>,
}

impl Plot {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let plot = Plot {
            machine: MachineOf::read(&mut fields)?,
            nc: fields.needed("nc")?,
            origins: fields.list("origins")?,
            cl: fields.text("cl")?.unwrap_or_default(),
            cl_name: fields.text("cl_name")?.unwrap_or_else(|| "part.ncl".to_string()),
            fil: fields.files("fil")?,
        };
        fields.end()?;
        Ok(plot)
    }

    /// The answer: `page`, or `errors`.
    pub fn draw(&self) -> Value {
        match self.page() {
            Ok(page) => json!({ "page": page }),
            Err(error) => refused(&Fault::Setup(error), &[]),
        }
    }

    /// The page with the path of the program, whose lines name what made them.
    fn page(&self) -> Result<String, Error> {
        let commons = self.machine.builder().build_machine()?;
        let nc = filpost::tape_style::page(&commons).encode(&self.nc);
        let bytes = nc.as_deref().unwrap_or(self.nc.as_bytes());
        let text = Text { name: "the program", bytes };
        let mut drawing = plot::program(text, &commons)?;
        let notes = &mut drawing.notes;
        notes.source_name.clone_from(&self.cl_name);
        notes.source = Some(self.cl.clone());
        let mut numbers = HashMap::new();
        for origin in &self.origins {
            let line = origin[0].as_u64().unwrap_or(0) as u32;
            let stack = *numbers.entry(origin[2].to_string()).or_insert_with(|| {
                let stack = self.stack(&origin[2]);
                if stack.is_empty() {
                    return 0;
                }
                notes.stacks.push(stack);
                notes.stacks.len() as u32
            });
            notes.causes.push(LineCause { line, stack });
        }
        Ok(html(&drawing))
    }

    /// The FIL lines of a block, innermost first.
    fn stack(&self, fil: &Value) -> String {
        let lines = fil.as_array().into_iter().flatten().filter_map(|at| {
            let (name, line) = (at[0].as_str()?, at[1].as_u64()?);
            let file = self.fil.iter().find(|file| file.name == name)?;
            let text = file.text.lines().nth(usize::try_from(line).ok()?.checked_sub(1)?)?;
            Some(format!("{name}:{line}  {}", text.trim()))
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}
