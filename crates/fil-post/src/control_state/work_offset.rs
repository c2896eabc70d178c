//! The work offset in force: its code, with the number that some codes have beside them.

use std::fmt;

use fil_machine::FunctionCode;

/// A work offset of the control: G54, G54.1 P3, G15 H2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkOffset {
    /// The code that chooses it.
    pub code: FunctionCode,
    /// The word beside the code, as its value; `None` for a code that has none.
    pub number: Option<i32>,
}

impl WorkOffset {
    /// The offset of a code of its own.
    pub const fn plain(code: FunctionCode) -> Self {
        WorkOffset { code, number: None }
    }
}

impl fmt::Display for WorkOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.number {
            Some(number) => write!(f, "G{} with number {number}", self.code),
            None => write!(f, "G{}", self.code),
        }
    }
}
