//! An audit as data for other programs.

use serde_json::{Value, json};

use super::{Audit, Author, Change, What};
use crate::verify::finding_as_json;

/// An audit as one object: what `filpost post --audit=FILE` writes and `filpost verify --map`
/// prints with `--format json`.
pub fn as_json(audit: &Audit) -> Value {
    json!({
        "verdict": audit.verdict().name(),
        "changes": audit.changes.iter().map(change).collect::<Value>(),
        "more_changes": audit.more_changes,
        "findings": audit.findings.iter().map(finding_as_json).collect::<Value>(),
        "more": audit.more,
        "not_compared": audit.not_compared,
        "motions": audit.motions.map(|(asked, made)| json!({ "asked": asked, "made": made })),
        "blocks": { "all": audit.blocks, "as_the_post": audit.kept },
    })
}

fn author(author: &Author) -> Value {
    match author {
        Author::Script { place, section } => json!({
            "kind": "script",
            "file": place.as_ref().map(|(file, _)| file),
            "line": place.as_ref().map(|(_, line)| line),
            "section": section,
        }),
        Author::Insert => json!({ "kind": "insert" }),
        Author::Post { after } => {
            json!({ "kind": "post", "after": after.as_deref().map(self::author) })
        }
    }
}

fn change(change: &Change) -> Value {
    let what = match &change.what {
        What::Number { letter, from, to, by } => {
            json!({ "kind": "number", "letter": letter, "from": from, "to": to, "by": by })
        }
        What::Turned { letter, from, to, stays, blocks } => json!({
            "kind": "turned", "letter": letter, "from": from, "to": to, "stays": stays, "motions": blocks,
        }),
        What::Blocks { from, to } => json!({ "kind": "blocks", "from": from, "to": to }),
    };
    json!({
        "author": author(&change.author),
        "cl_lines": change.cl_lines,
        "nc_lines": change.nc_lines,
        "count": change.count,
        "what": what,
        "text": change.sentence(),
    })
}
