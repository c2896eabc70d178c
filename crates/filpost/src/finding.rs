//! Diagnostics as data for other programs: the fields of `filpost check --format json` and
//! of the C library.

use std::borrow::Cow;

use fil_diag::{Diag, TextSpan};
use serde::Serialize;
use serde_json::{Value, json};

/// A diagnostic with its first place; line and column count from 1, the column in
/// characters.
///
/// ```
/// let program = filpost::Program::builder().ready("fanuc-mill").fil("a.fil", "XX=\n").build();
/// let error = program.err().expect("the FIL is wrong");
/// let found = filpost::Finding::from(&error.diags()[0]);
/// assert_eq!((found.file.as_deref(), found.line), (Some("a.fil"), Some(1)));
/// assert!(found.to_json()["hint"].is_string());
/// ```
#[derive(Clone, Debug, Serialize)]
pub struct Finding<'a> {
    /// `E0501` or `W0151`.
    pub code: Cow<'a, str>,
    /// `error` or `warning`.
    pub severity: &'static str,
    /// What the code means, in a few words.
    pub title: Cow<'a, str>,
    /// What is wrong here.
    pub message: Cow<'a, str>,
    /// The CL, FIL or machine file.
    pub file: Option<Cow<'a, str>>,
    /// Line of the file.
    pub line: Option<u32>,
    /// Column of the line.
    pub column: Option<usize>,
    /// What can be done.
    pub hint: Cow<'a, str>,
    /// Further lines.
    pub notes: &'a [String],
}

impl<'a> From<&'a Diag> for Finding<'a> {
    fn from(diag: &'a Diag) -> Self {
        let place = diag.spans.first();
        Finding {
            code: diag.code.name().into(),
            severity: diag.severity().name(),
            title: diag.code.title.into(),
            message: diag.message.as_str().into(),
            file: place.map(|place| place.file.as_str().into()),
            line: place.map(|place| place.line),
            column: place.map(TextSpan::column),
            hint: diag.advice().into(),
            notes: &diag.notes,
        }
    }
}

impl Finding<'_> {
    /// The fields as a JSON object; what there is not is null.
    pub fn to_json(&self) -> Value {
        json!(self)
    }
}
