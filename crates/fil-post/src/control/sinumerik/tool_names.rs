//! Tools by their names, `T="END MILL"`: what TPRINT, or TOOL PATH of NX, says before LOADTL.

use std::collections::BTreeMap;

use fil_cl::Record;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations::{self as loc, ControlFamily, ControlToolCall};

use crate::control::Control;
use crate::errors::PostCode;

/// Longest name of a tool, characters.
const LONGEST: usize = 32;

/// The names of the tools of a CL file.
#[derive(Clone, Debug, Default)]
pub struct ToolNames {
    /// The name that was said last; the next LOADTL takes it.
    said: Option<String>,
    by_number: BTreeMap<i64, String>,
}

impl ToolNames {
    /// The name of a tool.
    ///
    /// # Errors
    /// The CL file has not said it.
    pub fn of(&self, tool: i64) -> Result<&str> {
        match self.by_number.get(&tool) {
            Some(name) => Ok(name),
            None => PostCode::Family.err(format!(
                "tool {tool} by its name (control.tool_call): neither TPRINT nor TOOL PATH named it before its LOADTL"
            )),
        }
    }

    /// LOADTL takes the name that was said before it.
    ///
    /// # Errors
    /// A tool with two names, a name of two tools, and one that the control can't read.
    fn load(&mut self, tool: i64) -> Result<()> {
        let Some(name) = self.said.take() else { return Ok(()) };
        let reads = |c: char| c.is_ascii_graphic() && c != '"' || c == ' ';
        if name.is_empty() || name.len() > LONGEST || !name.chars().all(reads) {
            return PostCode::Family.err(format!(
                "`{name}` as the name of tool {tool}: 1 to {LONGEST} letters of ASCII without quotes \
                 are needed"
            ));
        }
        if let Some(before) = self.by_number.get(&tool).filter(|before| **before != name) {
            return PostCode::Family.err(format!("tool {tool} was `{before}` and is now `{name}`"));
        }
        let same =
            |(other, known): &(&i64, &String)| **other != tool && known.eq_ignore_ascii_case(&name);
        if let Some((other, _)) = self.by_number.iter().find(same) {
            return PostCode::Family
                .err(format!("`{name}` is the name of tool {other} and of tool {tool}"));
        }
        self.by_number.insert(tool, name);
        Ok(())
    }
}

/// True for a machine that calls tools by the names of the CL file.
pub fn are_called(control: &Control) -> bool {
    control.tables.family == ControlFamily::Sinumerik
        && control.commons.read(loc::CONTROL_TOOL_CALL) == ControlToolCall::Name
}

/// Takes the name of the tool up that comes next: the first text of TPRINT, or what stands
/// behind TOOL in TOOL PATH of NX.
pub fn note(control: &mut Control, record: &Record) {
    let text = match record.major {
        w::TPRINT => record.text.split(',').next(),
        w::TOOL_PATH => record.text.splitn(3, ',').nth(2),
        _ => return,
    };
    if are_called(control) {
        control.sinumerik.tool_names.said = text.map(|text| text.trim().to_string());
    }
}

/// A tool comes: it has the name that was said last.
///
/// # Errors
/// As [`ToolNames`] refuses names.
pub fn load(control: &mut Control, tool: i64) -> Result<()> {
    if are_called(control) { control.sinumerik.tool_names.load(tool) } else { Ok(()) }
}
