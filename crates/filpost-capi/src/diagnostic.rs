//! Errors and warnings as structs and as JSON.

use std::ffi::{CString, c_char};

use filpost::{Diag, Finding};
use serde_json::Value;

use crate::pointer::c_text;

/// How bad a diagnostic is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The run goes on; the NC program is written.
    Warning,
    /// There is no NC program.
    Error,
}

/// An error or a warning. Its texts live as long as what it was asked of.
#[repr(C)]
pub struct Diagnostic {
    /// `E0501` or `W0151`; `USAGE` for a wrong call, `FAULT` for a fault of the library.
    pub code: *const c_char,
    /// Error or warning.
    pub severity: Severity,
    /// What the code means, in a few words.
    pub title: *const c_char,
    /// What is wrong here.
    pub message: *const c_char,
    /// The CL, FIL or machine file; NULL without a place.
    pub file: *const c_char,
    /// Line of the file, from 1; 0 without a place.
    pub line: u32,
    /// Column in characters, from 1; 0 without a place.
    pub column: u32,
    /// What can be done.
    pub hint: *const c_char,
}

/// The texts behind a [`Diagnostic`].
pub struct Held {
    pub code: CString,
    severity: Severity,
    title: CString,
    message: CString,
    file: Option<CString>,
    line: u32,
    column: u32,
    hint: CString,
    notes: Vec<String>,
}

impl Held {
    fn new(diag: &Diag) -> Self {
        let place = diag.spans.first();
        Held {
            code: c_text(&diag.code.name()),
            severity: if diag.is_error() { Severity::Error } else { Severity::Warning },
            title: c_text(diag.code.title),
            message: c_text(&diag.message),
            file: place.map(|place| c_text(&place.file)),
            line: place.map_or(0, |place| place.line),
            column: place.map_or(0, |place| place.column() as u32),
            hint: c_text(diag.hint.as_deref().unwrap_or(diag.code.hint)),
            notes: diag.notes.clone(),
        }
    }

    /// A diagnostic of the border itself, which has no code page.
    pub fn own(code: &str, title: &str, message: &str, hint: &str) -> Self {
        Held {
            code: c_text(code),
            severity: Severity::Error,
            title: c_text(title),
            message: c_text(message),
            file: None,
            line: 0,
            column: 0,
            hint: c_text(hint),
            notes: Vec::new(),
        }
    }

    fn as_c(&self) -> Diagnostic {
        Diagnostic {
            code: self.code.as_ptr(),
            severity: self.severity,
            title: self.title.as_ptr(),
            message: self.message.as_ptr(),
            file: self.file.as_ref().map_or(std::ptr::null(), |file| file.as_ptr()),
            line: self.line,
            column: self.column,
            hint: self.hint.as_ptr(),
        }
    }

    /// The same fields as `filpost check --format json`.
    fn as_json(&self) -> Value {
        let has_place = self.file.is_some();
        let severity = match self.severity {
            Severity::Warning => filpost::Severity::Warning,
            Severity::Error => filpost::Severity::Error,
        };
        let finding = Finding {
            code: self.code.to_string_lossy(),
            severity: severity.name(),
            title: self.title.to_string_lossy(),
            message: self.message.to_string_lossy(),
            file: self.file.as_ref().map(|file| file.to_string_lossy()),
            line: has_place.then_some(self.line),
            column: has_place.then_some(self.column as usize),
            hint: self.hint.to_string_lossy(),
            notes: &self.notes,
        };
        finding.to_json()
    }
}

/// Diagnostics that C may ask for.
pub struct Diagnostics {
    pub list: Vec<Held>,
    json: CString,
}

impl Diagnostics {
    pub fn new(diags: &[Diag]) -> Self {
        Diagnostics::of(diags.iter().map(Held::new).collect())
    }

    pub fn of(list: Vec<Held>) -> Self {
        let json: Value = list.iter().map(Held::as_json).collect();
        Diagnostics { json: c_text(&json.to_string()), list }
    }

    /// The diagnostic of an index.
    pub fn get(&self, index: usize) -> Option<Diagnostic> {
        self.list.get(index).map(Held::as_c)
    }

    pub fn json(&self) -> *const c_char {
        self.json.as_ptr()
    }
}
