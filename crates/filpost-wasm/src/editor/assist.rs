//! Findings and their repairs, hover, proposals.

use fil_ide::{Edit, Finding, Fix, Item, Text, cl_file, machine};
use serde_json::{Value, json};

use super::{Edited, Language};
use crate::places;

impl Edited {
    /// Findings as `{line, from, to_line, to, code, severity, message}`; places as editors
    /// count them. A CL file is judged by posting it.
    pub fn findings(&self) -> Value {
        match self.language {
            Language::Cl => json!([]),
            Language::Machine => {
                let found = machine::findings(&self.name, &Text::new(&self.text)).into_iter();
                found.map(|found| finding(&found)).collect()
            }
            Language::Fil => self.with_script(|script| {
                let found = script.findings().into_iter();
                found.map(|found| finding(&found)).collect()
            }),
        }
    }

    /// Repairs as `{title, code, line, preferred, edits}`: `line` is that of the finding, each edit has
    /// `file`, `range` and `text`.
    pub fn fixes(&self) -> Value {
        let text = Text::new(&self.text);
        let found = match self.language {
            Language::Cl => Vec::new(),
            Language::Machine => machine::fixes(&self.name, &text, text.whole()),
            Language::Fil => self.with_script(|script| script.fixes(text.whole())),
        };
        found.iter().map(fix).collect()
    }

    /// What stands at the place: Markdown and its range, or null.
    pub fn hover(&self) -> Value {
        let position = self.position();
        let found = match self.language {
            Language::Cl => cl_file::hover(&Text::new(&self.text), position),
            Language::Machine => machine::hover(&Text::new(&self.text), position),
            Language::Fil => self.with_script(|script| script.hover(position)),
        };
        found.map_or(
            Value::Null,
            |(markdown, range)| json!({ "markdown": markdown, "range": places(range) }),
        )
    }

    /// What may stand at the place: `{label, detail, kind, range}` of each.
    pub fn complete(&self) -> Value {
        let position = self.position();
        let items: Vec<Item> = match self.language {
            Language::Cl => Vec::new(),
            Language::Machine => machine::complete(&Text::new(&self.text), position),
            Language::Fil => self.with_script(|script| script.complete(position)),
        };
        let item = |item: Item| {
            let kind = format!("{:?}", item.kind).to_ascii_lowercase();
            json!({
                "label": item.label,
                "detail": item.detail,
                "kind": kind,
                "range": places(item.range),
            })
        };
        items.into_iter().map(item).collect()
    }
}

fn finding(found: &Finding) -> Value {
    json!({
        "range": places(found.range),
        "code": found.code.name(),
        "severity": found.severity.name(),
        "message": found.message,
    })
}

fn fix(fix: &Fix) -> Value {
    let edit = |edit: &Edit| json!({ "file": edit.place.file, "range": places(edit.place.range), "text": edit.text });
    json!({
        "title": fix.title,
        "code": fix.finding.code.name(),
        "line": fix.finding.range.start.line,
        "preferred": fix.preferred,
        "edits": fix.edits.iter().map(edit).collect::<Vec<_>>(),
    })
}
