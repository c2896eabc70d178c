//! Diagnostics as JSON.

use filpost::{Diag, Severity};
use serde_json::{Value, json};

/// Findings as an array, one object each; line and column from 1.
pub fn findings(diags: &[Diag]) -> Value {
    diags.iter().map(finding).collect()
}

fn finding(diag: &Diag) -> Value {
    let place = diag.spans.first();
    json!({
        "code": diag.code.name(),
        "severity": match diag.code.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        },
        "title": diag.code.title,
        "message": diag.message,
        "file": place.map(|place| &place.file),
        "line": place.map(|place| place.line),
        "column": place.map(filpost::TextSpan::column),
        "hint": diag.hint.as_deref().unwrap_or(diag.code.hint),
        "notes": diag.notes,
    })
}
