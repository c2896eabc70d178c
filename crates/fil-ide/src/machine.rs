//! `machine.toml` in an editor: keys with their rows of the table of settings.

use filpost::locations::{Location, TABLE};
use filpost::{Diag, settings};

use crate::actions::Fix;
use crate::complete::{Item, ItemKind};
use crate::navigate::{Edit, Place};
use crate::script::Finding;
use crate::symbols::{Outline, OutlineKind};
use crate::tables;
use crate::text::{Position, Range, Text};

/// Reads a `machine.toml` that may begin from a ready post: the warnings, or what is wrong.
fn read(name: &str, text: &str) -> Result<Vec<Diag>, Vec<Diag>> {
    let ready = |base: &str| filpost::ready::find(base).map(|post| post.machine);
    settings::read_toml_with(name, text, &ready).map(|(_, warnings)| warnings)
}

/// What is wrong in a `machine.toml`.
pub fn findings(name: &str, text: &Text) -> Vec<Finding> {
    let diags = read(name, text.as_str()).unwrap_or_else(|diags| diags);
    let found = diags.iter().map(|diag| {
        let place = diag.spans.first();
        let line = place.map_or(0, |place| (place.line as usize).saturating_sub(1));
        let bytes = text.line_bytes(line);
        let from =
            place.map_or(bytes.start, |place| (bytes.start + place.span.start).min(bytes.end));
        let to =
            place.map_or(bytes.end, |place| (bytes.start + place.span.end).clamp(from, bytes.end));
        let hint = diag.hint.as_deref().unwrap_or(diag.code.hint).to_string();
        let message = format!("{}\n{hint}", diag.message);
        let range = text.range(from..to);
        Finding { range, code: diag.code, severity: diag.severity, message, hint }
    });
    found.collect()
}

/// Repairs for what is wrong in some lines of a `machine.toml`: the setting that was meant.
pub fn fixes(name: &str, text: &Text, range: Range) -> Vec<Fix> {
    let here = |finding: &Finding| {
        finding.range.start.line <= range.end.line && finding.range.end.line >= range.start.line
    };
    let mut found = Vec::new();
    for finding in findings(name, text).into_iter().filter(here) {
        let Some(meant) = finding.hint.strip_prefix("did you mean ") else { continue };
        for meant in meant.split('?').next().unwrap_or_default().split(" or ") {
            let line = finding.range.start.line as usize;
            let Some((bytes, new)) = meant_edit(text, line, meant) else { continue };
            let place = Place { file: name.to_string(), range: text.range(bytes) };
            let (title, edits) = (format!("write {meant}"), vec![Edit { place, text: new }]);
            found.push(Fix { title, edits, finding: finding.clone(), preferred: true });
        }
    }
    found
}

/// The edit that makes the key of a line another one: its own word, or the table above it.
fn meant_edit(text: &Text, line: usize, meant: &str) -> Option<(std::ops::Range<usize>, String)> {
    let (own, bytes) = key_at(text, line)?;
    let Some(table) = table_of(text, line) else { return Some((bytes, meant.to_string())) };
    if let Some(name) = meant.strip_prefix(table).and_then(|rest| rest.strip_prefix('.')) {
        return Some((bytes, name.to_string()));
    }
    let (meant_table, name) = meant.rsplit_once('.')?;
    if own.strip_prefix(table)?.strip_prefix('.')? != name {
        return None;
    }
    let head = (0..line).rev().find(|above| text.line(*above).trim().starts_with('['))?;
    let bytes = text.line_bytes(head);
    let start = bytes.start + text.line(head).find(table)?;
    Some((start..start + table.len(), meant_table.to_string()))
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

/// The keys with their values as they are written; those over several lines are left out.
pub fn values(text: &Text) -> Vec<(String, String)> {
    let values = (0..text.line_count()).filter_map(|line| {
        let (key, _) = key_at(text, line).filter(|_| text.line(line).contains('='))?;
        let bytes = value_bytes(text, line).ok()?;
        Some((key, text.as_str()[bytes].to_string()))
    });
    values.collect()
}

/// The default of a setting as it is shown.
pub fn default_of(row: &Location) -> String {
    tables::value(row.default_value())
}

/// The edit that gives a key a value as TOML writes it, or takes the key away.
///
/// # Errors
/// Why not, in a sentence: a value that the key can't have, a value over several lines.
pub fn edit(text: &Text, key: &str, value: Option<&str>) -> Result<(Range, String), String> {
    if value.is_some_and(|value| value.contains(['\n', '\r'])) {
        return Err("a value over several lines is edited in the text".to_string());
    }
    let found = (0..text.line_count()).find(|line| {
        key_at(text, *line).is_some_and(|(own, _)| own == key.replace(' ', ""))
            && text.line(*line).contains('=')
    });
    let (bytes, new) = match (found, value) {
        (None, None) => return Err(format!("{key} is not in this file")),
        (Some(line), None) => (whole_line(text, line)?, String::new()),
        (Some(line), Some(value)) => (value_bytes(text, line)?, value.to_string()),
        (None, Some(value)) => added(text, key, value),
    };
    let whole = text.as_str();
    let after = format!("{}{new}{}", &whole[..bytes.start], &whole[bytes.end..]);
    let errors = |text: &str| read("machine.toml", text).err().unwrap_or_default();
    let before = errors(whole).len();
    let wrong = errors(&after);
    if wrong.len() > before {
        let diag = wrong.last();
        return Err(diag.map_or_else(String::new, |diag| diag.message.clone()));
    }
    Ok((text.range(bytes), new))
}

/// Where a new key goes: behind the last line of its table, else in a new table at the end.
fn added(text: &Text, key: &str, value: &str) -> (std::ops::Range<usize>, String) {
    // A name in quotes may have points: `effects."G65 P1.5"`.
    let (table, name) = match key.find(".\"").or_else(|| key.rfind('.')) {
        Some(at) => (Some(&key[..at]), &key[at + 1..]),
        None => (None, key),
    };
    let mut of_table = (0..text.line_count()).filter(|line| {
        let own = text.line(*line).trim();
        let heads = own.strip_prefix('[').and_then(|rest| rest.split(']').next()).map(str::trim);
        let within = heads.or_else(|| table_of(text, *line)) == table;
        within && !own.is_empty() && !own.starts_with('#')
    });
    let end = text.as_str().len();
    match of_table.next_back() {
        Some(line) => {
            let at = text.line_bytes(line).end;
            (at..at, format!("\n{name} = {value}"))
        }
        None if table.is_none() => (0..0, format!("{name} = {value}\n")),
        None => {
            let gap = if text.as_str().is_empty() || text.as_str().ends_with("\n\n") {
                ""
            } else if text.as_str().ends_with('\n') {
                "\n"
            } else {
                "\n\n"
            };
            let table = table.unwrap_or_default();
            (end..end, format!("{gap}[{table}]\n{name} = {value}\n"))
        }
    }
}

/// The bytes of the value of a line, without the comment behind it.
fn value_bytes(text: &Text, line: usize) -> Result<std::ops::Range<usize>, String> {
    let bytes = text.line_bytes(line);
    let own = text.line(line);
    let from = own.find('=').map_or(own.len(), |at| at + 1);
    let (mut quote, mut depth, mut to) = (None, 0i32, own.len());
    for (at, sign) in own.char_indices().skip_while(|(at, _)| *at < from) {
        match (sign, quote) {
            ('"' | '\'', None) => quote = Some(sign),
            (_, Some(open)) if sign == open => quote = None,
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth -= 1,
            ('#', None) => {
                to = at;
                break;
            }
            _ => {}
        }
    }
    if depth != 0 || quote.is_some() || own.contains("\"\"\"") {
        return Err("a value over several lines is edited in the text".to_string());
    }
    let value = &own[from..to];
    let start = from + value.len() - value.trim_start().len();
    let end = start + value.trim().len();
    Ok(bytes.start + start..bytes.start + end)
}

/// A line with its end.
fn whole_line(text: &Text, line: usize) -> Result<std::ops::Range<usize>, String> {
    value_bytes(text, line)?;
    let bytes = text.line_bytes(line);
    let end =
        if line + 1 < text.line_count() { text.line_bytes(line + 1).start } else { bytes.end };
    Ok(bytes.start..end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_value_is_refused_in_a_machine_that_begins_from_a_ready_post() {
        for text in ["", "base = \"haas-mill\"\n"] {
            let text = Text::new(text);
            assert!(edit(&text, "program.number", Some("\"many\"")).is_err());
            assert!(edit(&text, "program.number", Some("12")).is_ok());
        }
    }
}
