//! `machine.toml` in an editor: keys with their rows of the table of settings.

use filpost::locations::{Location, TABLE};
use filpost::{Diag, settings};

use crate::complete::{Item, ItemKind};
use crate::symbols::{Outline, OutlineKind};
use crate::tables;
use crate::text::{Position, Range, Text};

/// What is wrong in a `machine.toml`: place, code, sentence with its hint.
pub fn findings(name: &str, text: &Text) -> Vec<(Range, &'static filpost::Code, String)> {
    let diags: Vec<Diag> = match settings::read_toml(name, text.as_str()) {
        Ok((_, warnings)) => warnings,
        Err(diags) => diags,
    };
    let found = diags.iter().map(|diag| {
        let place = diag.spans.first();
        let line = place.map_or(0, |place| (place.line as usize).saturating_sub(1));
        let bytes = text.line_bytes(line);
        let from =
            place.map_or(bytes.start, |place| (bytes.start + place.span.start).min(bytes.end));
        let to =
            place.map_or(bytes.end, |place| (bytes.start + place.span.end).clamp(from, bytes.end));
        let hint = diag.hint.as_deref().unwrap_or(diag.code.hint);
        (text.range(from..to), diag.code, format!("{}\n{hint}", diag.message))
    });
    found.collect()
}

/// The dotted key of a line: the table above it and what stands before `=`.
fn key_at(text: &Text, line: usize) -> Option<(String, std::ops::Range<usize>)> {
    let own = text.line(line);
    let name = own.split('=').next().unwrap_or(own);
    let trimmed = name.trim();
    if trimmed.is_empty() || trimmed.starts_with(['#', '[']) {
        return None;
    }
    let start = text.line_bytes(line).start + name.len() - name.trim_start().len();
    let key = match table_of(text, line) {
        Some(table) => format!("{table}.{trimmed}"),
        None => trimmed.to_string(),
    };
    Some((key.replace(' ', ""), start..start + trimmed.len()))
}

/// The `[table]` that a line stands in.
fn table_of(text: &Text, line: usize) -> Option<&str> {
    (0..line.min(text.line_count())).rev().find_map(|above| {
        let above = text.line(above).trim();
        above.strip_prefix('[')?.split(']').next().map(str::trim)
    })
}

/// The row of the key at a place.
pub fn hover(text: &Text, position: Position) -> Option<(String, Range)> {
    let (key, bytes) = key_at(text, position.line as usize)?;
    let row = Location::named(&key)?;
    Some((tables::location(row), text.range(bytes)))
}

/// Keys at the start of a line, choices behind `=`.
pub fn complete(text: &Text, position: Position) -> Vec<Item> {
    let line = position.line as usize;
    let byte = text.byte(position);
    let start = text.line_bytes(line).start;
    let head = &text.as_str()[start..byte];
    if head.trim_start().starts_with(['#', '[']) {
        return Vec::new();
    }
    if let Some((_, value)) = head.split_once('=') {
        let Some(row) = key_at(text, line).and_then(|(key, _)| Location::named(&key)) else {
            return Vec::new();
        };
        let typed = value.trim_start().len();
        let range = text.range(byte - typed..byte);
        let choices = row.choice_list().into_iter().map(|(number, meaning)| Item {
            label: number.to_string(),
            kind: ItemKind::Number,
            detail: meaning.to_string(),
            range,
        });
        return choices.collect();
    }
    let typed = head.trim_start().len();
    let range = text.range(byte - typed..byte);
    let prefix = table_of(text, line).map_or_else(String::new, |table| format!("{table}."));
    let rows = TABLE.iter().filter_map(|row| Some((row, row.name.strip_prefix(&prefix)?)));
    let items = rows.map(|(row, key)| {
        let acts = if row.used { "" } else { " (the post does not act on it)" };
        let detail = format!("{}{acts}", row.meaning);
        Item { label: key.to_string(), kind: ItemKind::Setting, detail, range }
    });
    items.collect()
}

/// Tables and their keys.
pub fn outline(text: &Text) -> Vec<Outline> {
    let mut found: Vec<Outline> = Vec::new();
    for line in 0..text.line_count() {
        let bytes = text.line_bytes(line);
        let own = text.line(line).trim();
        let range = text.range(bytes);
        if let Some(table) = own.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
            let (name, kind) = (table.trim().to_string(), OutlineKind::Group);
            found.push(Outline { name, kind, whole: range, range, children: Vec::new() });
        } else if let Some((key, key_bytes)) = key_at(text, line).filter(|_| own.contains('=')) {
            let range = text.range(key_bytes);
            let kind = OutlineKind::Variable;
            let entry = Outline { name: key, kind, whole: range, range, children: Vec::new() };
            match found.last_mut().filter(|last| last.kind == OutlineKind::Group) {
                Some(table) => {
                    table.whole.end = range.end;
                    table.children.push(entry);
                }
                None => found.push(entry),
            }
        }
    }
    found
}
