//! The drawing of a program that was posted.

use std::collections::HashMap;

use filpost::Commons;
use filpost::Error;
use filpost::cl::reader::Options;
use filpost::nc::plot::{Drawing, LineCause, base64, columns, html};
use filpost::plot::{self, ClText, Text};
use serde_json::{Value, json};

use crate::fields::{Fields, Named};
use crate::machine::MachineOf;
use crate::{Fault, Misuse, refused};

/// A request to draw: the machine, the program (a request for columns may leave it out) and the
/// `origins` of the answer that brought it, and the texts that they are lines of.
pub(crate) struct Plot {
    machine: MachineOf,
    nc: Option<String>,
    origins: Vec<Value>,
    cl: String,
    cl_name: String,
    fil: Vec<Named>,
}

impl Plot {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let plot = Plot {
            machine: MachineOf::read(&mut fields)?,
            nc: fields.text("nc")?,
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

    /// The answer: `columns`, the path as [`columns`] gives it, in base 64; or `errors`.
    pub fn columns(&self) -> Value {
        match self.path() {
            Ok(path) => json!({ "columns": base64(&columns(&path)) }),
            Err(error) => refused(&Fault::Setup(error), &[]),
        }
    }

    /// The path of the program, with the tools of the CL file; without a program that of the CL
    /// file.
    fn path(&self) -> Result<Drawing<'_>, Error> {
        let cl = ClText {
            text: Text { name: &self.cl_name, bytes: self.cl.as_bytes() },
            options: Options::default(),
            unit: None,
        };
        let Some(nc) = &self.nc else { return plot::cl_file(cl) };
        let commons = self.machine.builder().build_machine()?;
        let mut drawing = self.program(nc, &commons)?;
        // A program can be drawn without its CL file, whatever that one lacks.
        let _ = plot::take_tools(&mut drawing, cl, &commons);
        Ok(drawing)
    }

    fn program(&self, nc: &str, commons: &Commons) -> Result<Drawing<'static>, Error> {
        let encoded = filpost::tape_style::page(commons).encode(nc);
        let bytes = encoded.as_deref().unwrap_or(nc.as_bytes());
        Ok(plot::program(Text { name: "the program", bytes }, commons)?.into_owned())
    }

    /// The page with the path of the program, whose lines name what made them.
    fn page(&self) -> Result<String, Error> {
        let commons = self.machine.builder().build_machine()?;
        let mut drawing = self.program(self.nc.as_deref().unwrap_or_default(), &commons)?;
        let notes = &mut drawing.notes;
        notes.source_name.clone_from(&self.cl_name);
        notes.source = Some(self.cl.clone());
        let mut numbers = HashMap::new();
        let mut line = 0;
        for origin in &self.origins {
            if let Some(row) = origin.as_u64() {
                // A program has no more lines than letters.
                let row = row.min(self.nc.as_ref().map_or(0, String::len) as u64) as u32;
                notes
                    .causes
                    .extend((1..=row).map(|next| LineCause { line: line + next, stack: 0 }));
                line += row;
                continue;
            }
            line = origin[0].as_u64().map_or(line, |line| line as u32);
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
