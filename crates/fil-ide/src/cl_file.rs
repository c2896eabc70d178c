//! CL files in an editor: numbered words of a statement, tools and operations.

use filpost::cl::Vocabulary;

use crate::context::parts;
use crate::symbols::{Outline, OutlineKind};
use crate::tables;
use crate::text::{Position, Range, Text};

/// A statement with its lines, continuations joined.
struct Statement {
    first: usize,
    last: usize,
    text: String,
}

fn continues(line: &str) -> bool {
    let line = line.trim_end();
    line.ends_with('$') && !line.trim_start().starts_with("$$")
}

fn statement_at(text: &Text, line: usize) -> Statement {
    let mut first = line;
    while first > 0 && continues(text.line(first - 1)) {
        first -= 1;
    }
    let mut last = first;
    let mut joined = String::new();
    loop {
        let own = text.line(last).trim_end();
        if continues(own) && last + 1 < text.line_count() {
            joined.push_str(own.trim_end_matches('$'));
            last += 1;
        } else {
            joined.push_str(own);
            return Statement { first, last, text: joined };
        }
    }
}

/// The words of the statement at a place by number, as POSTF(7,n) counts them, and what
/// its major word means.
pub fn hover(text: &Text, position: Position) -> Option<(String, Range)> {
    let statement = statement_at(text, position.line as usize);
    let (major, items) = split(&statement.text)?;
    let coordinates = ["x", "y", "z", "i", "j", "k"];
    let is_motion = matches!(major.as_str(), "GOTO" | "FROM" | "GODLTA");
    let mut shown = format!("```text\n   3  {major}\n");
    if is_motion {
        // A motion record has its number of values at 4 and the record's name at 5.
        shown = "```text\n".to_string();
    }
    let first = if is_motion { 6 } else { 4 };
    for (index, item) in items.iter().enumerate() {
        let name = coordinates.get(index).filter(|_| is_motion).copied().unwrap_or_default();
        shown += &format!("{:>4}  {:<12} {name}\n", index + first, item);
    }
    shown += "```\n";
    let range = Range {
        start: text.range(text.line_bytes(statement.first)).start,
        end: text.range(text.line_bytes(statement.last)).end,
    };
    Some((format!("{shown}\n{}", tables::word(&major)), range))
}

/// Major word and items of a statement; `None` for comments and empty lines.
fn split(statement: &str) -> Option<(String, Vec<String>)> {
    let plain = statement.split("$$").next().unwrap_or_default();
    let (major, rest) = plain.split_once('/').unwrap_or((plain, ""));
    let major = major.trim().to_ascii_uppercase();
    let is_word = !major.is_empty() && major.bytes().all(|byte| byte.is_ascii_alphanumeric());
    if !is_word {
        return None;
    }
    let items = parts(rest).into_iter().map(|item| item.trim().to_string());
    Some((major, items.filter(|item| !item.is_empty()).collect()))
}

/// Tools with the operations that they do: comments of the CAM system that name a feature,
/// cycles, and rapid motions after feed.
pub fn outline(text: &Text) -> Vec<Outline> {
    let vocabulary = Vocabulary::new();
    let mut found: Vec<Outline> = Vec::new();
    for line in 0..text.line_count() {
        let own = text.line(line).trim();
        let range = text.range(text.line_bytes(line));
        let entry = |name: String, kind: OutlineKind| Outline {
            name,
            kind,
            whole: range,
            range,
            children: Vec::new(),
        };
        let feature = own.strip_prefix("$$->").map(str::trim).filter(|rest| {
            rest.starts_with("FEATNO") || rest.starts_with("MFGNO") || rest.starts_with("OPERATION")
        });
        let statement = split(own);
        let major = statement.as_ref().map_or("", |(major, _)| major.as_str());
        let (entry, is_tool) = match (feature, major) {
            (Some(name), _) => (entry(name.to_string(), OutlineKind::Section), false),
            (None, "LOADTL" | "TURRET" | "TOOLNO") => {
                (entry(own.to_string(), OutlineKind::Group), true)
            }
            (None, "CYCLE" | "THREAD" | "PARTNO" | "PPRINT") => {
                (entry(own.to_string(), OutlineKind::Section), false)
            }
            (None, _) => {
                let known = vocabulary.find(major).is_some_and(|id| vocabulary.is_known(id));
                if let Some(last) = found.last_mut().filter(|_| known) {
                    last.whole.end = range.end;
                }
                continue;
            }
        };
        match found.last_mut().filter(|last| !is_tool && last.kind == OutlineKind::Group) {
            Some(tool) => {
                tool.whole.end = range.end;
                tool.children.push(entry);
            }
            None => found.push(entry),
        }
    }
    found
}
