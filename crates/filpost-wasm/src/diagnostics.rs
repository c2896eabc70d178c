//! Diagnostics as JSON.

use filpost::Diag;
use serde_json::{Value, json};

/// A diagnostic: `line` counts from 1, `from` and `to` are UTF-16 units of that line, as
/// pages count.
pub(crate) fn diagnostic(diag: &Diag) -> Value {
    let places = diag.spans.iter().map(|place| {
        let units =
            |end: usize| place.excerpt.get(..end).map_or(0, |head| head.encode_utf16().count());
        json!({
            "file": place.file,
            "line": place.line,
            "from": units(place.span.start),
            "to": units(place.span.end),
            "label": place.label,
        })
    });
    json!({
        "code": diag.code.name(),
        "severity": diag.severity().name(),
        "title": diag.code.title,
        "message": diag.message,
        "hint": diag.hint.as_deref().unwrap_or(diag.code.hint),
        "notes": diag.notes,
        "places": places.collect::<Vec<_>>(),
    })
}

/// All of several.
pub(crate) fn all<'d>(diags: impl IntoIterator<Item = &'d Diag>) -> Vec<Value> {
    diags.into_iter().map(diagnostic).collect()
}
