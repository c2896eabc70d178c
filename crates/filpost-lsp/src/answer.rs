//! From what `fil-ide` finds to values of the protocol.

use fil_ide::{Edit, Finding, Fix, Item, ItemKind, Outline, OutlineKind, Position, Range, Token};
use filpost::Severity;
use serde_json::{Map, Value, json};

pub(crate) fn position(position: Position) -> Value {
    json!({ "line": position.line, "character": position.character })
}

pub(crate) fn range(range: Range) -> Value {
    json!({ "start": position(range.start), "end": position(range.end) })
}

/// A place of the protocol.
pub(crate) fn read_position(value: &Value) -> Option<Position> {
    let number = |name: &str| u32::try_from(value.get(name)?.as_u64()?).ok();
    Some(Position { line: number("line")?, character: number("character")? })
}

/// A range of the protocol.
pub(crate) fn read_range(value: &Value) -> Option<Range> {
    Some(Range {
        start: read_position(value.get("start")?)?,
        end: read_position(value.get("end")?)?,
    })
}

pub(crate) fn finding(found: &Finding) -> Value {
    let severity = match found.severity {
        Severity::Error => 1,
        Severity::Warning => 2,
    };
    json!({
        "range": range(found.range),
        "severity": severity,
        "code": found.code.name(),
        "source": "filpost",
        "message": found.message,
    })
}

pub(crate) fn item(item: &Item) -> Value {
    let kind = match item.kind {
        ItemKind::Keyword => 14,
        ItemKind::Function | ItemKind::Macro => 3,
        ItemKind::Word => 20,
        ItemKind::Variable => 6,
        ItemKind::Label => 18,
        ItemKind::Number => 12,
        ItemKind::Setting => 10,
    };
    json!({
        "label": item.label,
        "kind": kind,
        "detail": item.detail,
        "filterText": item.label,
        "textEdit": { "range": range(item.range), "newText": item.label },
    })
}

pub(crate) fn outline(entry: &Outline) -> Value {
    json!({
        "name": entry.name,
        "kind": kind_of(entry.kind),
        "range": range(entry.whole),
        "selectionRange": range(entry.range),
        "children": entry.children.iter().map(outline).collect::<Vec<_>>(),
    })
}

/// A symbol with its file, for a search in all of them.
pub(crate) fn symbol(entry: &Outline, uri: &str) -> Value {
    json!({
        "name": entry.name,
        "kind": kind_of(entry.kind),
        "location": { "uri": uri, "range": range(entry.range) },
    })
}

fn kind_of(kind: OutlineKind) -> u32 {
    match kind {
        OutlineKind::Section => 5,
        OutlineKind::Macro => 12,
        OutlineKind::Label => 20,
        OutlineKind::Array => 18,
        OutlineKind::Variable => 13,
        OutlineKind::Group => 3,
    }
}

/// Edits by the document they change.
pub(crate) fn workspace_edit(edits: &[Edit], uri: impl Fn(&str) -> String) -> Value {
    let mut changes = Map::new();
    for edit in edits {
        let list = changes.entry(uri(&edit.place.file)).or_insert_with(|| json!([]));
        if let Some(list) = list.as_array_mut() {
            list.push(json!({ "range": range(edit.place.range), "newText": edit.text }));
        }
    }
    json!({ "changes": changes })
}

pub(crate) fn fix(fix: &Fix, uri: impl Fn(&str) -> String) -> Value {
    json!({
        "title": fix.title,
        "kind": "quickfix",
        "isPreferred": fix.preferred,
        "diagnostics": [finding(&fix.finding)],
        "edit": workspace_edit(&fix.edits, uri),
    })
}

/// The five numbers of each token, counted from the one before.
pub(crate) fn tokens(tokens: &[Token]) -> Value {
    let mut data: Vec<u32> = Vec::with_capacity(tokens.len() * 5);
    let mut last = Position::default();
    for token in tokens {
        let start = token.range.start;
        let line = start.line - last.line;
        let character = if line == 0 { start.character - last.character } else { start.character };
        let length = token.range.end.character - start.character;
        data.extend([line, character, length, token.kind as u32, 0]);
        last = start;
    }
    json!({ "data": data })
}
