//! What an editor asks of a text: findings, hover, proposals.

use fil_ide::{Edit, Finding, Fix, Item, Position, Range, Script, Text, cl_file, machine};
use filpost::{Commons, Included, settings};
use serde_json::{Value, json};

use crate::Misuse;
use crate::fields::{Fields, Named};

/// What language a text is in.
#[derive(Clone, Copy)]
enum Language {
    Fil,
    Cl,
    Machine,
}

/// An edited text, and a place in it.
pub(crate) struct Edited {
    language: Language,
    name: String,
    text: String,
    /// Line, counted from 0.
    line: u32,
    /// UTF-16 units from the start of the line.
    character: u32,
    /// The `machine.toml` that FIL runs on.
    machine: Option<String>,
    includes: Vec<Named>,
}

impl Edited {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let language = match fields.needed("language")?.as_str() {
            "fil" => Language::Fil,
            "cl" => Language::Cl,
            "machine" => Language::Machine,
            other => {
                return Err(Misuse(format!("`language` must be fil, cl or machine, not {other}")));
            }
        };
        let count = |number: Option<u64>| u32::try_from(number.unwrap_or(0)).unwrap_or(u32::MAX);
        let edited = Edited {
            language,
            name: fields.needed("name")?,
            text: fields.needed("text")?,
            line: count(fields.number("line")?),
            character: count(fields.number("character")?),
            machine: fields.text("machine")?,
            includes: fields.files("includes")?,
        };
        fields.end()?;
        Ok(edited)
    }

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
        let position = Position { line: self.line, character: self.character };
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
        let position = Position { line: self.line, character: self.character };
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

    fn with_script<T>(&self, ask: impl FnOnce(&Script) -> T) -> T {
        let mut includes = |_: &str, name: &str| {
            let found = self.includes.iter().find(|file| file.name == name);
            match found {
                Some(file) => Ok(Included { name: file.name.clone(), text: file.text.clone() }),
                None => Err(format!("there is no {name} here")),
            }
        };
        let machine: Option<Commons> = self.machine.as_ref().and_then(|text| {
            let ready = |base: &str| filpost::ready::find(base).map(|post| post.machine);
            settings::read_toml_with("machine.toml", text, &ready).ok().map(|(commons, _)| commons)
        });
        let files = [(self.name.as_str(), self.text.as_str())];
        ask(&Script::new(&files, &self.name, Some(&mut includes), machine.as_ref()))
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

/// A range as `[line, character, line, character]`, from 0.
fn places(range: Range) -> [u32; 4] {
    [range.start.line, range.start.character, range.end.line, range.end.character]
}
