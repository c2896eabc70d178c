//! Warnings of a run: each code and subject once, and never without end.

use std::collections::HashSet;

use fil_diag::{Code, Diag, Levels};

use crate::errors::PostCode;

/// Most warnings of one run.
const MOST: usize = 1000;

/// The warnings of a run.
#[derive(Clone, Debug, Default)]
pub struct Warnings {
    /// Those not yet taken away.
    pub list: Vec<Diag>,
    /// Levels that the user has set.
    pub levels: Levels,
    known: HashSet<(u16, String)>,
}

impl Warnings {
    /// Warns once per code and subject; a run that warns without end stops at
    /// a thousand, so that memory does not grow with the CL file.
    pub fn add(&mut self, code: PostCode, message: String) {
        self.add_with(code, message, || None);
    }

    /// The same with a hint made for this case when the warning is a new one.
    pub fn add_with(
        &mut self,
        code: PostCode,
        message: String,
        hint: impl FnOnce() -> Option<String>,
    ) {
        let code: &'static Code = code.into();
        if self.is_new(code, &message) {
            let note = self.note();
            self.list.push(Diag { hint: hint(), ..Diag::new(code, message + note) });
        }
    }

    /// The same for a warning of another crate.
    pub fn add_made(&mut self, mut diag: Diag) {
        if self.is_new(diag.code, &diag.message) {
            diag.message += self.note();
            self.list.push(diag);
        }
    }

    fn is_new(&mut self, code: &'static Code, message: &str) -> bool {
        self.known.len() < MOST && self.known.insert((code.number, message.to_string()))
    }

    fn note(&self) -> &'static str {
        if self.known.len() == MOST { "; further warnings are not listed" } else { "" }
    }
}
