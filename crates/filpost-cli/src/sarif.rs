//! Diagnostics as SARIF 2.1.0, the form that code hosts and editors read.

use filpost::{Code, Diag, TextSpan};
use serde_json::{Value, json};

use crate::render::shown_excerpt;

/// The schema of the form.
const SCHEMA: &str = "https://json.schemastore.org/sarif-2.1.0.json";

/// A log with one run; its rules are the codes that were raised, in the order
/// of their numbers.
pub fn log(diags: &[Diag]) -> Value {
    let mut rules: Vec<&Code> = diags.iter().map(|diag| diag.code).collect();
    rules.sort_by_key(|code| code.number);
    rules.dedup();
    let results: Vec<Value> = diags.iter().map(|diag| result(diag, &rules)).collect();
    json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "filpost",
                "version": env!("CARGO_PKG_VERSION"),
                "informationUri": env!("CARGO_PKG_REPOSITORY"),
                "rules": rules.iter().map(|code| rule(code)).collect::<Vec<_>>(),
            }},
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    })
}

fn rule(code: &Code) -> Value {
    json!({
        "id": code.name(),
        "shortDescription": { "text": code.title },
        "fullDescription": { "text": code.reason },
        "help": { "text": code.hint },
        "defaultConfiguration": { "level": code.severity().name() },
    })
}

fn result(diag: &Diag, rules: &[&Code]) -> Value {
    let hint = diag.hint.as_deref().map_or_else(String::new, |hint| format!(" ({hint})"));
    let (first, others) = diag.spans.split_first().map_or((None, &[][..]), |(f, o)| (Some(f), o));
    let mut result = json!({
        "ruleId": diag.code.name(),
        "ruleIndex": rules.iter().position(|code| *code == diag.code),
        "level": diag.severity().name(),
        "message": { "text": format!("{}{hint}", diag.message) },
        "locations": first.into_iter().map(location).collect::<Vec<_>>(),
    });
    if !others.is_empty() {
        result["relatedLocations"] = others.iter().map(location).collect();
    }
    result
}

/// A place; columns count characters from 1 and end behind the last one.
fn location(place: &TextSpan) -> Value {
    let marked = place.excerpt.get(place.span.clone()).unwrap_or_default();
    let column = place.column();
    json!({
        "physicalLocation": {
            "artifactLocation": { "uri": uri(&place.file) },
            "region": {
                "startLine": place.line,
                "startColumn": column,
                "endColumn": column + marked.chars().count(),
                "snippet": { "text": shown_excerpt(place).0 },
            },
        },
    })
}

/// A file name as a URI reference: what is not plain ASCII is escaped.
fn uri(file: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte);
    file.bytes()
        .map(|byte| match byte {
            b'\\' => "/".to_string(),
            byte if is_plain(byte) => char::from(byte).to_string(),
            byte => format!("%{byte:02X}"),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Value {
        let fil = "CIMFIL/ON,CYCLE\nXX=POSTF(7,9)\nLA) DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
        log(&filpost::check::check(&[("my posts/a.fil", fil)], Default::default()))
    }

    #[test]
    fn rules_and_results_belong_together() {
        let log = sample();
        let run = &log["runs"][0];
        let rules = run["tool"]["driver"]["rules"].as_array().expect("rules");
        let results = run["results"].as_array().expect("results");
        assert_eq!(log["version"], "2.1.0");
        assert_eq!(results.len(), 2);
        for result in results {
            let index = result["ruleIndex"].as_u64().expect("an index");
            assert_eq!(rules[index as usize]["id"], result["ruleId"]);
            assert!(!result["message"]["text"].as_str().expect("a text").is_empty());
        }
    }

    #[test]
    fn places_are_lines_and_columns_of_a_uri() {
        let log = sample();
        let place = &log["runs"][0]["results"][0]["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "my%20posts/a.fil");
        let region = &place["region"];
        assert_eq!(
            (&region["startLine"], &region["startColumn"], &region["endColumn"]),
            (&json!(2), &json!(4), &json!(14))
        );
    }
}
