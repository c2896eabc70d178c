//! Outlines, where names are, new names, the call that is written, and the layout of a text.

use fil_ide::{Edit, Outline, OutlineKind, Place, Script, Text, cl_file, machine};
use serde_json::{Value, json};

use super::{Edited, Language};
use crate::places;

impl Edited {
    /// Tools and operations of a CL file, sections and macros of FIL, tables of a machine: `{name, line, children}`
    /// of each, lines from 0.
    pub fn outline(&self) -> Value {
        let found = match self.language {
            Language::Cl => cl_file::outline(&Text::new(&self.text)),
            Language::Machine => machine::outline(&Text::new(&self.text)),
            Language::Fil => self.with_script(|script| script.outline()),
        };
        entries(&found).collect()
    }

    /// Where the name at the place is defined: `{file, range}` of each.
    pub fn definition(&self) -> Value {
        self.in_script(|script| all(&script.definition(self.position())))
    }

    /// Where the name at the place is used, its definition included.
    pub fn references(&self) -> Value {
        self.in_script(|script| all(&script.references(self.position(), true)))
    }

    /// The `edits` that give the name at the place another one, each with `file`, `range` and `text`; or `why` not.
    pub fn rename(&self) -> Value {
        let new = self.new.as_deref().unwrap_or_default();
        let edit = |edit: &Edit| json!({ "file": edit.place.file, "range": places(edit.place.range), "text": edit.text });
        match self.with_script(|script| script.rename(self.position(), new)) {
            Ok(edits) => json!({ "edits": edits.iter().map(edit).collect::<Vec<_>>() }),
            Err(why) => json!({ "why": why }),
        }
    }

    /// The call around the place: `{label, doc, parameters, active}`, or null.
    pub fn signature(&self) -> Value {
        self.in_script(|script| {
            script.signature(self.position()).map_or(Value::Null, |found| {
                json!({
                    "label": found.label, "doc": found.doc, "parameters": found.parameters,
                    "active": found.active,
                })
            })
        })
    }

    /// What stands beside a script: `hints`, each `[line, character, text]`, such as the meaning of a number of POSTF;
    /// and `folds`, each the first and the last line of what can be folded. Lines from 0.
    pub fn beside(&self) -> Value {
        self.in_script(|script| {
            let hints = script
                .inlays()
                .into_iter()
                .map(|hint| json!([hint.position.line, hint.position.character, hint.label]));
            let folds = script.folds().into_iter().map(|fold| json!([fold.first, fold.last]));
            json!({ "hints": hints.collect::<Value>(), "folds": folds.collect::<Value>() })
        })
    }

    /// The `text` of a FIL file laid out as the formatter does; or `why` not.
    pub fn format(&self) -> Value {
        match filpost::syntax::format(&self.name, &self.text) {
            Ok(text) => json!({ "text": text }),
            Err(diags) => {
                json!({ "why": diags.first().map_or(String::new(), |diag| diag.message.clone()) })
            }
        }
    }

    /// Asks a script; other texts have no names.
    fn in_script(&self, ask: impl FnOnce(&Script) -> Value) -> Value {
        match self.language {
            Language::Fil => self.with_script(ask),
            Language::Cl | Language::Machine => Value::Null,
        }
    }
}

/// Entries with those in them. Variables are left out: a script has many, and they have no length.
fn entries(found: &[Outline]) -> impl Iterator<Item = Value> {
    let listed = found.iter().filter(|outline| outline.kind != OutlineKind::Variable);
    listed.map(|outline| {
        json!({
            "name": outline.name,
            "line": outline.range.start.line,
            "children": entries(&outline.children).collect::<Vec<_>>(),
        })
    })
}

fn all(found: &[Place]) -> Value {
    let place = |place: &Place| json!({ "file": place.file, "range": places(place.range) });
    found.iter().map(place).collect()
}
