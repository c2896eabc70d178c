//! Diagnostics as JSON.

#[cfg(any(feature = "post", feature = "plot"))]
use fil_ide::Edit;
#[cfg(feature = "post")]
use fil_ide::repairs::of_diag;
#[cfg(any(feature = "post", feature = "plot"))]
use fil_ide::repairs::{Act, Repair};
#[cfg(feature = "plot")]
use fil_ide::repairs::{of_finding, of_open};
#[cfg(feature = "post")]
use filpost::Commons;
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

/// All of several that a post says, with their `repairs`; `machine` is the one it ran on, where it could be read.
#[cfg(feature = "post")]
pub(crate) fn all_repaired<'d>(
    diags: impl IntoIterator<Item = &'d Diag>,
    machine: Option<&Commons>,
    cl_name: &str,
) -> Vec<Value> {
    let repaired = |diag: &Diag| {
        let mut said = diagnostic(diag);
        said["repairs"] = repairs(&of_diag(diag, machine, cl_name));
        said
    };
    diags.into_iter().map(repaired).collect()
}

/// Repairs as `{title}` with `set`, the key and the value of a setting, or `show`, the key of one, or `edits`.
#[cfg(any(feature = "post", feature = "plot"))]
pub(crate) fn repairs(found: &[Repair]) -> Value {
    let edit = |edit: &Edit| {
        json!({
            "file": edit.place.file, "range": crate::places(edit.place.range), "text": edit.text,
        })
    };
    let repair = |Repair { title, act }: &Repair| match act {
        Act::Set { key, value } => json!({ "title": title, "set": [key, value] }),
        Act::Show(key) => json!({ "title": title, "show": key }),
        Act::Write(edits) => {
            json!({ "title": title, "edits": edits.iter().map(edit).collect::<Vec<_>>() })
        }
    };
    found.iter().map(repair).collect()
}

/// Gives the findings of a check, and what it could not compare, their `repairs`.
#[cfg(feature = "plot")]
pub(crate) fn repair_findings(answer: &mut Value) {
    let text = |of: &Value, key: &str| of[key].as_str().unwrap_or_default().to_string();
    for finding in answer["findings"].as_array_mut().into_iter().flatten() {
        let found = of_finding(&text(finding, "kind"), &text(finding, "message"));
        finding["repairs"] = repairs(&found);
    }
    for open in answer["not_compared"].as_array_mut().into_iter().flatten() {
        if open.is_object() {
            open["repairs"] = repairs(&of_open(&text(open, "what")));
        }
    }
}

/// All of several.
pub(crate) fn all<'d>(diags: impl IntoIterator<Item = &'d Diag>) -> Vec<Value> {
    diags.into_iter().map(diagnostic).collect()
}
