//! What the CL file calls its tools, for machines that call them so.

use std::collections::BTreeMap;

use fil_cl::Record;
use fil_cl::vocabulary::words as w;

use crate::interpret::number_of_tool;

/// Names by the numbers of LOADTL.
#[derive(Clone, Debug, Default)]
pub(super) struct ToolNames {
    /// The machine calls tools by these names.
    pub(super) are_called: bool,
    last: Option<u32>,
    known: BTreeMap<u32, u32>,
}

impl ToolNames {
    /// `TPRINT/NAME[,…]`, `TOOL PATH/PATH,TOOL,NAME`.
    pub(super) fn say(&mut self, record: &Record) {
        let mut parts = record.text.split(',');
        let name = match record.major {
            w::TPRINT => parts.next().map(str::to_string),
            _ => Some(parts.skip(2).collect::<Vec<_>>().join(",")).filter(|name| !name.is_empty()),
        };
        self.last = name.map(|name| number_of_tool(&name));
    }

    /// The number that the program calls the tool by: that of its name.
    pub(super) fn number(&mut self, tool: u32) -> u32 {
        if !self.are_called {
            return tool;
        }
        match self.last.take() {
            Some(named) => {
                self.known.insert(tool, named);
                named
            }
            None => self.known.get(&tool).copied().unwrap_or(tool),
        }
    }
}
